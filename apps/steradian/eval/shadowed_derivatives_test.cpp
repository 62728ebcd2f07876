// Compares derivatives past occluders with central differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "eval/answer.h"

namespace steradian::eval::shadowed_derivatives_test {
namespace {

using nlohmann::json;

json answer(const json& query) {
  static QueryReader reader;
  std::string line = query.dump(), out;
  const std::size_t size = line.size();
  line.append(kQueryPadding, ' ');
  answer_line(reader, {line.data(), size}, out);
  return json::parse(out);
}

// The value of the green channel.
double value(const json& query, const std::string& judge) {
  json q = query;
  q["method"] = judge;
  const json a = answer(q);
  EXPECT_TRUE(a.contains("radiance")) << a;
  return a["radiance"][1];
}

// The derivative by coordinates at some places of the query that grow together. Cells of the light move with the objects they represent in
// steps of 1.2e-7 of its half side, so the step is no smaller.
constexpr double kStep = 1e-3;
double central_difference(const json& query, const std::vector<json::json_pointer>& places, const std::string& judge) {
  const auto at = [&](double step) {
    json moved = query;
    for (const auto& place : places) moved[place] = moved[place].get<double>() + step;
    return value(moved, judge);
  };
  return (at(kStep) - at(-kStep)) / (2 * kStep);
}

struct Lobe {
  std::string material, method, judge;
};
const Lobe kLobes[] = {
    {R"({"brdf":"lambert","albedo":[0.3,0.7,0.5]})", "exact", "exact"},
    {R"({"brdf":"ggx","alpha":0.3})", "closed-form", "reference"},
    {R"({"brdf":"ggx","alpha_x":0.15,"alpha_y":0.5,"tangent":[1,0,0.3],"f0":0.1})", "closed-form", "reference"},
    {R"({"brdf":"phong","exponent":12})", "series", "exact"},
    {R"({"brdf":"ggx","alpha":0.4})", "ltc", "ltc"},
    {R"({"brdf":"ggx","alpha":0.4})", "ltc-compact", "ltc-compact"},
};

struct Setting {
  std::string name, light, occluders;
  bool plane_turns = true;  // true if the light's vertices also move out of its plane
};
const std::string kBent =
    R"([[[0,1,-1],[0,1,1],[0.6,1.1,1]],[[0,1,-1],[0.6,1.1,1],[0.6,1.1,-1]],[[-0.3,1.2,-0.2],[-0.1,0.9,0.3],[-0.2,1.3,0.4]]])";
const Setting kSettings[] = {
    {"triangle", R"({"type":"polygon","vertices":[[-0.5,2,-0.4],[0.9,2.1,-0.5],[0.3,1.9,0.7]],"radiance":[1,2,3]})", kBent},
    {"from behind", R"({"type":"polygon","vertices":[[0.9,2.1,-0.5],[-0.5,2,-0.4],[0.3,1.9,0.7]],"two_sided":true})", kBent},
    {"hole",
     R"({"type":"polygon","vertices":[[-0.5,2,-0.5],[0.9,2,-0.5],[0.9,2,0.6],[-0.5,2,0.6]],"holes":[[[-0.25,2,-0.2],[-0.25,2,0.3],[-0.05,2,0]]]})",
     kBent, false},
    {"through the light's plane", R"({"type":"polygon","vertices":[[-0.5,2,-0.5],[0.9,2,-0.5],[0.9,2,0.6],[-0.5,2,0.6]]})",
     R"([[[0.1,1.6,-0.9],[0.3,2.4,-0.1],[0.2,1.5,0.5]],[[-0.3,1.2,-0.2],[-0.1,0.9,0.3],[-0.2,1.3,0.4]]])", false},
};

json query_of(const Setting& setting, const Lobe& lobe) {
  return {{"light", json::parse(setting.light)},
          {"position", {0.05, 0, 0.02}},
          {"normal", {0.1, 1, 0}},
          {"view", {-0.5, 1, 0.1}},
          {"material", json::parse(lobe.material)},
          {"method", lobe.method},
          {"occluders", json::parse(setting.occluders)}};
}

json::json_pointer place(const std::string& path, int coordinate) { return json::json_pointer(path + "/" + std::to_string(coordinate)); }

// A derivative, and the parts of the query that move.
struct Move {
  std::string what;
  double derivative;
  std::vector<json::json_pointer> places;
};

std::vector<Move> moves_of(const Setting& setting, const json& query, const json& d) {
  std::vector<Move> moves;
  for (int c = 0; c < 3; ++c) moves.push_back({"position", d["d_position"][1][c], {place("/position", c)}});
  std::size_t number = 0;
  const auto add_vertices = [&](const json& list, const std::string& path) {
    for (std::size_t i = 0; i < list.size(); ++i, ++number)
      for (int c = 0; c < 3; ++c)
        if (setting.plane_turns || c != 1)
          moves.push_back({"light", d["d_vertices"][1][number][c], {place(path + "/" + std::to_string(i), c)}});
  };
  add_vertices(query["light"]["vertices"], "/light/vertices");
  if (query["light"].contains("holes")) add_vertices(query["light"]["holes"][0], "/light/holes/0");
  // Equal positions move together.
  std::vector<json> seen;
  number = 0;
  const json& triangles = query["occluders"];
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k, ++number) {
      const json& position = triangles[t][k];
      const bool repeats = std::find(seen.begin(), seen.end(), position) != seen.end();
      seen.push_back(position);
      for (int c = 0; c < 3; ++c) {
        const double derivative = d["d_occluders"][1][number][c];
        if (repeats) {
          EXPECT_EQ(derivative, 0) << "of a position that stands earlier";
          continue;
        }
        std::vector<json::json_pointer> places;
        for (std::size_t u = 0; u < triangles.size(); ++u)
          for (std::size_t l = 0; l < 3; ++l)
            if (triangles[u][l] == position) places.push_back(place("/occluders/" + std::to_string(u) + "/" + std::to_string(l), c));
        moves.push_back({"occluder " + std::to_string(number), derivative, places});
      }
    }
  return moves;
}

TEST(ShadowedDerivatives, AgreeWithCentralDifferences) {
  for (const Setting& setting : kSettings)
    for (const Lobe& lobe : kLobes) {
      SCOPED_TRACE(setting.name + ", " + lobe.material + " by " + lobe.method);
      const json query = query_of(setting, lobe);
      json asked = query;
      asked["derivatives"] = true;
      const json d = answer(asked);
      ASSERT_TRUE(d.contains("d_occluders")) << d;
      const double whole = value(query, lobe.judge);
      EXPECT_GT(whole, 0);
      const std::vector<Move> moves = moves_of(setting, query, d);
      double largest = 0;
      for (const Move& move : moves) largest = std::max(largest, std::fabs(move.derivative));
      EXPECT_GT(largest, 0.1 * whole);
      // Error of the cells' steps: 2.4e-7 of the light over twice the step. Error of the differences: the square of the step over that of
      // the distances, 1e-5 of a derivative if a lobe changes over a tenth of them.
      const double bar = 3e-4 * whole + 1e-3 * largest;
      for (const Move& move : moves)
        EXPECT_NEAR(move.derivative, central_difference(query, move.places, lobe.judge), bar) << move.what << ", " << move.places[0];
    }
}

// The normal rotates as a direction, and the horizon with it. This also holds if the horizon cuts the visible part and the lobe does not
// end there.
TEST(ShadowedDerivatives, ByTheNormalAgreeWithCentralDifferences) {
  for (const Lobe& lobe : kLobes)
    for (const bool grazing : {false, true}) {
      SCOPED_TRACE(lobe.material + " by " + lobe.method + (grazing ? ", cut by the horizon" : ""));
      json query = query_of(kSettings[0], lobe);
      query["geometric_normal"] = {0, 1, 0};
      if (grazing) {
        query["normal"] = {-1, 0.05, 0.1};
        query["view"] = {-0.2, -0.985, 0.03};
      }
      json asked = query;
      asked["derivatives"] = true;
      const json d = answer(asked);
      ASSERT_TRUE(d.contains("d_normal")) << d;
      const double size = std::sqrt(grazing ? 1.0125 : 1.01);  // length of the normal as stored in the query
      const double whole = value(query, lobe.method);
      EXPECT_GT(whole, 0);
      double largest = 0;
      for (int c = 0; c < 3; ++c) largest = std::max(largest, std::fabs(d["d_normal"][1][c].get<double>()));
      // Both are differences of the method's own value. ltc interpolates its table in the view's cosine piecewise, so a step may cross a
      // node.
      const double bar = 6e-4 * whole + (lobe.method.starts_with("ltc") ? 2e-2 : 2e-3) * largest;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(d["d_normal"][1][c].get<double>() / size, central_difference(query, {place("/normal", c)}, lobe.method), bar) << c;
    }
}

// A view along the normal defines no direction across it.
TEST(ShadowedDerivatives, AgreeWithCentralDifferencesWhereTheViewIsTheNormal) {
  for (const Lobe& lobe : kLobes) {
    SCOPED_TRACE(lobe.material + " by " + lobe.method);
    json query = query_of(kSettings[0], lobe);
    query["normal"] = query["view"] = {0.3, 1, 0.2};
    json asked = query;
    asked["derivatives"] = true;
    const json d = answer(asked);
    ASSERT_TRUE(d.contains("d_position")) << d;
    const double whole = value(query, lobe.judge);
    double largest = 0;
    for (const json& x : d["d_position"][1]) largest = std::max(largest, std::fabs(x.get<double>()));
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(d["d_position"][1][c].get<double>(), central_difference(query, {place("/position", c)}, lobe.judge),
                  3e-4 * whole + 1e-3 * largest);
  }
}

TEST(ShadowedDerivatives, WithNothingInTheWayAreThoseOfTheWholeLight) {
  for (const Lobe& lobe : kLobes) {
    json query = query_of(kSettings[0], lobe);
    query["derivatives"] = true;
    query["occluders"] = json::array();
    const json past = answer(query);
    query.erase("occluders");
    const json whole = answer(query);
    ASSERT_TRUE(past.contains("d_vertices")) << past;
    double largest = 0;
    for (const json& vertex : whole["d_vertices"][1])
      for (const json& x : vertex) largest = std::max(largest, std::fabs(x.get<double>()));
    // The point is 1e-5 off its surface, and the methods for the whole light have their documented errors.
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(past["d_vertices"][1][i][c].get<double>(), whole["d_vertices"][1][i][c].get<double>(), 2e-2 * largest) << lobe.material;
  }
}

// Round lights: by their own keys, the point and the occluders, against differences of quadrature over the light's surface.
TEST(ShadowedDerivatives, OfRoundLightsAgreeWithCentralDifferences) {
  const Setting settings[] = {
      {"disk", R"({"type":"disk","center":[0.2,2,0.1],"x":[0.6,0.1,0],"y":[0,-0.1,0.5],"radiance":[1,2,3],"two_sided":true})", kBent},
      {"sphere", R"({"type":"sphere","center":[0.2,2.2,0.1],"radius":0.5,"radiance":[1,2,3]})", kBent},
      {"ellipsoid", R"({"type":"ellipsoid","center":[0.2,2.2,0.1],"x":[0.6,0.1,0],"y":[0,0.3,0.1],"z":[0,-0.1,0.5],"radiance":[1,2,3]})",
       kBent},
      {"capsule", R"({"type":"capsule","ends":[[-0.4,2.1,0],[0.7,2.3,0.3]],"radius":0.2,"radiance":[1,2,3]})", kBent},
  };
  for (const Setting& setting : settings)
    for (const Lobe& lobe : {Lobe{R"({"brdf":"lambert","albedo":[0.3,0.7,0.5]})", "exact", "reference"},
                             Lobe{R"({"brdf":"ggx","alpha":0.3})", "closed-form", "reference"}}) {
      SCOPED_TRACE(setting.name + ", " + lobe.material);
      const json query = query_of(setting, lobe);
      json asked = query;
      asked["derivatives"] = true;
      const json d = answer(asked);
      ASSERT_TRUE(d.contains("d_occluders")) << d;
      std::vector<Move> moves;
      for (int c = 0; c < 3; ++c) {
        moves.push_back({"position", d["d_position"][1][c], {place("/position", c)}});
        for (const std::string key : {"center", "x", "y", "z"})
          if (query["light"].contains(key)) moves.push_back({key, d["d_" + key][1][c], {place("/light/" + key, c)}});
        if (query["light"].contains("ends"))
          for (std::size_t k = 0; k < 2; ++k)
            moves.push_back({"end", d["d_ends"][1][k][c], {place("/light/ends/" + std::to_string(k), c)}});
        // A vertex of the triangle that stands alone.
        moves.push_back({"occluder", d["d_occluders"][1][7][c], {place("/occluders/2/1", c)}});
      }
      if (query["light"].contains("radius")) moves.push_back({"radius", d["d_radius"][1], {json::json_pointer("/light/radius")}});
      const double whole = value(query, lobe.judge);
      double largest = 0;
      for (const Move& move : moves) largest = std::max(largest, std::fabs(move.derivative));
      EXPECT_GT(largest, 0.1 * whole);
      // As above, and the polygon of 96 corners: its outline is (pi / 96)^2 / 2 = 5e-4 of the radius off.
      const double bar = 3e-4 * whole + 2e-3 * largest;
      double worst = 0;
      for (const Move& move : moves) {
        const double judge = central_difference(query, move.places, lobe.judge);
        worst = std::max(worst, std::fabs(move.derivative - judge) / largest);
        EXPECT_NEAR(move.derivative, judge, bar) << move.what << ", " << move.places[0];
      }
      std::printf("%s, %s: worst %.1e of the largest derivative\n", setting.name.c_str(), lobe.method.c_str(), worst);
    }
}

}  // namespace
}  // namespace steradian::eval::shadowed_derivatives_test
