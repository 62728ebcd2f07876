// A stage's picture equals the cold frame's, byte for byte, after any sequence of changes.
#include <cstring>
#include <gtest/gtest.h>

#include "plane/exact/random.h"
#include "plane/stage/drawing.h"
#include "steradian/plane_stage.h"

namespace steradian::plane::stage_test {
namespace {

PlaneBody random_body(SceneRandom& random, const PlaneScene& scene) {
  const Vec2d c{random.uniform(0, scene.width), random.uniform(0, scene.height)};
  const auto v = [&](double r) { return Vec2d{random.uniform(-r, r), random.uniform(-r, r)}; };
  PlaneBody body;
  switch (static_cast<int>(random.uniform() * 5)) {
    case 0: body = plane_circle(c, random.uniform(2, 15)); break;
    case 1:
      body = plane_circle(c, 1);
      body.x_axis = v(15);
      body.y_axis = v(15);
      break;
    case 2:
      body.shape = PlaneBody::Shape::capsule;
      body.contours = {{c, c + v(25)}};
      body.radius = random.uniform(1, 8);
      break;
    case 3: body = plane_polygon({c, c + v(20), c + v(20), c + v(20)}); break;
    default: body.shape = PlaneBody::Shape::polyline; body.contours = {{c, c + v(30), c + v(30)}};
  }
  if (random.uniform() < 0.3) {
    PlaneEmission& light = body.light.emplace();
    light.radiance = {random.uniform(), random.uniform(), 1};
    if (random.uniform() < 0.7) light.range = random.uniform(30, 150);
    if (random.uniform() < 0.2) light.profile = PlaneProfile::lambert;
  }
  return body;
}

void change(PlaneStage& stage, SceneRandom& random) {
  const std::size_t count = stage.scene().bodies.size(), i = static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
  switch (static_cast<int>(random.uniform() * 6)) {
    case 0: stage.add(random_body(random, stage.scene())); break;
    case 1: stage.remove(i); break;
    case 2: stage.replace(i, random_body(random, stage.scene())); break;
    case 3:
      if (stage.scene().bodies[i].light) stage.recolour(i, {random.uniform(), 1, 0.5});
      break;
    default: stage.move(i, {random.uniform(-9, 9), random.uniform(-9, 9)});
  }
}

void expect_cold_frame(PlaneStage& stage, const PlaneFrameOptions& options, const std::string& what) {
  const Picture& picture = stage.draw();
  const Picture cold = render_plane(PlaneWorld(stage.scene()), options);
  ASSERT_EQ(picture.pixels.size(), cold.pixels.size());
  for (std::size_t i = 0; i < cold.pixels.size(); ++i)
    ASSERT_EQ(std::memcmp(&picture.pixels[i], &cold.pixels[i], sizeof(Vec3f)), 0)
        << what << ": pixel " << i % static_cast<std::size_t>(cold.width) << ", " << i / static_cast<std::size_t>(cold.width) << " is "
        << picture.pixels[i].x << ", cold " << cold.pixels[i].x;
}

}  // namespace

TEST(PlaneStage, EqualsTheColdFrameAfterAnySequence) {
  for (int kind = 0; kind < 3; ++kind) {
    SceneRandom random(static_cast<std::uint64_t>(17 + kind));
    PlaneScene scene;
    if (kind == 0) scene = make_light_field({24, 60, 120, 7, 9, 640, 360}, 5);
    if (kind == 1) scene = make_light_field({6, 40, 1e300, 7, 9, 640, 360}, 5);
    if (kind == 2) {
      scene.width = 400;
      scene.height = 300;
      for (int i = 0; i < 25; ++i) scene.bodies.push_back(random_body(random, scene));
    }
    PlaneFrameOptions options;
    if (kind == 1) options.limits.memory = 12'000'000;  // capacity for some of the cached light, not for all
    PlaneStage stage(scene, options);
    std::size_t drawn = 0, all = 0, anew = 0;
    for (int step = 0; step < 40; ++step) {
      expect_cold_frame(stage, options, "kind " + std::to_string(kind) + ", step " + std::to_string(step));
      anew += stage.stats().anew ? 1 : 0;
      if (step > 0) drawn += stage.stats().drawn, all += stage.stats().tiles;
      const int changes = step % 8 == 7 ? 3 : 1;
      for (int i = 0; i < changes; ++i) change(stage, random);
    }
    std::printf("kind %d: %.1f %% of the tiles drawn again, %zu of 40 times the scene made ready anew\n", kind,
                100.0 * static_cast<double>(drawn) / static_cast<double>(all), anew);
    if (kind == 0) {
      EXPECT_LT(drawn, all / 3);
    }
    EXPECT_LT(anew, 25u);
  }
}

// The capacity for replacements of blockers that overlap lights depends on the number that a scene has at the beginning.
TEST(PlaneStage, KeepsWhatIsReadyWhereManyThingsOverlap) {
  PlaneFrameOptions options;
  options.width = 192;
  options.height = 108;
  PlaneStage stage(make_light_field({4096, 5000, 60, 4, 8}, 1), options);
  stage.draw();
  for (std::size_t i = 0; i < 6; ++i) {
    stage.move(5000 + i, {3.6, 0});
    stage.draw();
    EXPECT_FALSE(stage.stats().anew) << "move " << i;
  }
}

TEST(PlaneStage, DrawsNothingWhereNothingHasChanged) {
  PlaneStage stage(make_light_field({4, 10, 120, 7, 9, 200, 100}, 5));
  stage.draw();
  EXPECT_EQ(stage.stats().drawn, stage.stats().tiles);
  stage.draw();
  EXPECT_EQ(stage.stats().drawn, 0u);
  EXPECT_THROW(stage.remove(1000), std::exception);
}

}  // namespace steradian::plane::stage_test
