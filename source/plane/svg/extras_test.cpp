// SVG attributes of suns, fog, glass, mirrors, stones and textured lines.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "steradian/error.h"
#include "steradian/plane.h"

namespace steradian::extras_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::string drawing(const std::string& body, const std::string& root = "") {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 100 100\"" + root + ">\n" + body + "\n</svg>";
}

PlaneScene read(const std::string& body, const std::string& root = "") {
  return load_plane_scene_from_text(drawing(body, root), "a.svg").scene;
}

// The error that a drawing causes.
Error refusal(const std::string& body) {
  try {
    PlaneWorld(read(body));
  } catch (const Error& e) {
    return e;
  }
  ADD_FAILURE() << "accepted: " << body;
  return Error("", "");
}

}  // namespace

TEST(PlaneSvgExtras, AreRead) {
  const PlaneScene scene = read(
      R"(<g data-steradian="sun" data-intensity="3"><rect id="noon" width="1" height="1" fill="#fff" data-sun-direction="-90 2.5"/>
         <circle r="1" fill="red" opacity="0.5" data-sun-direction="10"/></g>
         <g data-transmittance="0.5"><rect width="9" height="9" fill="#123456"/><circle class="light" cx="50" cy="50" r="3" fill="#fff"/>
         <rect width="5" height="5" data-transmittance="1 0 0.25"/></g>
         <rect width="4" height="4" data-mirror="0.9"/><circle r="4" data-light-depth="7"/>)",
      " data-fog-density=\"0.01\"");
  ASSERT_EQ(scene.suns.size(), 2u);
  EXPECT_EQ(scene.suns[0].name, "noon");
  EXPECT_NEAR(scene.suns[0].direction, -90 * kDegree, 1e-15);
  EXPECT_NEAR(scene.suns[0].half_width, 2.5 * kDegree, 1e-15);
  EXPECT_NEAR(scene.suns[0].radiance.y, 3, 1e-12);
  EXPECT_EQ(scene.suns[1].half_width, 0);
  EXPECT_NEAR(scene.suns[1].radiance.x, 1.5, 1e-12);
  EXPECT_EQ(scene.suns[1].radiance.y, 0);
  EXPECT_EQ(scene.fog_density, 0.01);
  ASSERT_EQ(scene.bodies.size(), 5u);
  EXPECT_EQ(scene.bodies[0].transmittance->y, 0.5);
  EXPECT_FALSE(scene.bodies[1].transmittance) << "a light in a group of panes";
  EXPECT_EQ(scene.bodies[2].transmittance->z, 0.25);
  EXPECT_EQ(scene.bodies[3].mirror->x, 0.9);
  EXPECT_EQ(scene.bodies[4].light_depth, 7);
}

TEST(PlaneSvgExtras, AreWrittenAsTheyAreRead) {
  PlaneScene scene = read(
      R"(<rect id="a" width="9" height="9" data-transmittance="1 0 0.25"/><rect width="4" height="4" data-mirror="0.9"/>
         <circle r="4" data-light-depth="7"/><circle class="light" cx="50" cy="50" r="3" fill="#fff"/>)",
      " data-fog-density=\"0.01\"");
  scene.suns.push_back({{5, 2, 1}, 0.7, 0.02, "evening"});
  const PlaneScene again = load_plane_scene_from_text(plane_scene_to_svg(scene), "b.svg").scene;
  EXPECT_EQ(again.fog_density, 0.01);
  ASSERT_EQ(again.suns.size(), 1u);
  EXPECT_EQ(again.suns[0].name, "evening");
  EXPECT_NEAR(again.suns[0].direction, 0.7, 1e-14);
  EXPECT_NEAR(again.suns[0].half_width, 0.02, 1e-15);
  EXPECT_NEAR(again.suns[0].radiance.y, 2, 1e-12);
  EXPECT_EQ(again.bodies[0].transmittance->z, 0.25);
  EXPECT_EQ(again.bodies[1].mirror->y, 0.9);
  EXPECT_EQ(again.bodies[2].light_depth, 7);
}

TEST(PlaneSvgExtras, ALineHasColoursAlongIt) {
  const PlaneScene scene = read(
      R"(<polyline class="light" points="10,10 50,10 50,30" fill="none" stroke="#fff" data-intensity="2" data-texture="red; #000; #00f"/>)");
  ASSERT_EQ(scene.bodies.size(), 2u);
  const auto& first = scene.bodies[0].light->gradient->stops;
  ASSERT_EQ(first.size(), 3u);
  EXPECT_EQ(first[0].radiance.x, 2);
  EXPECT_NEAR(first[1].offset, 0.75, 1e-15) << "the black one is half way, at 30 of 60";
  EXPECT_NEAR(first[2].radiance.z, 2 * 10.0 / 30, 1e-12);
  EXPECT_EQ(scene.bodies[1].light->gradient->stops.back().radiance.z, 2);
}

TEST(PlaneSvgExtras, WhatMeansNothingIsRefusedWithItsPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {R"(<rect width="9" height="9" data-transmittance="1 2 3"/>)", "one number from 0 to 1"},
      {R"(<rect width="9" height="9" data-mirror="shiny"/>)", "one number from 0 to 1"},
      {R"(<rect width="9" height="9" data-mirror="1" data-transmittance="1"/>)", "give one of them"},
      {R"(<circle r="9" data-mirror="1"/>)", "a rect, a polygon or a line"},
      {R"(<circle r="9" data-light-depth="-1"/>)", "a distance in user units"},
      {R"(<line x2="9" stroke="#000" data-light-depth="1"/>)", "filled shape"},
      {R"(<circle r="9" class="light" fill="#fff" data-mirror="1"/>)", "it is for occluders"},
      {R"(<circle r="9" class="light" fill="#fff" data-texture="red"/>)", "a stroke"},
      {R"(<line x2="9" stroke="#000" data-texture="red"/>)", "make it a light"},
      {R"(<line class="light" x2="9" stroke="#000" data-texture="red; rod"/>)", "semicolons"},
      {R"(<line class="light" x2="9" stroke="#000" data-texture=" ; "/>)", "semicolons"},
      {R"(<circle r="9" data-steradian="sun" fill="#fff"/>)", "data-sun-direction"},
      {R"(<circle r="9" data-steradian="sun" fill="#fff" data-sun-direction="up"/>)", "DIRECTION HALF-WIDTH"},
      {R"(<circle r="9" data-steradian="sun" fill="#fff" data-sun-direction="0 200"/>)", "DIRECTION HALF-WIDTH"},
      {R"(<circle r="9" data-steradian="moon"/>)", "light, occluder, sun or ignore"},
      {R"(<circle r="9" data-fog-density="1"/>)", "outermost <svg>"},
      {R"(<circle r="9" data-transmitance="1"/>)", "write data-transmittance"},
      {R"(<circle r="9" data-light-deph="1"/>)", "write data-light-depth"}};
  for (const auto& [body, hint] : cases) {
    const Error e = refusal(body);
    EXPECT_NE(e.hint().find(hint), std::string::npos) << body << ": " << e.what();
    EXPECT_NE(e.place().find("a.svg:2"), std::string::npos) << body << ": " << e.place();
  }
  EXPECT_THROW(read("", " data-fog-density=\"-1\""), Error);
}

}  // namespace steradian::extras_test
