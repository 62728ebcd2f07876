#include "fit/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlopt.hpp>
#include <numbers>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <optional>

#include "fit/test_lights.h"
#include "lobes/samplers.h"
#include "steradian/kernels.h"

namespace steradian::fit {

double clipped_sphere_form_factor(double cosine, double form_factor) {
  return Kernels<double>{}.ltc_clipped_sphere(std::clamp(cosine, -1.0, 1.0), std::clamp(form_factor, 0.0, 1.0)).v;
}

namespace {

constexpr std::uint64_t kLightSeed = 1;

// Fixed directions with the lobe's values as a structure of arrays, so that the objective's loop is vectorized.
struct Nodes {
  std::vector<double> x, y2, z, weight, value;
};

// Places midpoints of the lobe's own coordinates, azimuth in the half y > 0. It adds a third as many by the cosine, since a lobe's
// coordinates need not reach the tails of the fit. The weights are those of the mixture of both.
Nodes place_nodes(const Lobe& lobe, int n) {
  Nodes nodes;
  const int m = std::max(n / 3, 1);  // rings by the cosine
  const double share = static_cast<double>(n) / (n + m);
  const double scale = 1.0 / (n * (n + m));
  const auto add = [&](Vec3d l) {
    if (!(l.z > 0)) return;
    nodes.x.push_back(l.x);
    nodes.y2.push_back(l.y * l.y);
    nodes.z.push_back(l.z);
    nodes.weight.push_back(scale / (share * lobe.pdf(l) + (1 - share) * l.z / std::numbers::pi));
    nodes.value.push_back(lobe.evaluate(l));
  };
  const auto midpoint = [](int i, int count) { return (i + 0.5) / count; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) add(lobe.sample(midpoint(i, n), 0.5 * midpoint(j, n)));
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) add(lobes::sample_cosine_hemisphere(0.5 * midpoint(j, n), midpoint(i, m)));
  return nodes;
}

struct Magnitudes {
  double albedo = 0, grazing = 0;
};

// Integrates by a Fibonacci lattice: the horizon cuts rings of a product rule all at once, but a lattice gradually.
Magnitudes integrate_magnitudes(const Lobe& lobe, int directions) {
  Magnitudes sum;
  for (int i = 0; i < directions; ++i) {
    const double b = i * 0.6180339887498949;
    const Vec3d l = lobe.sample((i + 0.5) / directions, 0.5 * (b - std::floor(b)));
    if (!(l.z > 0)) continue;
    const double f = lobe.evaluate(l) / lobe.pdf(l);
    const double v_dot_h = dot(lobe.view, normalized(l + lobe.view));
    sum.albedo += f;
    sum.grazing += f * std::pow(std::clamp(1 - v_dot_h, 0.0, 1.0), 5.0);
  }
  sum.albedo /= directions;
  sum.grazing /= directions;
  return sum;
}

struct Objective {
  const Nodes& nodes;
  LobeFrame frame;
  double alpha;
  Vec3d view;
  double albedo;
  FitNorm norm;
  std::vector<TestRectangle> lights;
  std::vector<double> truth;

  // The optimiser's variables, all of the order of 1: e00 through the determinant, so that every point is an
  // orientation-preserving map; e20, which grows like the tangent of the view, times the view's cosine.
  LtcShape shape(const double* p) const {
    const double e20 = p[3] / view.z;
    return {std::exp(p[0]) + scale() * p[2] * e20, std::exp(p[1]), p[2], e20};
  }
  std::vector<double> variables(const LtcShape& s) const {
    // A start from the neighbouring view may be a map that does not preserve orientation.
    return {std::log(std::max(s.e00 - scale() * s.e02 * s.e20, 1e-3)), std::log(s.e11), s.e02, s.e20 * view.z};
  }
  double scale() const { return frame == LobeFrame::mirror ? alpha : 1.0; }

