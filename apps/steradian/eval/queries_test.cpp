// Keys for scripts: ids, lists of lights, parallel light, derivatives by the parameters of the light and the lobe.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "eval/answer.h"

namespace steradian::eval::queries_test {
namespace {

using nlohmann::json;

const char* const kRect = R"({"type":"rect","center":[0.3,2,0],"x":[1,0,0],"y":[0,0,1],"radiance":[3,2,1]})";
const char* const kPoint = R"({"type":"point","position":[1,2,0.5],"intensity":[4,5,6]})";
const char* const kSun = R"({"type":"directional","direction":[-0.3,-1,0.2],"illuminance":[2,3,4]})";

std::string answer_text(std::string line) {
  static QueryReader reader;
  const std::size_t size = line.size();
  line.append(kQueryPadding, ' ');
  std::string out;
  answer_line(reader, {line.data(), size}, out);
  return out;
}

std::string query(const std::string& light_key, const std::string& material, const std::string& rest = "") {
  return "{" + light_key + R"(,"position":[0.1,0,0.2],"normal":[0,1,0],"view":[0.4,1,0.3],"material":)" + material + rest + "}";
}
std::string light(const std::string& text) { return "\"light\":" + text; }

Vec3d radiance(const std::string& line) {
  const json a = json::parse(answer_text(line));
  if (!a.contains("radiance")) {
    ADD_FAILURE() << line << "\n" << a;
    return {};
  }
  return {a["radiance"][0].get<double>(), a["radiance"][1].get<double>(), a["radiance"][2].get<double>()};
}

void expect_near(const json& a, Vec3d b, double relative) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double expected = i == 0 ? b.x : i == 1 ? b.y : b.z;
    EXPECT_NEAR(a[i].get<double>(), expected, relative * std::fabs(expected)) << a << " channel " << i;
  }
}

const char* const kLambert = R"({"brdf":"lambert","albedo":0.5})";

}  // namespace

