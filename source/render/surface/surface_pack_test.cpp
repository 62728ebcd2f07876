#include "render/surface/surface_pack.h"

#include <gtest/gtest.h>

#include <memory>

#include "support/random_configurations.h"

namespace steradian::surface_pack_test {
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
      mesh.texcoords[0].push_back({any(random, -2, 3), any(random, -2, 3)});
      mesh.texcoords[1].push_back({any(random, 0, 1), any(random, 0, 1)});
      mesh.indices.push_back(3 * t + static_cast<std::uint32_t>(i));
    }
  }
  return mesh;
}

// A random use of one of the images.
TextureUse any_use(Random& random, const Scene& scene, ColorSpace space) {
  const auto one_of = [&](int n) { return static_cast<int>(random.uniform(0, n - 0.001)); };
  TextureUse use;
  use.image = one_of(static_cast<int>(scene.images.size()));
  use.texcoord = one_of(2);
  use.wrap_u = static_cast<Wrap>(one_of(3));
  use.wrap_v = static_cast<Wrap>(one_of(3));
  use.filter = static_cast<Filter>(one_of(2));
  use.color_space = space;
  for (float& c : use.uv) c = any(random, -1, 1);
  return use;
}

// Smooth pictures: where a texture jumps, the rounding of its coordinates does too. Blue is that of a normal map: its vectors are no
// shorter than 0.17.
void add_images(Scene& scene) {
  for (const auto& [width, height] : {std::pair{64, 32}, {33, 7}}) {
    Image image{"", width, height, {}};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 4; ++c) {
          const double wave = std::sin(6.2832 * (x * (1.0 + c % 2) / width + c * y / (2.0 * height)));
          image.rgba.push_back(static_cast<std::uint8_t>(c == 2 ? 200 + 50 * wave : 128 + 100 * wave));
        }
    scene.images.push_back(image);
  }
}

void add_textured(Random& random, Scene& scene) {
  for (int i = 0; i < 4; ++i) {
    SurfaceMaterial m;
    m.base_color = {0.9f, 0.8f, 0.7f, 0.6f};
    m.base_color_texture = any_use(random, scene, ColorSpace::srgb);
    if (i % 2 == 0) m.alpha_mode = AlphaMode::blend;
    if (i != 1) m.metallic_roughness_texture = any_use(random, scene, ColorSpace::linear);
    if (i != 2) m.normal_texture = any_use(random, scene, ColorSpace::linear);
    m.normal_texture.scale = 0.7f;
    if (i == 3) m.specular_texture = m.specular_color_texture = any_use(random, scene, ColorSpace::linear);
    m.emissive = {0.5f, 1, 2};
    m.emissive_texture = any_use(random, scene, ColorSpace::srgb);
    m.double_sided = i == 1;
    if (i == 2) m.specular_override = {Material{}};
    scene.materials.push_back(m);
    scene.meshes.push_back(triangles(random, static_cast<int>(scene.materials.size()) - 1));
    Mesh& mesh = scene.meshes.back();
    for (std::size_t k = 0; k < mesh.positions.size() && i < 2; ++k) {
      const Vec3f t = k % 9 == 0 ? Vec3f{} : normalized(Vec3f{any(random, -1, 1), any(random, -1, 1), any(random, -1, 1)});
      mesh.tangents.push_back({t.x, t.y, t.z, k % 2 == 0 ? 1.0f : -1.0f});
      mesh.colors.push_back({any(random, 0, 1), any(random, 0, 1), any(random, 0, 1), any(random, 0, 1)});
    }
  }
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
  scene.materials[2].emissive = {3, 2, 1};  // shines on one side
  scene.materials[3].clearcoat = 0.5f;
  for (int m = 0; m < 4; ++m) scene.meshes.push_back(triangles(random, m));
  add_images(scene);
  add_textured(random, scene);
  return scene;
}

// Blocks that hit one mesh, one triangle or any meshes, and blocks with nothing in some or all slots.
std::unique_ptr<TileHits> any_hits(Random& random) {
  auto hits = std::make_unique<TileHits>();
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    const std::size_t block = i / 16 % 8, first = i / 16 * 16;
    hits->geometry[i] = block < 2 || (block == 2 && i > first)
                            ? (i == first ? static_cast<unsigned>(random.uniform(0, 7.999)) : hits->geometry[first])
                            : static_cast<unsigned>(random.uniform(0, 7.999));
    hits->triangle[i] = block == 0 && i > first ? hits->triangle[first] : static_cast<unsigned>(random.uniform(0, 199.999));
    if (block == 4 || (block == 5 && random.uniform(0, 1) < 0.5)) hits->geometry[i] = RTC_INVALID_GEOMETRY_ID;
    hits->u[i] = any(random, 0, 1);
    hits->v[i] = any(random, 0, 1) * (1 - hits->u[i]);
    hits->distance[i] = any(random, 0.1, 10);
    const Vec3f d = normalized(Vec3f{any(random, -1, 1), any(random, -1, 1), any(random, -1, 1)});
    hits->direction.x[i] = d.x;
    hits->direction.y[i] = d.y;
    hits->direction.z[i] = d.z;
  }
  return hits;
}

}  // namespace

