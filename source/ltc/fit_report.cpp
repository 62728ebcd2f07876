#include "ltc/fit_report.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "steradian/kernels.h"

namespace steradian {
namespace {

constexpr double kPi = std::numbers::pi;

// SplitMix64 (Steele, Lea, Flood 2014): small, and the same on every machine.
struct Random {
  std::uint64_t state;
  double operator()() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
};

Vec3d on_sphere(double z, double phi) {
  const double s = std::sqrt(std::max(1 - z * z, 0.0));
  return {s * std::cos(phi), s * std::sin(phi), z};
}

// The four planes of origin and edge: inside is the positive side of each.
std::array<Vec3d, 4> side_planes(const TestRectangle& r) {
  std::array<Vec3d, 4> planes;
  for (std::size_t i = 0; i < 4; ++i) planes[i] = cross(r[(i + 1) % 4], r[i]);
  return planes;
}

bool inside(const std::array<Vec3d, 4>& planes, Vec3d l) {
  return dot(planes[0], l) < 0 && dot(planes[1], l) < 0 && dot(planes[2], l) < 0 && dot(planes[3], l) < 0;
}

// True radiance of every rectangle: a Fibonacci lattice in the lobe's coordinates.
std::vector<double> true_radiance(const Lobe& lobe, const std::vector<TestRectangle>& rectangles, int directions) {
  std::vector<std::array<Vec3d, 4>> planes;
  for (const TestRectangle& r : rectangles) planes.push_back(side_planes(r));
  std::vector<double> sum(rectangles.size());
  for (int i = 0; i < directions; ++i) {
    const double b = i * 0.6180339887498949;
    const Vec3d l = lobe.sample((i + 0.5) / directions, b - std::floor(b));
    if (!(l.z > 0)) continue;
    const double f = lobe.evaluate(l) / lobe.pdf(l);
    for (std::size_t k = 0; k < planes.size(); ++k)
      if (inside(planes[k], l)) sum[k] += f;
  }
  for (double& s : sum) s /= directions;
  return sum;
}

}  // namespace

std::vector<TestRectangle> test_rectangles(int count, std::uint64_t seed) {
  Random random{seed};
  std::vector<TestRectangle> result;
  for (int i = 0; i < count; ++i) {
    const Vec3d centre = on_sphere(-0.1 + 1.1 * random(), 2 * kPi * random());
    const Frame about = Frame::from_normal(-centre);
    const Vec3d tilted = on_sphere(1 - 0.5 * random(), 2 * kPi * random());
    const Frame frame = Frame::from_normal(normalized(about.to_world(tilted)));
    const double turn = 2 * kPi * random();
    const Vec3d u = (frame.x * std::cos(turn) + frame.y * std::sin(turn)) * (0.1 + 0.7 * random());
    const Vec3d v = (frame.y * std::cos(turn) - frame.x * std::sin(turn)) * (0.1 + 0.7 * random());
    result.push_back({centre - u - v, centre + u - v, centre + u + v, centre - u + v});
  }
  return result;
}

ReportOptions whole_grid() {
  return {{0.05, 0.1, 0.15, 0.2, 0.27, 0.35, 0.43, 0.51, 0.6, 0.7, 0.8, 0.9, 1.0},
          {0, 15, 30, 45, 55, 65, 73, 80, 85, 88}};
}

ReportOptions node_grid() {
  ReportOptions options;
  for (int i : {4, 9, 16, 25, 34, 43, 53, 63}) options.roughness.push_back(ltc_roughness_at(i, 64));
  for (int j : {0, 24, 42, 53, 60}) options.degrees.push_back(std::acos(ltc_cosine_at(j, 64)) * 180 / kPi);
  options.rectangles = 32;
  return options;
}

double integrate_rectangle_lobe_only(const LtcInverse& inverse, const TestRectangle& rectangle) {
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

double integrate_rectangle(const LtcValue& value, const TestRectangle& rectangle) {
  return value.n_a * integrate_rectangle_lobe_only(value.inverse, rectangle);
}

double lobe_l1(const Lobe& lobe, const LtcValue& value, int n) {
  double difference = 0, albedo = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3d l = lobe.sample((i + 0.5) / n, 0.5 * (j + 0.5) / n);
      if (!(l.z > 0)) continue;
      const double f = lobe.evaluate(l), p = lobe.pdf(l);
      difference += std::fabs(f - value.n_a * ltc_evaluate(value.inverse, l)) / p;
      albedo += f / p;
    }
  return difference / albedo;
}

Report measure(const LobeFamily& family, const LookUp& table, const ReportOptions& options) {
  Report report;
  const std::size_t columns = options.roughness.size();
  report.cells.resize(columns * options.degrees.size());
  tbb::parallel_for(std::size_t{0}, report.cells.size(), [&](std::size_t index) {
    CellError& cell = report.cells[index];
    cell.roughness = options.roughness[index % columns];
    cell.degrees = options.degrees[index / columns];
    const double cosine = std::max(std::cos(cell.degrees * kPi / 180), 1e-3);
    const Lobe lobe = family.at(cell.roughness, cosine);
    const LtcValue value = table(cell.roughness, cosine);
    const auto rectangles = test_rectangles(options.rectangles, options.seed + index);
    const std::vector<double> truth = true_radiance(lobe, rectangles, options.directions);
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const double difference = integrate_rectangle(value, rectangles[k]) - truth[k];
      cell.rmse += difference * difference;
      cell.signal += truth[k] * truth[k];
    }
    cell.rmse = std::sqrt(cell.rmse / options.rectangles);
    cell.signal = std::sqrt(cell.signal / options.rectangles);
    cell.lobe_l1 = lobe_l1(lobe, value, 128);
    cell.below = 0.5 - 0.5 * value.inverse.xx / std::hypot(value.inverse.xx, value.inverse.zx);
  });
  double error = 0, signal = 0;
  for (const CellError& cell : report.cells) {
    error += cell.rmse * cell.rmse;
    signal += cell.signal * cell.signal;
  }
  report.rmse = std::sqrt(error / static_cast<double>(report.cells.size()));
  report.relative = std::sqrt(error / signal);
  return report;
}

}  // namespace steradian
