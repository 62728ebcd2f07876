// draw_par PICTURE.png: shadows that overlap, by `exact`, by `par` with its intervals merged, and by `par` with its intervals added. Below
// each method's light stands its difference from `exact`, enlarged about grey. Prints the errors over the number of rows of boxes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "plane/exact/outline.h"
#include "plane/exact/world.h"
#include "steradian/picture.h"
#include "steradian/plane.h"

using namespace steradian;
using namespace steradian::plane;

namespace {

constexpr int kSide = 240, kGap = 4;
constexpr double kSpace = 240;                             // side of the square that a panel shows
constexpr float kWhite = 2, kEnlarged = 4, kGrey = 0.22f;  // of a panel: radiance times kWhite; differences times kEnlarged about kGrey

PlaneBody box(double x, double y, double half, double turn) {
  const double c = half * std::cos(turn), s = half * std::sin(turn);
  return plane_polygon({{x + c - s, y + s + c}, {x - c - s, y - s + c}, {x - c + s, y - s - c}, {x + c + s, y + s - c}});
}

// A lamp on top, and rows of boxes below it. All bodies are convex and apart, so `par` is exact.
PlaneScene rows_of_boxes(int rows) {
  PlaneScene scene;
  scene.width = scene.height = kSpace;
  scene.bodies.push_back(plane_polygon({{70, 14}, {170, 14}, {170, 22}, {70, 22}}));
  scene.bodies.back().light.emplace();
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < 5; ++i) {
      const double x = 48 + 36 * i + (row % 2 == 0 ? 0 : 18), y = 66 + 26 * row;
      scene.bodies.push_back(box(x, y, 5.5, 0.35 * (i + 2 * row)));
    }
  return scene;
}

using Light = std::function<double(const PlaneWorld&, Vec2d)>;

double by_par(const PlaneWorld& world, Vec2d p, ParOverlaps overlaps) {
  return par_light(world.impl(), p * world.impl().scale, overlaps).radiance.x;
}

bool within_a_body(const PlaneScene& scene, Vec2d p) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const PlaneBody& body) { return contains(body, p); });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: draw_par PICTURE.png\n");
    return 2;
  }
  const Light methods[] = {[](const PlaneWorld& world, Vec2d p) { return world.query(p).radiance.x; },
                           [](const PlaneWorld& world, Vec2d p) { return by_par(world, p, ParOverlaps::merged); },
                           [](const PlaneWorld& world, Vec2d p) { return by_par(world, p, ParOverlaps::added); }};
  std::printf(
      "| rows of boxes | merged: mean error, %% | merged: points > 1 %% off | added: mean error, %% | added: points > 1 %% off |\n");
  std::printf("|---|---|---|---|---|\n");
  Picture sheet(3 * kSide + 2 * kGap, 2 * kSide + kGap);
  for (Vec3f& pixel : sheet.pixels) pixel = {1, 1, 1};
  for (int rows = 1; rows <= 4; ++rows) {
    const PlaneScene scene = rows_of_boxes(rows);
    const PlaneWorld world(scene);
    double mean = 0, error[3] = {}, off[3] = {};
    int points = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const Vec2d p{(x + 0.5) * kSpace / kSide, (y + 0.5) * kSpace / kSide};
        const bool inside = within_a_body(scene, p);
        const double truth = methods[0](world, p);
        if (!inside) mean += truth, ++points;
        for (int m = 0; m < 3; ++m) {
          const double light = inside ? truth : methods[m](world, p), difference = light - truth;
          error[m] += std::fabs(difference);
          off[m] += std::fabs(difference) > 0.01 * truth + 1e-12 ? 1 : 0;  // the umbra is 0 but for rounding
          if (rows != 3) continue;
          const float shown = kWhite * static_cast<float>(light), wrong = kGrey + kWhite * kEnlarged * static_cast<float>(difference);
          sheet.at(m * (kSide + kGap) + x, y) = {shown, shown, shown};
          sheet.at(m * (kSide + kGap) + x, kSide + kGap + y) = {wrong, wrong, wrong};
        }
      }
    // Rounding differs from machine to machine: below 1e-9 % it is 0.
    const auto percent = [](double part, double whole) { return 100 * part > 1e-9 * whole ? 100 * part / whole : 0; };
    std::printf("| %d | %.2g | %.3g %% | %.3g | %.3g %% |\n", rows, percent(error[1], mean), percent(off[1], points),
                percent(error[2], mean), percent(off[2], points));
  }
  write_picture(sheet, argv[1]);
}
