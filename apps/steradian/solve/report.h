// The report of `steradian solve`: numbers as JSON, and one page with pictures.
#pragma once

#include <string>

#include "solve/job.h"

namespace steradian::app {

struct SolveReport {
  const std::string& scene_path;
  const std::string& output;
  std::string command;
  double seconds = 0;
  const Scene& start;
  const SolveJob& job;
  const Solution& found;
  const RenderOptions& render;
};

std::string solve_report_json(const SolveReport& report);
// Writes index.html and report.json. The picture of the result is that of the written scene, loaded again.
void write_solve_report(const SolveReport& report, const std::string& folder, const LoadOptions& load);

}  // namespace steradian::app
