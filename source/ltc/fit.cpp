#include "ltc/fit.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <nlopt.hpp>
#include <numbers>
#include <optional>

#include "steradian/kernels.h"

namespace steradian {
namespace {

constexpr double kPi = std::numbers::pi;

// Fixed directions with the lobe's values: structure of arrays, so that the objective's loop becomes vectors.
struct Nodes {
  std::vector<double> x, y2, z, weight, value;
};

// Midpoints of the lobe's own coordinates, azimuth in the half y > 0, and as many by the cosine, since a lobe's
// coordinates need not reach where the fit puts its tails. The weights are those of the mixture of both.
Nodes place_nodes(const Lobe& lobe, int n) {
  Nodes nodes;
  const auto add = [&](Vec3d l) {
    if (!(l.z > 0)) return;
    const double density = 0.75 * lobe.pdf(l) + 0.25 * l.z / kPi;
    nodes.x.push_back(l.x);
    nodes.y2.push_back(l.y * l.y);
    nodes.z.push_back(l.z);
    nodes.weight.push_back(1 / density);
    nodes.value.push_back(lobe.evaluate(l));
  };
  const auto midpoint = [](int i, int count) { return (i + 0.5) / count; };
  // Shares of 3 to 1, as in the density: n x n for the lobe, n x n/3 for the cosine.
  const int m = std::max(n / 3, 1);
  const double scale = 1.0 / (n * n + n * m);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) add(lobe.sample(midpoint(i, n), 0.5 * midpoint(j, n)));
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const double s = std::sqrt(midpoint(i, m)), phi = kPi * midpoint(j, n);
      add({s * std::cos(phi), s * std::sin(phi), std::sqrt(1 - s * s)});
    }
  for (double& w : nodes.weight) w *= scale;
  return nodes;
}

struct Magnitudes {
  double albedo = 0, grazing = 0;
};

Magnitudes integrate_magnitudes(const Lobe& lobe, int n) {
  Magnitudes sum;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3d l = lobe.sample((i + 0.5) / n, 0.5 * (j + 0.5) / n);
      if (!(l.z > 0)) continue;
      const double f = lobe.evaluate(l) / lobe.pdf(l);
      const double v_dot_h = dot(lobe.view, normalized(l + lobe.view));
      sum.albedo += f;
      sum.grazing += f * std::pow(std::clamp(1 - v_dot_h, 0.0, 1.0), 5.0);
    }
  sum.albedo /= n * n;
  sum.grazing /= n * n;
  return sum;
}

double energy_above_horizon(const LtcInverse& m) { return 0.5 + 0.5 * m.xx / std::hypot(m.xx, m.zx); }

struct Objective {
  const Nodes& nodes;
  LobeFrame frame;
  double alpha;
  Vec3d view;
  double albedo;
  FitNorm norm;

  // The optimiser's variables: e00 through the determinant, so that every point is an orientation-preserving map.
  LtcShape shape(const double* p) const {
    const double tilt = (frame == LobeFrame::mirror ? alpha : 1.0) * p[2];
    return {std::exp(p[0]) + tilt * p[3], std::exp(p[1]), p[2], p[3]};
  }
  static std::array<double, 4> variables(const LtcShape& s, double scale) {
    return {std::log(s.e00 - scale * s.e02 * s.e20), std::log(s.e11), s.e02, s.e20};
  }

  double distance(const LtcInverse& m, FitNorm power) const {
    const double magnitude = albedo / energy_above_horizon(m);
    const double determinant = m.yy * (m.xx * m.zz - m.xz * m.zx);
    const double k = magnitude * determinant / kPi;
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
  double operator()(const double* p) const { return distance(ltc_inverse(shape(p), frame, alpha, view), norm); }
};

}  // namespace

double ltc_roughness_at(int i, int n) { return static_cast<double>(i) / (n - 1); }

