// View factors: the exact exchange of radiation between plane polygons, with an error for every entry.
//
//   std::vector<ViewFactorFace> room = ...;
//   ViewFactors factors = view_factors(room);
//   double f = factors.between(0, 5) / factors.areas[0];   // from face 0 to face 5
//
// Stored is the exchange area H = A_i F_ij = A_j F_ji, one number a pair. See docs/viewfactor.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "steradian/vector.h"

namespace steradian {

// A plane polygon that exchanges radiation from the side on which its outline runs counter-clockwise.
struct ViewFactorFace {
  std::string name;
  std::vector<Vec3d> outline;
  std::vector<std::vector<Vec3d>> holes = {};
};

// Rows of the lower triangle: row r holds columns below r.
struct ExchangeBlock {
  std::size_t first_row = 0;
  std::vector<std::uint64_t> row_start;  // one more than there are rows; places in the other lists
  std::vector<std::uint32_t> columns;    // ascending in a row
  std::vector<double> values;            // exchange areas [m2]
  std::vector<float> errors;             // bounds or, of partly visible pairs, estimates [m2]; rounded upwards

  std::size_t rows() const { return row_start.empty() ? 0 : row_start.size() - 1; }
};

enum class Obstruction { on, off };

struct ViewFactorOptions {
  double eps = 1e-6;                            // error of an entry that is enough, relative to the unobstructed exchange area
  Obstruction obstruction = Obstruction::on;    // on: the faces obstruct each other, from both sides
  std::vector<std::array<Vec3d, 3>> obstacles;  // triangles that obstruct and exchange nothing
  int part = 1, parts = 1;                      // computes the rows of one part of `parts` only
  std::function<void(std::uint64_t)> advanced;  // called by any thread with the number of pairs that are done
  // To go on after an interruption: `finished` takes each block that is done, by any thread; `known` returns true if it can fill the block
  // that begins at its first_row, from an earlier run with the same faces and settings.
  std::function<void(const ExchangeBlock&)> finished;
  std::function<bool(ExchangeBlock&)> known;
};

struct ViewFactors {
  std::vector<std::string> names;
  std::vector<double> areas;
  std::vector<ExchangeBlock> blocks;         // ascending rows; with parts, those of this part
  std::vector<double> own;                   // exchange area of a group with itself; empty for single faces, whose own is 0
  std::vector<double> row_sums, row_errors;  // view factors of a row, and the bound of their error

  std::size_t size() const { return areas.size(); }
  std::uint64_t entries() const;
  double between(std::size_t i, std::size_t j) const;        // exchange area
  double error_between(std::size_t i, std::size_t j) const;  // its error
  // Computes row_sums and row_errors anew.
  void sum_rows();
};

// Throws Error that names the face if a face is no plane polygon, or UsageError for options that are out of range.
ViewFactors view_factors(const std::vector<ViewFactorFace>& faces, const ViewFactorOptions& options = {});

// Joins the parts of one run, in any order. Throws Error for parts that are missing or that do not belong together.
ViewFactors merge_view_factors(std::vector<ViewFactors> parts);

// Rows that one part of a run holds: pairs of the first row and the one behind the last.
std::vector<std::pair<std::size_t, std::size_t>> rows_of_part(std::size_t rows, int part, int parts);

// Corrections to a closed enclosure: the factors of each row add up to 1, each entry moves by its own error as far as possible, and
// symmetry stays exact. Throws Error if a row is off by more than its error: then the enclosure is not closed.
ViewFactors closed_view_factors(const ViewFactors& factors);

// Sums over groups of faces. groups[i]: the group of face i, below names.size().
ViewFactors grouped_view_factors(const ViewFactors& factors, const std::vector<std::size_t>& groups, const std::vector<std::string>& names);

// Leaves out the entries whose view factors are below `smallest` in both directions. What they exchange counts in the errors of their rows.
ViewFactors without_small_factors(const ViewFactors& factors, double smallest);

}  // namespace steradian
