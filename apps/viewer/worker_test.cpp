// The pictures of a window: references that improve, and devices that fail.
#include "worker.h"

#include <gtest/gtest.h>

#include <cmath>

#include "accumulation.h"
#include "paths.h"
#include "session.h"
#include "steradian/error.h"

namespace steradian::view::worker_test {
namespace {

RenderOptions small(const std::string& method = "auto") {
  RenderOptions options;
  options.width = 48;
  options.height = 27;
  options.shadows = Shadows::on;
  options.method = method;
  return options;
}

std::string room() { return test::kSourceDir + "/scenes/diffuse_floor.glb"; }

// Two passes of 1 and 3 pairs, computed by hand.
TEST(ViewAccumulation, IsTheMeanByPairs) {
  const auto pass = [](float value, float variance) {
    Picture p(1, 1);
    p.pixels[0] = {value, 0, 2 * value};
    p.layers["variance"] = {{variance, 0, variance}};
    return p;
  };
  Accumulation a;
  EXPECT_EQ(a.relative_error(), 0);
  a.add(pass(1, 0.5f), 1);
  a.add(pass(5, 0.25f), 3);
  EXPECT_EQ(a.pairs(), 4u);
  EXPECT_EQ(a.picture().pixels[0], (Vec3f{4, 0, 8}));
  // (1 x 0.5 + 9 x 0.25) / 16 in each of two channels.
  EXPECT_NEAR(a.picture().layers["variance"][0].x, 2.75 / 16, 1e-7);
  EXPECT_NEAR(a.relative_error(), std::sqrt(2 * 2.75 / 16 / (16 + 64)), 1e-7);
}

// Compares with closed forms, up to the estimated variance. For independent pixels, the squared deviations in standard errors have the mean
// 1, with a deviation of sqrt(2/n) if they are normal. 40 passes of four pairs use seeds that differ as the window's do. The test has no
// shadows, because their rays start a little above the surface, in proportion to its coordinates. At the horizon, thousands of units away,
// they start at another place than the closed form. A few hundred pairs show the difference.
TEST(ViewAccumulation, GrowsTowardsTheExactPictureAsItsErrorSays) {
  const LoadedScene loaded = load_scene(room());
  RenderOptions closed = small(), options = small("reference");
  closed.shadows = options.shadows = Shadows::off;
  const Picture exact = render(loaded.scene, closed);
  options.target_error = 0;
  options.spp = 4;
  RenderCache cache;
  Accumulation a;
  double last = INFINITY;
  for (int i = 0; i < 40; ++i) {
    options.seed = 1 + a.pairs();
    a.add(render(loaded.scene, options, cache), options.spp);
    if (i % 10 == 9) {
      EXPECT_LT(a.relative_error(), last);
      last = a.relative_error();
    }
  }
  const Picture mean = a.picture();
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    const double variance = static_cast<double>(mean.layers.at("variance")[i].y);
    const double value = static_cast<double>(exact.pixels[i].y), off = static_cast<double>(mean.pixels[i].y) - value;
    if (variance <= 1e-8 * value * value) continue;  // nothing random: only the rounding of floats remains
    sum += off * off / variance;
    ++count;
  }
  std::printf("after %llu pairs: standard error %.4f, mean square of deviations %.3f over %d pixels\n",
              static_cast<unsigned long long>(a.pairs()), a.relative_error(), sum / count, count);
  ASSERT_GT(count, 200);
  // Variances of 40 passes of four pairs have 40 x 3 degrees of freedom: the mean square of Student's t. The bound is four standard
  // deviations of the mean.
  EXPECT_NEAR(sum / count, 120.0 / 118, 4 * std::sqrt(2.0 / count));
}

TEST(ViewSession, AReferenceBesideThePictureGrowsWhileItRests) {
  Session s(room(), small());
  RenderOptions reference = small("reference");
  reference.target_error = 0.005;  // less than the error of the first pass, so passes must be added, even if the picture exists at once
  s.other() = reference;
  s.changed();
  s.wait_until_settled();
  const std::uint64_t pairs = s.frame().pairs;
  EXPECT_GT(pairs, 0u);
  EXPECT_LE(s.frame().standard_error, 0.005);
  while (!s.update()) std::this_thread::yield();
  EXPECT_GT(s.frame().pairs, pairs) << "it goes on";
  EXPECT_TRUE(s.settled());
  EXPECT_TRUE(s.frame().same);
  double square = 0, off = 0;
  for (std::size_t i = 0; i < s.frame().picture.pixels.size(); ++i) {
    const auto a = static_cast<Vec3d>(s.frame().picture.pixels[i]), b = static_cast<Vec3d>(s.frame().other.pixels[i]);
    square += dot(a, a);
    off += dot(a - b, a - b);
  }
  EXPECT_LT(std::sqrt(off / square), 3 * s.frame().standard_error);
  // A change restarts the accumulation.
  s.camera().orbit(0.05, 0);
  s.changed();
  s.wait_until_settled();
  EXPECT_FALSE(s.frame().same && s.frame().pairs > (1u << 20));
}

// A device that is lost while it renders, with the error that handles.h throws.
TEST(ViewSession, GoesOnWithTheCpuWhereADeviceIsLost) {
  int by_device = 0;
  RenderOptions options = small();
  options.backend = Backend::vulkan;
  Session s(room(), options, [&](const Scene& scene, const RenderOptions& o, RenderCache& cache, RenderStats* stats, RenderState* state) {
    if (o.backend == Backend::vulkan && ++by_device > 1) throw Error("Vulkan", "run a compute shader: the device was lost", "try again");
    RenderOptions on_cpu = o;
    on_cpu.backend = Backend::cpu;
    return render(scene, on_cpu, cache, stats, state);
  });
  while (!s.update()) std::this_thread::yield();
  s.wait_until_settled();
  s.camera().orbit(0.1, 0);
  s.changed();
  s.wait_until_settled();
  EXPECT_EQ(by_device, 2) << "it is not asked again";
  EXPECT_EQ(s.options().backend, Backend::cpu);
  EXPECT_NE(s.message().find("the device was lost"), std::string::npos) << s.message();
  EXPECT_NE(s.message().find("the CPU goes on"), std::string::npos) << s.message();
  RenderOptions cpu = small();
  const Scene shown = s.frame().scene->scene;
  EXPECT_EQ(render(shown, cpu).pixels, s.frame().picture.pixels);
}

struct Shown {
  ShownLight light;
  int divisor;
  bool last;
  bool operator==(const Shown&) const = default;
};

// Steps of a picture with bounces: a render that takes no time of its own, and tells the times of its passes.
struct Steps {
  explicit Steps(double preview) : preview_ms(preview) {
    request.file = scene::read_gltf_file(room());
    request.options = small();
    request.options.bounces = kAllBounces;
  }

