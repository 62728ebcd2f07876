// The two layouts of a table from a fit, and custom lobes of the caller, fitted and written in one call.
#include "fit/tables_of_fit.h"

#include <algorithm>
#include <cmath>

#include "fit/fit.h"
#include "fit/lobe.h"
#include "fit/table_files.h"
#include "integrals/tables/table.h"
#include "integrals/tables/table_lookup.h"
#include "steradian/error.h"
#include "steradian/fit.h"

namespace steradian {

LobeFit fit_lobe_table(const LobeFamily& family, const std::string& path, const LobeFitOptions& options) {
  if (options.size < 2 || options.size > 1024) throw Error("size", "must be from 2 to 1024, here is " + std::to_string(options.size));
  // A wrong ending is detected before the work, not after it.
  fit::classic_files({2, std::vector<std::array<float, 4>>(4), std::vector<std::array<float, 4>>(4), ClassicNormalisation::middle},
                     family.name, path);
  fit::FitOptions fit;
  fit.size = options.size;
  fit.threads = options.threads;
  fit.cell_done = options.cell_done;
  LobeFamily sampled = family;
  sampled.at = [&family](double roughness, double cosine) { return fit::with_samples(family.at(roughness, cosine)); };
  const fit::LtcTable table = fit::fit_table(sampled, fit);
  fit::write_files(fit::classic_files(fit::classic_table(table), family.name, path));
  LobeFit result;
  for (const fit::LtcCell& cell : table.cells) {
    result.mean_error += cell.error / static_cast<double>(table.cells.size());
    result.largest_error = std::max(result.largest_error, cell.error);
  }
  return result;
}

}  // namespace steradian

namespace steradian::fit {
namespace {

// Values on a coarse grid whose bilinear interpolation is nearest to the fine values, by weighted least squares: normal equations with
// Cholesky's decomposition.
std::vector<double> fit_coarse(const std::vector<double>& fine, const std::vector<double>& importance, int n, int coarse) {
  const auto count = static_cast<std::size_t>(coarse * coarse);
  std::vector<double> matrix(count * count), x(count);
  const auto at = [&](std::size_t row, std::size_t column) -> double& { return matrix[row * count + column]; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto s = stencil<double>(static_cast<double>(i) / (n - 1), static_cast<double>(j) / (n - 1), coarse);
      const auto k = static_cast<std::size_t>(j * n + i);
      for (std::size_t a = 0; a < 4; ++a) {
        x[s.index[a]] += importance[k] * s.weight[a].v * fine[k];
        for (std::size_t b = 0; b < 4; ++b) at(s.index[a], s.index[b]) += importance[k] * s.weight[a].v * s.weight[b].v;
      }
    }
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = at(i, j);
      for (std::size_t k = 0; k < j; ++k) sum -= at(i, k) * at(j, k);
      at(i, j) = i == j ? std::sqrt(sum) : sum / at(j, j);
    }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < i; ++k) x[i] -= at(i, k) * x[k];
    x[i] /= at(i, i);
  }
  for (std::size_t i = count; i-- > 0;) {
    for (std::size_t k = i + 1; k < count; ++k) x[i] -= at(k, i) * x[k];
    x[i] /= at(i, i);
  }
  return x;
}

}  // namespace

ClassicTable classic_table(const LtcTable& fit, ClassicNormalisation normalisation) {
  ClassicTable table;
  table.size = fit.size;
  table.normalisation = normalisation;
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

CompactTable compact_table(const LtcTable& fit, CompactSizes sizes) {
  CompactTable table;
  table.frame = fit.family.frame;
  table.shape_size = sizes.shape;
  table.magnitude_size = sizes.magnitude;
  table.shapes.resize(static_cast<std::size_t>(sizes.shape * sizes.shape));
  table.magnitudes.resize(static_cast<std::size_t>(sizes.magnitude * sizes.magnitude));
  const auto resample = [&](auto value, auto importance, int coarse, auto put, double least = -1e30) {
    std::vector<double> fine, weights;
    for (int j = 0; j < fit.size; ++j)
      for (int i = 0; i < fit.size; ++i) {
        const double scale = fit.family.frame == LobeFrame::mirror ? alpha_from_roughness(ltc_roughness_at(i, fit.size)) : 1;
        fine.push_back(value(fit.at(i, j)));
        // The shape of a lobe that reflects next to nothing has little weight.
        weights.push_back(importance(fit.at(i, j), scale) * std::clamp(10 * fit.at(i, j).albedo, 1e-6, 1.0));
      }
    const std::vector<double> result = fit.size == coarse ? fine : fit_coarse(fine, weights, fit.size, coarse);
    for (std::size_t k = 0; k < result.size(); ++k) put(k) = round_to_half(static_cast<float>(std::max(result[k], least)));
  };
  const auto even = [](const LtcCell&, double) { return 1.0; };
  // Effect of a change of an entry on the lobe, in units of the lobe's own width.
  const auto width_x = [](const LtcCell& c, double) { return 1 / (c.shape.e00 * c.shape.e00); };
  const auto width_y = [](const LtcCell& c, double) { return 1 / (c.shape.e11 * c.shape.e11); };
  const auto shear = [](const LtcCell&, double alpha) { return std::max(alpha * alpha, 1e-4); };
  const auto shape = [&](std::size_t c) { return [&table, c](std::size_t k) -> float& { return table.shapes[k][c]; }; };
  const auto magnitude = [&](std::size_t c) { return [&table, c](std::size_t k) -> float& { return table.magnitudes[k][c]; }; };
  resample([](const LtcCell& c) { return c.shape.e00; }, width_x, sizes.shape, shape(0));
  resample([](const LtcCell& c) { return c.shape.e11; }, width_y, sizes.shape, shape(1));
  resample([](const LtcCell& c) { return c.shape.e02; }, width_x, sizes.shape, shape(2));
  resample([](const LtcCell& c) { return c.shape.e20; }, shear, sizes.shape, shape(3));
  resample([](const LtcCell& c) { return c.n_a(); }, even, sizes.magnitude, magnitude(0), 0.0);
  resample([](const LtcCell& c) { return c.f_a(); }, even, sizes.magnitude, magnitude(1), 0.0);
  return table;
}

LtcValue look_up_shapes(const LtcTable& fit, double roughness, double cos_theta) {
  const auto s = ltc_stencil<double>(roughness, cos_theta, fit.size);
  LtcShape e{0, 0, 0, 0};
  LtcValue value;
  for (std::size_t k = 0; k < 4; ++k) {
    const LtcCell& cell = fit.cells[s.index[k]];
    const double weight = s.weight[k].v;
    e.e00 += weight * cell.shape.e00;
    e.e11 += weight * cell.shape.e11;
    e.e02 += weight * cell.shape.e02;
    e.e20 += weight * cell.shape.e20;
    value.n_a += weight * cell.n_a();
    value.f_a += weight * cell.f_a();
  }
  value.inverse = ltc_inverse(e, fit.family.frame, alpha_from_roughness(roughness), view_from_cosine(cos_theta));
  return value;
}

}  // namespace steradian::fit
