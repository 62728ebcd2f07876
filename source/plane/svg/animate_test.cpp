// Drawings at a time: timing, values, transforms and motions of SMIL.
#include <gtest/gtest.h>

#include "plane/svg/style/values.h"
#include "plane/svg/timing.h"
#include "steradian/plane_animation.h"

namespace steradian::plane::svg::animate_test {
namespace {

PlaneSvg at(const std::string& shapes, double seconds) {
  const std::string svg =
      "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' viewBox='0 0 100 100'>" + shapes;
  return PlaneAnimation(svg + "</svg>", "drawing", {}).at(seconds);
}

// The centre of the only circle.
Vec2d center_at(const std::string& inside, double seconds, const std::string& attributes = "cx='10' cy='20'") {
  const PlaneSvg svg = at("<circle r='2' " + attributes + ">" + inside + "</circle>", seconds);
  EXPECT_EQ(svg.scene.bodies.size(), 1u);
  return svg.scene.bodies.empty() ? Vec2d{} : svg.scene.bodies[0].center;
}

void expect_near(Vec2d a, Vec2d b, double bound = 1e-9) {
  EXPECT_NEAR(a.x, b.x, bound);
  EXPECT_NEAR(a.y, b.y, bound);
}

}  // namespace

TEST(PlaneAnimation, ReadsClocks) {
  for (const auto& [text, seconds] :
       {std::pair{"1.5", 1.5}, {"2s", 2.0}, {"250ms", 0.25}, {"2min", 120.0}, {"1h", 3600.0}, {"01:30", 90.0}, {"1:00:30.5", 3630.5}})
    EXPECT_EQ(clock_value(text), seconds) << text;
  for (const char* text : {"", "click", "2 days", "a.end+1s", "1:2:3:4", "-2s"}) EXPECT_FALSE(clock_value(text)) << text;
}

TEST(PlaneAnimation, KnowsWhenAllHasHappenedOnce) {
  const auto of = [](const std::string& inside) {
    return PlaneAnimation("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 9 9'><circle r='2'>" + inside + "</circle></svg>",
                          "drawing", {});
  };
  EXPECT_EQ(of("").duration(), 0);
  EXPECT_EQ(of("<animate attributeName='cx' to='3' begin='1s' dur='2s' repeatCount='2.5'/>").duration(), 6);
  const PlaneAnimation loop =
      of("<animate attributeName='cx' to='3' dur='2s' repeatCount='indefinite'/><set attributeName='r' to='1' begin='5s'/>");
  EXPECT_EQ(loop.duration(), 5);
  EXPECT_TRUE(loop.endless());
  EXPECT_FALSE(of("<animate attributeName='cx' to='3' begin='click' dur='2s'/>").endless());
}

TEST(PlaneAnimation, MixesValues) {
  EXPECT_EQ(value_between("10px", "20px", 0.25), "12.5px");
  EXPECT_EQ(value_between("M0,0 L10-5", "M2 4 L 10 -10", 0.5), "M1 2 L10 -7.5");
  EXPECT_EQ(value_between("10px", "20%", 0.5), std::nullopt);
  EXPECT_EQ(value_between("none", "auto", 0.5), std::nullopt);
  EXPECT_EQ(value_between("#000", "white", 0), "rgb(0%,0%,0%)");
  EXPECT_EQ(value_sum("1 2", "10 20", 2), "21 42");
}

TEST(PlaneAnimation, ChangesAttributesInTime) {
  const std::string slide = "<animate attributeName='cx' from='10' to='30' begin='1s' dur='2s'";
  EXPECT_EQ(center_at(slide + "/>", 0.9).x, 10);
  EXPECT_EQ(center_at(slide + "/>", 2).x, 20);
  EXPECT_EQ(center_at(slide + "/>", 3.5).x, 10);
  EXPECT_EQ(center_at(slide + " fill='freeze'/>", 9).x, 30);
  EXPECT_EQ(center_at(slide + " repeatCount='indefinite'/>", 1 + 2 * 7 + 0.5).x, 15);
  EXPECT_EQ(center_at(slide + " repeatCount='2.5' fill='freeze'/>", 50).x, 20);
  EXPECT_EQ(center_at(slide + " repeatCount='3' accumulate='sum'/>", 1 + 2 + 1).x, 20 + 30);
  EXPECT_EQ(center_at(slide + " additive='sum'/>", 2).x, 10 + 20);
  EXPECT_EQ(center_at("<animate attributeName='cx' by='8' dur='2s'/>", 1).x, 14);
  EXPECT_EQ(center_at("<animate attributeName='cx' to='20' dur='2s'/>", 1).x, 15);
  const std::string steps = "<animate attributeName='cx' values='0;10;50' dur='4s'";
  EXPECT_EQ(center_at(steps + "/>", 3).x, 30);
  EXPECT_EQ(center_at(steps + " keyTimes='0;.25;1'/>", 1).x, 10);
  EXPECT_EQ(center_at(steps + " calcMode='discrete'/>", 3.9).x, 50);
  // The curve of these splines is a straight line.
  EXPECT_NEAR(center_at(steps + " calcMode='spline' keySplines='.3 .3 .7 .7;0 0 1 1'/>", 3).x, 30, 1e-9);
  EXPECT_EQ(center_at("<set attributeName='cx' to='77' begin='1s' dur='1s'/>", 1.5).x, 77);
  EXPECT_EQ(center_at("<set attributeName='cx' to='77' begin='1s' dur='1s'/>", 2.5).x, 10);
}

TEST(PlaneAnimation, RecoloursOverStyles) {
  const char* light =
      "<style>.light{fill:#000}</style><circle r='2' class='light' style='fill:black' data-intensity='2'>"
      "<animate attributeName='fill' from='black' to='#fff' dur='2s' fill='freeze'/>"
      "<animate attributeName='data-intensity' values='2;4' dur='2s' fill='freeze'/></circle>";
  EXPECT_EQ(at(light, 0).scene.bodies.at(0).light->radiance.x, 0);
  EXPECT_EQ(at(light, 2).scene.bodies.at(0).light->radiance.x, 4);
  // Half way in sRGB, converted to linear.
  EXPECT_NEAR(at(light, 1).scene.bodies.at(0).light->radiance.x, 3 * 0.21404114048, 1e-9);
}

TEST(PlaneAnimation, TurnsAndMoves) {
  const std::string turn = "<animateTransform attributeName='transform' type='rotate' from='0 50 50' to='180 50 50' dur='2s'";
  expect_near(center_at(turn + "/>", 1), {80, 10});
  expect_near(center_at(turn + " additive='sum'/>", 1, "cx='10' cy='20' transform='translate(1 0)'"), {81, 10});
  expect_near(center_at("<animateTransform attributeName='transform' type='scale' from='1' to='3 1' dur='2s'/>", 1), {20, 20});
  expect_near(center_at("<animateMotion path='M0 0H30V40' dur='7s'/>", 5, "transform='rotate(90)' cx='1' cy='0'"), {30, 21}, 1e-6);
  // The element's own x axis follows the path, which goes down there.
  expect_near(center_at("<animateMotion path='M0 0H30V40' dur='7s' rotate='auto'/>", 5, "cx='1' cy='0'"), {30, 21}, 1e-6);
  expect_near(center_at("<animateMotion values='0 0;10 0;10 30' dur='4s'/>", 1, "cx='0' cy='0'"), {10, 0}, 1e-6);
  expect_near(center_at("<animateMotion values='0 0;10 0;10 30' calcMode='linear' dur='4s'/>", 1, "cx='0' cy='0'"), {5, 0}, 1e-6);
  const PlaneSvg by_path =
      at("<path id='way' fill='none' d='M0 0L8 6'/><circle id='c' r='1'/>"
         "<animateMotion xlink:href='#c' dur='2s'><mpath xlink:href='#way'/></animateMotion>",
         1);
  expect_near(by_path.scene.bodies.at(0).center, {4, 3}, 1e-6);
}

TEST(PlaneAnimation, NamesWhatItLeavesOut) {
  const auto ignored = [](const std::string& inside) {
    std::string all;
    for (const std::string& name : at("<circle r='2'>" + inside + "</circle>", 1).ignored) all += name + "; ";
    return all;
  };
  EXPECT_NE(ignored("<animate attributeName='cx' to='3' begin='click' dur='2s'/>").find("event"), std::string::npos);
  EXPECT_NE(ignored("<animate attributeName='cx' to='3' dur='2s' end='1s'/>").find("end"), std::string::npos);
  EXPECT_EQ(ignored("<animate attributeName='cx' to='3' dur='2s'/>"), "");
  for (const char* bad :
       {"<animate attributeName='cx' to='3' dur='soon'/>", "<animate to='3' dur='2s'/>",
        "<animate attributeName='cx' values='1;2' keyTimes='0;2' dur='2s'/>", "<animateTransform type='bend' to='3' dur='2s'/>",
        "<animate attributeName='cx' to='3' dur='2s' repeatCount='-1'/>"})
    EXPECT_THROW(ignored(bad), std::exception) << bad;
}

}  // namespace steradian::plane::svg::animate_test
