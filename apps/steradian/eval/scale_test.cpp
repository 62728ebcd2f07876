// Queries of any size and any place: light depends on neither.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/random.h"
#include "eval/answer.h"
#include "night.h"
#include "support/gltf_test_file.h"

namespace steradian::eval::scale_test {
namespace {

using nlohmann::json;
using reference::Random;

json answer(const json& query) {
  static QueryReader reader;
  std::string line = query.dump(), out;
  const std::size_t size = line.size();
  line.append(kQueryPadding, ' ');
  answer_line(reader, {line.data(), size}, out);
  return json::parse(out);
}

double between(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }
std::size_t one_of(Random& random, std::size_t count) {
  return std::min(static_cast<std::size_t>(random.uniform() * static_cast<double>(count)), count - 1);
}

const json kFloor = json::parse("[[[-4,0,-4],[4,0,4],[4,0,-4]],[[-4,0,-4],[-4,0,4],[4,0,4]]]");

void add_quad(json& triangles, const json& a, const json& b, const json& c, const json& d) {
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

void add_box(json& triangles, double x0, double y0, double z0, double x1, double y1, double z1) {
  const auto at = [&](int i) { return json{(i & 1) != 0 ? x1 : x0, (i & 2) != 0 ? y1 : y0, (i & 4) != 0 ? z1 : z0}; };
  const int faces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (const auto& f : faces) add_quad(triangles, at(f[0]), at(f[1]), at(f[2]), at(f[3]));
}

json random_light(Random& random, std::size_t kind) {
  const json center = {between(random, -1, 1), between(random, 1.2, 2.5), between(random, -1, 1)};
  const double size = between(random, 0.2, 0.8);
  const json away = {center[0].get<double>() + 0.5, center[1].get<double>() + 0.2, center[2]};
  switch (kind) {
    case 0: return {{"type", "rect"}, {"center", center}, {"x", {size, 0, 0.1}}, {"y", {0.05, 0.1, size}}};
    case 1: return {{"type", "disk"}, {"center", center}, {"x", {size, 0, 0}}, {"y", {0, 0, 0.5 * size}}};
    case 2: return {{"type", "sphere"}, {"center", center}, {"radius", 0.7 * size}};
    case 3: return {{"type", "ellipsoid"}, {"center", center}, {"x", {0.4, 0.1, 0}}, {"y", {-0.05, 0.2, 0}}, {"z", {0, 0, size}}};
    case 4: return {{"type", "capsule"}, {"ends", {center, away}}, {"radius", 0.1}};
    case 5: return {{"type", "point"}, {"position", center}, {"intensity", 3}};
    default: return {{"type", "directional"}, {"direction", {between(random, -1, 1), -1.5, between(random, -1, 1)}}};
  }
}

struct Lobe {
  json material;
  std::vector<const char*> methods;
};
const Lobe kLobes[] = {{{{"brdf", "lambert"}}, {"exact", "reference", "sampled"}},
                       {{{"brdf", "ggx"}, {"alpha", 0.3}}, {"closed-form", "reference", "sampled", "ltc"}},
                       {{{"brdf", "phong"}, {"exponent", 20}}, {"series", "exact", "sampled"}},
                       {{{"brdf", "beckmann"}, {"alpha", 0.3}}, {"half-vector", "sampled"}},
                       {{{"brdf", "charlie"}, {"alpha", 0.5}}, {"cubature"}}};

json random_query(Random& random) {
  const std::size_t kind = one_of(random, 7);
  const Lobe& lobe = kLobes[one_of(random, 5)];
  json q = {{"light", random_light(random, kind)},
            {"position", {between(random, -0.5, 0.5), 0, between(random, -0.5, 0.5)}},
            {"normal", {0, 1, 0}},
            {"view", {between(random, -1, 1), 1, between(random, -1, 1)}},
            {"material", lobe.material},
            {"method", kind < 5 ? lobe.methods[one_of(random, lobe.methods.size())] : "auto"},
            {"spp", 50}};
  if (kind == 0 && lobe.material["brdf"] == "lambert" && q["method"] == "exact") q["derivatives"] = true;
  if (random.uniform() < 0.2) return q;
  json triangles = kFloor;
  const double x = between(random, -0.8, 0.8), z = between(random, -0.8, 0.8), side = between(random, 0.05, 0.3);
  add_box(triangles, x - side, 0, z - side, x + side, between(random, 0.1, 1), z + side);
  for (std::size_t i = one_of(random, 4); i > 0; --i) {
    json triangle;
    const double at[3] = {between(random, -0.8, 0.8), between(random, 0.5, 1.1), between(random, -0.8, 0.8)};
    for (int corner = 0; corner < 3; ++corner) {
      json p;
      for (const double c : at) p.push_back(c + (corner > 0 ? between(random, -0.5, 0.5) : 0));
      triangle.push_back(p);
    }
    triangles.push_back(triangle);
  }
  q["occluders"] = triangles;
  return q;
}

// The query with all its points p at scale p + offset.
json placed(json q, double scale, const double (&offset)[3]) {
  const auto point = [&](json& p) {
    for (std::size_t i = 0; i < 3; ++i) p[i] = p[i].get<double>() * scale + offset[i];
  };
  json& light = q["light"];
  for (const char* key : {"center", "position"})
    if (light.contains(key)) point(light[key]);
  if (light.contains("ends"))
    for (json& p : light["ends"]) point(p);
  for (const char* key : {"x", "y", "z"})
    if (light.contains(key))
      for (json& c : light[key]) c = c.get<double>() * scale;
  if (light.contains("radius")) light["radius"] = light["radius"].get<double>() * scale;
  if (light["type"] == "point") light["intensity"] = light.value("intensity", 1.0) * scale * scale;
  point(q["position"]);
  if (q.contains("occluders"))
    for (json& triangle : q["occluders"])
      for (json& p : triangle) point(p);
  return q;
}

double red(const json& a) { return a["radiance"][0]; }

}  // namespace

// A scale by a power of two changes no digit but exponents, so the answers are equal. By other factors, and far from the origin, a
// coordinate is off by 2^-53 of itself: 1e-12 of the scene. An edge may then round to the next cell, 2^-22 of the light's half side. It
// takes 2.4e-7 of an outline that fills half of its box; up to 20 edges and as many sides of a round light do so. A sphere's outline may
// turn, and half-vector's polygon with it, which is off by up to 1e-3.
TEST(EvalScale, ChangesNoAnswer) {
  constexpr double kCells = 40 * 2.4e-7, kTurned = 1e-3;
  const struct {
    double scale, offset;
  } places[] = {{0x1p-20, 0}, {0x1p20, 0}, {1e-6, 0}, {1e-3, 0}, {1e3, 0}, {1e6, 0}, {1, 1e4}, {1e-6, 1e-2}, {1e-3, 10}, {1e3, 1e7}};
  Random random(5, 1);
  const int count = test::by_day_or_night(60, 1000);
  int compared = 0, lit = 0;
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const json query = random_query(random);
    json open = query;
    open.erase("occluders");
    open.erase("derivatives");
    const json base = answer(query);
    ASSERT_TRUE(base.contains("radiance")) << query << base;
    const double whole = red(answer(open));
    const bool turns = query["light"]["type"] == "sphere" && query["method"] == "half-vector";
    const double bound = (turns ? kTurned : kCells) * whole;
    lit += red(base) > 0 ? 1 : 0;
    for (const auto& [scale, offset] : places) {
      const json there = placed(query, scale, {offset, 0.5 * offset, -0.7 * offset});
      const json a = answer(there);
      ASSERT_TRUE(a.contains("radiance")) << there << a;
      ++compared;
      const bool exact = offset == 0 && std::exp2(std::round(std::log2(scale))) == scale;
      if (!turns) worst = std::max(worst, std::fabs(red(a) - red(base)) / std::max(whole, 1e-6));
      EXPECT_NEAR(red(a), red(base), exact ? 0 : bound) << scale << ' ' << offset << ' ' << query;
      if (!base.contains("d_position")) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double here = base["d_position"][0][axis], moved = a["d_position"][0][axis];
        EXPECT_NEAR(moved * scale, here, exact ? 0 : bound) << scale << ' ' << offset << ' ' << query;
      }
    }
  }
  std::cout << "[ measured ] " << compared << " answers, " << lit << " of " << count << " queries lit, largest difference " << worst
            << "\n";
  EXPECT_GT(lit, count / 2);
}

