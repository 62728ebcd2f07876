// Files that demand much: each is drawn small within a few seconds and a gigabyte, or refused with the option that raises the limit.
#include <sys/resource.h>

#include <cmath>

#include "program.h"

namespace steradian::plane_hostile_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::string number(double x) { return std::to_string(x); }

std::string svg(const std::string& body, const std::string& box = "0 0 640 480") {
  return "<svg xmlns='http://www.w3.org/2000/svg' viewBox='" + box + "'><circle class='light' cx='600' cy='240' r='9' fill='#fff'/>" +
         body + "</svg>";
}

std::string uses(int count, const std::string& more = "") {
  std::string text;
  for (int i = 0; i < count; ++i) text += "<use href='#shape' x='" + number(i * 37 % 600) + "' y='" + number(i * 53 % 460) + "'/>";
  return "<g " + more + ">" + text + "</g>";
}

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

// Numbers that appear random and are the same everywhere.
double spread(int i, double range) { return range * std::fmod(i * 0.6180339887498949, 1.0); }

const std::string kCurve = "<path id='shape' d='M0 0 C10 20 30 -10 20 15 C5 30 -10 10 0 0Z'/>";
const std::string kLight = "class='light' fill='#fff'";

std::string blob(int corners) {
  std::string points;
  for (int i = 0; i < corners; ++i) {
    const double t = 2 * kPi * i / corners, r = 20 * (1 + 0.3 * std::cos(7 * t));
    points += number(r * std::cos(t)) + "," + number(r * std::sin(t)) + " ";
  }
  return "<polygon id='shape' points='" + points + "'/>";
}

std::string path_of_curves(int count, const std::string& more) {
  std::string d = "M320 240";
  for (int i = 0; i < count; ++i) {
    d += " C";
    for (int k = 0; k < 3; ++k) d += number(spread(3 * i + k, 600)) + "," + number(spread(7 * i + 2 * k, 480)) + " ";
  }
  return "<path " + more + " d='" + d + "Z'/>";
}

std::string gradient(int stops) {
  std::string text = "<defs><linearGradient id='g'>";
  for (int i = 0; i < stops; ++i)
    text += "<stop offset='" + number(static_cast<double>(i) / stops) + "' stop-color='#" + std::to_string(i % 9 + 1) +
            std::to_string(i % 7) + "f'/>";
  return text + "</linearGradient></defs>";
}

// Shapes on a grid, one per cell.
template <class Shape>
std::string grid(int count, Shape shape) {
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  std::string text;
  for (int i = 0; i < count; ++i) text += shape(i, (i % side + 0.5) * 640 / side, (i / side + 0.5) * 480 / side, 640.0 / side);
  return text;
}

std::string lights_among_shapes(int lights, int shapes) {
  return grid(shapes, [&](int i, double x, double y, double cell) {
    return "<circle " + (i % 2 == 0 && i / 2 < lights ? kLight : "") + " cx='" + number(x) + "' cy='" + number(y) + "' r='" +
           number(0.23 * cell) + "'/>";
  });
}

}  // namespace

