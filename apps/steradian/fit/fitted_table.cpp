#include "fit/fitted_table.h"

#include <fmt/format.h>

#include "fit/table_files.h"

namespace steradian::app {

using namespace fit;

namespace {

ClassicNormalisation normalisation_of(const TableForm& form) {
  return form.normalisation == "last" ? ClassicNormalisation::last : ClassicNormalisation::middle;
}

}  // namespace

void check_table_name(const std::string& path, const TableForm& form) {
  const std::vector<std::array<float, 4>> empty(4);
  if (form.layout == "classic")
    classic_files({2, empty, empty, ClassicNormalisation::middle}, "lobe", path);
  else
    compact_files({}, "lobe", path);
}

void write_fitted_table(const LtcTable& table, const TableForm& form, const std::string& path) {
  const std::vector<TableFile> files = form.layout == "classic"
                                           ? classic_files(classic_table(table, normalisation_of(form)), table.family.name, path)
                                           : compact_files(compact_table(table, form.compact), table.family.name, path);
  write_files(files);
  for (const TableFile& file : files) fmt::print("{}\n", file.path);
}

LookUp look_up_of(const LtcTable& table, const TableForm& form) {
  if (form.layout == "compact") return [t = compact_table(table, form.compact)](double r, double c) { return t.look_up(r, c); };
  return [t = classic_table(table, normalisation_of(form))](double r, double c) { return t.look_up(r, c); };
}

}  // namespace steradian::app
