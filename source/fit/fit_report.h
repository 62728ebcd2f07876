// Errors of a table against its lobe: on lights, between its nodes, and below the horizon.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fit/tables_of_fit.h"
#include "fit/test_lights.h"
#include "steradian/picture.h"

namespace steradian::fit {

// Reads a table at (roughness, cos theta).
using LookUp = std::function<LtcValue(double roughness, double cos_theta)>;

// One cell of the error grid.
struct CellError {
  double roughness = 0;
  double degrees = 0;  // of the view
  double rmse = 0;     // of the radiance over the rectangles
  double signal = 0;   // root mean square of the true radiance
  double lobe_l1 = 0;  // integral of |lobe - table| over its albedo; 2 is no overlap
  double below = 0;    // fraction of the fitted lobe below the horizon
};

struct ReportOptions {
  std::vector<double> roughness;
  std::vector<double> degrees;
  int rectangles = 24;
  int directions = 1 << 17;  // quasi-random directions for the truth; its error is about 1e-4
  std::uint64_t seed = 5;
};
// Grid of 13 roughness x 10 views, between the nodes of every table.
ReportOptions whole_grid();
// Grid of 8 roughness x 5 views on nodes of the 64 x 64 table.
ReportOptions node_grid();

struct FitReport {
  std::vector<CellError> cells;  // view by view
  double rmse = 0;
  double relative = 0;  // over the root mean square of the signal
};

// The lobe's L1 at the fits' own nodes and half way between four of them, averaged over the views.
struct BetweenNodes {
  double roughness = 0;  // half way between two columns
  double at_nodes = 0;
  double between = 0;
  // L1 of the views up to 81 degrees: beyond, lobes change faster from node to node than any interpolation can follow.
  double steep_at_nodes = 0;
  double steep_between = 0;
};
std::vector<BetweenNodes> measure_between_nodes(const LtcTable& fit, const LookUp& table);

// Everything above as text, with the worst cells.
std::string describe(const FitReport& whole, const FitReport& nodes, const std::vector<BetweenNodes>& between);

// RMSE over roughness (to the right) and view (downwards): black 0, white 0.03 and more, 32 pixels a cell.
Picture draw(const FitReport& report, const ReportOptions& options);

FitReport measure(const LobeFamily& family, const LookUp& table, const ReportOptions& options);

// Error relative to the signal, both as root mean squares over the grid, with Schlick's Fresnel of F90 = 1.
struct FresnelError {
  double split = 0;  // by n_A and f_A under one matrix
  double lobe = 0;   // by the table of the lobe times (1 - v.h)^5 beside it
};
FresnelError measure_fresnel(const LobeFamily& family, const LookUp& table, const LookUp& fresnel_table, double f0,
                             const ReportOptions& options);

// Integral of |lobe - table's lobe| over the lobe's albedo, by quadrature in the lobe's coordinates, n x n on a half.
double lobe_l1(const Lobe& lobe, const LtcValue& value, int n);

}  // namespace steradian::fit
