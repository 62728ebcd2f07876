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

}  // namespace

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
    const double cosine = std::max(std::cos(cell.degrees * kPi / 180), kSmallestCosine);
    const Lobe lobe = family.at(cell.roughness, cosine);
    const LtcValue value = table(cell.roughness, cosine);
    const auto rectangles = test_rectangles(options.rectangles, options.seed + index);
    const std::vector<double> truth = true_radiance(lobe, rectangles, options.directions);
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const double difference = value.n_a * integrate_rectangle(value.inverse, rectangles[k]) - truth[k];
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
