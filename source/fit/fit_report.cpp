#include "fit/fit_report.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdint>
#include <numbers>

#include "steradian/kernels.h"

namespace steradian::fit {
namespace {

constexpr double kSteepestCosine = 0.156434465040230869;  // of 81 degrees

}  // namespace

ReportOptions whole_grid() {
  return {{0.05, 0.1, 0.15, 0.2, 0.27, 0.35, 0.43, 0.51, 0.6, 0.7, 0.8, 0.9, 1.0}, {0, 15, 30, 45, 55, 65, 73, 80, 85, 88}};
}

ReportOptions node_grid() {
  ReportOptions options;
  for (int i : {4, 9, 16, 25, 34, 43, 53, 63}) options.roughness.push_back(ltc_roughness_at(i, 64));
  for (int j : {0, 24, 42, 53, 60}) options.degrees.push_back(std::acos(ltc_cosine_at(j, 64)) * 180 / std::numbers::pi);
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

FitReport measure(const LobeFamily& family, const LookUp& table, const ReportOptions& options) {
  FitReport report;
  const std::size_t columns = options.roughness.size();
  report.cells.resize(columns * options.degrees.size());
  tbb::parallel_for(std::size_t{0}, report.cells.size(), [&](std::size_t index) {
    CellError& cell = report.cells[index];
    cell.roughness = options.roughness[index % columns];
    cell.degrees = options.degrees[index / columns];
    const double cosine = std::max(std::cos(cell.degrees * std::numbers::pi / 180), kSmallestCosine);
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

FresnelError measure_fresnel(const LobeFamily& family, const LookUp& table, const LookUp& fresnel_table, double f0,
                             const ReportOptions& options) {
  struct Sums {
    double split = 0, lobe = 0, signal = 0;
  };
  const std::size_t columns = options.roughness.size();
  std::vector<Sums> cells(columns * options.degrees.size());
  tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t index) {
    const double roughness = options.roughness[index % columns];
    const double cosine = std::max(std::cos(options.degrees[index / columns] * std::numbers::pi / 180), kSmallestCosine);
    const Lobe lobe = family.at(roughness, cosine);
    const LtcValue value = table(roughness, cosine), fresnel = fresnel_table(roughness, cosine);
    const auto rectangles = test_rectangles(options.rectangles, options.seed + index);
    const std::vector<double> plain = true_radiance(lobe, rectangles, options.directions);
    const std::vector<double> grazing = true_radiance(with_grazing_fresnel(lobe), rectangles, options.directions);
    for (std::size_t k = 0; k < plain.size(); ++k) {
      const double truth = f0 * plain[k] + (1 - f0) * grazing[k];
      const double integral = integrate_rectangle(value.inverse, rectangles[k]);
      const double split = (f0 * value.n_a + (1 - f0) * value.f_a) * integral - truth;
      const double own = f0 * value.n_a * integral + (1 - f0) * fresnel.n_a * integrate_rectangle(fresnel.inverse, rectangles[k]) - truth;
      cells[index].split += split * split;
      cells[index].lobe += own * own;
      cells[index].signal += truth * truth;
    }
  });
  Sums sum;
  for (const Sums& cell : cells) {
    sum.split += cell.split;
    sum.lobe += cell.lobe;
    sum.signal += cell.signal;
  }
  return {std::sqrt(sum.split / sum.signal), std::sqrt(sum.lobe / sum.signal)};
}

std::vector<BetweenNodes> measure_between_nodes(const LtcTable& fit, const LookUp& table) {
  std::vector<BetweenNodes> result;
  const int n = fit.size, step = std::max(n / 16, 1);
  for (int i = 1; i + 1 < n; i += step) {
    BetweenNodes sum;
    sum.roughness = 0.5 * (ltc_roughness_at(i, n) + ltc_roughness_at(i + 1, n));
    int count = 0, steep = 0;
    for (int j = 0; j + 1 < n; j += 2, ++count) {
      const double t = (j + 0.5) / (n - 1), cosine = 1 - t * t;
      const Lobe lobe = fit.family.at(sum.roughness, cosine);
      const double between = lobe_l1(lobe, table(sum.roughness, cosine), 48);
      double at_nodes = 0;
      for (int k = 0; k < 4; ++k) at_nodes += 0.25 * fit.at(i + k % 2, j + k / 2).error;
      sum.between += between;
      sum.at_nodes += at_nodes;
      if (cosine < kSteepestCosine) continue;
      ++steep;
      sum.steep_between += between;
      sum.steep_at_nodes += at_nodes;
    }
    sum.between /= count;
    sum.at_nodes /= count;
    sum.steep_between /= steep;
    sum.steep_at_nodes /= steep;
    result.push_back(sum);
  }
  return result;
}

std::string describe(const FitReport& whole, const FitReport& nodes, const std::vector<BetweenNodes>& between) {
  char line[160];
  std::string text;
  const auto add = [&](const char* format, auto... values) {
    std::snprintf(line, sizeof line, format, values...);
    text += line;
  };
  add("whole grid   %3zu cells  RMSE %.5f  relative %.2f %%\n", whole.cells.size(), whole.rmse, 100 * whole.relative);
  add("node grid    %3zu cells  RMSE %.5f  relative %.2f %%\n", nodes.cells.size(), nodes.rmse, 100 * nodes.relative);
  add("\nroughness  view    RMSE     signal   relative  lobe L1  below horizon\n");
  for (const CellError& c : whole.cells)
    add("%9.3f  %4.1f  %.5f  %.5f  %7.2f %%  %7.4f  %11.2f %%\n", c.roughness, c.degrees, c.rmse, c.signal,
        100 * c.rmse / std::max(c.signal, 1e-12), c.lobe_l1, 100 * c.below);
  std::vector<CellError> worst = whole.cells;
  std::sort(worst.begin(), worst.end(), [](const CellError& a, const CellError& b) { return a.rmse > b.rmse; });
  add("\nworst cells\n");
  for (std::size_t i = 0; i < std::min<std::size_t>(5, worst.size()); ++i)
    add("%9.3f  %4.1f  %.5f\n", worst[i].roughness, worst[i].degrees, worst[i].rmse);
  if (between.empty()) return text;
  add("\nlobe L1, mean over the views, and over those up to 81 degrees\n"
      "roughness  at nodes  between   ratio  at nodes  between   ratio\n");
  for (const BetweenNodes& b : between)
    add("%9.3f  %8.4f  %7.4f  %6.3f  %8.4f  %7.4f  %6.3f\n", b.roughness, b.at_nodes, b.between, b.between / b.at_nodes, b.steep_at_nodes,
        b.steep_between, b.steep_between / b.steep_at_nodes);
  return text;
}

Picture draw(const FitReport& report, const ReportOptions& options) {
  constexpr int kCell = 32;
  constexpr double kWhite = 0.03;
  const auto columns = static_cast<int>(options.roughness.size()), rows = static_cast<int>(options.degrees.size());
  Picture picture(kCell * columns, kCell * rows);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const CellError& cell = report.cells[static_cast<std::size_t>(y / kCell * columns + x / kCell)];
      const double t = std::min(cell.rmse / kWhite, 1.0);
      // Black, blue, red, yellow, white: lightness grows throughout.
      const auto ramp = [t](double from, double to) { return static_cast<float>(std::clamp((t - from) / (to - from), 0.0, 1.0)); };
      const float blue = t < 0.5 ? 0.6f * ramp(0, 0.25) * (1 - ramp(0.25, 0.5)) : ramp(0.75, 1);
      picture.at(x, y) = {ramp(0.2, 0.5), ramp(0.5, 0.8), blue};
    }
  return picture;
}

}  // namespace steradian::fit
