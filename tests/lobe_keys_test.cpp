// `eval` and glTF's extras read a lobe by the same keys. They give the same material, and both refuse what one refuses.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "eval/query.h"
#include "lobes/lobe.h"
#include "scene/gltf/gltf_materials.h"

namespace steradian::lobe_keys_test {
namespace {

using namespace scene;

using lobes::KeyKind;
using nlohmann::json;

std::optional<Material> by_eval(const json& lobe) {
  const json query = {{"light", {{"type", "point"}, {"position", {0, 1, 0}}}},
                      {"position", {0, 0, 0}},
                      {"normal", {0, 1, 0}},
                      {"view", {0, 1, 0}},
                      {"material", lobe}};
  const std::string line = query.dump() + std::string(eval::kQueryPadding, ' ');
  try {
    return eval::QueryReader().read(std::string_view(line).substr(0, line.size() - eval::kQueryPadding)).materials.at(0);
  } catch (const Error&) {
    return {};
  }
}

std::optional<Material> by_scene(const json& lobe) {
  try {
    return read_lobe(JsonCursor(lobe, "scene.gltf"));
  } catch (const Error&) {
    return {};
  }
}

bool same(const Material& a, const Material& b) {
  return a.brdf == b.brdf && a.albedo == b.albedo && a.exponent == b.exponent && a.alpha_x == b.alpha_x && a.alpha_y == b.alpha_y &&
         a.tangent == b.tangent && a.f0 == b.f0 && a.f90 == b.f90 && a.shadowing == b.shadowing && a.axis == b.axis &&
         a.foreshortening == b.foreshortening && a.axis_exponent == b.axis_exponent && a.multiple_scattering == b.multiple_scattering &&
         std::equal(a.factors.begin(), a.factors.end(), b.factors.begin(), b.factors.end(),
                    [](const AxisPower& x, const AxisPower& y) { return x.axis == y.axis && x.exponent == y.exponent; });
}

// Values that a key of a kind may have, and invalid ones.
std::vector<json> values_of(const lobes::Key& key) {
  switch (key.kind) {
    case KeyKind::not_negative: return {0, 2.5, 1e6, -1, "many"};
    case KeyKind::share: return {0, 1e-9, 0.25, 1, 1.5, -0.1, "wide"};
    case KeyKind::colour: return {0.5, {0.25, 0.5, 1}, -1, {0, 1}, "red"};
    case KeyKind::direction: return {{0, 3, 4}, {0, 0, 0}, 1};
    case KeyKind::flag: return {true, false, 1};
    case KeyKind::factors: {
      const json one = {{"axis", {0, 3, 4}}, {"exponent", 5}}, bare = {{"axis", {0, 0, 1}}}, zero = {{"axis", {0, 0, 0}}, {"exponent", 5}},
                 negative = {{"axis", {0, 0, 1}}, {"exponent", -1}};
      json more = one;
      more["width"] = 1;
      return {json::array(),
              json::array({one}),
              json::array({one, one}),
              json::array({bare}),
              json::array({zero}),
              json::array({negative}),
              json::array({more}),
              json::array({3}),
              one,
              "many"};
    }
    case KeyKind::word: return {"smith", "none", "some", 1};
  }
  return {};
}

TEST(LobeKeys, EvalAndScenesReadTheSame) {
  int read = 0, refused = 0;
  const auto compare = [&](const json& lobe) {
    const std::optional<Material> a = by_eval(lobe), b = by_scene(lobe);
    ASSERT_EQ(a.has_value(), b.has_value()) << lobe;
    if (a) {
      EXPECT_TRUE(same(*a, *b)) << lobe;
    }
    ++(a ? read : refused);
  };
  for (const lobes::LobeRow& row : lobes::lobe_rows()) {
    json least = {{"brdf", row.name}};
    compare(least);
    for (const lobes::Key& key : row.keys) {
      if (key.required) least[std::string(key.name)] = 3;
      if (key.name == "alpha") least["alpha"] = 0.25;
    }
    compare(least);
    ASSERT_TRUE(by_eval(least)) << least;
    for (const lobes::Key& key : row.keys)
      for (const json& value : values_of(key)) {
        json lobe = least;
        lobe[std::string(key.name)] = value;
        compare(lobe);
        if (key.kind == KeyKind::share) {  // the width given by a single name
          lobe.erase("alpha");
          lobe[std::string(key.name)] = value;
          compare(lobe);
          if (key.name == "alpha_x") lobe["alpha_y"] = 0.5;
          compare(lobe);
        }
      }
    least["colour"] = 1;
    compare(least);
  }
  EXPECT_GT(read, 40);
  EXPECT_GT(refused, 40);
}

}  // namespace
}  // namespace steradian::lobe_keys_test