// A box that stands on the floor, and a plate above it by a thousandth of its size, hide all of the light from below them, wherever they
// are.
TEST(EvalScale, ContactShadowsAreBlackAnywhere) {
  const char* const lights[] = {R"({"type":"rect","center":[0,2,0],"x":[0.5,0,0],"y":[0,0,0.5]})",
                                R"({"type":"disk","center":[0,2,0],"x":[0.5,0,0],"y":[0,0,0.5]})",
                                R"({"type":"sphere","center":[0,2,0],"radius":0.4})",
                                R"({"type":"capsule","ends":[[-0.4,2,0],[0.5,2.1,0.2]],"radius":0.15})",
                                R"({"type":"point","position":[0,2,0]})",
                                R"({"type":"directional","direction":[0.1,-1,0]})"};
  for (const char* light : lights)
    for (const double gap : {0.0, 1e-3})
      for (const char* method : {"auto", "reference", "sampled"}) {
        json triangles = kFloor;
        add_box(triangles, -0.5, gap, -0.5, 0.5, 0.3, 0.5);
        const json query = {{"light", json::parse(light)},
                            {"position", {0.05, 0, 0.02}},
                            {"normal", {0, 1, 0}},
                            {"method", method},
                            {"material", {{"brdf", "lambert"}}},
                            {"occluders", triangles},
                            {"spp", 50}};
        for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6})
          for (const double offset : {0.0, 1e4 * scale}) {
            const json a = answer(placed(query, scale, {offset, -offset, 0.3 * offset}));
            ASSERT_TRUE(a.contains("radiance")) << a;
            // Quadrature leaves the difference of two roundings.
            EXPECT_LE(red(a), std::string(method) == "reference" ? 1e-15 : 0) << light << method << scale << ' ' << offset;
          }
      }
}

