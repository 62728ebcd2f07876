// The shipped tables against the lobe itself, against a new fit, and between their nodes.
#include "fit/tables_of_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include "fit/fit_report.h"
#include "integrals/tables/ggx_tables.h"
#include "night.h"

namespace steradian::fit::table_test {
namespace {

struct CellCheck {
  double lobe_l1 = 0;
  double energy = 0;  // energy of the fit above the horizon over the lobe's
};

LtcValue shipped_at(int i, int j) {
  const ClassicTable& table = ggx_classic_table();
  const std::size_t at = static_cast<std::size_t>(j * table.size + i);
  const auto& m = table.matrix[at];
  return {{m[0], m[2], 1.0, m[1], m[3]}, table.magnitude[at][0], table.magnitude[at][1]};
}

Lobe lobe_at(int i, int j) { return lobe_family("ggx").at(ltc_roughness_at(i, 64), ltc_cosine_at(j, 64)); }

// Compares the cell's texels with the lobe of roughness i and view j.
CellCheck check(int texel_i, int texel_j, int i, int j, int n) {
  const LtcValue value = shipped_at(texel_i, texel_j);
  const Lobe lobe = lobe_at(i, j);
  double albedo = 0;
  for (int a = 0; a < n * n; ++a) {
    const double b = a * 0.6180339887498949;
    const Vec3d l = lobe.sample((a + 0.5) / (n * n), 0.5 * (b - std::floor(b)));
    if (l.z > 0) albedo += lobe.evaluate(l) / lobe.pdf(l) / (n * n);
  }
  return {lobe_l1(lobe, value, n), value.n_a * ltc_above_horizon(value.inverse) / albedo};
}

// Columns of the table that are fitted again, one of each range of roughness. Every view of each is fitted, including the grazing ones with
// the worst fits.
constexpr int kColumns[] = {0, 6, 14, 22, 30, 40, 52, 63};
const std::vector<LtcCell>& refitted(int i) {
  static std::map<int, std::vector<LtcCell>> columns;
  std::vector<LtcCell>& column = columns[i];
  if (column.empty()) column = fit_column(lobe_family("ggx"), i, 64, {});
  return column;
}

LtcValue value_of(const LtcCell& cell) { return {cell.inverse, cell.n_a(), cell.f_a()}; }

// The largest L1 of a good fit at a node. Between two columns it exceeds the larger of theirs by an eighth at most (measured over the
// table). This allows twice as much; 24 x 24 nodes on half a lobe have an error of 0.002.
double largest_l1(int i, int j) {
  std::size_t k = 0;
  while (k + 2 < std::size(kColumns) && kColumns[k + 1] <= i) ++k;
  const auto l1 = [&](int column) { return lobe_l1(lobe_at(column, j), value_of(refitted(column)[static_cast<std::size_t>(j)]), 24); };
  return 1.25 * std::max(l1(kColumns[k]), l1(kColumns[k + 1])) + 0.002;
}

// Objective of the fitter's second pass: the relative error on its rectangles and a tenth of the L1.
double objective(const Lobe& lobe, const LtcValue& value) {
  const FitOptions options;
  const std::vector<TestRectangle> lights = test_rectangles_near(lobe, options.lights, 1);
  const std::vector<double> truth = true_radiance(lobe, lights, options.light_directions);
  double error = 0, signal = 0;
  for (std::size_t k = 0; k < lights.size(); ++k) {
    const double difference = value.n_a * integrate_rectangle(value.inverse, lights[k]) - truth[k];
    error += difference * difference;
    signal += truth[k] * truth[k];
  }
  return std::sqrt(error / signal) + options.lobe_share * lobe_l1(lobe, value, options.nodes);
}

// A lattice of 576 points that the horizon cuts has an error of about 576^(-3/4).
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
  ASSERT_EQ(ggx_classic_table().size, 64);
  double worst = 0, worst_energy = 0;
  const int step = test::by_day_or_night(3, 1);
  for (int j = 0; j < 64; j += step)
    for (int i = 0; i < 64; i += step) {
      const CellCheck c = check(i, j, i, j, 24);
      EXPECT_LE(c.lobe_l1, largest_l1(i, j)) << "cell " << i << " " << j;
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
      const CellCheck c = check(j, i, i, j, 24);
      failures += c.lobe_l1 > largest_l1(i, j) || std::fabs(c.energy - 1) > kEnergyTolerance;
      ++cells;
    }
  EXPECT_GT(failures, cells * 9 / 10) << failures << " of " << cells;
}

// Continuation makes a cell depend on those before it in its column, so whole columns are fitted again. Another compiler may lead the
// optimiser to another point of a flat valley. The test therefore compares the objective, not the entries, and the energies, which are
// unique.
TEST(LtcTable, IsTheFittersOwn) {
  double worst = 0, worst_energy = 0;
  for (int i : kColumns)
    for (int j = 0; j < 64; ++j) {
      const LtcCell& cell = refitted(i)[static_cast<std::size_t>(j)];
      const LtcValue shipped = shipped_at(i, j);
      const double above = ltc_above_horizon(shipped.inverse);
      // The errors of the table's floats: of the magnitude and of the four entries that give the fraction above the horizon.
      EXPECT_NEAR(shipped.n_a * above, cell.albedo, 6 * 6e-8 * cell.albedo) << i << " " << j;
      EXPECT_NEAR(shipped.f_a * above, cell.grazing, 6 * 6e-8) << i << " " << j;
      worst_energy = std::max(worst_energy, std::fabs(shipped.n_a * above / cell.albedo - 1));
      const Lobe lobe = lobe_at(i, j);
      const double ours = objective(lobe, shipped), again = objective(lobe, value_of(cell));
      // The last two views of the roughest lobe have two valleys, and builds may end in either.
      const double bound = (i == 63 && j >= 62 ? 0.15 : 0.02) * again + 1e-4;
      EXPECT_NEAR(ours, again, bound) << i << " " << j;
      worst = std::max(worst, std::fabs(ours - again) / bound);
    }
  std::printf("largest difference of the objectives %.2f of the bound, of the energies %.1e\n", worst, worst_energy);
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

// Columns of parts, and columns of an earlier run, are those of one run.
TEST(LtcFit, IsTheSameInPartsAndFromKnownColumns) {
  FitOptions options;
  options.size = 5;
  options.nodes = 8;
  options.lights = 4;
  options.light_directions = 64;
  options.magnitude_directions = 64;
  for (const char* lobe : {"ggx", "charlie"}) {
    LobeFamily family = lobe_family(lobe);
    if (family.name == "charlie") family.fixed_roughness = 0.5;
    std::vector<std::vector<LtcCell>> columns(static_cast<std::size_t>(options.size));
    FitOptions keeping = options;
    keeping.finished = [&](int i, const std::vector<LtcCell>& column) { columns[static_cast<std::size_t>(i)] = column; };
    const LtcTable whole = fit_table(family, keeping);
    LtcTable joined = whole;
    joined.cells.assign(joined.cells.size(), LtcCell{});
    int made = 0;
    for (int part = 1; part <= 3; ++part) {
      FitOptions some = options;
      some.part = part;
      some.parts = 3;
      some.finished = [&](int, const std::vector<LtcCell>&) { ++made; };
      some.known = [&](int i, std::vector<LtcCell>& column) {
        column = columns[static_cast<std::size_t>(i)];
        return i % 2 == 1;
      };
      const LtcTable table = fit_table(family, some);
      for (const int i : columns_of_part(family, some)) {
        std::vector<LtcCell> column;
        for (int j = 0; j < options.size; ++j) column.push_back(table.at(i, j));
        put_column(joined, i, column);
      }
    }
    EXPECT_EQ(made, family.fixed_roughness ? 1 : 3);
    for (std::size_t k = 0; k < whole.cells.size(); ++k)
      EXPECT_EQ(std::memcmp(&joined.cells[k], &whole.cells[k], sizeof(LtcCell)), 0) << lobe << " " << k;
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

// Errors of dielectrics that docs/theory/ltc.md states: by n_A and f_A, and by the table of Fresnel's lobe. 2^12 directions instead of 2^17
// have an error of 2^(-9) of the signal, whose square adds to the error's.
TEST(LtcTable, OfFresnelsLobeKeepsTheErrorThatIsClaimed) {
  const auto classic = [](double r, double c) { return ggx_classic_table().look_up(r, c); };
  const auto fresnel = [](double r, double c) { return ggx_fresnel_table().look_up(r, c); };
  ReportOptions grid = whole_grid();
  grid.directions = 1 << 12;
  const double noise = 0x1p-9;
  for (const auto& [f0, split, lobe] : {std::array{0.04, 0.1398, 0.0152}, {0.2, 0.0906, 0.0209}, {0.9, 0.0299, 0.0286}}) {
    const FresnelError e = measure_fresnel(lobe_family("ggx"), classic, fresnel, f0, grid);
    std::printf("F0 = %.2f: by n_A and f_A %.4f, with the lobe of its own %.4f\n", f0, e.split, e.lobe);
    EXPECT_NEAR(e.split, split, std::hypot(split, noise) - split + 0.0005) << f0;
    EXPECT_NEAR(e.lobe, lobe, std::hypot(lobe, noise) - lobe + 0.0005) << f0;
  }
}

TEST(LtcTable, CompactStaysWithinFourKilobytesAndHoldsNarrowLobesTogether) {
  const CompactTable& compact = ggx_compact_table();
  EXPECT_LE(compact.bytes(), 4096u);
  // Half way between the nodes of a 64 x 64 table, where the classic layout's lobes degenerate.
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

}  // namespace steradian::fit::table_test
