#include "bench/studies/line_plot.h"

#include <algorithm>
#include <cstdio>

namespace steradian::moment {
namespace {

constexpr double kLeft = 60, kTop = 36, kPlotWidth = 420, kPlotHeight = 260, kLegend = 170;
// The palette of Okabe and Ito, which people with any colour vision can distinguish.
constexpr const char* kPalette[] = {"#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#999999"};

template <class... T>
std::string print(const char* pattern, T... values) {
  char text[512];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string label(double x, double y, const char* anchor, const std::string& words) {
  return print("<text x='%.1f' y='%.1f' text-anchor='%s'>", x, y, anchor) + words + "</text>\n";
}

}  // namespace

std::string to_svg(const LinePlot& plot) {
  const auto x_of = [&](double x) { return kLeft + kPlotWidth * (x - plot.x_low) / (plot.x_high - plot.x_low); };
  const auto y_of = [&](double y) { return kTop + kPlotHeight * (plot.y_high - y) / (plot.y_high - plot.y_low); };
  std::string svg = print(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %.0f %.0f' font-family='sans-serif' font-size='12'>\n"
      "<rect width='100%%' height='100%%' fill='white'/>\n"
      "<clipPath id='c'><rect x='%.0f' y='%.0f' width='%.0f' height='%.0f'/></clipPath>\n",
      kLeft + kPlotWidth + kLegend, kTop + kPlotHeight + 44, kLeft, kTop, kPlotWidth, kPlotHeight);
  for (int i = 0; i <= 5; ++i) {
    const double x = plot.x_low + (plot.x_high - plot.x_low) * i / 5, y = plot.y_low + (plot.y_high - plot.y_low) * i / 5;
    svg += print("<path d='M%.1f %.1fv%.1f M%.1f %.1fh%.1f' stroke='#ddd'/>\n", x_of(x), kTop, kPlotHeight, kLeft, y_of(y), kPlotWidth);
    svg += label(x_of(x), kTop + kPlotHeight + 16, "middle", print("%.3g", x));
    svg += label(kLeft - 6, y_of(y) + 4, "end", print("%.3g", y));
  }
  svg += label(kLeft + kPlotWidth / 2, kTop + kPlotHeight + 36, "middle", plot.x_label);
  svg += label(kLeft, kTop - 18, "start", plot.title);
  svg += label(kLeft, kTop - 4, "start", plot.y_label);
  double legend = kTop + 10;
  for (const PlotCurve& curve : plot.curves) {
    const char* colour = kPalette[curve.colour % 8];
    const char* dash = curve.dashed ? " stroke-dasharray='5 4'" : "";
    svg += print("<g clip-path='url(#c)'><polyline fill='none' stroke='%s' stroke-width='1.5'%s points='", colour, dash);
    for (const auto& [x, y] : curve.points) svg += print("%.1f,%.1f ", x_of(x), std::clamp(y_of(y), -1e4, 1e4));
    svg += "'/></g>\n";
    if (curve.name.empty()) continue;
    svg += print("<path d='M%.1f %.1fh22' stroke='%s' stroke-width='1.5'%s/>\n", kLeft + kPlotWidth + 10, legend - 4, colour, dash);
    svg += label(kLeft + kPlotWidth + 38, legend, "start", curve.name);
    legend += 18;
  }
  return svg + "</svg>\n";
}

std::string sheet_to_svg(const std::vector<LinePlot>& plots, int columns) {
  constexpr double kPanelWidth = kLeft + kPlotWidth + kLegend, kPanelHeight = kTop + kPlotHeight + 44;
  const int count = static_cast<int>(plots.size()), rows = (count + columns - 1) / columns;
  std::string svg = print("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %.0f %.0f'>\n", columns * kPanelWidth, rows * kPanelHeight);
  for (int i = 0; i < count; ++i) {
    svg += print("<svg x='%.0f' y='%.0f' width='%.0f' height='%.0f'>\n", i % columns * kPanelWidth, i / columns * kPanelHeight, kPanelWidth,
                 kPanelHeight);
    svg += to_svg(plots[static_cast<std::size_t>(i)]) + "</svg>\n";
  }
  return svg + "</svg>\n";
}

}  // namespace steradian::moment
