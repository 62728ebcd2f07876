// The CPU is the reference for the device: the bounce's light alone, with the same virtual lights, sets and seeds.
#include "device/bounce/bounce.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "device/frame/frame.h"
#include "night.h"
#include "paths.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "steradian/render_cache.h"
#include "support/memory.h"
#include "support/mixed_corner.h"

namespace steradian::vulkan::bounce_test {
namespace {

Scene scene_of(const std::string& name) { return load_scene(test::kSourceDir + "/scenes/" + name + ".glb").scene; }

RenderOptions small(IndirectMode mode, int lights) {
  RenderOptions options;
  options.width = 112;
  options.height = 63;
  options.method = "ltc-compact";
  options.shadows = Shadows::off;
  options.indirect.mode = mode;
  options.indirect.virtual_lights = lights;
  return options;
}

class VulkanBounce : public ::testing::Test {
 protected:
  void SetUp() override {
    if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device";
  }
};

// The bound is the back end's promise. Rounding moves halves by 1e-6 of them. The same fraction of the pairs crosses the threshold by
// which chance keeps them. One pair weighs a few hundredths of a pixel's light.
void expect_same(const std::string& name, const Scene& scene, RenderOptions options, RaysBy rays = RaysBy::automatic) {
  options.backend = Backend::cpu;
  const std::vector<Vec3f> cpu = render(scene, options).layers.at("indirect");
  options.backend = Backend::vulkan;
  const std::vector<Vec3f> device = DeviceFrame(scene, options, nullptr, SurfacesBy::automatic, rays).render().layers.at("indirect");
  double squares = 0, errors = 0, largest = 0;
  for (std::size_t i = 0; i < cpu.size(); ++i) {
    const Vec3f off = device[i] - cpu[i];
    const auto error = static_cast<double>(dot(off, off));
    ASSERT_TRUE(std::isfinite(error)) << name << " pixel " << i;
    squares += static_cast<double>(dot(cpu[i], cpu[i]));
    errors += error;
    largest = std::max(largest, error);
  }
  EXPECT_GT(squares, 0) << name;
  const double relative = std::sqrt(errors / squares);
  std::printf("%-24s relative L2 %.1e, largest %.1e of the root mean square\n", name.c_str(), relative,
              std::sqrt(largest / squares * static_cast<double>(cpu.size())));
  EXPECT_LE(relative, 1e-3) << name;
}

TEST_F(VulkanBounce, LightsTheProjectsScenesAsTheCpu) {
  for (const char* name : {"ring", "gallery"}) {
    if (std::string(name) == "gallery" && !test::is_night()) continue;
    const Scene scene = scene_of(name);
    expect_same(std::string(name) + ", ltc", scene, small(IndirectMode::ltc, 1 << 12));
    expect_same(std::string(name) + ", ggx", scene, small(IndirectMode::ggx, 1 << 12));
  }
}

TEST_F(VulkanBounce, LightsByAMapOfTheDevicesRaysAsTheCpu) {
  for (const char* name : {"ring", "gallery", "hall"})
    if (std::string(name) != "gallery" || test::is_night())
      expect_same(std::string(name) + ", own rays", scene_of(name), small(IndirectMode::ltc, 1 << 12), RaysBy::device);
}

// An object stands in front of the wall that could have holes.
TEST_F(VulkanBounce, LeavesTheMapBehindCutOutsToTheHost) {
  Scene scene = indirect::mixed_corner();
  scene.materials.push_back(indirect::plastic(0.5f, 0.5f));
  scene.materials.back().alpha_mode = AlphaMode::mask;
  scene.meshes.push_back(scene::quad_mesh({-0.2f, 1, 1}, {0.2f, 1, 1}, {0.2f, 1.6f, 1}, {-0.2f, 1.6f, 1}, 2));
  RenderOptions options = small(IndirectMode::ltc, 1 << 10);
  expect_same("behind a cut-out", scene, options, RaysBy::device);
}

// Rays in a cache must be those of the scene that is drawn.
TEST_F(VulkanBounce, KeepsTheRaysOfAScene) {
  RenderOptions options = small(IndirectMode::ltc, 1 << 10);
  options.backend = Backend::vulkan;
  Scene scene = indirect::mixed_corner();
  RenderCache cache;
  const auto draw = [&](RenderCache* kept) {
    return DeviceFrame(scene, options, nullptr, SurfacesBy::automatic, RaysBy::device, kept).render().layers.at("indirect");
  };
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(draw(&cache) == draw(nullptr)) << k;
    if (k == 1)
      for (Vec3f& p : scene.meshes[1].positions) p.z += 0.4f;
  }
}

TEST_F(VulkanBounce, HasEveryOptionOfTheCpu) {
  const Scene scene = indirect::mixed_corner();
  RenderOptions options = small(IndirectMode::ltc, 1 << 10);
  options.width = 65;  // no tile of 16 sub-images is full
  options.height = 49;
  expect_same("corner", scene, options);
  expect_same("sharp corner", indirect::metal_corner(0.2f), options);  // quads
  options.indirect.quads = options.indirect.soften = false;
  expect_same("points, not softened", indirect::metal_corner(0.2f), options);
  options.indirect.filter = false;
  expect_same("without filter", scene, options);
  options.indirect.interleave = 2;
  options.indirect.kept_pairs = 0;
  expect_same("nothing culled", scene, options);
}

TEST_F(VulkanBounce, SheetsSendNothingThroughThemselves) {
  RenderOptions options = small(IndirectMode::ltc, 1 << 12);
  options.backend = Backend::vulkan;
  options.indirect.interleave = 1;
  options.indirect.kept_pairs = 0;
  const Picture picture = render(indirect::lit_sheet(), options);
  EXPECT_GT(indirect::largest(picture.pixels), 1);
  EXPECT_LT(indirect::largest(picture.layers.at("indirect")), 1e-3f);
}

// One set has more lights than a round has words.
TEST_F(VulkanBounce, AddsUpManyLightsInRounds) {
  RenderOptions options = small(IndirectMode::ltc, 40000);
  options.width = 24;
  options.height = 18;
  options.indirect.interleave = 1;
  options.indirect.kept_pairs = 0;
  expect_same("in rounds", indirect::metal_corner(), options);
}

TEST_F(VulkanBounce, SaysWhatItsPassesTook) {
  RenderOptions options = small(IndirectMode::ltc, 1 << 10);
  const Scene scene = indirect::mixed_corner();
  options.width = options.height = 32;
  options.backend = Backend::vulkan;
  DeviceFrame frame(scene, options, nullptr, SurfacesBy::automatic, RaysBy::device);
  RenderStats stats;
  for (int i = 0; i < 2; ++i) frame.render(&stats);
  for (const char* name :
       {"indirect: device: shadow map", "indirect: device: cull", "indirect: device: light", "indirect: device: resolve"})
    EXPECT_TRUE(std::any_of(stats.passes.begin(), stats.passes.end(), [&](const PassTime& p) { return p.name == name && p.ms > 0; }))
        << name;
}

TEST_F(VulkanBounce, AHundredFramesLeaveMemoryWhereItWas) {
  RenderOptions options = small(IndirectMode::ltc, 1 << 8);
  const Scene scene = indirect::mixed_corner();
  options.width = options.height = 16;
  options.backend = Backend::vulkan;
  DeviceFrame frame(scene, options, nullptr, SurfacesBy::automatic, RaysBy::device);
  for (int i = 0; i < 30; ++i) frame.render();
  const double before = test::resident_mib();
  for (int i = 0; i < 100; ++i) frame.render();
  EXPECT_LE(test::resident_mib(), before + 2);  // 20 KiB a frame
}

TEST_F(VulkanBounce, LeavesNothingToTheValidationLayer) {
  std::shared_ptr<const Device> validated;
  try {
    validated = std::make_shared<const Device>(DeviceOptions{"", true});
  } catch (const Error& e) {
    GTEST_SKIP() << e.what();
  }
  const Scene scene = indirect::mixed_corner();
  for (const IndirectMode mode : {IndirectMode::ltc, IndirectMode::ggx}) {
    RenderOptions options = small(mode, 1 << 10);
    options.backend = Backend::vulkan;
    options.width = options.height = 32;
    DeviceFrame(scene, options, validated, SurfacesBy::automatic, RaysBy::device).render();
  }
  EXPECT_TRUE(validated->validation_messages().empty()) << validated->validation_messages().front();
}

TEST_F(VulkanBounce, LeavesShadowRaysAndAlgorithmOneToTheCpuAndSaysSo) {
  const Scene scene = indirect::mixed_corner();
  RenderOptions shadowed = small(IndirectMode::ltc, 1 << 10);
  shadowed.indirect.shadow_rays = 1;
  for (auto [options, lack] : {std::pair{shadowed, "no --indirect-shadows"},
                               std::pair{small(IndirectMode::ltc_outgoing, 1 << 10), "no --indirect ltc-outgoing"}}) {
    RenderStats stats;
    const Picture cpu = render(scene, options);
    options.backend = Backend::vulkan;
    const Picture picture = render(scene, options, &stats);
    ASSERT_EQ(stats.warnings.size(), 1u);
    EXPECT_NE(stats.warnings[0].find(lack), std::string::npos) << stats.warnings[0];
    EXPECT_TRUE(cpu.pixels == picture.pixels);
  }
}

}  // namespace
}  // namespace steradian::vulkan::bounce_test
