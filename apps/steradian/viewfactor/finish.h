// The last steps on the view factors of a whole run: small ones are left out, doubtful rows are named, and a summary is printed.
#pragma once

#include <string>
#include <vector>

#include "exchange/files/matrix_files.h"

namespace steradian::app {

// The smallest factor that --drop keeps. Throws WrongOption where it is not below 1.
double smallest_kept(double drop, double eps);
// Leaves out smaller ones. drop: 0 keeps all.
void drop_small(exchange::StoredRun& stored, double drop);

// Sentences about rows that a user should look at, with the name of the worst one.
std::vector<std::string> doubts_about(const exchange::StoredRun& stored);
void warn(const std::string& path, const std::vector<std::string>& warnings);

void print_summary(const exchange::StoredRun& stored, double seconds);

}  // namespace steradian::app
