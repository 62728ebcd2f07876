// draw_point_light PICTURE.png: one point light over a plane, as docs/indirect.md shows it; prints its table.
// Columns: roughness 0.1, 0.3, 0.5, 1; above by transformed cosines, below by GGX.
#include <cstdio>

#include "render/bounce/point_light_plane.h"
#include "steradian/picture.h"

using namespace steradian;

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: draw_point_light PICTURE.png\n");
    return 2;
  }
  std::printf("| roughness | rmse | relative L2 | mean ratio |\n|---|---|---|---|\n");
  for (const double roughness : {0.1, 0.2, 0.3, 0.5, 0.7, 1.0}) {
    const auto p = indirect::point_light_over_plane(roughness, 800, 600);
    std::printf("| %.1f | %.4f | %.4f | %.4f |\n", roughness, p.rmse, p.relative_l2, p.mean_ratio);
  }
  constexpr int kWidth = 200, kHeight = 150, kGap = 4;
  const double shown[] = {0.1, 0.3, 0.5, 1.0};
  Picture sheet(4 * kWidth + 3 * kGap, 2 * kHeight + kGap);
  for (Vec3f& pixel : sheet.pixels) pixel = {1, 1, 1};
  for (int column = 0; column < 4; ++column) {
    const auto p = indirect::point_light_over_plane(shown[column], kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto i = static_cast<std::size_t>(y * kWidth + x);
        const auto grey = [&](double value) {
          const auto g = static_cast<float>(value / p.white);
          return Vec3f{g, g, g};
        };
        const int left = column * (kWidth + kGap) + x;
        sheet.at(left, y) = grey(p.transformed[i]);
        sheet.at(left, y + kHeight + kGap) = grey(p.ggx[i]);
      }
  }
  write_picture(sheet, argv[1]);
}
