// compare_shadows FILE.svg [POINTS]: soft shadows by pieces, by clipping, by counts at places and by rays, for docs/measured/shadows.md.
// The tables go to standard output, the picture of error over time to the file.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "bench/studies/line_plot.h"
#include "bench/studies/shadow_comparison.h"

using namespace steradian;
using studies::ShadowRow;
using studies::ShadowScene;

namespace {

double geometric_mean(const std::vector<ShadowScene>& scenes, std::size_t row, double (*of)(const ShadowRow&)) {
  double sum = 0;
  for (const ShadowScene& scene : scenes) sum += std::log(of(scene.rows[row]));
  return std::exp(sum / static_cast<double>(scenes.size()));
}

// A method's points of the plot, over all scenes: one for each of its rows.
moment::PlotCurve curve_of(const std::vector<ShadowScene>& scenes, const std::string& name, const std::vector<std::size_t>& rows,
                           int colour) {
  moment::PlotCurve curve;
  curve.name = name;
  curve.colour = colour;
  for (const std::size_t row : rows)
    curve.points.emplace_back(std::log10(geometric_mean(scenes, row, [](const ShadowRow& r) { return r.microseconds; })),
                              std::log10(geometric_mean(scenes, row, [](const ShadowRow& r) { return std::max(r.rms, 1e-8); })));
  // A single row is drawn as a little cross.
  if (rows.size() == 1) {
    const auto [x, y] = curve.points[0];
    curve.points = {{x - 0.06, y}, {x + 0.06, y}, {x, y}, {x, y - 0.15}, {x, y + 0.15}};
  }
  return curve;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: compare_shadows FILE.svg [POINTS]\n");
    return 2;
  }
  const int points = argc > 2 ? std::atoi(argv[2]) : 200;
  const std::vector<ShadowScene> scenes = studies::compare_shadows(points);
  std::printf(
      "| scene (triangles, segments a point) | method | rms, Lambert | rms, LTC | off by over 1 %% | time [us] | in rays |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const ShadowScene& scene : scenes)
    for (const ShadowRow& row : scene.rows)
      std::printf("| %s (%zu, %.1f) | %s | %.1e | %.1e | %.0f %% | %.1f | %.0f |\n", scene.name.c_str(), scene.triangles, scene.segments,
                  row.method.c_str(), row.rms, row.rms_ltc, 100 * row.off_by_1, row.microseconds,
                  row.microseconds / scene.ray_microseconds);
  std::printf("\n");
  for (const ShadowScene& scene : scenes)
    std::printf("%s: the truth is %.1e rms off rays at five points; a ray takes %.3f us\n", scene.name.c_str(), scene.truth,
                scene.ray_microseconds);

  moment::LinePlot plot;
  plot.title = "Five scenes, geometric means: error in a penumbra over time a point";
  plot.x_label = "log10 of the time [us]";
  plot.y_label = "log10 of the rms error (Lambert)";
  plot.x_low = 0;
  plot.x_high = 5;
  plot.y_low = -10;
  plot.y_high = 0;
  plot.curves = {curve_of(scenes, "pieces", {0}, 2), curve_of(scenes, "clipping, scaled", {1}, 4),
                 curve_of(scenes, "clipping, not scaled", {2}, 7), curve_of(scenes, "counts, 256 - 1024", {3, 4}, 1),
                 curve_of(scenes, "rays, 16 - 1024", {5, 6, 7}, 3)};
  std::ofstream(argv[1]) << moment::to_svg(plot);

  std::printf("\n| triangles of a sphere | segments a point | method | time [us] |\n|---|---|---|---|\n");
  for (const ShadowScene& scene : studies::grow_shadows(std::max(points / 20, 5)))
    for (const ShadowRow& row : scene.rows)
      std::printf("| %zu | %.1f | %s | %.1f |\n", scene.triangles, scene.segments, row.method.c_str(), row.microseconds);
}
