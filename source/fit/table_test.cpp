// The shipped tables against the lobe itself, against a new fit, and between their nodes.
#include "fit/tables_of_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/fit_report.h"
#include "integrals/ltc/ggx_tables.h"

namespace steradian::fit {
namespace {

struct CellCheck {
  double lobe_l1 = 0;
  double energy = 0;  // the fit's above the horizon over the lobe's
};

// The cell's texels taken for the lobe of roughness i and view j.
CellCheck check(const ClassicTable& table, int texel_i, int texel_j, int i, int j, int n) {
  const std::size_t at = static_cast<std::size_t>(texel_j * table.size + texel_i);
  const auto& m = table.matrix[at];
  const LtcValue value = {{m[0], m[2], 1.0, m[1], m[3]}, table.magnitude[at][0], table.magnitude[at][1]};
  const Lobe lobe = lobe_family("ggx").at(ltc_roughness_at(i, table.size), ltc_cosine_at(j, table.size));
  double albedo = 0;
  for (int a = 0; a < n * n; ++a) {
    const double b = a * 0.6180339887498949;
    const Vec3d l = lobe.sample((a + 0.5) / (n * n), 0.5 * (b - std::floor(b)));
    if (l.z > 0) albedo += lobe.evaluate(l) / lobe.pdf(l) / (n * n);
  }
  return {lobe_l1(lobe, value, n), value.n_a * ltc_above_horizon(value.inverse) / albedo};
}

// The largest L1 of a good fit: the table of docs/ltc.md, "error of the fits", rounded up.
double largest_l1(int j) { return ltc_cosine_at(j, 64) > 0.26 ? 0.3 : 0.75; }

// A lattice of 576 points that the horizon cuts is off by about 576^(-3/4).
constexpr double kEnergyTolerance = 0.01;

// Shading error on few rectangles, for comparisons rather than for figures.
double relative_error(const LookUp& look_up, double from, double to) {
  ReportOptions grid = whole_grid();
  std::erase_if(grid.roughness, [&](double r) { return r < from || r > to; });
  grid.directions = 1 << 12;
  return measure(lobe_family("ggx"), look_up, grid).relative;
}

}  // namespace

TEST(LtcTable, EveryCellIsTheLobe) {
  const ClassicTable& table = ggx_classic_table();
  ASSERT_EQ(table.size, 64);
  double worst = 0, worst_energy = 0;
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 64; ++i) {
      const CellCheck c = check(table, i, j, i, j, 24);
      EXPECT_LE(c.lobe_l1, largest_l1(j)) << "cell " << i << " " << j;
      EXPECT_NEAR(c.energy, 1, kEnergyTolerance) << "cell " << i << " " << j;
      worst = std::max(worst, c.lobe_l1);
      worst_energy = std::max(worst_energy, std::fabs(c.energy - 1));
    }
  std::printf("largest lobe L1 %.3f, largest relative error of energy %.2g\n", worst, worst_energy);
}

TEST(LtcTable, SwappedAxesWouldFail) {
  int failures = 0, cells = 0;
  for (int j = 1; j < 64; j += 3)
    for (int i = 1; i < 64; i += 3) {
      if (std::abs(i - j) < 4) continue;
      const CellCheck c = check(ggx_classic_table(), j, i, i, j, 24);
      failures += c.lobe_l1 > largest_l1(j) || std::fabs(c.energy - 1) > kEnergyTolerance;
      ++cells;
    }
  EXPECT_GT(failures, cells * 9 / 10) << failures << " of " << cells;
}

// Continuation makes a cell depend on those before it in its column: columns are fitted again from the start.
TEST(LtcTable, IsTheFittersOwn) {
  const LobeFamily& family = lobe_family("ggx");
  for (int i : {6, 30, 60}) {
    const std::vector<LtcCell> column = fit_column(family, i, 12, {});
    for (int j : {0, 4, 11}) {
      const LtcCell& cell = column[static_cast<std::size_t>(j)];
      const auto& m = ggx_classic_table().matrix[static_cast<std::size_t>(j * 64 + i)];
      const double expected[4] = {cell.inverse.xx, cell.inverse.zx, cell.inverse.xz, cell.inverse.zz};
      // The optimiser stops at 1e-5 of its variables; compilers may lead it there by different steps.
      for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(m[c], expected[c] / cell.inverse.yy, 1e-3) << i << " " << j << " entry " << c;
      EXPECT_NEAR(ggx_classic_table().magnitude[static_cast<std::size_t>(j * 64 + i)][0], cell.n_a(), 1e-4);
      EXPECT_NEAR(ggx_classic_table().magnitude[static_cast<std::size_t>(j * 64 + i)][1], cell.f_a(), 1e-4);
    }
  }
}