TEST(EvalQueries, EchoTheirId) {
  EXPECT_EQ(answer_text(query(R"("id":"a \"b\"",)" + light(kRect), kLambert)).rfind(R"({"id":"a \"b\"","radiance":)", 0), 0u);
  EXPECT_EQ(answer_text(query(R"("id":17,)" + light(kRect), kLambert)).rfind(R"({"id":17,"radiance":)", 0), 0u);
  const std::string wrong = answer_text(query(R"("id":"x",)" + light("{}"), kLambert));
  EXPECT_EQ(wrong.rfind(R"({"id":"x","error":)", 0), 0u) << wrong;
  EXPECT_EQ(answer_text(query(light(kRect), kLambert)).rfind("{\"radiance\"", 0), 0u) << "the last line's id is forgotten";
  EXPECT_NE(answer_text(query(R"("id":[1],)" + light(kRect), kLambert)).find("id: expected a string or a number"), std::string::npos);
}

TEST(EvalQueries, AListOfLightsAdds) {
  for (const char* material : {kLambert, R"([{"brdf":"lambert"},{"brdf":"ggx","roughness":0.4}])"}) {
    const Vec3d sum =
        radiance(query(light(kRect), material)) + radiance(query(light(kPoint), material)) + radiance(query(light(kSun), material));
    const Vec3d together = radiance(query(std::string("\"lights\":[") + kRect + "," + kPoint + "," + kSun + "]", material));
    EXPECT_NEAR(length(together - sum), 0, 1e-14 * length(sum));
  }
  EXPECT_NE(answer_text(query(light(kRect) + ",\"lights\":[" + kSun + "]", kLambert)).find("given beside"), std::string::npos);
  EXPECT_NE(answer_text(query("\"lights\":[]", kLambert)).find("lights: the list is empty"), std::string::npos);
  EXPECT_NE(answer_text(query("\"lights\":{}", kLambert)).find("expected a list of lights"), std::string::npos);
  EXPECT_NE(answer_text(query(std::string("\"lights\":[") + kRect + ",{}]", kLambert)).find("lights[1].type: missing"), std::string::npos);
}

// The samples of two lights are independent: the standard error is the root of the summed squares.
// docs/theory/moments.md, "The published fits": f = x for even exponents, f = 1 for all others.
TEST(EvalQueries, ThePublishedFormOfAPeakFollowsTheParity) {
  const auto by = [&](int exponent, const std::string& form) {
    return radiance(query(light(kRect), R"({"brdf":"phong","exponent":)" + std::to_string(exponent) + "}",
                          R"(,"method":"ellipsoid","peak_form":")" + form + "\""));
  };
  EXPECT_EQ(by(100, "published"), by(100, "x"));
  EXPECT_EQ(by(101, "published"), by(101, "one"));
  EXPECT_EQ(by(100, "best"), by(100, "one"));
  EXPECT_NE(by(100, "x"), by(100, "one"));
  EXPECT_NE(answer_text(query(light(kRect), kLambert, R"(,"peak_form":"round")")).find("published"), std::string::npos);
}

// The rest of an edge's sum is at most that fraction of it, so the answer is at most that much too small.
TEST(EvalQueries, AnEarlyStopLeavesOutNoMoreThanItsFraction) {
  const auto by = [&](const std::string& stop) {
    return radiance(query(light(kRect), R"({"brdf":"phong","exponent":4000})", R"(,"method":"arvo","early_stop":)" + stop)).x;
  };
  const double whole = by("0"), rough = by("0.1");
  ASSERT_GT(whole, 0);
  EXPECT_NEAR(by("1e-12"), whole, 1e-9 * whole);
  EXPECT_NE(rough, whole);
}

TEST(EvalQueries, AListOfLightsAddsVariances) {
  const std::string sampled = R"(,"method":"sampled","spp":4000)";
  const auto of = [&](const std::string& lights) {
    return json::parse(answer_text(query(lights, kLambert, sampled)))["standard_error"].get<double>();
  };
  const double one = of(light(kRect)), two = of(std::string("\"lights\":[") + kRect + "," + kRect + "]");
  EXPECT_NEAR(two, one * std::sqrt(2.0), 0.1 * one);
}

TEST(EvalQueries, ParallelLightIsAPointLightFarAway) {
  const double cosine = 1 / std::sqrt(0.09 + 1 + 0.04);
  const Vec3d lambert = radiance(query(light(kSun), kLambert));
  EXPECT_NEAR(lambert.x, 2 * cosine * 0.5 / std::numbers::pi, 1e-15);
  EXPECT_NEAR(lambert.z, 4 * cosine * 0.5 / std::numbers::pi, 1e-15);
  // The light is 1e7 away along the direction, so the angle differs by 1e-8.
  const double d = 1e7, u = d * cosine;
  const std::string far = R"({"type":"point","position":[)" + std::to_string(0.1 + 0.3 * u) + "," + std::to_string(u) + "," +
                          std::to_string(0.2 - 0.2 * u) + R"(],"intensity":[2e14,3e14,4e14]})";
  const char* glossy = R"({"brdf":"ggx","roughness":0.5,"f0":0.04})";
  const Vec3d a = radiance(query(light(kSun), glossy)), b = radiance(query(light(far), glossy));
  EXPECT_NEAR(length(a - b), 0, 1e-6 * length(a));
  EXPECT_EQ(radiance(query(light(R"({"type":"directional","direction":[0,1,0]})"), kLambert)), Vec3d{}) << "from below";
}

TEST(EvalQueries, ParallelLightIsBlockedByWhatStandsInItsWay) {
  const std::string roof = R"(,"occluders":[[[-9,5,-9],[9,5,-9],[0,5,9]]])", aside = R"(,"occluders":[[[20,5,-9],[29,5,-9],[20,5,9]]])";
  EXPECT_EQ(radiance(query(light(kSun), kLambert, roof)), Vec3d{});
  EXPECT_EQ(radiance(query(light(kSun), kLambert, aside)), radiance(query(light(kSun), kLambert)));
}

TEST(EvalQueries, DerivativesByParametersAreThoseOfDifferences) {
  const auto ggx = [](double roughness, double f0) {
    return R"({"brdf":"ggx","roughness":)" + std::to_string(roughness) + R"(,"f0":)" + std::to_string(f0) + "}";
  };
  const json a = json::parse(answer_text(query(light(kRect), ggx(0.4, 0.2), R"(,"derivatives":true)")));
  ASSERT_TRUE(a.contains("d_radiance") && a.contains("d_f0") && a.contains("d_roughness")) << a;
  const Vec3d at = radiance(query(light(kRect), ggx(0.4, 0.2)));
  expect_near(a["d_radiance"], {at.x / 3, at.y / 2, at.z}, 1e-12);
  // The radiance is linear in F0, so any step is exact.
  expect_near(a["d_f0"], (radiance(query(light(kRect), ggx(0.4, 0.7))) - at) / 0.5, 1e-11);
  // A different step, 2e-3 of the roughness: off by 4e-6 of the third derivative. The derivative is that of high quality.
  const double h = 1e-3;
  const auto high = [&](double roughness) { return radiance(query(light(kRect), ggx(roughness, 0.2), R"(,"quality":"high")")); };
  expect_near(a["d_roughness"], (high(0.4 + h) - high(0.4 - h)) / (2 * h), 1e-4);
  const json lambert = json::parse(answer_text(query(light(kRect), kLambert, R"(,"derivatives":true)")));
  EXPECT_TRUE(lambert.contains("d_radiance") && !lambert.contains("d_f0") && !lambert.contains("d_roughness")) << lambert;
}

// Points and parallel light have no outline: their derivatives are differences of the answer. This test takes larger steps. Those of lines
// are of the true integral.
TEST(EvalQueries, DerivativesOfLightsWithoutOutlineAreThoseOfDifferences) {
  struct Moved {
    const char *light, *key, *path;
  };
  const Moved cases[] = {
      {R"({"type":"point","position":[0.5,2,-0.3],"intensity":[1,2,3]})", "d_light_position", "/light/position"},
      {R"({"type":"capsule","ends":[[0.5,2,-0.3],[-0.6,1.5,0.4]],"radius":0})", "d_ends", "/light/ends/1"},
      {R"({"type":"point","position":[0.5,2,-0.3]})", "d_position", "/position"},
      {R"({"type":"capsule","ends":[[0.5,2,-0.3],[-0.6,1.5,0.4]],"radius":0})", "d_view", "/view"},
      {R"({"type":"directional","direction":[0.2,-1,0.1]})", "d_direction", "/light/direction"},
      {R"({"type":"directional","direction":[0.2,-1,0.1]})", "d_normal", "/normal"},
  };
  for (const Moved& c : cases) {
    json q = {{"light", json::parse(c.light)},
              {"position", {0, 0, 0}},
              {"normal", {0, 1, 0}},
              {"view", {-0.3, 0.9, 0.2}},
              {"material", {{"brdf", "ggx"}, {"roughness", 0.6}}}};
    json asked = q;
    asked["derivatives"] = true;
    const json a = json::parse(answer_text(asked.dump()));
    ASSERT_TRUE(a.contains(c.key)) << a;
    json d = a[c.key][0];
    if (d[0].is_array()) d = d[1];
    // Directions need not be unit: a derivative by a stored one is that of the unit vector over its length.
    const json stored = q[json::json_pointer(c.path)];
    const bool is_direction = std::string_view(c.key) == "d_view" || std::string_view(c.key) == "d_direction";
    const double size =
        is_direction ? std::sqrt(stored[0].get<double>() * stored[0].get<double>() + stored[1].get<double>() * stored[1].get<double>() +
                                 stored[2].get<double>() * stored[2].get<double>())
                     : 1;
    for (int axis = 0; axis < 3; ++axis) {
      const json::json_pointer place(std::string(c.path) + "/" + std::to_string(axis));
      const auto at = [&](double h) {
        json moved = q;
        if (moved["light"]["type"] == "capsule") moved["method"] = "reference";
        moved[place] = q[place].get<double>() + h;
        return radiance(moved.dump()).x;
      };
      const double h = 1e-3, slope = ((at(h / 2) - at(-h / 2)) * 8 - (at(h) - at(-h))) / (6 * h);
      EXPECT_NEAR(d[static_cast<std::size_t>(axis)].get<double>() / size, slope, 1e-6 * (1 + std::fabs(slope))) << c.key << axis << a;
    }
  }
}

}  // namespace steradian::eval::queries_test
