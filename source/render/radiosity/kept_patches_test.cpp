// A cache keeps the light of all patches from picture to picture, and no picture differs by it.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>

#include "paths.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"
#include "steradian/render_cache.h"

namespace steradian::kept_patches_test {
namespace {

RenderOptions tiny() {
  RenderOptions options;
  options.width = 48;
  options.height = 27;
  options.shadows = Shadows::on;
  options.quality = Quality::draft;
  options.bounces = kAllBounces;
  return options;
}

// Renders, and counts the steps of its work. The light of patches takes steps of its own.
struct Counted {
  Picture picture;
  std::uint64_t steps = 0;
};
Counted counted(const Scene& scene, RenderOptions options, RenderCache& cache) {
  std::atomic<std::uint64_t> steps{0};
  options.progress = [&](std::uint64_t, std::uint64_t) { ++steps; };
  Counted result{render(scene, options, cache)};
  result.steps = steps;
  return result;
}

void expect_same(const Picture& a, const Picture& b) {
  EXPECT_EQ(a.pixels, b.pixels);
  for (const char* layer : {"indirect", "bounce_error", "bounce_bound"}) EXPECT_EQ(a.layers.at(layer), b.layers.at(layer)) << layer;
}

// Moves a lamp and its shape, or scales its light.
struct Change {
  Vec3d by{};
  double light = 1;
};
Scene with_lamp(Scene scene, const Change& change) {
  AreaLight& lamp = scene.area_lights.front();
  std::vector<Vec3d>& vertices = std::get<Polygon>(lamp.shape).vertices;
  for (Vec3d& v : vertices) v += change.by;
  lamp.radiance = lamp.radiance * change.light;
  for (Mesh& mesh : scene.meshes) {
    if (!mesh.is_light_shape) continue;
    for (Vec3f& p : mesh.positions) p += static_cast<Vec3f>(change.by);
    SurfaceMaterial& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    material.emissive = material.emissive * static_cast<float>(change.light);
  }
  return scene;
}

}  // namespace

TEST(KeptPatches, ServeAnotherCameraAndNoOtherLight) {
  const Scene scene = load_scene(test::kSourceDir + "/scenes/cornell.glb").scene;
  const RenderOptions options = tiny();
  RenderCache cache;
  counted(scene, options, cache);
  const std::uint64_t with_kept = counted(scene, options, cache).steps;  // of the picture's tiles alone
  const auto check = [&](const char* name, bool kept, const std::function<void(Scene&, RenderOptions&)>& change) {
    SCOPED_TRACE(name);
    Scene changed = scene;
    RenderOptions changed_options = options;
    change(changed, changed_options);
    const Counted with = counted(changed, changed_options, cache);
    EXPECT_EQ(with.steps == with_kept, kept);
    expect_same(with.picture, render(changed, changed_options));
    counted(scene, options, cache);  // the light of the first scene again
  };
  check("the same", true, [](Scene&, RenderOptions&) {});
  check("the camera", true, [](Scene& s, RenderOptions&) { s.cameras.front().position.x += 0.1; });
  check("the size", true, [](Scene&, RenderOptions& o) { o.width = 50; });
  check("a preview", false, [](Scene&, RenderOptions& o) { o.bounce_preview = true; });
  check("the bounces", false, [](Scene&, RenderOptions& o) { o.bounces = 2; });
  check("the shadows", false, [](Scene&, RenderOptions& o) { o.shadows = Shadows::off; });
  check("a light", false, [](Scene& s, RenderOptions&) { s.area_lights.front().radiance.x *= 2; });
  check("a material", false, [](Scene& s, RenderOptions&) { s.materials.front().base_color.x *= 0.5f; });
  check("a mesh", false, [](Scene& s, RenderOptions&) { s.meshes.back().positions.front().y += 0.01f; });
}

// While lights alone change, the rays from patch to patch stay, but for those near a lamp's shape. No picture differs by it. The boxes
// float above the floor: of two surfaces at one place, rays may meet either.
TEST(KeptPatches, KeepTheirRaysWhileLightsChange) {
  Scene cornell = load_scene(test::kSourceDir + "/scenes/cornell.glb").scene;
  for (Mesh& mesh : cornell.meshes)
    if (mesh.name.ends_with("box"))
      for (Vec3f& p : mesh.positions) p.y += 0.01f;
  Scene glass = cornell;
  for (const Mesh& mesh : cornell.meshes)
    if (mesh.name == "short box") {
      glass.meshes[static_cast<std::size_t>(&mesh - cornell.meshes.data())].material = static_cast<int>(glass.materials.size());
      glass.materials.push_back({});
      glass.materials.back().metallic = 0;
      glass.materials.back().roughness = 0;
      glass.materials.back().base_color = {0.9f, 0.6f, 0.7f, 1};
      glass.materials.back().transmission = 1;
    }
  ASSERT_GT(glass.materials.size(), cornell.materials.size());
  RenderOptions options = tiny();
  options.bounce_preview = true;
  for (const Scene& scene : {cornell, glass}) {
    RenderCache cache;
    RenderStats all;
    render(scene, options, cache, &all);
    EXPECT_GT(all.patch_rays, 0u);
    // Returns the fraction of the rays that were traced again.
    const auto traced = [&](const char* name, const Scene& changed) {
      SCOPED_TRACE(name);
      RenderStats stats;
      expect_same(render(changed, options, cache, &stats), render(changed, options));
      return static_cast<double>(stats.patch_rays) / static_cast<double>(all.patch_rays);
    };
    EXPECT_EQ(traced("more light", with_lamp(scene, {{}, 2})), 0);
    // Even rays within a box meet a ball as often as the ball's area over the box's says: 5 % for each of two.
    const double near = traced("to the side", with_lamp(scene, {{0.3, 0, 0.4}}));
    EXPECT_GT(near, 0);
    EXPECT_LT(near, 0.15);
    EXPECT_LT(traced("down", with_lamp(scene, {{0.3, -1, 0.4}})), 0.15);
    Scene other = scene;
    other.meshes.front().positions.front().x -= 0.25f;
    EXPECT_GE(traced("another floor", other), 1);
    Scene red = scene;
    red.materials.front().base_color.y *= 0.5f;
    EXPECT_EQ(traced("another wall", red), 1);
  }
}

// A preview is kept beside the picture's own light.
TEST(KeptPatches, HoldAPreviewToo) {
  const Scene scene = load_scene(test::kSourceDir + "/scenes/cornell.glb").scene;
  RenderOptions options = tiny(), preview = tiny();
  preview.bounce_preview = true;
  RenderCache cache;
  const std::uint64_t first = counted(scene, options, cache).steps, first_preview = counted(scene, preview, cache).steps;
  EXPECT_LT(first_preview, first) << "it has fewer patches";
  EXPECT_LT(counted(scene, options, cache).steps, first);
  EXPECT_LT(counted(scene, preview, cache).steps, first_preview);
}

// The light of patches and the tiles share one count, which never falls and is full at the end alone.
TEST(KeptPatches, ProgressIsFullAtTheEndAlone) {
  const Scene scene = load_scene(test::kSourceDir + "/scenes/cornell.glb").scene;
  for (const int bounces : {0, 1, kAllBounces}) {
    RenderOptions options = tiny();
    options.bounces = bounces;
    options.threads = 1;
    std::uint64_t last = 0, calls = 0, full = 0;
    options.progress = [&](std::uint64_t done, std::uint64_t total) {
      EXPECT_GE(done, last);
      EXPECT_LE(done, total);
      last = done;
      full += done == total;
      ++calls;
    };
    render(scene, options);
    EXPECT_EQ(full, 1u) << bounces << " bounces";
    EXPECT_GT(calls, bounces == 0 ? 1u : 20u);
  }
}

// A picture that is stopped while its patches are lit leaves nothing unfinished behind.
TEST(KeptPatches, HoldNothingOfAStoppedPicture) {
  const Scene scene = load_scene(test::kSourceDir + "/scenes/cornell.glb").scene;
  RenderOptions options = tiny();
  RenderCache cache;
  std::atomic<bool> stop{false};
  options.stop = &stop;
  options.progress = [&](std::uint64_t done, std::uint64_t) { stop = done >= 3; };
  RenderState state;
  render(scene, options, cache, nullptr, &state);
  EXPECT_FALSE(state.complete);
  expect_same(render(scene, tiny(), cache), render(scene, tiny()));
}

}  // namespace steradian::kept_patches_test