double ltc_cosine_at(int j, int n) {
  const double t = static_cast<double>(j) / (n - 1);
  return std::max(1 - t * t, 1e-3);
}

LtcInverse ltc_inverse(const LtcShape& s, LobeFrame frame, double alpha, Vec3d view) {
  const bool mirror = frame == LobeFrame::mirror;
  Kernels<double>::vec4 e;
  e.x = s.e00, e.y = s.e11, e.z = s.e02, e.w = s.e20;
  const Vec3d v = mirror ? view : Vec3d{0, 0, 1};
  const auto m = Kernels<double>{}.ltc_from_compact(e, mirror ? alpha : 1.0, {v.x, v.y, v.z});
  return {m.xx.v, m.xz.v, m.yy.v, m.zx.v, m.zz.v};
}

double ltc_evaluate(const LtcInverse& m, Vec3d l) {
  Kernels<double>::LtcMatrix k;
  k.xx = m.xx, k.xz = m.xz, k.yy = m.yy, k.zx = m.zx, k.zz = m.zz;
  return Kernels<double>{}.ltc_lobe(k, {l.x, l.y, l.z}).v;
}

LtcCell fit_cell(const LobeFamily& family, double roughness, double cos_theta, const LtcShape& start,
                 const FitOptions& options) {
  const Lobe lobe = family.at(roughness, cos_theta);
  const double alpha = alpha_from_roughness(roughness);
  const Nodes nodes = place_nodes(lobe, options.nodes);
  const Magnitudes magnitudes = integrate_magnitudes(lobe, options.magnitude_nodes);
  const Objective objective{nodes, family.frame, alpha, lobe.view, magnitudes.albedo, options.norm};
  const double scale = family.frame == LobeFrame::mirror ? alpha : 1.0;

  auto p = Objective::variables(start, scale);
  std::vector<double> x(p.begin(), p.end());
  const auto run = [&](nlopt::algorithm algorithm, double step, double tolerance, int evaluations) {
    nlopt::opt opt(algorithm, 4);
    opt.set_min_objective(
        [](unsigned, const double* v, double*, void* data) { return (*static_cast<const Objective*>(data))(v); },
        const_cast<Objective*>(&objective));
    opt.set_initial_step(step);
    opt.set_xtol_abs(tolerance);
    opt.set_maxeval(evaluations);
    double value = 0;
    try {
      opt.optimize(x, value);
    } catch (const nlopt::roundoff_limited&) {  // x is then the best point found
    }
  };
  run(nlopt::LN_BOBYQA, 0.1, 1e-5, 300);
  run(nlopt::LN_SBPLX, 0.02, 1e-5, 400);

  LtcCell cell;
  cell.shape = objective.shape(x.data());
  cell.inverse = ltc_inverse(cell.shape, family.frame, alpha, lobe.view);
  cell.albedo = magnitudes.albedo;
  cell.grazing = magnitudes.grazing;
  cell.above_horizon = energy_above_horizon(cell.inverse);
  cell.error = objective.distance(cell.inverse, FitNorm::l1) / magnitudes.albedo;
  return cell;
}

LtcTable fit_table(const LobeFamily& family, const FitOptions& options) {
  LtcTable table;
  table.family = family;
  table.size = options.size;
  const int n = options.size;
  table.cells.resize(static_cast<std::size_t>(n * n));
  std::optional<tbb::global_control> limit;
  if (options.threads > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
  std::atomic<int> done{0};
  tbb::parallel_for(0, n, [&](int i) {
    LtcShape start;
    for (int j = 0; j < n; ++j) {
      LtcCell& cell = table.cells[static_cast<std::size_t>(j * n + i)];
      cell = fit_cell(family, ltc_roughness_at(i, n), ltc_cosine_at(j, n), start, options);
      start = cell.shape;
      if (options.progress) options.progress(static_cast<double>(++done) / (n * n));
    }
  });
  return table;
}

}  // namespace steradian
