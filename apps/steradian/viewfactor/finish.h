// The last steps on the view factors of a whole run: small ones are left out, doubtful rows are named, and a summary is printed.
#pragma once

#include <string>
#include <vector>

#include "exchange/files/matrix_files.h"

namespace steradian::app {

// The smallest factor that --drop keeps. Throws WrongOption where it is not below 1.
double smallest_kept(double drop, double eps);

struct FinishOptions {
  bool close = false;
  double drop = 0;  // 0 keeps all
};

// The last steps on the matrix of all faces: warns of doubtful rows, closes the enclosure, adds up the rows of groups, and drops small
// factors. Returns the warnings. path: the file that errors name.
std::vector<std::string> finish_factors(const std::string& path, exchange::StoredRun& stored, const FinishOptions& options);

void warn(const std::string& path, const std::vector<std::string>& warnings);

void print_summary(const exchange::StoredRun& stored, double seconds);

}  // namespace steradian::app
