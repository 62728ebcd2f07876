// Bounced light by a lattice against the same light at every pixel.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "plane/stage/drawing.h"
#include "steradian/plane_bounce.h"

namespace steradian::plane::lattice_test {
namespace {

PlaneScene closed_room() {
  PlaneScene scene = make_light_field({2, 6, std::numeric_limits<double>::infinity(), 12, 30, 480, 320}, 3);
  scene.bodies.push_back(plane_polygon({{-20, -20}, {500, -20}, {500, 340}, {-20, 340}}));
  scene.bodies.back().contours.push_back({{1, 1}, {1, 319}, {479, 319}, {479, 1}});
  for (PlaneBody& body : scene.bodies)
    if (!body.light) body.albedo = Vec3d{0.75, 0.5, 0.25};
  return scene;
}

struct Off {
  double mean = 0, rms = 0, worst = 0;
};
Off compare(const Picture& a, const Picture& b) {
  Off off;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double x = static_cast<double>(a.pixels[i].x), d = x - static_cast<double>(b.pixels[i].x);
    off.mean += x;
    off.rms += d * d;
    off.worst = std::max(off.worst, std::fabs(d));
  }
  off.mean /= static_cast<double>(a.pixels.size());
  off.rms = std::sqrt(off.rms / static_cast<double>(a.pixels.size())) / off.mean;
  off.worst /= off.mean;
  return off;
}

}  // namespace

TEST(PlaneLattice, IsOffByWhatItsToleranceSays) {
  const PlaneWorld world(closed_room());
  PlaneBounceOptions rough;
  rough.tolerance = 1e-2;
  const PlaneBounces bounces(world, rough);
  PlaneFrameOptions options;
  options.bounces = &bounces;
  PlaneFrameStats stats;
  const Picture whole = render_plane(world, options, &stats);
  EXPECT_EQ(stats.lattice_drawn, 1);
  double before = 0;
  for (const double tolerance : {1e-3, 1e-2}) {
    options.bounce_lattice = tolerance;
    const Picture drawn = render_plane(world, options, &stats);
    const Off off = compare(whole, drawn);
    std::printf("tolerance %.0e: %.0f %% drawn, middles off by %.1e; rms %.1e, largest %.1e of the mean\n", tolerance,
                100 * stats.lattice_drawn, stats.lattice_error, off.rms, off.worst);
    // The brightest place of the light that walls reflect is at most a few times the mean of all light. A linear cell errs by two thirds of
    // the error of its middle, root mean square, and most err by less than the tolerance.
    EXPECT_LT(off.rms, tolerance);
    EXPECT_GT(off.rms, before);
    EXPECT_GT(stats.lattice_error, 0);
    EXPECT_LT(stats.lattice_drawn, 0.8);
    before = off.rms;
  }
  // Nothing passes the test: every pixel is computed, in two sums.
  options.bounce_lattice = 1e-12;
  EXPECT_LT(compare(whole, render_plane(world, options, &stats)).worst, 1e-5);
}

}  // namespace steradian::plane::lattice_test
