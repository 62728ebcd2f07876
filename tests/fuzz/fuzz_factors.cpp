#include <cstdlib>

#include "exchange/files/matrix_files.h"
#include "exchange/files/vs3.h"
#include "memory_file.h"
#include "steradian/error.h"

namespace steradian::fuzz {

void factors(Input input) {
  const MemoryFile file(input);
  Budget budget(kLimits);
  try {
    exchange::read_factors_npz(file.path(), budget);
  } catch (const Error&) {
  }
  try {
    const exchange::SceneFaces faces = exchange::read_vs3(file.path(), {}, budget);
    if (faces.faces.size() > 8) return;
    ViewFactorOptions options;
    options.eps = 0.01;
    options.obstacles = faces.obstacles;
    ViewFactors f = view_factors(faces.faces, options);
    if (!faces.masks.empty()) f = exchange::with_masks(grouped_view_factors(f, faces.groups, faces.group_names), faces.masks);
    for (const double sum : f.row_sums)
      if (!(sum >= 0)) std::abort();  // not a number, or negative
  } catch (const Error&) {
  }
}

}  // namespace steradian::fuzz
