// Time and error of the plane's methods over the numbers of lights and of occluders, to check the claims of the heuristic `par` against
// marching.
#pragma once

#include <string>
#include <vector>

namespace steradian::plane {

struct MethodCost {
  std::string method;  // "exact", "par", "par, intervals added", "sampled, 64 rays", "marched, 64 rays"
  int lights = 0, occluders = 0;
  double microseconds = 0;   // per point, one thread
  double error_percent = 0;  // mean absolute error against `exact`, relative to the mean radiance
};

struct MethodCostOptions {
  int points = 200;        // outside all bodies
  double min_time = 0.02;  // seconds for each time; 0: no times
};

// Round lights of radius 6 without a range, among boxes of half sides 5 to 14, which may overlap, on a square of 512.
std::vector<MethodCost> measure_plane_methods(const MethodCostOptions& options);

// Markdown: a table over lights, a table over occluders.
std::string plane_methods_text(const std::vector<MethodCost>& costs);

}  // namespace steradian::plane
