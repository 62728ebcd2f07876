#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "eval/answer.h"

namespace steradian::eval::shadowed_test {
namespace {

using nlohmann::json;

json answer(std::string line) {
  static QueryReader reader;
  const std::size_t size = line.size();
  line.append(kQueryPadding, ' ');
  std::string out;
  answer_line(reader, {line.data(), size}, out);
  return json::parse(out);
}

const std::string kRect = R"({"type":"rect","center":[0.2,2,0.1],"x":[0.6,0,0],"y":[0,0,0.5]})";
const std::string kTwoSided = R"({"type":"rect","center":[0.2,2,0.1],"x":[0.6,0,0],"y":[0,0,-0.5],"two_sided":true})";
const std::string kDisk = R"({"type":"disk","center":[0.2,2,0.1],"x":[0.5,0,0],"y":[0,0,0.5]})";
const std::string kSphere = R"({"type":"sphere","center":[0.2,2,0.1],"radius":0.4})";
const std::string kCapsule = R"({"type":"capsule","ends":[[-0.4,2,0],[0.5,2.1,0.2]],"radius":0.15})";

// A bent plate and a loose triangle that occlude a large part of every light.
const std::string kOccluders =
    R"([[[0,1,-1],[0,1,1],[0.6,1.1,1]],[[0,1,-1],[0.6,1.1,1],[0.6,1.1,-1]],[[-0.3,1.2,-0.2],[-0.1,0.9,0.3],[-0.2,1.3,0.4]]])";

std::string query(const std::string& light, const std::string& material, const std::string& method, const std::string& rest = {}) {
  return R"({"light":)" + light + R"(,"position":[0.05,0,0],"normal":[0.1,1,0],"view":[-0.5,1,0.1],"material":)" + material +
         R"(,"method":")" + method + "\"" + rest + "}";
}
const std::string kWithOccluders = ",\"occluders\":" + kOccluders;

struct Row {
  std::string material;
  std::vector<std::string> methods;
  double error;  // documented error of the method without occluders over the whole light's value, times the concentration in a part
};

// Compares every lobe and method over the visible part with rays.
TEST(ShadowedEval, EveryMethodAgreesWithRays) {
  const Row rows[] = {
      {R"({"brdf":"lambert","albedo":0.7})", {"exact", "reference"}, 1e-5},
      {R"({"brdf":"ggx","alpha":0.25,"f0":0.04})", {"closed-form"}, 6e-3},
      {R"({"brdf":"ggx","alpha":0.25,"shadowing":"none"})", {"exact", "reference"}, 1e-5},
      {R"({"brdf":"ggx","alpha":0.25})", {"closed-form", "reference"}, 3e-3},
      {R"({"brdf":"ggx","alpha_x":0.1,"alpha_y":0.4,"tangent":[1,0,0.3]})", {"closed-form", "reference"}, 1e-2},
      {R"({"brdf":"ggx","alpha":0.3})", {"ltc", "ltc-compact", "half-vector"}, 0.1},
      {R"({"brdf":"phong","exponent":20})", {"series", "exact", "arvo", "reference"}, 2e-3},
      {R"({"brdf":"phong","exponent":7.5})", {"series", "exact", "reference"}, 2e-3},
      {R"({"brdf":"blinn-phong","exponent":30})", {"half-vector", "reference"}, 1e-2},
      {R"({"brdf":"beckmann","alpha":0.3})", {"half-vector", "reference"}, 1e-2},
      {R"({"brdf":"charlie","alpha":0.5})", {"cubature", "reference"}, 1e-2},
  };
  for (const std::string& light : {kRect, kTwoSided, kDisk, kSphere, kCapsule})
    for (const Row& row : rows) {
      const json rays = answer(query(light, row.material, "sampled", kWithOccluders + R"(,"spp":20000)"));
      ASSERT_TRUE(rays.contains("radiance")) << rays;
      const double expected = rays["radiance"][0], sigma = rays["standard_error"];
      const double whole = answer(query(light, row.material, "sampled", R"(,"spp":2000)"))["radiance"][0];
      EXPECT_GT(expected, 1e-3 * whole);
      EXPECT_LT(expected, 0.9 * whole);
      for (const std::string& method : row.methods) {
        const json a = answer(query(light, row.material, method, kWithOccluders));
        ASSERT_TRUE(a.contains("radiance")) << light << row.material << method << a;
        // 4.5 sigma: exceeded once in 150,000 times, and there are some hundred checks. Round lights become polygons: 1e-3 of the whole.
        const double bar = 4.5 * sigma + (row.error + 1e-3) * whole;
        EXPECT_NEAR(a["radiance"][0].get<double>(), expected, bar) << light << row.material << method;
        if (method == "reference") continue;
        const json single = answer(query(light, row.material, method, kWithOccluders + R"(,"precision":"float")"));
        EXPECT_NEAR(single["radiance"][0].get<double>(), a["radiance"][0].get<double>(), (row.error + 2e-4) * whole + 1e-6)
            << light << row.material << method;
      }
    }
}

TEST(ShadowedEval, TakesMeshesAndNormals) {
  const std::string lambert = R"({"brdf":"lambert"})";
  const json inline_triangles = answer(query(kRect, lambert, "exact", R"(,"occluders":[[[0,1,-1],[0,1,1],[1,1,1]]])"));
  const json mesh = answer(query(kRect, lambert, "exact", R"(,"occluders":{"positions":[[0,1,-1],[0,1,1],[1,1,1]],"indices":[0,1,2]})"));
  EXPECT_EQ(inline_triangles, mesh);
  // Nothing arrives from below the triangle that the point is on.
  EXPECT_EQ(answer(query(kRect, lambert, "exact", R"(,"occluders":[],"geometric_normal":[0,-1,0])"))["radiance"][0].get<double>(), 0.0);
  const double open = answer(query(kRect, lambert, "exact"))["radiance"][0],
               none = answer(query(kRect, lambert, "exact", R"(,"occluders":[])"))["radiance"][0];
  EXPECT_NEAR(none, open, 1e-6 * open);  // the light's corners are in cells
  const std::string point = R"({"type":"point","position":[0.3,2,0]})";
  EXPECT_EQ(answer(query(point, lambert, "exact", kWithOccluders))["radiance"][0].get<double>(), 0.0);
  EXPECT_GT(answer(query(point, lambert, "exact", R"(,"occluders":[])"))["radiance"][0].get<double>(), 0.0);
}

TEST(ShadowedEval, NamesWhatIsWrongWithOccluders) {
  const std::string lambert = R"({"brdf":"lambert"})";
  for (const char* wrong : {"7", R"([[[0,0,0],[1,1,1]]])", R"({"positions":[[0,0,0]],"indices":[0,0,1]})", R"("/no/such/scene.glb")"}) {
    const json a = answer(query(kRect, lambert, "exact", std::string(",\"occluders\":") + wrong));
    ASSERT_TRUE(a.contains("error")) << wrong;
    EXPECT_NE(a["error"].get<std::string>().find("occluders"), std::string::npos) << a;
  }
}

}  // namespace
}  // namespace steradian::eval::shadowed_test
