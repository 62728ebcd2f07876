// The report of `steradian viewfactor`: rows, errors and guarantees, as JSON or as a page.
#pragma once

#include <string>
#include <vector>

#include "exchange/files/matrix_files.h"

namespace steradian::app {

// Row sums are off by their rounding, whatever the errors are.
inline constexpr double kRowRounding = 1e-12;

// The guarantees of a matrix, as found in its numbers.
struct GuaranteeCounts {
  std::size_t outside = 0, overfull = 0;
  double worst_error = 0, largest_sum = 0, smallest_sum = 1;
};
GuaranteeCounts guarantees_of(const exchange::StoredRun& stored);

// A page where the name ends in .html, else JSON. The page shows the faces coloured by the error of their row, or by the factor to a face
// that is chosen with the mouse.
void write_report(const std::string& path, const std::string& scene, const exchange::StoredRun& stored,
                  const std::vector<std::string>& warnings, double seconds);

}  // namespace steradian::app
