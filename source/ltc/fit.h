// The fitter: the linearly transformed cosine nearest to a lobe, for one view and for a table of roughness and view.
#pragma once

#include <functional>
#include <vector>

#include "ltc/lobe.h"

namespace steradian {

// Four degrees of freedom: entries (0,0), (1,1), (0,2), (2,0) of R^T M over alpha, entry (2,2) being 1.
// About the mirror direction: R turns z into it. About the normal: R and alpha are 1. See ltc_from_compact.
struct LtcShape {
  double e00 = 1, e11 = 1, e02 = 0, e20 = 0;
};

// M^-1 up to a factor: rows (xx, 0, xz), (0, yy, 0), (zx, 0, zz).
struct LtcInverse {
  double xx = 1, xz = 0, yy = 1, zx = 0, zz = 1;
};

struct LtcCell {
  LtcShape shape;
  LtcInverse inverse;
  double albedo = 0;         // integral of the lobe over the hemisphere: F = 1
  double grazing = 0;        // of the lobe times (1 - v.h)^5
  double above_horizon = 1;  // share of the fitted lobe above the real horizon
  double error = 0;          // integral of |lobe - fit| over the hemisphere, over albedo

  // What tables hold: the fit's part above the horizon then carries the lobe's energy.
  double n_a() const { return albedo / above_horizon; }
  double f_a() const { return grazing / above_horizon; }
};

// Which distance the optimiser minimises; |difference| to the power 1, 2 or 3. docs/ltc.md compares them.
enum class FitNorm { l1 = 1, l2 = 2, l3 = 3 };

struct FitOptions {
  int size = 64;                // nodes along roughness and along sqrt(1 - cos theta)
  FitNorm norm = FitNorm::l1;
  int nodes = 32;               // quadrature nodes: nodes^2 on half of the hemisphere, in the lobe's own coordinates
  int magnitude_nodes = 128;    // the same for albedo and grazing
  int threads = 0;              // 0: all
  std::function<void(double)> progress;  // share done, called from any thread
};

// Node i of n along an axis: roughness, and the view's cosine (at least 1e-3: at 0 the lobe has no limit).
double ltc_roughness_at(int i, int n);
double ltc_cosine_at(int j, int n);

LtcInverse ltc_inverse(const LtcShape& shape, LobeFrame frame, double alpha, Vec3d view);
double ltc_evaluate(const LtcInverse& inverse, Vec3d l);

// The fit of one view, from a starting shape. Deterministic: same input, same bits.
LtcCell fit_cell(const LobeFamily& family, double roughness, double cos_theta, const LtcShape& start,
                 const FitOptions& options);

// Node (i, j) at j * size + i: roughness i, view j. Every column of one roughness starts at the normal view and
// continues from view to view, so that columns are independent: the same bits on any number of threads.
struct LtcTable {
  LobeFamily family;
  int size = 0;
  std::vector<LtcCell> cells;
  const LtcCell& at(int i, int j) const { return cells[static_cast<std::size_t>(j * size + i)]; }
};

LtcTable fit_table(const LobeFamily& family, const FitOptions& options = {});

}  // namespace steradian
