#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plane/exact/outline.h"
#include "plane/exact/random.h"
#include "steradian/error.h"
#include "steradian/plane.h"
#include "support/plane_families.h"

namespace steradian::plane::load_test {
namespace {

PlaneSvg load(const std::string& inside, const std::string& attributes = "viewBox=\"0 0 100 100\"") {
  return load_plane_scene_from_text("<svg xmlns=\"http://www.w3.org/2000/svg\" " + attributes + ">\n" + inside + "\n</svg>", "test.svg");
}

void expect_refusal(const std::string& inside, const std::string& line, const std::string& problem) {
  try {
    load(inside);
    ADD_FAILURE() << "accepted: " << inside;
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("test.svg:" + line), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find(problem), std::string::npos) << e.what();
    EXPECT_FALSE(e.hint().empty()) << e.what();
  }
}

double area_of(const PlaneBody& body) {
  double sum = 0;
  for (const auto& c : body.contours)
    for (std::size_t i = 0; i < c.size(); ++i) sum += 0.5 * cross(c[i], c[(i + 1) % c.size()]);
  return std::fabs(sum);
}

}  // namespace

TEST(LoadSvg, RolesComeFromDataAttributeClassAndGroup) {
  const PlaneSvg svg = load(R"~(<rect width="10" height="10"/>
    <g class="light big"><circle r="5" fill="#fff"/><rect data-steradian="occluder" width="1" height="1"/></g>
    <g data-steradian="ignore"><rect class="light" width="9" height="9"/></g>
    <circle data-steradian="light" r="3" fill="red" data-intensity="2.5" data-range="40"/>
    <rect width="5" height="5" fill="none"/>)~");
  const auto& bodies = svg.scene.bodies;
  ASSERT_EQ(bodies.size(), 4u);
  EXPECT_FALSE(bodies[0].light);
  ASSERT_TRUE(bodies[1].light);
  EXPECT_NEAR(bodies[1].light->radiance.y, 1, 1e-15);
  EXPECT_FALSE(bodies[2].light);
  EXPECT_EQ(bodies[3].light->radiance.x, 2.5);
  EXPECT_EQ(bodies[3].light->radiance.y, 0);
  EXPECT_EQ(bodies[3].light->range, 40);
  EXPECT_TRUE(svg.ignored.empty());
}

TEST(LoadSvg, ColorsAreMadeLinear) {
  const PlaneSvg svg = load(R"~(<g class="light"><circle r="1" fill="#808080"/><circle r="1" fill="rgb(100%,0%,50%)"/>
    <circle r="1" style="fill: CornflowerBlue"/></g>)~");
  EXPECT_NEAR(svg.scene.bodies[0].light->radiance.x, std::pow((128 / 255.0 + 0.055) / 1.055, 2.4), 1e-15);
  EXPECT_NEAR(svg.scene.bodies[1].light->radiance.z, std::pow((0.5 + 0.055) / 1.055, 2.4), 1e-15);
  EXPECT_NEAR(svg.scene.bodies[2].light->radiance.z, std::pow((237 / 255.0 + 0.055) / 1.055, 2.4), 1e-15);
}