  std::vector<Shown> shown(bool moving) {
    request.moving = moving;
    std::vector<Shown> all;
    const std::uint64_t number = worker.submit(request);
    for (bool ended = false; !ended;) {
      worker.wait();
      const auto frame = worker.take();
      if (!frame) break;
      EXPECT_EQ(frame->error, "");
      EXPECT_EQ(frame->request, number);
      EXPECT_EQ(frame->picture.width, small().width / frame->divisor);
      EXPECT_EQ(frame->picture.pixels[0].x > 0, frame->light != ShownLight::direct);
      EXPECT_EQ(frame->picture.pixels[0].y > 0, frame->light == ShownLight::preview);
      all.push_back({frame->light, frame->divisor, frame->last});
      ended = frame->last || moving;
    }
    return all;
  }

  double preview_ms;
  RenderRequest request;
  Worker worker{[this](const Scene&, const RenderOptions& o, RenderCache&, RenderStats* stats, RenderState* state) {
    stats->passes = {{"build", 0}, {"bounces: patches", o.bounce_preview ? preview_ms : 0}};
    state->complete = true;
    Picture picture(o.width, o.height);
    picture.pixels[0] = {o.bounces != 0 ? 1.0f : 0.0f, o.bounce_preview ? 1.0f : 0.0f, 0};
    return picture;
  }};
};

const std::vector<Shown> kDirect{{ShownLight::direct, 1, false}}, kPreview{{ShownLight::preview, 1, false}};

// The window may take only the newest of several pictures, so the last one at rest is what counts.
TEST(ViewWorker, ShowsDirectLightThenAPreviewThenAllLight) {
  Steps steps(1e4);
  EXPECT_EQ(steps.shown(false).back(), (Shown{ShownLight::all, 1, true}));
  EXPECT_EQ(steps.shown(true), kDirect) << "a preview takes too long";
  steps.preview_ms = 1;
  EXPECT_EQ(steps.shown(false).back(), (Shown{ShownLight::all, 1, true}));
  EXPECT_EQ(steps.shown(true), kPreview);
  steps.preview_ms = 450;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(steps.shown(true), kPreview) << "two pictures a second";
  steps.preview_ms = 1e3;
  for (int i = 0; i < 2; ++i) EXPECT_EQ(steps.shown(true), kPreview) << "one picture that takes long does not end the previews";
  EXPECT_EQ(steps.shown(true), kDirect) << "but two of them do";
}

TEST(ViewWorker, ForgivesTheFirstPreview) {
  Steps steps(700);
  steps.shown(false);
  steps.preview_ms = 100;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(steps.shown(true), kPreview) << "the first one paid for cold caches";
}

TEST(ViewWorker, ChoosesTheLargestPictureThatTheTimeAllows) {
  EXPECT_EQ(divisor_within(33, {0, 20, 1}), 1);
  EXPECT_EQ(divisor_within(33, {0, 100, 1}), 2);
  EXPECT_EQ(divisor_within(33, {0, 30, 4}), 4);
  EXPECT_EQ(divisor_within(33, {0, 1, 4}), 1);
  EXPECT_EQ(divisor_within(33, {0, 1e9, 1}), 8);
  EXPECT_EQ(divisor_within(33, {20, 20, 1}), 2) << "the scene's own time leaves less";
  EXPECT_EQ(divisor_within(33, {1e6, 20, 1}), 2) << "but half of it";
}

}  // namespace
}  // namespace steradian::view::worker_test
