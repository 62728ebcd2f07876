#include "fit/test_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "lobes/samplers.h"
#include "steradian/kernels.h"

namespace steradian::fit {
namespace {

Vec3d on_sphere(double z, double turn) { return lobes::direction_at(z, std::sqrt(std::max(1 - z * z, 0.0)), turn); }

// The four planes of origin and edge: inside is the positive side of each.
std::array<Vec3d, 4> side_planes(const TestRectangle& r) {
  std::array<Vec3d, 4> planes;
  for (std::size_t i = 0; i < 4; ++i) planes[i] = cross(r[(i + 1) % 4], r[i]);
  return planes;
}

bool inside(const std::array<Vec3d, 4>& planes, Vec3d l) {
  return dot(planes[0], l) > 0 && dot(planes[1], l) > 0 && dot(planes[2], l) > 0 && dot(planes[3], l) > 0;
}

TestRectangle rectangle_about(Vec3d centre, reference::Random& random) {
  const Frame about = Frame::from_normal(-centre);
  const double tilt = 1 - 0.5 * random.uniform();
  const Frame frame = Frame::from_normal(normalized(about.to_world(on_sphere(tilt, random.uniform()))));
  const double turn = 2 * std::numbers::pi * random.uniform();
  const Vec3d u = (frame.x * std::cos(turn) + frame.y * std::sin(turn)) * (0.2 + 0.8 * random.uniform());
  const Vec3d v = (frame.y * std::cos(turn) - frame.x * std::sin(turn)) * (0.2 + 0.8 * random.uniform());
  return {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
}

}  // namespace

std::vector<TestRectangle> test_rectangles(int count, std::uint64_t seed) {
  reference::Random random{seed};
  std::vector<TestRectangle> result;
  for (int i = 0; i < count; ++i) {
    const double z = -0.1 + 1.1 * random.uniform();
    result.push_back(rectangle_about(on_sphere(z, random.uniform()), random));
  }
  return result;
}

std::vector<TestRectangle> test_rectangles_near(const Lobe& lobe, int count, std::uint64_t seed) {
  reference::Random random{seed};
  std::vector<TestRectangle> result;
  for (int i = 0; i < count; ++i) {
    const double a = random.uniform(), b = random.uniform();
    const Vec3d centre = i % 2 ? lobe.sample(a, b) : on_sphere(-0.1 + 1.1 * a, b);
    result.push_back(rectangle_about(centre, random));
  }
  return result;
}

std::vector<double> true_radiance(const Lobe& lobe, const std::vector<TestRectangle>& rectangles, int directions) {
  std::vector<std::array<Vec3d, 4>> planes;
  for (const TestRectangle& r : rectangles) planes.push_back(side_planes(r));
  std::vector<double> sum(rectangles.size());
  for (int i = 0; i < directions; ++i) {
    // A Fibonacci lattice.
    const double b = i * 0.6180339887498949;
    const Vec3d l = lobe.sample((i + 0.5) / directions, 0.5 * (b - std::floor(b)));
    if (!(l.z > 0)) continue;
    const double f = lobe.evaluate(l) / lobe.pdf(l);
    for (std::size_t k = 0; k < planes.size(); ++k) sum[k] += f * (inside(planes[k], l) + inside(planes[k], {l.x, -l.y, l.z}));
  }
  for (double& s : sum) s /= 2.0 * directions;
  return sum;
}

double integrate_rectangle(const LtcInverse& inverse, const TestRectangle& rectangle) {
  Kernels<double> k;
  Kernels<double>::LtcMatrix m;
  m.xx = inverse.xx, m.xz = inverse.xz, m.yy = inverse.yy, m.zx = inverse.zx, m.zz = inverse.zz;
  auto walk = k.ltc_begin();
  const auto direction = [&](Vec3d v) { return k.polygon_direction({v.x, v.y, v.z}); };
  for (std::size_t i = 4; i > 0; --i) {  // walk order is the reverse of the stored one
    const auto a = direction(rectangle[i % 4]), b = direction(rectangle[i - 1]);
    walk = k.ltc_add_edge(walk, m, a, b, k.ltc_direction(m, a), k.ltc_direction(m, b));
  }
  return k.ltc_integral(walk, Mask<double>(false)).v;
}

}  // namespace steradian::fit