  double distance(const LtcInverse& m, FitNorm power) const {
    const double magnitude = albedo / ltc_above_horizon(m);
    const double determinant = m.yy * (m.xx * m.zz - m.xz * m.zx);
    const double k = magnitude * determinant / std::numbers::pi;
    const double yy2 = m.yy * m.yy;
    const std::size_t count = nodes.x.size();
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = m.xx * nodes.x[i] + m.xz * nodes.z[i];
      const double z = m.zx * nodes.x[i] + m.zz * nodes.z[i];
      const double d2 = x * x + yy2 * nodes.y2[i] + z * z;
      const double difference = std::fabs(k * std::max(z, 0.0) / (d2 * d2) - nodes.value[i]);
      double term = difference;
      if (power != FitNorm::l1) term *= difference;
      if (power == FitNorm::l3) term *= difference;
      sum += nodes.weight[i] * term;
    }
    return sum;
  }
  LtcInverse inverse(const double* p) const { return ltc_inverse(shape(p), frame, alpha, view); }

  // Root mean square of the error over the lights, relative to their radiance.
  double shading_error(const LtcInverse& m) const {
    const double magnitude = albedo / ltc_above_horizon(m);
    double error = 0, signal = 0;
    for (std::size_t k = 0; k < lights.size(); ++k) {
      const double difference = magnitude * integrate_rectangle(m, lights[k]) - truth[k];
      error += difference * difference;
      signal += truth[k] * truth[k];
    }
    return signal > 0 ? std::sqrt(error / signal) : 0.0;
  }
};

// An L1 distance from the lobe that no table of GGX reaches; 2 is no overlap.
constexpr double kAstray = 0.75;

// Albedo of a lobe that reflects next to nothing (a smooth sheen away from the horizon, the grazing part of a polished surface). There is
// no shape to fit.
constexpr double kDarkest = 1e-5;
LtcCell dark_cell(const LtcShape& shape, LobeFrame frame, double alpha, Vec3d view) {
  LtcCell cell;
  cell.shape = shape;
  cell.inverse = ltc_inverse(shape, frame, alpha, view);
  cell.above_horizon = ltc_above_horizon(cell.inverse);
  return cell;
}

}  // namespace

double ltc_cosine_at(int j, int n) {
  const double t = static_cast<double>(j) / (n - 1);
  return std::max(1 - t * t, kSmallestCosine);
}

LtcCell fit_cell(const LobeFamily& family, double roughness, double cos_theta, const LtcShape& start, const FitOptions& options) {
  const Lobe lobe = family.at(roughness, cos_theta);
  const double alpha = alpha_from_roughness(roughness);
  const Nodes nodes = place_nodes(lobe, options.nodes);
  const Magnitudes magnitudes = integrate_magnitudes(lobe, options.magnitude_directions);
  if (!(magnitudes.albedo > kDarkest)) return dark_cell(start, family.frame, alpha, lobe.view);
  const std::vector<TestRectangle> lights = test_rectangles_near(lobe, options.lights, kLightSeed);
  const Objective objective{nodes,
                            family.frame,
                            alpha,
                            lobe.view,
                            magnitudes.albedo,
                            options.norm,
                            lights,
                            true_radiance(lobe, lights, options.light_directions)};
  std::vector<double> x = objective.variables(start);
  const auto minimise = [&](auto function, double step, int evaluations) {
    nlopt::opt opt(options.search == FitSearch::bobyqa ? nlopt::LN_BOBYQA : nlopt::LN_NELDERMEAD, 4);
    opt.set_min_objective(
        [](unsigned, const double* v, double*, void* data) {
          const double value = (*static_cast<decltype(function)*>(data))(v);
          return std::isfinite(value) ? value : 1e30;  // a map without inverse: a huge number instead of infinity
        },
        &function);
    opt.set_initial_step(step);
    opt.set_xtol_abs(1e-5);
    opt.set_maxeval(evaluations);
    double value = 0;
    try {
      opt.optimize(x, value);
    } catch (const nlopt::roundoff_limited&) {  // x is then the best point found
    }
  };
  minimise([&](const double* v) { return objective.distance(objective.inverse(v), options.norm); }, 0.1, 300);
  if (options.lights > 0)
    minimise(
        [&](const double* v) {
          const LtcInverse m = objective.inverse(v);
          return objective.shading_error(m) + options.lobe_share * objective.distance(m, FitNorm::l1) / objective.albedo;
        },
        0.05, 300);

  const auto sane = [&] {
    const LtcShape e = objective.shape(x.data());
    return std::fabs(e.e00) + std::fabs(e.e02) + std::fabs(e.e20) < 1e4 && e.e11 > 1e-3 && e.e11 < 1e3 &&
           ltc_above_horizon(objective.inverse(x.data())) > 0.05;
  };
  if (!sane())
    return start == LtcShape{} ? dark_cell({}, family.frame, alpha, lobe.view) : fit_cell(family, roughness, cos_theta, {}, options);

  LtcCell cell;
  cell.shape = objective.shape(x.data());
  cell.inverse = ltc_inverse(cell.shape, family.frame, alpha, lobe.view);
  cell.albedo = magnitudes.albedo;
  cell.grazing = magnitudes.grazing;
  cell.above_horizon = ltc_above_horizon(cell.inverse);
  cell.error = objective.distance(cell.inverse, FitNorm::l1) / magnitudes.albedo;
  // A lobe that hardly resembles its neighbour's may have misled the continuation: try again without it.
  if (cell.error > kAstray && !(start == LtcShape{})) {
    const LtcCell fresh = fit_cell(family, roughness, cos_theta, {}, options);
    if (fresh.error < cell.error) return fresh;
  }
  return cell;
}

