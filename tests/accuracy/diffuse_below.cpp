// A diffuse lobe under a dielectric's boundary: the weight that an area light gets, against glTF's for every direction.
#include <fmt/format.h>

#include <ostream>

#include "sections.h"
#include "support/diffuse_below.h"

namespace steradian::accuracy {

void write_diffuse_below(std::ostream& out) {
  constexpr int kLights = 200;
  constexpr double kViews[] = {0, 30, 60, 75, 85};
  out << "\n## Diffuse under Fresnel\n\nThe diffuse lobe of a dielectric weighs (1 - F0)(1 - (1 - v.h)^5) (F90 = 1), in `render` at the "
         "light's mean "
         "direction,\nblended with the sky's mean. Relative RMSE over "
      << kLights
      << " squares at distance 1 in all directions, against adaptive cubature of\nthe lobe itself; in brackets: of the "
         "constant weight 1 - F0.\n\n| side | view 0° | 30° | 60° | 75° | 85° |\n|---:|---:|---:|---:|---:|---:|\n";
  for (const double side : {0.05, 0.5, 1.0, 2.0, 5.0, 20.0}) {
    out << fmt::format("| {} |", side);
    for (const double view : kViews) {
      const auto e = reference::measure_diffuse_below(side, view, kLights, 7);
      out << fmt::format(" {:.4f} ({:.4f}) |", e.ours, e.constant);
    }
    out << "\n";
  }
}

}  // namespace steradian::accuracy
