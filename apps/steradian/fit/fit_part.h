// Parts of a fit: some columns of a table in a JSON file, which steradian merge joins.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fit/fit.h"
#include "fit/fitted_table.h"
#include "part.h"
#include "steradian/limits.h"

namespace steradian::app {

struct FitPart {
  std::string settings;  // all on which the columns depend, with the program's version
  TableForm form;        // the whole table has it
  LobeFamily family;     // its name, frame and fixed roughness; a part that was read has no lobes
  int size = 0;
  Part part;
  std::map<int, std::vector<fit::LtcCell>> columns = {};
};

void write_fit_part(const FitPart& part, const std::string& path);

// Throws Error for a file that is no whole part of a fit.
FitPart read_fit_part(const std::string& path, const Limits& limits);

// The text of FitPart::settings. samples: the file of a measured lobe; may be empty.
std::string fit_settings(const LobeFamily& family, const std::string& samples, const fit::FitOptions& options);

}  // namespace steradian::app
