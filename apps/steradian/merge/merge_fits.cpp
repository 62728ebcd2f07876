#include "merge/merge_fits.h"

#include <fmt/format.h>

#include <set>

#include "fit/fit_part.h"
#include "steradian/error.h"

namespace steradian::app {

void merge_fits(const std::vector<std::string>& parts, const std::string& output, const Limits& limits) {
  FitPart first;
  fit::LtcTable table;
  std::set<int> numbers;
  for (const std::string& path : parts) {
    FitPart part = read_fit_part(path, limits);
    if (numbers.empty()) {
      first = part;
      check_table_name(output, first.form);
      table.family = first.family;
      table.size = first.size;
      table.cells.resize(static_cast<std::size_t>(table.size * table.size));
    }
    if (part.settings != first.settings || part.form.layout != first.form.layout || part.form.normalisation != first.form.normalisation ||
        part.part.count != first.part.count)
      throw Error(path, "has other settings than " + parts[0], "merge the parts of one run");
    if (!numbers.insert(part.part.number).second)
      throw Error(path, fmt::format("is part {} once more", part.part.number), "name each part once");
    for (const auto& [i, column] : part.columns) put_column(table, i, column);
  }
  int lacks = 1;
  while (numbers.count(lacks) != 0) ++lacks;
  if (lacks <= first.part.count)
    throw Error(parts[0], fmt::format("is one of {} parts, and {} are here; part {} is missing", first.part.count, numbers.size(), lacks),
                "merge all parts");
  write_fitted_table(table, first.form, output);
}

}  // namespace steradian::app