TEST(LoadSvg, StyleSheetsSayWhatAttributesWouldWhereverTheyStand) {
  const PlaneSvg svg =
      load(R"~(<rect id="a" class="lamp warm" width="9" height="9" fill="#000"/><circle class="lamp" r="4"/><circle r="2" class="cold"/>
    <rect class="light cold" width="3" height="3" style="fill:#00f"/>
    <style><![CDATA[ /* a { fill: red } */ .lamp, .cold { fill: #ff0000; } #a { fill: lime } circle.cold { display: none }
    @media print { rect { display: none } } g > rect { fill: blue } ]]></style>)~");
  ASSERT_EQ(svg.scene.bodies.size(), 3u) << "circle.cold is not displayed";
  EXPECT_EQ(svg.ignored, (std::vector<std::string>{"CSS @media", "CSS selector 'g > rect'"}));
  const PlaneSvg lit = load(R"~(<style>.lamp { fill: #f00 } #a { fill: #0f0 } rect { fill: #00f }</style>
    <g class="light"><rect id="a" class="lamp" width="1" height="1" fill="#fff"/><rect class="lamp" width="1" height="1"/><rect width="1" height="1" fill="#fff"/>
    <rect class="lamp" style="fill:#fff" width="1" height="1"/></g>)~");
  const auto radiance = [&](std::size_t i) { return lit.scene.bodies.at(i).light->radiance; };
  EXPECT_EQ(radiance(0), (Vec3d{0, 1, 0})) << "an id weighs more than a class";
  EXPECT_EQ(radiance(1), (Vec3d{1, 0, 0})) << "a class more than an element";
  EXPECT_EQ(radiance(2), (Vec3d{0, 0, 1})) << "a rule more than an attribute";
  EXPECT_NEAR(radiance(3).y, 1, 1e-15) << "style=\"\" more than a rule";
}

TEST(LoadSvg, LayersAreNamedForTheirRole) {
  const PlaneSvg svg = load(
      R"~(<g inkscape:label="Lights"><rect width="1" height="1"/></g><g inkscape:label="Highlight"><rect width="1" height="1"/></g>)~");
  EXPECT_TRUE(svg.scene.bodies.at(0).light);
  EXPECT_FALSE(svg.scene.bodies.at(1).light);
}

TEST(LoadSvg, OpacityDimsLights) {
  const PlaneSvg svg =
      load(R"~(<g class="light" opacity="0.5"><circle r="1" fill="#fff" fill-opacity="50%"/><circle r="1" fill="hsl(120, 100%, 50%)"/></g>
    <rect width="1" height="1" opacity="0"/><rect width="1" height="1" fill-opacity="0"/>)~");
  ASSERT_EQ(svg.scene.bodies.size(), 2u) << "what is not seen does not block";
  EXPECT_NEAR(svg.scene.bodies[0].light->radiance.x, 0.25, 1e-15);
  EXPECT_EQ(svg.scene.bodies[1].light->radiance.x, 0);
  EXPECT_NEAR(svg.scene.bodies[1].light->radiance.y, 0.5, 1e-15);
}

TEST(LoadSvg, TransformsNestAndUseMoves) {
  const PlaneSvg svg = load(R"~(<defs><rect id="box" width="2" height="1"/></defs>
    <g transform="translate(10 20)"><g transform="scale(3) rotate(90)"><use href="#box" x="1"/></g></g>)~");
  ASSERT_EQ(svg.scene.bodies.size(), 1u);
  const Box2d box = bounds_of(svg.scene.bodies[0]);
  EXPECT_NEAR(box.low.x, 7, 2e-12);
  EXPECT_NEAR(box.high.x, 10, 2e-12);
  EXPECT_NEAR(box.low.y, 23, 2e-12);
  EXPECT_NEAR(box.high.y, 29, 2e-12);
}

TEST(LoadSvg, CirclesStayExactUnderAnyTransform) {
  const PlaneSvg svg = load(R"~(<ellipse transform="skewX(30) scale(2 1)" cx="5" cy="5" rx="3" ry="2"/>)~");
  const PlaneBody& body = svg.scene.bodies[0];
  EXPECT_EQ(body.shape, PlaneBody::Shape::ellipse);
  EXPECT_NEAR(std::fabs(cross(body.x_axis, body.y_axis)), 12, 1e-12) << "area / pi";
}

// The flattened outline stays within 1e-5 of the picture's 100 units: areas agree within that times the outline's length.
TEST(LoadSvg, CurvesAreFlattenedToAThousandthOfAUnitHere) {
  const struct {
    const char* data;
    double area, perimeter;
  } kShapes[] = {
      {"M50,10 A40,40 0 0 1 50,90 A40 40 0 1 1 50,10 Z", M_PI * 1600, 252},
      {"M10 10 h80 v80 h-80 z", 6400, 320},
      {"M0 0 Q50 100 100 0 Z", 2.0 / 3 * 100 * 50, 250},
      {"m0,0 c0,50 100,50 100,0 z", 0.6 * 100 * 50, 220},
      {"M0 0 C0 50 50 50 50 25 S100 0 100 50 L100 0 z", 2500, 290},  // the S begins at (50, 0), mirrored at (50, 25)
      {"M0,0q25,50,50,0t50,0z", 0, 250},
  };
  for (const auto& s : kShapes) {
    const PlaneSvg svg = load(std::string("<path d=\"") + s.data + "\"/>");
    ASSERT_EQ(svg.scene.bodies.size(), 1u) << s.data;
    EXPECT_NEAR(area_of(svg.scene.bodies[0]), s.area, 1e-3 * s.perimeter) << s.data;
  }
  const PlaneSvg round = load(R"~(<rect x="10" y="10" width="60" height="40" rx="10"/>)~");
  EXPECT_NEAR(area_of(round.scene.bodies[0]), 2400 - (4 - M_PI) * 100, 1e-3 * 200);
}

// The same drawing in other units is the same picture: the accuracy of curves is a fraction of the picture, not of a user unit.
TEST(LoadSvg, CurvesAreAsFineInAnyUnit) {
  for (double unit : {1e-3, 0.01, 1.0, 1000.0}) {
    const auto number = [&](double x) { return std::to_string(x * unit); };
    const std::string r = number(10);
    const PlaneSvg svg = load("<path d=\"M" + number(40) + " " + number(50) + " a" + r + " " + r + " 0 1 0 " + number(20) + " 0 a" + r +
                                  " " + r + " 0 1 0 " + number(-20) + " 0z\"/>",
                              "viewBox=\"0 0 " + number(100) + " " + number(100) + "\"");
    // The inscribed polygon is smaller by two thirds of the sagitta, along the outline.
    EXPECT_NEAR(area_of(svg.scene.bodies.at(0)) / (unit * unit), M_PI * 100, 1e-3 * 63) << unit;
    EXPECT_LT(svg.scene.bodies[0].contours[0].size(), 400u) << "no finer than that: " << unit;
  }
}

TEST(LoadSvg, ArcsOfAnySizeHaveFinitePoints) {
  for (const char* data : {"M0 0 A1e-200 1e200 0 0 1 5 5", "M0 0 A1e-320 1e-320 0 0 1 5 5", "M0 0 A1e300 1e300 0 1 1 5 5",
                           "M0 0 A1e-200 1e-200 30 0 1 1e-190 0 L9 9", "M0 0 A0 3 0 0 1 5 5 L2 9", "M0 0 A1e160 1e-160 7 0 1 5 5 L3 8"}) {
    const PlaneSvg svg = load(std::string("<path d=\"") + data + "\" fill=\"none\" stroke=\"black\"/>");
    for (const PlaneBody& body : svg.scene.bodies)
      for (const auto& contour : body.contours)
        for (Vec2d p : contour) EXPECT_TRUE(is_finite(p)) << data;
  }
}

TEST(LoadSvg, FillRulesMakeHoles) {
  const char* kPath = R"~(<path fill-rule="%s" d="M0 0H90V90H0Z M30 30H60V60H30Z"/>)~";
  for (const char* rule : {"evenodd", "nonzero"}) {
    char text[200];
    std::snprintf(text, sizeof text, kPath, rule);
    const PlaneBody body = load(text).scene.bodies.at(0);
    EXPECT_TRUE(contains(body, {10, 10}));
    EXPECT_EQ(contains(body, {45, 45}), std::string(rule) == "nonzero") << rule;
  }
}

TEST(LoadSvg, StrokesAreThinOrCapsules) {
  const PlaneSvg svg = load(R"~(<line x1="0" y1="0" x2="50" y2="0" stroke="black"/>
    <line x2="50" stroke="#fff" stroke-width="6" stroke-linecap="round" class="light"/>
    <polyline points="0,0 10,10 20,0" fill="none" stroke="black"/>
    <polyline points="0,0 10,10 20,0"/> <line x2="9"/>)~");
  ASSERT_EQ(svg.scene.bodies.size(), 4u);
  EXPECT_EQ(svg.scene.bodies[0].shape, PlaneBody::Shape::polyline);
  EXPECT_EQ(svg.scene.bodies[1].shape, PlaneBody::Shape::capsule);
  EXPECT_EQ(svg.scene.bodies[1].radius, 3);
  EXPECT_NEAR(svg.scene.bodies[1].light->radiance.x, 1, 1e-15);
  EXPECT_EQ(svg.scene.bodies[2].shape, PlaneBody::Shape::polyline);
  EXPECT_EQ(svg.scene.bodies[3].shape, PlaneBody::Shape::polygon);
}

TEST(LoadSvg, GradientsFollowTheirBoxAndTransform) {
  const PlaneSvg svg = load(
      R"~(<defs><linearGradient id="stops"><stop offset="0" stop-color="black"/><stop offset="100%" stop-color="white"/></linearGradient>
    <linearGradient id="g" href="#stops"/></defs>
    <rect class="light" x="20" y="10" width="40" height="5" fill="url(#g)" transform="translate(5 0)"/>
    <rect class="light" width="10" height="10" fill="url(#g)" transform="skewX(45)"/>)~");
  const PlaneEmission& e = *svg.scene.bodies[0].light;
  EXPECT_NEAR(radiance_at(e, {25, 12}).x, 0, 1e-15);
  EXPECT_NEAR(radiance_at(e, {45, 12}).x, 0.5, 1e-15);
  EXPECT_NEAR(radiance_at(e, {99, 12}).x, 1, 1e-15);
  // Sheared: lines of one colour run along the sheared side.
  const PlaneEmission& sheared = *svg.scene.bodies[1].light;
  EXPECT_NEAR(radiance_at(sheared, {5, 0}).x, 0.5, 1e-12);
  EXPECT_NEAR(radiance_at(sheared, {15, 10}).x, 0.5, 1e-12);
}

TEST(LoadSvg, NamesEachUnknownElementOnce) {
  const PlaneSvg svg = load(R"~(<image/><image/><foreignObject/><g filter="url(#f)"><rect width="1" height="1"/></g><title>t</title>)~");
  EXPECT_EQ(svg.ignored, (std::vector<std::string>{"<foreignObject>", "<image>", "filter"}));
}

TEST(LoadSvg, SymbolsAndNestedPicturesFillTheirRoom) {
  const std::string symbol =
      R"~(<symbol id="s" viewBox="10 10 20 40" preserveAspectRatio="xMinYMax"><circle cx="20" cy="30" r="4"/></symbol>)~";
  const PlaneSvg svg = load(symbol + R"~(<use href="#s" x="100" y="50" width="80" height="80"/>
      <svg x="10" y="20" width="30" height="60" viewBox="0 0 3 3" preserveAspectRatio="none"><ellipse cx="1" cy="1" rx="1" ry="1"/></svg>)~");
  ASSERT_EQ(svg.scene.bodies.size(), 2u);
  const PlaneBody &used = svg.scene.bodies[0], &nested = svg.scene.bodies[1];
  EXPECT_EQ(used.center, (Vec2d{100 + 2 * 10, 50 + 2 * 20})) << "80 units show 40, from the left";
  EXPECT_EQ(used.x_axis, (Vec2d{8, 0}));
  EXPECT_EQ(nested.center, (Vec2d{10 + 10, 20 + 20}));
  EXPECT_EQ(nested.y_axis, (Vec2d{0, 20}));
}

TEST(LoadSvg, ClipPathsCutOutlines) {
  const std::string clips = R"~(<clipPath id="c"><rect x="10" y="10" width="40" height="40"/></clipPath>
      <clipPath id="two"><circle cx="20" cy="20" r="10" fill="none"/><rect x="60" y="0" width="10" height="100"/></clipPath>
      <clipPath id="ring" clip-path="url(#c)"><path clip-rule="evenodd" d="M0 0H100V100H0Z M20 20H40V40H20Z"/></clipPath>)~";
  const auto bodies = [&](const std::string& shape) { return load(clips + shape).scene.bodies; };
  // Halves, corners, holes, and shapes entirely within, which stay unchanged.
  EXPECT_NEAR(area_of(bodies(R"~(<rect width="30" height="100" clip-path="url(#c)"/>)~").at(0)), 20 * 40, 1e-6);
  EXPECT_EQ(bodies(R"~(<circle cx="30" cy="30" r="5" clip-path="url(#c)"/>)~").at(0).shape, PlaneBody::Shape::ellipse);
  EXPECT_TRUE(bodies(R"~(<circle cx="90" cy="30" r="5" clip-path="url(#c)"/>)~").empty());
  EXPECT_NEAR(area_of(bodies(R"~(<circle cx="50" cy="30" r="5" clip-path="url(#c)"/>)~").at(0)), 0.5 * M_PI * 25, 0.02);
  const PlaneBody both = bodies(R"~(<rect width="100" height="30" clip-path="url(#two)"/>)~").at(0);
  EXPECT_NEAR(area_of(both), M_PI * 100 + 10 * 30, 0.1) << "a clip's paint does not matter";
  const PlaneBody ring = bodies(R"~(<rect width="30" height="30" clip-path="url(#ring)"/>)~").at(0);
  EXPECT_NEAR(area_of(ring), 400 - 100, 1e-6) << "the clip is clipped, too";
  EXPECT_FALSE(plane::contains(ring, {25, 25}));
  // A comb leaves several parts without bridges between them, and groups clip everything in them, twice over.
  const PlaneBody comb = bodies(R"~(<g clip-path="url(#c)"><path d="M0 0H100V60H90V5H80V60H70V5H30V60H25V5H15V60H0Z"/></g>)~").at(0);
  EXPECT_EQ(comb.contours.size(), 2u);
  EXPECT_NEAR(area_of(comb), 5 * 40 + 5 * 40, 1e-6);
  EXPECT_NEAR(
      area_of(
          bodies(
              R"~(<g clip-path="url(#c)"><g transform="translate(30 0)" clip-path="url(#c)"><rect x="-50" width="200" height="99"/></g></g>)~")
              .at(0)),
      10 * 40, 1e-6);
  const PlaneBody line = bodies(R"~(<line x1="0" y1="20" x2="100" y2="20" stroke="#000" clip-path="url(#c)"/>)~").at(0);
  ASSERT_EQ(line.contours.size(), 1u);
  EXPECT_NEAR(line.contours[0].front().x, 10, 1e-9);
  EXPECT_NEAR(line.contours[0].back().x, 50, 1e-9);
}

TEST(LoadSvg, MasksOfWhiteAndBlackCutOutlines) {
  const std::string masks = R"~(<defs><mask id="m"><g class="light"><rect x="10" y="10" width="40" height="40" fill="white"/></g></mask>
      <mask id="hole" fill="#fff"><rect x="10" y="10" width="40" height="40"/><circle cx="30" cy="30" r="10" fill="black"/>
        <rect x="28" y="28" width="4" height="4"/></mask>
      <mask id="knife" fill="#fff"><rect x="10" y="10" width="40" height="40"/><path d="M0 20H100V30H0Z" fill="#000"/></mask>
      <mask id="alpha" mask-type="alpha"><rect x="10" y="10" width="40" height="40" fill="#123"/></mask>
      <mask id="room" maskUnits="userSpaceOnUse" x="10" y="10" width="40" height="40"><path d="M0 0H100V100H0Z" fill="white"/></mask>
      <mask id="none"/></defs>)~";
  const auto read = [&](const std::string& name) { return load(masks + "<rect width='30' height='100' mask='url(#" + name + ")'/>"); };
  for (const char* name : {"m", "alpha", "room"}) {
    const PlaneSvg svg = read(name);
    ASSERT_EQ(svg.scene.bodies.size(), 1u) << name;
    EXPECT_NEAR(area_of(svg.scene.bodies[0]), 20 * 40, 1e-6) << name;
    EXPECT_TRUE(svg.ignored.empty()) << name;
  }
  const PlaneBody hole = read("hole").scene.bodies.at(0);
  EXPECT_NEAR(area_of(hole), 20 * 40 - 0.5 * M_PI * 100 + 2 * 4, 0.1);
  EXPECT_FALSE(plane::contains(hole, {25, 30}));
  EXPECT_TRUE(plane::contains(hole, {29, 29})) << "white again, over the black";
  const PlaneBody knife = read("knife").scene.bodies.at(0);
  EXPECT_NEAR(area_of(knife), 20 * 30, 1e-6);
  EXPECT_EQ(knife.contours.size(), 2u);
  EXPECT_TRUE(read("none").scene.bodies.empty()) << "an empty mask shows nothing";
}

TEST(LoadSvg, OtherMasksAreNamedAndLeftOut) {
  for (const std::string inside :
       {R"~(<rect width="9" height="9" fill="#888"/>)~", R"~(<rect width="9" height="9" fill="#fff" opacity="0.5"/>)~",
        R"~(<path d="M0 0H9" stroke="#fff" fill="none"/>)~"}) {
    const PlaneSvg svg = load("<mask id='m'>" + inside + "</mask><rect width='30' height='100' mask='url(#m)'/>");
    ASSERT_EQ(svg.scene.bodies.size(), 1u) << inside;
    EXPECT_NEAR(area_of(svg.scene.bodies[0]), 3000, 1e-6);
    EXPECT_EQ(svg.ignored, (std::vector<std::string>{"mask (but of plain white and black shapes)"})) << inside;
  }
}

TEST(LoadSvg, OccludersKeepTheirColour) {
  const PlaneSvg svg =
      load(R"~(<defs><linearGradient id="g"><stop stop-color="#000"/><stop offset="1" stop-color="#fff"/></linearGradient></defs>
      <g color="#f00"><rect width="1" height="1" fill="currentColor"/></g><rect width="1" height="1" fill="url(#g)"/><rect width="1" height="1"/>)~");
  ASSERT_EQ(svg.scene.bodies.size(), 3u);
  EXPECT_EQ(svg.scene.bodies[0].color, (Vec3d{1, 0, 0}));
  EXPECT_EQ(svg.scene.bodies[1].color, (Vec3d{0.5, 0.5, 0.5}));
  EXPECT_EQ(svg.scene.bodies[2].color, (Vec3d{}));
}

namespace {

Vec2d middle_of(const PlaneBody& body) { return bounds_of(body).center(); }

}  // namespace

// For any font that the machine has: an O has a hole and is as high as a capital, and lines are anchored.
TEST(LoadSvg, TextIsOutlines) {
  const PlaneSvg svg = load(R"~(<text x="100" y="80" font-size="50" class="light" fill="#fff">O</text>
      <text x="300" y="80" font-size="50" text-anchor="middle"> HH </text>
      <text y="200"><tspan x="50">I</tspan><tspan x="250" fill="#f00">I</tspan></text>)~");
  if (!svg.ignored.empty() && svg.ignored[0].starts_with("<text>")) GTEST_SKIP() << svg.ignored[0];
  ASSERT_EQ(svg.scene.bodies.size(), 4u);
  const PlaneBody& o = svg.scene.bodies[0];
  EXPECT_TRUE(o.light);
  EXPECT_EQ(o.contours.size(), 2u);
  EXPECT_FALSE(plane::contains(o, middle_of(o))) << "the hole";
  EXPECT_GT(middle_of(o).x, 100);
  EXPECT_NEAR(middle_of(o).y, 80 - 0.36 * 50, 0.1 * 50) << "half a capital above the baseline";
  EXPECT_NEAR(middle_of(svg.scene.bodies[1]).x, 300, 1) << "as much to the left as to the right, but for side bearings";
  EXPECT_NEAR(middle_of(svg.scene.bodies[3]).x - middle_of(svg.scene.bodies[2]).x, 200, 1e-9);
}

TEST(LoadSvg, NamesTheFontThatStandsInForAnother) {
  const PlaneSvg svg = load(R"~(<text font-family="'No Such Font'">a</text>)~");
  ASSERT_EQ(svg.ignored.size(), 1u);
  if (svg.ignored[0].starts_with("<text>")) GTEST_SKIP() << svg.ignored[0];
  EXPECT_TRUE(svg.ignored[0].starts_with("the font 'No Such Font' (")) << svg.ignored[0];
}

TEST(LoadSvg, RefusesBrokenFilesWithLineAndHint) {
  expect_refusal("<rect", "", "not well-formed");
  expect_refusal("\n<circle r=\"abc\"/>", "3", "r=\"abc\"");
  expect_refusal("<path d=\"M 1 2 L 3\"/>", "2", "number is missing");
  expect_refusal("<path d=\"L 3 4\"/>", "2", "begin with M");
  expect_refusal("<path d=\"M0 0 X 4\"/>", "2", "unknown path command");
  expect_refusal("<path d=\"M0 0 A1 1 0 2 0 4 4\"/>", "2", "flags");
  expect_refusal("\n\n<g transform=\"turn(3)\"/>", "4", "transform");
  expect_refusal("<circle class=\"light\" r=\"3\" fill=\"url(#none)\"/>", "2", "refers to nothing");
  expect_refusal("<circle class=\"light\" r=\"3\" fill=\"reddish\"/>", "2", "not a colour");
  expect_refusal("<circle r=\"-3\"/>", "2", "negative");
  expect_refusal("<rect data-steradian=\"lamp\" width=\"1\" height=\"1\"/>", "2", "unknown");
  expect_refusal("<rect data-range=\"0\" width=\"1\" height=\"1\"/>", "2", "positive");
  expect_refusal("<rect data-albedo=\"1.2\" width=\"1\" height=\"1\"/>", "2", "albedo");
  expect_refusal("<rect data-albedo=\"0.1 0.2\" width=\"1\" height=\"1\"/>", "2", "three");
  expect_refusal("<rect data-intesity=\"2\" width=\"1\" height=\"1\"/>", "2", "data-intesity is unknown");
  EXPECT_NO_THROW(load("<rect data-name=\"Layer 1\" width=\"1\" height=\"1\"/>"));
  expect_refusal("<g id=\"a\"><use href=\"#a\"/></g>", "2", "nest deeper");
  expect_refusal("<use href=\"#nobody\"/>", "2", "refers to nothing");
  EXPECT_THROW(load_plane_scene_from_text("", "test.svg"), Error);
  EXPECT_THROW(load_plane_scene_from_text("<html/>", "test.svg"), Error);
  EXPECT_THROW(load("", "viewBox=\"0 0 -1 5\""), Error);
  EXPECT_THROW(load_plane_scene("/nonexistent/scene.svg"), Error);
}

TEST(LoadSvg, DoesNotBlowUpOnNestedUses) {
  // Ten levels of ten: a few bytes that would expand to ten thousand million.
  std::string text = "<defs><rect id=\"l0\" width=\"1\" height=\"1\"/>";
  for (int i = 1; i <= 10; ++i) {
    text += "<g id=\"l" + std::to_string(i) + "\">";
    for (int k = 0; k < 10; ++k) text += "<use href=\"#l" + std::to_string(i - 1) + "\"/>";
    text += "</g>";
  }
  EXPECT_THROW(load(text + "</defs><use href=\"#l10\"/>"), Error);
}

TEST(LoadSvg, WrittenScenesReadBackAsTheSame) {
  for (int family = 1; family <= kPlaneFamilies; ++family) {
    PlaneScene scene = make_plane_family(family, 3);
    for (PlaneBody& body : scene.bodies)
      if (body.light) {
        body.light->radiance = {3, 0.25, 0.01};
        body.light->range = 0.5;
      } else {
        body.color = {0.5, 0.25, 1};
      }
    const PlaneSvg read = load_plane_scene_from_text(plane_scene_to_svg(scene), "written.svg");
    ASSERT_EQ(read.scene.bodies.size(), scene.bodies.size());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (scene.bodies[i].light) continue;
      EXPECT_NEAR(read.scene.bodies[i].color.y, 0.25, 1e-12);
    }
    const PlaneWorld before(scene), after(read.scene);
    for (Vec2d p : points_outside(before, 20, 4)) {
      EXPECT_NEAR(before.query(p).radiance.x, after.query(p).radiance.x, 1e-12);
      EXPECT_NEAR(before.query(p).radiance.z, after.query(p).radiance.z, 1e-12);
    }
  }
}

TEST(LoadSvg, RefusesClipsAndMasksOfThemselves) {
  for (const std::string kind : {"clip-path", "mask"}) {
    const std::string name = kind == "mask" ? "mask" : "clipPath", use = "<use href='#s' " + kind + "='url(#c)'/>";
    expect_refusal("<" + name + " id='c'>" + use + "</" + name + "><rect id='s' width='9' height='9'/>" + use, "2", "nest deeper");
  }
}

// Any bytes give a scene or an Error; and no scene makes the exact method return a value that is not a number.
TEST(LoadSvg, SurvivesMutations) {
  const std::string seed =
      R"~(<svg viewBox="0 0 64 64"><defs><linearGradient id="g" x1="0" y1="0" x2="1" y2="1" gradientTransform="rotate(10)">
<stop offset="0" stop-color="#f00"/><stop offset="1" stop-color="blue"/></linearGradient></defs>
<g transform="translate(3,4) scale(1.5)" class="light" data-range="30" data-spot="10 40"><circle cx="10" cy="10" r="4" fill="url(#g)"/>
<path d="M20 20 c5 5 10 5 15 0 a3 4 10 0 1 4 4 q1 2 3 4 z" fill="#fe8" data-profile="lambert"/></g>
<rect x="1" y="2" width="6" height="7" rx="2"/><line x1="1" y1="40" x2="50" y2="41" stroke="red" stroke-width="3" stroke-linecap="round"/>
<polyline points="1,2 3,4 5,1" fill="none" stroke="#000"/><use href="#g" x="3"/></svg>)~";
  SceneRandom random(20);
  int accepted = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = seed;
    const int edits = 1 + static_cast<int>(random.uniform() * 4);
    for (int k = 0; k < edits; ++k) {
      const std::size_t at = static_cast<std::size_t>(random.uniform() * static_cast<double>(text.size()));
      const std::size_t from = static_cast<std::size_t>(random.uniform() * static_cast<double>(seed.size()));
      switch (static_cast<int>(random.uniform() * 4)) {
        case 0: text[at] = static_cast<char>(random.bits()); break;
        case 1: text.erase(at, 1 + static_cast<std::size_t>(random.uniform() * 8)); break;
        case 2: text.insert(at, seed.substr(from, 9)); break;
        default: text[at] = "0123456789.-e%"[static_cast<std::size_t>(random.uniform() * 14)];
      }
    }
    try {
      const PlaneWorld world(load_plane_scene_from_text(text, "fuzz").scene);
      const PlaneLight light = world.query({20, 30});
      ASSERT_TRUE(is_finite(light.radiance)) << text;
      ASSERT_TRUE(is_finite(light.moment_x) && is_finite(light.moment_y)) << text;
      ++accepted;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(accepted, 100);
}

TEST(PlaneSvg, ReadsAndWritesAlbedos) {
  const std::string svg =
      R"(<svg viewBox="0 0 9 9"><g data-albedo="0.5"><rect width="1" height="1"/><circle r="1" data-albedo="0.1,0.2 0.3"/></g><rect width="2" height="2"/></svg>)";
  PlaneScene scene = load_plane_scene_from_text(svg, "albedos.svg").scene;
  for (int pass = 0; pass < 2; ++pass) {
    ASSERT_EQ(scene.bodies.size(), 3u);
    EXPECT_EQ(scene.bodies[0].albedo, (Vec3d{0.5, 0.5, 0.5}));
    EXPECT_EQ(scene.bodies[1].albedo, (Vec3d{0.1, 0.2, 0.3}));
    EXPECT_FALSE(scene.bodies[2].albedo.has_value());
    scene = load_plane_scene_from_text(plane_scene_to_svg(scene), "written.svg").scene;
  }
}

}  // namespace steradian::plane::load_test
