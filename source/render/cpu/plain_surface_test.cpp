#include "render/cpu/plain_surface.h"

#include <gtest/gtest.h>

#include <memory>

#include "reference/random_configurations.h"

namespace steradian {
namespace {

using reference::Random;

float any(Random& random, double from, double to) { return static_cast<float>(random.uniform(from, to)); }

// Triangles of all sizes, some without area, some without normals.
Mesh triangles(Random& random, int material) {
  Mesh mesh;
  mesh.material = material;
  for (std::uint32_t t = 0; t < 200; ++t) {
    const float size = t % 7 == 0 ? 1e-9f : t % 11 == 0 ? 0.0f : any(random, 0.01, 3);
    const Vec3f corner{any(random, -5, 5), any(random, -5, 5), any(random, -5, 5)};
    for (int i = 0; i < 3; ++i) {
      const Vec3f aside{any(random, -1, 1), any(random, -1, 1), any(random, -1, 1)};
      mesh.positions.push_back(corner + aside * size);
      mesh.normals.push_back(t % 13 == 0 ? Vec3f{} : normalized(Vec3f{any(random, -1, 1), any(random, -1, 1), any(random, 1, 2)}));
      mesh.indices.push_back(3 * t + static_cast<std::uint32_t>(i));
    }
  }
  return mesh;
}

Scene scene_of_triangles(Random& random) {
  Scene scene;
  scene.materials.resize(4);
  scene.materials[0].metallic = 0.3f;
  scene.materials[0].roughness = 0.4f;
  scene.materials[1].emissive = {1, 2, 3};
  scene.materials[1].double_sided = true;
  scene.materials[1].base_color = {0.2f, 0.5f, 0.7f, 0.25f};
  scene.materials[1].alpha_mode = AlphaMode::blend;
  scene.materials[2].emissive = {3, 2, 1};  // on one side
  scene.materials[3].clearcoat = 0.5f;
  for (int m = 0; m < 4; ++m) scene.meshes.push_back(triangles(random, m));
  return scene;
}

// Blocks of one mesh, of one triangle, of any meshes, and with nothing in some slots or all.
std::unique_ptr<TileHits> any_hits(Random& random) {
  auto hits = std::make_unique<TileHits>();
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    const std::size_t block = i / 16 % 8, first = i / 16 * 16;
    hits->geometry[i] = block < 2 || (block == 2 && i > first)
                            ? (i == first ? static_cast<unsigned>(random.uniform(0, 3.999)) : hits->geometry[first])
                            : static_cast<unsigned>(random.uniform(0, 3.999));
    hits->triangle[i] = block == 0 && i > first ? hits->triangle[first] : static_cast<unsigned>(random.uniform(0, 199.999));
    if (block == 4 || (block == 5 && random.uniform(0, 1) < 0.5)) hits->geometry[i] = RTC_INVALID_GEOMETRY_ID;
    hits->u[i] = any(random, 0, 1);
    hits->v[i] = any(random, 0, 1) * (1 - hits->u[i]);
    hits->distance[i] = 1;
    const Vec3f d = normalized(Vec3f{any(random, -1, 1), any(random, -1, 1), any(random, -1, 1)});
    hits->direction.x[i] = d.x;
    hits->direction.y[i] = d.y;
    hits->direction.z[i] = d.z;
  }
  return hits;
}

}  // namespace

// Every slot against the surface of its own, by one call a pixel. A component of a unit vector is some roundings off, of which the
// turning of a normal that is nearly across the view makes more; a position those of its coordinates, at most 8.
TEST(PlainSurface, PacksFollowTheSurfaceOfEverySlot) {
  Random random(5);
  const Scene scene = scene_of_triangles(random);
  ASSERT_TRUE(is_plain(scene, scene.meshes[0]) && is_plain(scene, scene.meshes[1]));
  ASSERT_FALSE(is_plain(scene, scene.meshes[2]) || is_plain(scene, scene.meshes[3]));
  for (const Simd simd : available_simd())
    for (int round = 0; round < 10; ++round) {
      const auto hits = any_hits(random);
      const auto tile = std::make_unique<SurfaceTile>(), expected = std::make_unique<SurfaceTile>();
      shade_tile(scene, plain_surface_table_for(simd), *hits, Terminator::strict, *tile);
      double worst = 0;
      for (std::size_t i = 0; i < kTilePixels; ++i) {
        if (hits->geometry[i] == RTC_INVALID_GEOMETRY_ID) {
          ASSERT_EQ(tile->material[i], nullptr);
          ASSERT_EQ(tile->normal.x[i], 0.0f);
          continue;
        }
        const Vec3f view{-hits->direction.x[i], -hits->direction.y[i], -hits->direction.z[i]};
        const Surface truth = surface_at(scene, scene.meshes[hits->geometry[i]], hits->triangle[i], hits->u[i], hits->v[i], view);
        const Surface found = surface_in(*tile, i);
        const auto off = [&](Vec3f a, Vec3f b) { worst = std::max(worst, static_cast<double>(length(a - b))); };
        off(found.position, truth.position);
        off(found.normal, truth.normal);
        off(found.geometric_normal, truth.geometric_normal);
        off(found.coat_normal, truth.coat_normal);
        off({tile->view.x[i], tile->view.y[i], tile->view.z[i]}, view);
        EXPECT_LT(std::fabs(dot(found.tangent, found.normal)), 2e-6f);
        EXPECT_NEAR(length(found.tangent), 1, 2e-6f);
        EXPECT_EQ(found.albedo, truth.albedo);
        EXPECT_EQ(found.fresnel_loss, truth.fresnel_loss);
        EXPECT_EQ(found.f0, truth.f0);
        EXPECT_EQ(found.f90, truth.f90);
        EXPECT_EQ(found.alpha_x, truth.alpha_x);
        EXPECT_EQ(found.alpha_y, truth.alpha_y);
        EXPECT_EQ(found.coat, truth.coat);
        EXPECT_EQ(found.coat_alpha, truth.coat_alpha);
        EXPECT_EQ((Vec3f{tile->passes.x[i], tile->passes.y[i], tile->passes.z[i]}), truth.passes);
        EXPECT_EQ(found.sheen, truth.sheen);
        EXPECT_EQ(found.material, truth.material);
        EXPECT_EQ((Vec3f{tile->radiance.x[i], tile->radiance.y[i], tile->radiance.z[i]}), truth.emission);
      }
      EXPECT_LT(worst, 5e-6) << name_of(simd);
      EXPECT_TRUE(tile->any_surface && tile->any_coat && tile->any_passing && tile->any_diffuse && tile->any_specular);
    }
}

}  // namespace steradian
