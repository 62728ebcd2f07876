// Culling in packs: each block's list has all lights that a receiver would keep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "render/bounce/cull.h"
#include "render/bounce/virtual_lights.h"

namespace steradian::indirect::cull_test {
namespace {

struct Draw {
  reference::Random random{21};
  float number(double low, double high) { return static_cast<float>(random.uniform(low, high)); }
  Vec3f direction() {
    for (;;) {
      const Vec3f d{number(-1, 1), number(-1, 1), number(-1, 1)};
      if (const float d2 = dot(d, d); d2 < 1 && d2 > 0.01f) return normalized(d);
    }
  }
};

ShadowMap random_map(Draw& draw, std::size_t count) {
  ShadowMap map;
  map.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    map.position.put(i, {draw.number(-2, 2), draw.number(-2, 2), draw.number(-2, 2)});
    map.normal.put(i, draw.direction());
    Vec3f incoming = draw.direction();
    if (dot(incoming, map.normal[i]) < 0) incoming = -incoming;
    map.incoming.put(i, incoming);
    map.flux.put(i, {1, 1, 1});
    map.albedo.put(i, {0.5f, 0.5f, 0.5f});
    map.f0.put(i, {0.8f, 0.8f, 0.8f});
    map.f90.put(i, {1, 1, 1});
    map.alpha[i] = std::exp(draw.number(std::log(0.01), 0));
    map.column[i] = static_cast<std::uint16_t>(i % 64);
    map.row[i] = static_cast<std::uint16_t>(i / 64);
  }
  return map;
}

// Patches of all sizes and curvatures; some receivers have no surface.
Receivers random_tile(Draw& draw) {
  Receivers r;
  r.position.resize(kTileReceivers);
  r.normal.resize(kTileReceivers);
  const Vec3f middle{draw.number(-2, 2), draw.number(-2, 2), draw.number(-2, 2)}, normal = draw.direction();
  const Vec3f x = normalized(cross(normal, draw.direction())), y = cross(normal, x);
  const float size = std::exp(draw.number(-5, 0)), bend = draw.number(0, 0.5);
  for (std::size_t i = 0; i < kTileReceivers; ++i) {
    if (draw.number(0, 1) < 0.05f) continue;
    const float u = draw.number(-1, 1), v = draw.number(-1, 1);
    r.position.put(i, middle + (x * u + y * v + normal * (bend * u * u)) * size);
    r.normal.put(i, normalized(normal - x * (2 * bend * u)));
  }
  return r;
}

TEST(IndirectCulling, ListsHoldAllThatIsKept) {
  Draw draw;
  const ShadowMap map = random_map(draw, 2048);
  LobeArrays lobes(map.count);
  virtual_light_table_for(active_simd()).prepare(map, ltc_pack_tables(Method::ltc_compact), lobes);
  std::size_t kept = 0, lost = 0, listed = 0;
  for (const double threshold : {0.01, 0.3, 10.0}) {
    SetOptions options;
    options.stride = 1;
    options.threshold = threshold;
    options.soften = false;
    const LightSet set = make_sets(map, lobes, options).front();
    for (const Simd simd : available_simd())
      for (int tile = 0; tile < 12; ++tile) {
        const Receivers receivers = random_tile(draw);
        BlockLists lists;
        lists.cull(cull_table_for(simd), set, receivers, 0);
        for (std::size_t b = 0; b < kBlocks; ++b) {
          const auto missing = [](BlockLists::List list, std::size_t j) {
            return !std::binary_search(list.begin, list.begin + list.count, j);
          };
          listed += (lists.diffuse(b).count + lists.glossy(b).count) * kBlockReceivers;
          for (std::size_t i = b * kBlockReceivers; i < (b + 1) * kBlockReceivers; ++i) {
            const Vec3f n = receivers.normal[i];
            if (dot(n, n) == 0) continue;
            // Lights that exceed the threshold by less than rounding may be missing.
            const auto check = [&](BlockLists::List list, std::size_t j, double value, float reach, float xi, double distance) {
              if (!(value > 1.0001 * static_cast<double>(reach * xi) * distance)) return;
              ++kept;
              lost += missing(list, j);
            };
            for (std::size_t j = 0; j < set.diffuse.size(); ++j) {
              const DiffuseLight& light = set.diffuse[j];
              const Vec3d v = static_cast<Vec3d>(light.position) - static_cast<Vec3d>(receivers.position[i]);
              const double d2 = dot(v, v), facing = dot(static_cast<Vec3d>(light.normal), v);
              if (!(dot(static_cast<Vec3d>(n), v) > 1e-5) || !(facing > 1e-5)) continue;
              check(lists.diffuse(b), j, facing / d2, light.reach, light.xi, std::sqrt(d2));
            }
            for (std::size_t j = 0; j < set.glossy.size(); ++j) {
              const GlossyLight& light = set.glossy[j];
              const Vec3d v = static_cast<Vec3d>(light.position) - static_cast<Vec3d>(receivers.position[i]);
              const auto row = [&](Vec3f r) { return dot(static_cast<Vec3d>(r), v); };
              const double d2 = dot(v, v), x = row(light.row_x), y = row(light.row_y), z = row(light.row_z), w2 = x * x + y * y + z * z;
              if (!(row(light.normal) > 1e-5) || !(z > 0)) continue;
              check(lists.glossy(b), j, z * d2 / (w2 * w2), light.reach, light.xi, std::sqrt(d2));
            }
          }
        }
      }
  }
  std::cout << kept << " pairs kept, " << listed << " on the lists\n";
  EXPECT_EQ(lost, 0u);
  EXPECT_GT(kept, 100'000u);
  EXPECT_LT(static_cast<double>(listed), 4 * static_cast<double>(kept));
}

}  // namespace
}  // namespace steradian::indirect::cull_test
