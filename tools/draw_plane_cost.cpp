// draw_plane_cost DIR: DIR/cost-lights.svg and DIR/cost-occluders.svg, and their tables in Markdown, and one of
// the scenes of the bench.
//
// 1080p frames of random light fields on one thread, scene preparation included: processor time, the least of five.
#include <ctime>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "bench/studies/line_plot.h"
#include "plane/stage/drawing.h"
#include "steradian/plane.h"

using namespace steradian;
using namespace steradian::plane;

namespace {

double frame_ms(const LightField& field) {
  const PlaneScene scene = make_light_field(field, 1);
  PlaneFrameOptions options;
  options.threads = 1;
  Picture picture;
  double best = 1e300;
  for (int i = 0; i < 5; ++i) {
    const std::clock_t start = std::clock();
    const PlaneWorld world(scene);
    render_plane_into(picture, world, options);
    best = std::min(best, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

void draw(const std::string& path, const std::string& what, const std::string& title,
          const std::vector<std::pair<double, double>>& points) {
  double highest = 0;
  std::printf("| %s |", what.c_str());
  for (const auto& [x, y] : points) std::printf(" %.0f |", x), highest = std::max(highest, y);
  std::printf("\n|---|");
  for (std::size_t i = 0; i < points.size(); ++i) std::printf("---|");
  std::printf("\n| ms |");
  for (const auto& [x, y] : points) std::printf(" %.0f |", y);
  std::printf("\n\n");
  moment::LinePlot plot;
  plot.title = title;
  plot.x_label = what;
  plot.y_label = "ms";
  plot.x_high = points.back().first;
  plot.y_high = 1.05 * highest;
  plot.curves.push_back({"", points, false, 0});
  std::ofstream(path) << moment::to_svg(plot);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: draw_plane_cost DIR\n");
    return 2;
  }
  const std::string folder = argv[1];
  std::vector<std::pair<double, double>> by_lights, by_boxes;
  std::printf("| lights / boxes | ms |\n|---|---|\n");
  for (const LightField& field : kLightFields) std::printf("| %d / %d | %.0f |\n", field.lights, field.boxes, frame_ms(field));
  std::printf("\n");
  const auto plain = [](int lights, int boxes) { return frame_ms({lights, boxes, 200, 8, 12}); };
  for (int lights : {1, 32, 64, 128, 256, 512, 768, 1024}) by_lights.emplace_back(lights, plain(lights, 1000));
  for (int boxes : {0, 125, 250, 500, 1000, 2000, 4000, 8000}) by_boxes.emplace_back(boxes, plain(128, boxes));
  draw(folder + "/cost-lights.svg", "lights", "1000 boxes, 1920 x 1080, one thread", by_lights);
  draw(folder + "/cost-occluders.svg", "boxes", "128 lights, 1920 x 1080, one thread", by_boxes);
}
