// Editing a drawing: its bodies, its picture, its file.
#include "drawing/drawing.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "paths.h"
#include "steradian/error.h"
#include "support/gltf_test_file.h"

namespace steradian::view::drawing_test {
namespace {

const std::string lamps() { return test::kSourceDir + "/scenes/plane/lamps.svg"; }

Picture fresh(const PlaneScene& scene, int width, int height) {
  PlaneFrameOptions options;
  options.width = width;
  options.height = height;
  return render_plane(PlaneWorld(scene), options);
}

TEST(ViewPlaneBody, IsFoundByItsInside) {
  PlaneScene s;
  s.bodies.push_back(plane_polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
  s.bodies[0].contours.push_back({{4, 4}, {4, 6}, {6, 6}, {6, 4}});  // a hole
  s.bodies.push_back(plane_circle({30, 5}, 4));
  s.bodies.push_back(plane_circle({32, 5}, 4));
  PlaneBody capsule;
  capsule.shape = PlaneBody::Shape::capsule;
  capsule.contours = {{{50, 0}, {60, 10}}};
  capsule.radius = 2;
  s.bodies.push_back(capsule);
  PlaneBody line;
  line.shape = PlaneBody::Shape::polyline;
  line.contours = {{{80, 0}, {80, 10}}};
  s.bodies.push_back(line);
  EXPECT_EQ(body_at(s, {1, 1}, 0), 0u);
  EXPECT_FALSE(body_at(s, {5, 5}, 0)) << "the hole";
  EXPECT_EQ(body_at(s, {30, 5}, 0), 2u) << "the upper of two";
  EXPECT_EQ(body_at(s, {27, 5}, 0), 1u);
  EXPECT_EQ(body_at(s, {56, 5}, 0), 3u);
  EXPECT_FALSE(body_at(s, {78, 5}, 1));
  EXPECT_EQ(body_at(s, {78, 5}, 3), 4u) << "a line has no inside, but is near";
}

TEST(ViewPlaneBody, TurnsAndScalesAboutAPoint) {
  PlaneBody b = plane_circle({10, 0}, 2);
  b.light = PlaneEmission{};
  b.light->spot_axis = {1, 0};
  const PlaneBody t = turned(b, {0, 0}, std::acos(0.0));
  EXPECT_NEAR(length(t.center - Vec2d{0, 10}), 0, 1e-12);
  EXPECT_NEAR(length(t.light->spot_axis - Vec2d{0, 1}), 0, 1e-12);
  const PlaneBody s = scaled(b, {0, 0}, 3);
  EXPECT_NEAR(length(s.center - Vec2d{30, 0}), 0, 1e-12);
  EXPECT_NEAR(length(s.x_axis), 6, 1e-12);
  EXPECT_EQ(s.light->spot_axis, (Vec2d{1, 0}));
  EXPECT_NEAR(bounds_of(s).high.x, 36, 3e-12);
}

TEST(ViewDrawing, ADraggedLampIsDrawnAsASceneFromScratchWouldBe) {
  DrawingStage d(lamps(), 320, 200, 0);
  d.wait_until_settled();
  EXPECT_EQ(d.picture().pixels, fresh(d.scene(), 320, 200).pixels);
  const Picture before = d.picture();
  const Vec2d lamp = d.to_pixel({130, 120});
  d.press(PointerButton::left, false, lamp);
  ASSERT_TRUE(d.selection());
  const Vec2d center = d.scene().bodies[*d.selection()].center;
  for (int i = 1; i <= 10; ++i) {
    d.drag(lamp + Vec2d{4.0 * i, 2.0 * i});
    d.update();
  }
  d.release(lamp + Vec2d{40, 20});
  d.wait_until_settled();
  EXPECT_NEAR(length(d.scene().bodies[*d.selection()].center - center - Vec2d{80, 40}), 0, 1e-9);
  EXPECT_EQ(d.picture().pixels, fresh(d.scene(), 320, 200).pixels);
  EXPECT_NE(d.picture().pixels, before.pixels);
  d.undo();
  d.wait_until_settled();
  EXPECT_EQ(d.picture().pixels, before.pixels) << "a drag is one step";
  d.redo();
  d.wait_until_settled();
  EXPECT_NE(d.picture().pixels, before.pixels);
}

TEST(ViewDrawing, IsSavedAsAnSvgThatReadsBackAsIt) {
  DrawingStage d(lamps(), 160, 100, 0);
  d.add(true, {20, 20});
  PlaneBody red = d.scene().bodies.back();
  red.light->radiance = {2, 0.5, 0.25};
  d.change(d.scene().bodies.size() - 1, red);
  d.press(PointerButton::left, false, *d.resize_handle());
  d.release(*d.resize_handle() + Vec2d{5, 5});
  d.press(PointerButton::left, false, d.to_pixel({289, 85}));
  d.release(d.to_pixel({289, 85}));
  d.remove_selected();
  d.wait_until_settled();
  const std::string path = scene::test_path("saved.svg");
  d.save_scene(path);
  DrawingStage again(path, 160, 100, 0);
  again.wait_until_settled();
  EXPECT_EQ(again.scene().bodies.size(), d.scene().bodies.size());
  double largest = 0;
  for (std::size_t i = 0; i < d.picture().pixels.size(); ++i) {
    const Vec3f e = again.picture().pixels[i] - d.picture().pixels[i];
    largest = std::max(largest, static_cast<double>(length(e)));
  }
  std::printf("largest difference of a saved drawing's picture: %.2g\n", largest);
  EXPECT_LT(largest, 1e-5) << "what the frame itself may be off, plane.h";
  EXPECT_THROW(d.save_scene(scene::test_path("saved.png")), Error);
}

// An animated drawing with edits: animated bodies move as the file says, others stay where they were put.
TEST(ViewDrawing, PlaysItsOwnMotionAndKeepsWhatAHandHasMoved) {
  const std::string svg =
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 160 100'>"
      "<circle id='lamp' class='light' cx='20' cy='20' r='6' fill='#fff'><animate attributeName='cx' from='20' to='120' dur='2s'/></circle>"
      "<rect id='box' x='60' y='50' width='20' height='20'/></svg>";
  const std::string path = scene::write_test_file("moves.svg", svg);
  DrawingStage d(path, 160, 100, 0);
  d.wait_until_settled();
  EXPECT_EQ(d.duration(), 2);
  EXPECT_EQ(d.scene().bodies.at(0).center, (Vec2d{20, 20}));
  d.set_time(0.5);
  d.wait_until_settled();
  EXPECT_EQ(d.scene().bodies[0].center, (Vec2d{45, 20}));
  EXPECT_EQ(d.picture().pixels, fresh(PlaneAnimation(path).at(0.5).scene, 160, 100).pixels);
  // Tiles far from the animated bodies are not drawn again.
  EXPECT_LE(d.stats().drawn, d.stats().tiles);

  d.press(PointerButton::left, false, d.to_pixel({70, 60}));
  ASSERT_EQ(d.selection(), 1u);
  d.drag(d.to_pixel({80, 65}));
  d.release(d.to_pixel({80, 65}));
  d.add(true, d.to_pixel({140, 90}));
  d.set_time(1);
  d.wait_until_settled();
  EXPECT_EQ(d.scene().bodies[0].center, (Vec2d{70, 20}));
  EXPECT_NEAR(bounds_of(d.scene().bodies[1]).low.x, 70, 1e-9) << "the box stays where the hand has put it";
  EXPECT_EQ(d.scene().bodies.size(), 3u);
  EXPECT_EQ(d.picture().pixels, fresh(d.scene(), 160, 100).pixels);

  d.undo();
  d.undo();
  d.wait_until_settled();
  EXPECT_EQ(d.scene().bodies[0].center, (Vec2d{70, 20})) << "undone is what was done, not the time";
  EXPECT_EQ(d.picture().pixels, fresh(PlaneAnimation(path).at(1).scene, 160, 100).pixels);
  d.set_time(2.5);
  d.wait_until_settled();
  EXPECT_EQ(d.time(), 0.5) << "it begins again";
}

TEST(ViewDrawing, WhatCannotBeDrawnIsSaidAndUndone) {
  DrawingStage d(lamps(), 160, 100, 0);
  d.wait_until_settled();
  PlaneBody far = d.scene().bodies[0];
  far.center = {1e300, 0};
  d.change(0, far);
  d.wait_until_settled();
  EXPECT_NE(d.message(), "");
  d.undo();
  d.wait_until_settled();
  EXPECT_EQ(d.message(), "");
  EXPECT_EQ(d.picture().pixels, fresh(d.scene(), 160, 100).pixels);
}

}  // namespace
}  // namespace steradian::view::drawing_test
