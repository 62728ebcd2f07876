// Charlie's sheen by its cubature, against the reference.
#include <fmt/format.h>

#include <ostream>

#include "sections.h"
#include "steradian/radiance.h"
#include "support/random_squares.h"

namespace steradian::accuracy {

void write_sheen(std::ostream& out) {
  constexpr int kLights = 60;
  constexpr double kViews[] = {0, 30, 60, 75, 85};
  constexpr double kRoughness[] = {0.07, 0.2, 0.3, 0.5, 0.7, 1.0};
  out << "\n## Sheen\n\nCharlie's lobe by `cubature`. Relative RMSE over " << kLights
      << " squares at distance 1 in all directions for each of roughness 0.07, 0.2, 0.3,\n0.5, 0.7, 1, against adaptive cubature; "
         "in brackets: the worst roughness.\n\n| side | view 0° | 30° | 60° | 75° | 85° |\n|---:|---:|---:|---:|---:|---:|\n";
  for (const double side : {0.05, 0.2, 0.5, 1.0, 2.0, 5.0}) {
    out << fmt::format("| {} |", side);
    for (const double view : kViews) {
      reference::RelativeRms all;
      double worst = 0;
      for (const double roughness : kRoughness) {
        reference::RelativeRms cell;
        reference::Random random(8);
        Material m;
        m.brdf = Brdf::charlie;
        m.alpha_x = m.alpha_y = roughness * roughness;
        for (int i = 0; i < kLights; ++i) {
          const PreparedPolygon light = reference::random_square(random, side);
          const ShadingPoint at = reference::seen_from(view);
          cell.add(radiance(light, at, m, {Method::cubature}).radiance.x,
                   reference_radiance(light, at, m, {1e-4, 1e-9, 60'000}).radiance.x);
        }
        all.add(cell);
        worst = std::max(worst, cell.value());
      }
      out << fmt::format(" {:.4f} ({:.4f}) |", all.value(), worst);
    }
    out << "\n";
  }
}

}  // namespace steradian::accuracy
