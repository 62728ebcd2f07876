// Strokes in a session, and the lights that a fit moves towards them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "player.h"
#include "steradian/error.h"
#include "support/viewer_session.h"

namespace steradian::view::session_paint_test {
namespace {

double light_at(const Session& s, Vec2d pixel) {
  const Picture& p = s.frame().picture;
  return luminance(static_cast<Vec3d>(p.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y))));
}

// A pixel of the floor in front of the camera, for strokes of 40 pixels to the right.
constexpr Vec2d kFrom{60, 75}, kTo{100, 75};

AreaLight panel_of(const Session& s) { return s.frame().scene->scene.area_lights.at(0); }

void take_brush(Session& s, double wanted) {
  s.take_brush(true);
  s.brush.radius = 6;
  s.brush.radiance = Vec3d{1, 1, 1} * wanted;
}

TEST(ViewStrokes, MakeOneTargetForEachCameraAndPart) {
  Scene scene;
  PaintStroke stroke;
  stroke.width = 640;
  stroke.height = 320;
  stroke.points = {{100, 100}, {200, 100}};
  stroke.radius = 20;
  stroke.radiance = {2, 2, 2};
  PaintStroke across = stroke, other = stroke, highlight = stroke;
  across.points = {{150, 50}, {150, 150}};
  across.radiance = {3, 3, 3};
  other.camera.position = {1, 0, 0};
  highlight.part = LightPart::specular;
  const std::vector<LightTarget> targets = targets_of({stroke, across, other, highlight}, scene);
  ASSERT_EQ(targets.size(), 3u);
  ASSERT_EQ(scene.cameras.size(), 3u);
  const auto& first = std::get<PictureTarget>(targets[0]);
  EXPECT_EQ(first.picture.width, 160);
  EXPECT_EQ(first.picture.height, 80);
  EXPECT_EQ(first.camera, scene.cameras[0].name);
  EXPECT_EQ(first.picture.at(27, 25), (Vec3f{2, 2, 2}));
  EXPECT_EQ(first.picture.at(37, 25), (Vec3f{3, 3, 3})) << "the later stroke covers the earlier one";
  EXPECT_EQ(first.pixel_weights[25 * 160 + 37], 1.0f);
  EXPECT_EQ(first.pixel_weights[60 * 160 + 100], 0.0f) << "without a stroke, a pixel does not count";
  EXPECT_EQ(std::get<PictureTarget>(targets[2]).pixel_weights[60 * 160 + 100], 0.1f) << "a highlight is wanted nowhere else";
}

TEST(ViewStrokes, APaintedBrightnessSetsThePowerAsOneStepOfUndo) {
  Session s(room(), small());
  s.wait_until_settled();
  const double before = light_at(s, {80, 75});
  ASSERT_GT(before, 0);
  const Vec3d radiance = panel_of(s).radiance;
  const Picture first = s.frame().picture;

  take_brush(s, 3 * before);
  drag(s, kFrom, kTo);
  ASSERT_EQ(s.strokes().size(), 1u);
  EXPECT_GT(s.strokes()[0].points.size(), 2u);
  EXPECT_EQ(s.strokes()[0].places.size(), s.strokes()[0].points.size()) << "all of it lies on the floor";
  EXPECT_TRUE(s.fitting());
  EXPECT_FALSE(s.settled());
  s.wait_until_settled();
  ASSERT_EQ(s.message(), "");
  // The weight of staying holds the factor of 3 back by less than a hundredth; the floor is not evenly bright.
  EXPECT_NEAR(panel_of(s).radiance.x / radiance.x, 3, 0.3);
  EXPECT_NEAR(light_at(s, {80, 75}) / before, 3, 0.3);
  EXPECT_NE(s.fit_state().find("fitted"), std::string::npos) << s.fit_state();
  EXPECT_TRUE(s.unsaved());

  s.undo();
  s.wait_until_settled();
  EXPECT_EQ(s.frame().picture.pixels, first.pixels) << "one step takes the whole fit back";
  s.redo();
  s.wait_until_settled();
  EXPECT_NEAR(panel_of(s).radiance.x / radiance.x, 3, 0.3);
}