std::vector<LtcCell> fit_column(const LobeFamily& family, int i, int views, const FitOptions& options) {
  const int n = options.size;
  const double roughness = family.fixed_roughness.value_or(ltc_roughness_at(i, n));
  std::vector<LtcCell> column;
  LtcShape start;
  for (int j = 0; j < views; ++j) {
    const double cosine = ltc_cosine_at(j, n);
    column.push_back(fit_cell(family, roughness, cosine, start, options));
    start = column.back().shape;
    start.e20 *= cosine / ltc_cosine_at(std::min(j + 1, n - 1), n);
    if (options.cell_done) options.cell_done();
  }
  return column;
}

std::vector<int> columns_of_part(const LobeFamily& family, const FitOptions& options) {
  // The columns of a part are spread over the roughness: neighbours cost about the same.
  std::vector<int> columns;
  for (int i = options.part - 1; i < (family.fixed_roughness ? 1 : options.size); i += options.parts) columns.push_back(i);
  return columns;
}

void put_column(LtcTable& table, int i, const std::vector<LtcCell>& column) {
  const int n = table.size, first = table.family.fixed_roughness ? 0 : i, last = table.family.fixed_roughness ? n - 1 : i;
  for (int j = 0; j < n; ++j)
    for (int k = first; k <= last; ++k) table.cells[static_cast<std::size_t>(j * n + k)] = column[static_cast<std::size_t>(j)];
}

LtcTable fit_table(const LobeFamily& family, const FitOptions& options) {
  LtcTable table;
  table.family = family;
  table.size = options.size;
  table.cells.resize(static_cast<std::size_t>(options.size * options.size));
  std::optional<tbb::global_control> limit;
  if (options.threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
  const std::vector<int> columns = columns_of_part(family, options);
  tbb::parallel_for(std::size_t{0}, columns.size(), [&](std::size_t at) {
    const int i = columns[at];
    std::vector<LtcCell> column;
    if (options.known && options.known(i, column)) {
      for (int j = 0; options.cell_done && j < options.size; ++j) options.cell_done();
    } else {
      column = fit_column(family, i, options.size, options);
      if (options.finished) options.finished(i, column);
    }
    put_column(table, i, column);
  });
  return table;
}

LtcTable fit_table_from_both_sides(const LobeFamily& family, const FitOptions& options) {
  LtcTable table = fit_table(family, options);
  const int n = options.size;
  std::optional<tbb::global_control> limit;
  if (options.threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
  tbb::parallel_for(0, n, [&](int j) {
    for (int i = n - 2; i >= 0; --i) {
      LtcCell& cell = table.cells[static_cast<std::size_t>(j * n + i)];
      const LtcCell other = fit_cell(family, ltc_roughness_at(i, n), ltc_cosine_at(j, n), table.at(i + 1, j).shape, options);
      if (other.albedo > 0 && other.error < cell.error) cell = other;
    }
  });
  return table;
}

}  // namespace steradian::fit
