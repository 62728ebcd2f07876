// Repeats the published comparison of Phong area lights: errors and times of every method on one scene.
#pragma once

#include <string>
#include <vector>

#include "core/simd.h"
#include "steradian/phong.h"

namespace steradian::moment {

struct ComparedMethod {
  std::string name;  // "series", "series high", "arvo to 1e-4", ...
  PhongOptions options;
};

// All methods except exact, the cheapest error last.
const std::vector<ComparedMethod>& compared_methods();

struct Table2Row {
  std::string light, method;
  int exponent = 0;
  double rmse = 0;       // over all pixels of the picture, divided by its largest value
  double largest = 0;    // largest error of a pixel, divided by the same value
  double scalar_ns = 0;  // per edge and pixel on one core, float
  double packs_ns = 0;
};

struct Table2Options {
  int width = 1280, height = 720;
  int every = 3;           // step between the pixels that count, in both directions
  double min_time = 0.05;  // seconds of runs per time; 0: no times
  Simd simd = active_simd();
};

std::vector<Table2Row> measure_table2(const Table2Options& options);

// Markdown: a table for each light, the published figures below.
std::string table2_text(const std::vector<Table2Row>& rows, const Table2Options& options);

// Writes the pictures and plots of docs/theory/moments.md into an existing folder; returns the files' names.
std::vector<std::string> write_table2_figures(const std::string& folder, Simd simd);

}  // namespace steradian::moment
