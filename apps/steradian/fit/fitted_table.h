// The form in which `fit` and `merge` write a fitted table.
#pragma once

#include <string>

#include "fit/fit_report.h"
#include "fit/tables_of_fit.h"

namespace steradian::app {

struct TableForm {
  std::string layout = "classic", normalisation = "middle";
  fit::CompactSizes compact = {};
};

// Throws Error for an ending that the layout does not have.
void check_table_name(const std::string& path, const TableForm& form);

// Writes the table, and prints the names of its files.
void write_fitted_table(const fit::LtcTable& table, const TableForm& form, const std::string& path);

// The values that a renderer takes from the table.
fit::LookUp look_up_of(const fit::LtcTable& table, const TableForm& form);

}  // namespace steradian::app