// Compares every slot with the surface from one scalar call a pixel. A component of a unit vector is some roundings off. Turning a normal
// that is nearly across the view increases this. A position is off by the roundings of its coordinates, at most 8. A textured mesh also has
// the roundings of its texture coordinates, at most 12, times the slope of the looked-up value, at most 39. Its factors are 4.9 of a
// picture, 2.3 of sRGB's decoding, 2 of emission's factor, and three channels. A bent normal has twice that over its vector's length. If it
// pointed away from the view, within a fiftieth of its opposite, turning it back multiplies this by fifty.
TEST(SurfacePacks, FollowTheSurfaceOfEverySlot) {
  Random random(5);
  const Scene scene = scene_of_triangles(random);
  const SurfaceKind kinds[] = {SurfaceKind::plain, SurfaceKind::plain, SurfaceKind::textured, SurfaceKind::layered};
  for (std::size_t m = 0; m < 8; ++m) ASSERT_EQ(kind_of(scene, scene.meshes[m]), m < 4 ? kinds[m] : SurfaceKind::textured);
  const MipMaps maps(scene.images);
  const PixelSteps steps{{0.003f, 0, 0}, {0, 0.003f, 0}, {0, 0, -1}};
  for (const Simd simd : available_simd())
    for (int round = 0; round < 10; ++round) {
      const auto hits = any_hits(random);
      const auto tile = std::make_unique<SurfaceTile>(), expected = std::make_unique<SurfaceTile>();
      shade_tile(scene, {surface_packs_for(simd), Terminator::strict, &maps, steps}, *hits, *tile);
      double worst = 0, worst_plain = 0, worst_textured = 0, worst_bent = 0, worst_turned = 0;
      for (std::size_t i = 0; i < kTilePixels; ++i) {
        if (hits->geometry[i] == RTC_INVALID_GEOMETRY_ID) {
          ASSERT_EQ(tile->material[i], nullptr);
          ASSERT_EQ(tile->normal.x[i], 0.0f);
          continue;
        }
        const Vec3f view{-hits->direction.x[i], -hits->direction.y[i], -hits->direction.z[i]};
        const Mesh& mesh = scene.meshes[hits->geometry[i]];
        const SurfaceFootprint footprint = footprint_on(maps, mesh, hits->triangle[i], -view, hits->distance[i], steps);
        const Surface truth = surface_at(scene, mesh, hits->triangle[i], hits->u[i], hits->v[i], view, footprint);
        const Surface found = surface_in(*tile, i);
        const auto off = [&](Vec3f a, Vec3f b) { worst = std::max(worst, static_cast<double>(length(a - b))); };
        off(found.position, truth.position);
        off(found.geometric_normal, truth.geometric_normal);
        off({tile->view.x[i], tile->view.y[i], tile->view.z[i]}, view);
        EXPECT_LT(std::fabs(dot(found.tangent, found.normal)), 2e-6f);
        EXPECT_NEAR(length(found.tangent), 1, 2e-6f);
        EXPECT_EQ(found.coat, truth.coat);
        EXPECT_EQ(found.coat_alpha, truth.coat_alpha);
        EXPECT_EQ(found.sheen, truth.sheen);
        EXPECT_EQ(found.material, truth.material);
        const bool textured = kind_of(scene, mesh) == SurfaceKind::textured;
        double& sum = textured ? worst_textured : worst_plain;
        const auto lobe = [&](Vec3f a, Vec3f b) { sum = std::max(sum, static_cast<double>(length(a - b))); };
        if (textured) {
          const bool turned = dot(truth.normal, view) < 0.011f;  // turned back to the viewer
          double& bent = turned ? worst_turned : worst_bent;
          bent = std::max(bent, static_cast<double>(length(found.normal - truth.normal)));
        } else {
          off(found.normal, truth.normal);
        }
        if (truth.coat > 0) off(found.coat_normal, truth.coat_normal);
        lobe(found.albedo, truth.albedo);
        lobe(found.f0, truth.f0);
        lobe(found.f90, truth.f90);
        lobe({found.fresnel_loss, found.alpha_x, found.alpha_y}, {truth.fresnel_loss, truth.alpha_x, truth.alpha_y});
        lobe({tile->passes.x[i], tile->passes.y[i], tile->passes.z[i]}, truth.passes);
        lobe({tile->radiance.x[i], tile->radiance.y[i], tile->radiance.z[i]}, truth.emission);
      }
      EXPECT_EQ(worst_plain, 0) << name_of(simd);
      constexpr double kTextured = 39 * 12 * 1.2e-7;
      EXPECT_LT(worst_textured, kTextured) << name_of(simd);
      EXPECT_LT(worst_bent, 2 / 0.17 * kTextured) << name_of(simd);
      EXPECT_LT(worst_turned, 50 * 2 / 0.17 * kTextured) << name_of(simd);
      EXPECT_LT(worst, 5e-6) << name_of(simd);
      EXPECT_TRUE(tile->any_surface && tile->any_coat && tile->any_passing && tile->any_diffuse && tile->any_specular);
    }
}

}  // namespace steradian::surface_pack_test
