#include "ltc/table.h"

#include <algorithm>
#include <cmath>

#include "ltc/clipped_sphere.h"
#include "ltc/half.h"

namespace steradian {
namespace {

// Four nodes and their bilinear weights.
struct Stencil {
  std::size_t index[4];
  double weight[4];
};

Stencil stencil(double u, double v, int n) {
  const double x = std::clamp(u, 0.0, 1.0) * (n - 1), y = std::clamp(v, 0.0, 1.0) * (n - 1);
  const int i = std::min(static_cast<int>(x), n - 2), j = std::min(static_cast<int>(y), n - 2);
  const double fx = x - i, fy = y - j;
  const auto base = static_cast<std::size_t>(j * n + i), row = static_cast<std::size_t>(n);
  return {{base, base + 1, base + row, base + row + 1}, {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
}

double view_coordinate(double cos_theta) { return std::sqrt(std::clamp(1 - cos_theta, 0.0, 1.0)); }

template <std::size_t N>
std::array<double, N> interpolate(const std::vector<std::array<float, N>>& table, const Stencil& s) {
  std::array<double, N> sum{};
  for (int k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < N; ++c) sum[c] += s.weight[k] * static_cast<double>(table[s.index[k]][c]);
  return sum;
}

// Values on a coarse grid whose bilinear interpolation is nearest to the fine values: normal equations, solved by
// Gauss-Seidel, which converges since they are diagonally dominant in blocks (a few dozen sweeps to 1e-12).
std::vector<double> fit_coarse(const std::vector<double>& fine, int n, int coarse) {
  const auto count = static_cast<std::size_t>(coarse * coarse);
  std::vector<double> matrix(count * count), right(count), result(count);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Stencil s = stencil(static_cast<double>(i) / (n - 1), static_cast<double>(j) / (n - 1), coarse);
      for (int a = 0; a < 4; ++a) {
        right[s.index[a]] += s.weight[a] * fine[static_cast<std::size_t>(j * n + i)];
        for (int b = 0; b < 4; ++b) matrix[s.index[a] * count + s.index[b]] += s.weight[a] * s.weight[b];
      }
    }
  for (int sweep = 0; sweep < 200; ++sweep)
    for (std::size_t a = 0; a < count; ++a) {
      double rest = right[a];
      for (std::size_t b = 0; b < count; ++b)
        if (b != a) rest -= matrix[a * count + b] * result[b];
      result[a] = rest / matrix[a * count + a];
    }
  return result;
}

}  // namespace

LtcValue ClassicTable::look_up(double roughness, double cos_theta) const {
  const Stencil s = stencil(roughness, view_coordinate(cos_theta), size);
  const auto m = interpolate(matrix, s);
  const auto f = interpolate(magnitude, s);
  return {{m[0], m[2], 1.0, m[1], m[3]}, f[0], f[1]};
}

ClassicTable classic_table(const LtcTable& fit, ClassicNormalisation normalisation) {
  ClassicTable table;
  table.size = fit.size;
  for (int j = 0; j < fit.size; ++j)
    for (int i = 0; i < fit.size; ++i) {
      const LtcCell& cell = fit.at(i, j);
      const LtcInverse& m = cell.inverse;
      const double k = 1 / (normalisation == ClassicNormalisation::middle ? m.yy : m.zz);
      const auto f = [k](double x) { return static_cast<float>(k * x); };
      table.matrix.push_back({f(m.xx), f(m.zx), f(m.xz), normalisation == ClassicNormalisation::middle ? f(m.zz) : f(m.yy)});
      const double u = static_cast<double>(i) / (fit.size - 1), v = static_cast<double>(j) / (fit.size - 1);
      table.magnitude.push_back({static_cast<float>(cell.n_a()), static_cast<float>(cell.f_a()), 0.0f,
                                 static_cast<float>(clipped_sphere_form_factor(2 * u - 1, v))});
    }
  return table;
}

LtcValue CompactTable::look_up(double roughness, double cos_theta) const {
  const double v = view_coordinate(cos_theta);
  const auto e = interpolate(shapes, stencil(roughness, v, shape_size));
  const auto f = interpolate(magnitudes, stencil(roughness, v, magnitude_size));
  return {ltc_inverse({e[0], e[1], e[2], e[3]}, frame, alpha_from_roughness(roughness), view_from_cosine(cos_theta)),
          f[0], f[1]};
}

CompactTable compact_table(const LtcTable& fit, CompactSizes sizes) {
  CompactTable table;
  table.frame = fit.family.frame;
  table.shape_size = sizes.shape;
  table.magnitude_size = sizes.magnitude;
  table.shapes.resize(static_cast<std::size_t>(sizes.shape * sizes.shape));
  table.magnitudes.resize(static_cast<std::size_t>(sizes.magnitude * sizes.magnitude));
  const auto resample = [&](auto value, int coarse, auto put) {
    std::vector<double> fine;
    for (const LtcCell& cell : fit.cells) fine.push_back(value(cell));
    const std::vector<double> result = fit.size == coarse ? fine : fit_coarse(fine, fit.size, coarse);
    for (std::size_t k = 0; k < result.size(); ++k) put(k) = round_to_half(static_cast<float>(result[k]));
  };
  double LtcShape::*const entries[4] = {&LtcShape::e00, &LtcShape::e11, &LtcShape::e02, &LtcShape::e20};
  for (std::size_t c = 0; c < 4; ++c)
    resample([&](const LtcCell& cell) { return cell.shape.*entries[c]; }, sizes.shape,
             [&](std::size_t k) -> float& { return table.shapes[k][c]; });
  resample([](const LtcCell& cell) { return cell.n_a(); }, sizes.magnitude,
           [&](std::size_t k) -> float& { return table.magnitudes[k][0]; });
  resample([](const LtcCell& cell) { return cell.f_a(); }, sizes.magnitude,
           [&](std::size_t k) -> float& { return table.magnitudes[k][1]; });
  return table;
}

LtcValue look_up_shapes(const LtcTable& fit, double roughness, double cos_theta) {
  const Stencil s = stencil(roughness, view_coordinate(cos_theta), fit.size);
  LtcShape e{0, 0, 0, 0};
  LtcValue value;
  for (int k = 0; k < 4; ++k) {
    const LtcCell& cell = fit.cells[s.index[k]];
    e.e00 += s.weight[k] * cell.shape.e00;
    e.e11 += s.weight[k] * cell.shape.e11;
    e.e02 += s.weight[k] * cell.shape.e02;
    e.e20 += s.weight[k] * cell.shape.e20;
    value.n_a += s.weight[k] * cell.n_a();
    value.f_a += s.weight[k] * cell.f_a();
  }
  value.inverse = ltc_inverse(e, fit.family.frame, alpha_from_roughness(roughness), view_from_cosine(cos_theta));
  return value;
}

}  // namespace steradian
