// A line plot as SVG: axes, ticks, curves and their names.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace steradian::moment {

struct PlotCurve {
  std::string name;  // no legend where empty
  std::vector<std::pair<double, double>> points;
  bool dashed = false;
  int colour = 0;  // index in a palette of eight
};

struct LinePlot {
  std::string title, x_label, y_label;
  double x_low = 0, x_high = 1, y_low = 0, y_high = 1;
  std::vector<PlotCurve> curves;
};

std::string to_svg(const LinePlot& plot);

// Several plots as one picture, row by row.
std::string sheet_to_svg(const std::vector<LinePlot>& plots, int columns);

}  // namespace steradian::moment
