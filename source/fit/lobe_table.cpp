// Custom lobes of the caller, fitted and written in one call.
#include <algorithm>

#include "fit/fit.h"
#include "fit/lobe.h"
#include "fit/table_files.h"
#include "fit/tables_of_fit.h"
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