TEST(LtcFit, IsTheSameAtAnyNumberOfThreads) {
  FitOptions options;
  options.size = 6;
  options.nodes = 12;
  options.lights = 8;
  options.light_directions = 256;
  options.magnitude_directions = 256;
  options.threads = 1;
  const LtcTable one = fit_table(lobe_family("ggx"), options);
  options.threads = 2;
  const LtcTable two = fit_table(lobe_family("ggx"), options);
  for (std::size_t k = 0; k < one.cells.size(); ++k) {
    EXPECT_EQ(one.cells[k].shape.e00, two.cells[k].shape.e00) << k;
    EXPECT_EQ(one.cells[k].shape.e11, two.cells[k].shape.e11) << k;
    EXPECT_EQ(one.cells[k].shape.e02, two.cells[k].shape.e02) << k;
    EXPECT_EQ(one.cells[k].shape.e20, two.cells[k].shape.e20) << k;
    EXPECT_EQ(one.cells[k].n_a(), two.cells[k].n_a()) << k;
  }
}

TEST(LtcFit, FitsEveryLobe) {
  FitOptions options;
  options.nodes = 16;
  options.lights = 16;
  options.light_directions = 512;
  options.magnitude_directions = 1024;
  for (const LobeFamily& family : lobe_families()) {
    const LtcCell cell = fit_cell(family, 0.7, 0.8, {}, options);
    const Lobe lobe = family.at(0.7, 0.8);
    EXPECT_LT(lobe_l1(lobe, {cell.inverse, cell.n_a(), cell.f_a()}, 32), family.name == "charlie" ? 0.5 : 0.2) << family.name;
    EXPECT_GT(cell.inverse.yy, 0) << family.name;
  }
}

TEST(LtcTable, KeepsTheErrorThatIsClaimed) {
  const auto classic = [](double r, double c) { return ggx_classic_table().look_up(r, c); };
  const auto compact = [](double r, double c) { return ggx_compact_table().look_up(r, c); };
  EXPECT_LE(relative_error(classic, 0, 1), 0.04);
  const double classic_rough = relative_error(classic, 0.1, 1), compact_rough = relative_error(compact, 0.1, 1);
  EXPECT_LE(compact_rough, 1.05 * classic_rough);
  const double classic_smooth = relative_error(classic, 0, 0.09), compact_smooth = relative_error(compact, 0, 0.09);
  EXPECT_LT(compact_smooth, classic_smooth);
  std::printf("relative error r >= 0.1: classic %.4f compact %.4f; r = 0.05: classic %.4f compact %.4f\n", classic_rough, compact_rough,
              classic_smooth, compact_smooth);
}

TEST(LtcTable, CompactStaysWithinFourKilobytesAndHoldsNarrowLobesTogether) {
  const CompactTable& compact = ggx_compact_table();
  EXPECT_LE(compact.bytes(), 4096u);
  // Half way between the nodes of a 64 x 64 table: where the classic layout's lobes break.
  for (double row : {0.5, 1.5, 4.5}) {
    const double roughness = row / 63;
    for (double t : {0.2, 0.5, 0.8}) {
      const double cosine = 1 - t * t;
      const Lobe lobe = lobe_family("ggx").at(roughness, cosine);
      const double ours = lobe_l1(lobe, compact.look_up(roughness, cosine), 64);
      const double classic = lobe_l1(lobe, ggx_classic_table().look_up(roughness, cosine), 64);
      EXPECT_LT(ours, 0.06) << roughness << " " << t;
      EXPECT_LT(ours, classic) << roughness << " " << t;
    }
  }
}

}  // namespace steradian::fit