// Occluders of a file whose node lies 10 km away are as exact as listed ones, though the file's vertices are floats.
TEST(EvalScale, ReadsFarFilesInDouble) {
  scene::GltfTestFile f;
  const int positions = f.add_floats({-0.1f, 1, -0.5f, 0.3f, 1.1f, -0.5f, 0.2f, 1, 0.7f}, "VEC3");
  f.add_mesh({{"POSITION", positions}}, f.add_indices({0, 1, 2}));
  const double at[3] = {12345.678, -9876.543, 5432.109};
  f.node()["translation"] = {at[0], at[1], at[2]};
  json query = {{"light", json::parse(R"({"type":"rect","center":[0,2,0],"x":[0.5,0,0],"y":[0,0,0.5]})")},
                {"position", {0.05, 0, 0.02}},
                {"normal", {0, 1, 0}},
                {"material", {{"brdf", "lambert"}}},
                {"occluders", {{{-0.1f, 1.0f, -0.5f}, {0.3f, 1.1f, -0.5f}, {0.2f, 1.0f, 0.7f}}}}};
  const double listed = red(answer(query));
  query.erase("occluders");
  const double open = red(answer(query));
  EXPECT_LT(listed, 0.9 * open);
  json far = placed(query, 1, at);
  far["occluders"] = scene::write_test_file("far.gltf", f.text());
  const json a = answer(far);
  ASSERT_TRUE(a.contains("radiance")) << a;
  EXPECT_NEAR(red(a), listed, 1e-6 * open);  // a few cells
}

// Sheets that stand on the floor: a point in their planes is lit from both sides by halves, by each method. From a point beside a sheet's
// face, its edge hides nothing.
TEST(EvalScale, InTheFaceOfASheetIsTheMeanOfBothSides) {
  const json light = json::parse(R"({"type":"rect","center":[0.3,2,0],"x":[0.5,0,0],"y":[0,0,0.5]})");
  const auto value = [&](const json& sheets, double x, double z, const char* method) {
    json triangles = kFloor;
    for (const json& t : sheets) triangles.push_back(t);
    const json a = answer({{"light", light},
                           {"position", {x, 0, z}},
                           {"normal", {0, 1, 0}},
                           {"method", method},
                           {"material", {{"brdf", "lambert"}}},
                           {"occluders", triangles},
                           {"spp", 20000}});
    EXPECT_TRUE(a.contains("radiance")) << a;
    return std::pair(red(a), a.value("standard_error", 0.0));
  };
  json across_x, both;
  add_quad(across_x, {0, 0, -1}, {0, 1, -1}, {0, 1, 1}, {0, 0, 1});
  both = across_x;
  add_quad(both, {-1, 0, 0}, {-1, 1, 0}, {1, 1, 0}, {1, 0, 0});
  constexpr double kBeside = 1e-7;
  for (const char* method : {"exact", "reference", "sampled"}) {
    const auto sides = [&](const json& sheets, std::vector<std::pair<double, double>> points) {
      double mean = 0, variance = 0;
      for (const auto& [x, z] : points) {
        const auto [v, sigma] = value(sheets, x, z, method);
        mean += v / static_cast<double>(points.size());
        variance += sigma * sigma / static_cast<double>(points.size() * points.size());
      }
      return std::pair(mean, variance);
    };
    const auto [one, one_variance] = sides(across_x, {{-kBeside, 0}, {kBeside, 0}});
    const auto [in_one, in_one_error] = value(across_x, 0, 0, method);
    EXPECT_NEAR(in_one, one, 2 * kBeside + 5 * std::sqrt(one_variance + in_one_error * in_one_error)) << method;
    const auto [two, two_variance] = sides(both, {{-kBeside, -kBeside}, {kBeside, -kBeside}, {-kBeside, kBeside}, {kBeside, kBeside}});
    const auto [in_two, in_two_error] = value(both, 0, 0, method);
    EXPECT_NEAR(in_two, two, 2 * kBeside + 5 * std::sqrt(two_variance + in_two_error * in_two_error)) << method;
  }
  const double open = value(json::array(), 0, 2, "exact").first;
  EXPECT_NEAR(value(across_x, 0, 2, "exact").first, open, 1e-6 * open);  // in the plane, but beside the face
}

}  // namespace steradian::eval::scale_test
