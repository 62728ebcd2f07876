// The fitter, and the form factor of a clipped sphere that its tables hold.
#pragma once

#include <functional>
#include <vector>

#include "fit/lobe.h"
#include "integrals/ggx/ltc_radiance.h"

namespace steradian::fit {

// Form factor of a sphere cut by the horizon, over that of the whole sphere: the value that `ltc-clipless` looks up.

//   cosine       of the sphere's centre to the normal, in [-1, 1]
//   form_factor  of the whole sphere towards its centre: sin^2 of its angular radius, in [0, 1]
// Degenerate: form factor 0 gives max(cosine, 0).
double clipped_sphere_form_factor(double cosine, double form_factor);

// The fitter: finds the linearly transformed cosine nearest to a lobe, for one view and for a table of roughness and view.

struct LtcCell {
  LtcShape shape;
  LtcInverse inverse;
  double albedo = 0;         // integral of the lobe over the hemisphere: F = 1
  double grazing = 0;        // of the lobe times (1 - v.h)^5
  double above_horizon = 1;  // fraction of the fitted lobe above the real horizon
  double error = 0;          // integral of |lobe - fit| over the hemisphere, over albedo

  // Magnitudes that tables store: the fit's part above the horizon then carries the lobe's energy.
  double n_a() const { return albedo / above_horizon; }
  double f_a() const { return grazing / above_horizon; }
};

// Distance that the optimiser minimises: |difference| to the power 1, 2 or 3. docs/theory/ltc.md compares them.
enum class FitNorm { l1 = 1, l2 = 2, l3 = 3 };

// Search for the minimum. The literature's is Nelder and Mead's simplex.
enum class FitSearch { bobyqa, nelder_mead };

struct FitOptions {
  int size = 64;  // nodes along roughness and along sqrt(1 - cos theta)
  FitNorm norm = FitNorm::l1;
  FitSearch search = FitSearch::bobyqa;
  int nodes = 32;                      // quadrature nodes: nodes^2 on half of the hemisphere, in the lobe's own coordinates
  int magnitude_directions = 1 << 14;  // quadrature points for albedo and grazing
  int lights = 64;                     // random rectangles of the second pass; 0: none
  int light_directions = 4096;         // quadrature points for their true radiance
  double lobe_share = 0.1;             // weight of the lobe's L1 beside the relative error on the lights
  int threads = 0;                     // 0: all
  std::function<void()> cell_done;     // called after every cell, from any thread
  int part = 1, parts = 1;             // fits the columns of one part only; other cells stay as they are made
  // To go on after an interruption: `finished` takes the column of a roughness, from any thread; `known` returns true if it can fill the
  // column from an earlier run with the same lobe and settings.
  std::function<void(int, const std::vector<LtcCell>&)> finished;
  std::function<bool(int, std::vector<LtcCell>&)> known;
};

// Node i of n along an axis: roughness, and the view's cosine. At cosine 0 lobes have no limit, so the last node is at the smallest cosine.
// That is about where interpolation of 1 / cosine is best in the last row of 64.
inline constexpr double kSmallestCosine = 0.01;
inline double ltc_roughness_at(int i, int n) { return static_cast<double>(i) / (n - 1); }
double ltc_cosine_at(int j, int n);

// The fit of one view, from a starting shape. Deterministic: same input, same bits.
LtcCell fit_cell(const LobeFamily& family, double roughness, double cos_theta, const LtcShape& start, const FitOptions& options);

// Node (i, j) at j * size + i: roughness i, view j. Every column of one roughness starts at the normal view and
// continues from view to view, so that columns are independent: the same bits on any number of threads.
struct LtcTable {
  LobeFamily family;
  int size = 0;
  std::vector<LtcCell> cells;
  const LtcCell& at(int i, int j) const { return cells[static_cast<std::size_t>(j * size + i)]; }
};

// The first `views` cells of the column of one roughness in a table of options.size.
std::vector<LtcCell> fit_column(const LobeFamily& family, int i, int views, const FitOptions& options);

LtcTable fit_table(const LobeFamily& family, const FitOptions& options = {});

// The columns that a part fits: every one of `parts`. A lobe with fixed roughness has one column.
std::vector<int> columns_of_part(const LobeFamily& family, const FitOptions& options);

// Puts a column into the table; all columns are those of a lobe with fixed roughness.
void put_column(LtcTable& table, int i, const std::vector<LtcCell>& column);

// The same, but fits every cell once more from the shape of its rougher neighbour and takes the nearer lobe. This helps where a column's
// continuation is in another valley than its neighbour's. The lobe times (1 - v.h)^5 is such a case below roughness 0.4 at grazing views.
LtcTable fit_table_from_both_sides(const LobeFamily& family, const FitOptions& options = {});

}  // namespace steradian::fit