TEST(ViewStrokes, APaintedPlaceMovesTheLampThere) {
  Session s(room(), small());
  s.wait_until_settled();
  const Vec3d start = s.tree().world(s.lamps().at(0).node).t;
  // Strokes of the light that the lamp has half a metre away.
  Session wanted(room(), small());
  wanted.select({wanted.lamps().at(0).node, -1});
  set_pose(
      wanted.document(), wanted.lamps().at(0).node,
      moved(pose_of(wanted.document(), wanted.lamps().at(0).node), wanted.tree().parent_world(wanted.lamps().at(0).node), {0.5, 0, 0}));
  wanted.changed();
  wanted.wait_until_settled();
  s.fits_at_once = false;
  for (int x = 10; x < 150; x += 10) {
    take_brush(s, light_at(wanted, {x + 0.5, 75}));
    s.brush.radius = 2;
    drag(s, {x + 0.5, 74}, {x + 0.5, 76});
  }
  EXPECT_FALSE(s.fitting());
  s.fit_choice = {false};
  s.fit_choice.position = true;
  s.fit();
  s.wait_until_settled();
  ASSERT_EQ(s.message(), "");
  const Vec3d moved_by = s.tree().world(s.lamps().at(0).node).t - start;
  EXPECT_GT(moved_by.x, 0.1) << s.fit_state();
}

TEST(ViewStrokes, APaintedPlaceMovesTheCornersOfAPolygon) {
  Session s(room(), small());
  s.wait_until_settled();
  s.add_light("polygon");
  s.wait_until_settled();
  const std::vector<std::vector<Vec3d>> before = s.corners();
  ASSERT_EQ(before.size(), 1u);
  take_brush(s, 4 * light_at(s, {40, 75}));
  s.fit_choice = {false};
  s.fit_choice.vertices = true;
  drag(s, {30, 75}, {50, 75});
  s.wait_until_settled();
  ASSERT_EQ(s.message(), "");
  ASSERT_EQ(s.corners().size(), 1u);
  double most = 0;
  for (const Vec3d& corner : s.corners()[0]) {
    double nearest = 1e9;
    for (const Vec3d& old : before[0]) nearest = std::min(nearest, length(corner - old));
    most = std::max(most, nearest);
  }
  EXPECT_GT(most, 1e-3) << s.fit_state();
  s.undo();
  EXPECT_EQ(s.corners(), before) << "one step";
}

TEST(ViewStrokes, AChangeByHandEndsTheFitAndIsKept) {
  Session s(room(), small());
  s.wait_until_settled();
  take_brush(s, 5 * light_at(s, {80, 75}));
  s.fits_at_once = false;
  drag(s, kFrom, kTo);
  s.fit();
  EXPECT_TRUE(s.fitting());
  s.add_light("rect");
  const std::size_t lamps = s.lamps().size();
  s.wait_until_settled();
  EXPECT_FALSE(s.fitting());
  EXPECT_EQ(s.fit_state(), "stopped");
  EXPECT_EQ(s.lamps().size(), lamps);
}

TEST(ViewStrokes, SaysWhatCannotBeFitted) {
  Session s(room(), small());
  s.wait_until_settled();
  s.fit();
  EXPECT_EQ(s.message(), "there is no stroke to fit lights to");
  take_brush(s, 1);
  s.fits_at_once = false;
  drag(s, kFrom, kTo);
  s.fit_choice.selected = true;  // nothing is selected
  s.fit();
  s.wait_until_settled();
  EXPECT_NE(s.message().find("there is no light with these parameters"), std::string::npos) << s.message();
  s.remove_stroke();
  EXPECT_TRUE(s.strokes().empty());
  s.remove_stroke();
}

TEST(ViewStrokes, AScriptNamesBrushAndParameters) {
  ViewState state;
  open_stage(state, room(), small());
  state.session->wait_until_settled();
  set_value(state, "brush", 9);
  set_value(state, "wanted", {1, 2, 3});
  set_value(state, "part", "specular");
  set_value(state, "fit", {"position", "power"});
  set_value(state, "fit_at_once", false);
  EXPECT_EQ(state.session->brush.radius, 9);
  EXPECT_EQ(state.session->brush.radiance, (Vec3d{1, 2, 3}));
  EXPECT_EQ(state.session->brush.part, LightPart::specular);
  EXPECT_TRUE(state.session->fit_choice.position && state.session->fit_choice.power && !state.session->fit_choice.size);
  EXPECT_THROW(set_value(state, "fit", "shape"), Error);
  EXPECT_THROW(set_value(state, "brush", -1), Error);
  EXPECT_THROW(set_value(state, "wanted", {-1, 0, 0}), Error);
  act(state, Action::paint);
  EXPECT_TRUE(state.session->brush.on);
}

}  // namespace
}  // namespace steradian::view::session_paint_test