class PlaneHostile : public Program {
 protected:
  // The goal is 2 processor seconds on an otherwise idle machine with every optimisation. This limit assumes neither.
  void expect_bounded(const std::string& text, const std::vector<std::string>& more = {"--size", "64x48"}) {
    const std::string path = folder / "scene.svg";
    std::ofstream(path) << text;
    rusage before{}, after{};
    getrusage(RUSAGE_CHILDREN, &before);
    std::vector<std::string> arguments = {"render", path, "-o", folder / "a.exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome r = run(arguments);
    getrusage(RUSAGE_CHILDREN, &after);
    const auto seconds = [](const rusage& u) {
      return static_cast<double>(u.ru_utime.tv_sec + u.ru_stime.tv_sec) +
             1e-6 * static_cast<double>(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
    };
    const double taken = seconds(after) - seconds(before);
    std::printf("%7.0f KB: %s, %.2f s, %.0f MB\n", static_cast<double>(text.size()) / 1000, r.status == 0 ? "drawn" : "refused", taken,
                static_cast<double>(r.peak_kib) / 1000);
    EXPECT_TRUE(r.status == 0 || (r.status == 1 && r.err.find("--max-") != std::string::npos)) << r.status << ": " << r.err;
    EXPECT_LT(taken, 6);
    EXPECT_LT(r.peak_kib, 1'000'000);
  }
};

TEST_F(PlaneHostile, UsesOfManyEmptyGroups) {
  expect_bounded(svg("<defs><g id='shape'>" + repeated("<g/>", 1000) + "</g></defs>" + uses(99'000)));
}
TEST_F(PlaneHostile, UsesOfALongStyle) {
  expect_bounded(
      svg("<defs><rect id='shape' width='1' height='1' style='" + repeated("a:b;", 25'000) + "fill:none'/></defs>" + uses(99'000)));
}
TEST_F(PlaneHostile, UsesOfACurve) { expect_bounded(svg("<defs>" + kCurve + "</defs>" + uses(1000))); }
TEST_F(PlaneHostile, UsesOfAShiningCurve) { expect_bounded(svg("<defs>" + kCurve + "</defs>" + uses(1000, kLight))); }
TEST_F(PlaneHostile, APathOfManyCurves) { expect_bounded(svg(path_of_curves(1000, ""))); }
TEST_F(PlaneHostile, AShiningPathOfManyCurves) { expect_bounded(svg(path_of_curves(700, kLight))); }
TEST_F(PlaneHostile, ManyStopsOnManyShapes) {
  expect_bounded(svg(gradient(100) + grid(100, [](int, double x, double y, double) {
                       return "<rect class='light' x='" + number(x) + "' y='" + number(y) + "' width='20' height='10' fill='url(#g)'/>";
                     })));
  expect_bounded(svg(gradient(100) + grid(100, [](int, double x, double y, double) {
                       return "<circle class='light' cx='" + number(x) + "' cy='" + number(y) + "' r='9' fill='url(#g)'/>";
                     })));
}
TEST_F(PlaneHostile, UsesOfAPolygonOfManyCorners) { expect_bounded(svg("<defs>" + blob(4000) + "</defs>" + uses(100))); }
TEST_F(PlaneHostile, UsesOfAShiningPolygonOfManyCorners) { expect_bounded(svg("<defs>" + blob(4000) + "</defs>" + uses(100, kLight))); }
TEST_F(PlaneHostile, ClipsOfCurvesByCurves) {
  expect_bounded(svg("<defs><clipPath id='c'>" + path_of_curves(200, "") + "</clipPath>" + path_of_curves(200, "id='shape'") + "</defs>" +
                     uses(100, "clip-path='url(#c)'")));
}
TEST_F(PlaneHostile, LongTexts) {
  expect_bounded(svg("<text font-size='3'>" + repeated("many letters ", 20000) + "</text>"));
  expect_bounded(svg(repeated("<text font-size='3' y='9' " + kLight + ">a</text>", 20000)));
}
TEST_F(PlaneHostile, NestedRectangles) {
  for (const std::string& more : {std::string(), kLight}) {
    std::string text;
    for (int i = 0; i < 8000; ++i)
      text += "<rect " + more + " x='" + number(i * 0.02) + "' y='" + number(i * 0.02) + "' width='" + number(500 - i * 0.04) +
              "' height='" + number(400 - i * 0.04) + "'/>";
    expect_bounded(svg(text));
  }
}
TEST_F(PlaneHostile, ManyShapesAndSomeLights) {
  std::string text = grid(50'000, [](int, double x, double y, double cell) {
    return "<rect x='" + number(x) + "' y='" + number(y) + "' width='" + number(0.3 * cell) + "' height='" + number(0.3 * cell) + "'/>";
  });
  for (int i = 0; i < 16; ++i)
    text += "<circle " + kLight + " cx='" + number(40 * i + 13.7) + "' cy='" + number(i * 97 % 480) + "' r='0.2'/>";
  expect_bounded(svg(text));
}
TEST_F(PlaneHostile, ThousandsOfLightsAmongThousandsOfShapes) {
  expect_bounded(svg(lights_among_shapes(2000, 4000)));
  expect_bounded(svg(lights_among_shapes(4000, 8000)));
}
TEST_F(PlaneHostile, AHugePicture) { expect_bounded(svg("", "0 0 60000 60000"), {}); }
TEST_F(PlaneHostile, EndlessArcs) { expect_bounded(svg("<path d='M0 0" + repeated(" a1e9 1e9 0 1 1 1 0", 100'000) + "'/>")); }
TEST_F(PlaneHostile, ManyStrokes) {
  expect_bounded(
      svg("<path fill='none' stroke='#0ff' class='light' stroke-linecap='round' stroke-width='8' d='M60 100 C200 400 300 -200 500 300 S620 "
          "300 600 400'/>"));
}

}  // namespace steradian::plane_hostile_test
