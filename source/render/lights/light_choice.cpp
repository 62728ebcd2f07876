#include "render/lights/light_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steradian/area_light.h"  // luminance

namespace steradian {

LightChoice::LightChoice(const std::vector<PackLight>& lights) {
  for (const PackLight& light : lights) {
    Source& source = sources_.emplace_back();
    if (light.area == nullptr) continue;
    const AreaLight& area = *light.area;
    Vec3d normal;
    if (light.is_polygon()) {
      const std::vector<Vec3d> corners = flat_polygon(area).vertices;
      for (const Vec3d& corner : corners) source.center = source.center + corner * (1.0 / static_cast<double>(corners.size()));
      for (std::size_t i = 0; i < corners.size(); ++i)
        normal = normal + cross(corners[i] - source.center, corners[(i + 1) % corners.size()] - source.center) * 0.5;
      source.area = length(normal);
    } else if (const auto* ellipse = std::get_if<Ellipse>(&area.shape)) {
      source.center = ellipse->center;
      normal = cross(ellipse->x, ellipse->y);
      source.area = std::numbers::pi * length(normal);
    } else if (const auto* ellipsoid = std::get_if<Ellipsoid>(&area.shape)) {
      source.center = ellipsoid->center;
      source.area =
          std::numbers::pi * std::max({dot(ellipsoid->x, ellipsoid->x), dot(ellipsoid->y, ellipsoid->y), dot(ellipsoid->z, ellipsoid->z)});
    } else if (const auto* tube = std::get_if<Capsule>(&area.shape)) {
      source.center = (tube->end_a + tube->end_b) * 0.5;
      source.area = tube->radius * (2 * length(tube->end_b - tube->end_a) + std::numbers::pi * tube->radius);
    }
    if (area.is_flat() && !area.two_sided && source.area > 0) source.normal = normalized(normal);
    source.power = luminance(area.radiance) * source.area;
  }
}

std::vector<LightChoice::Chosen> LightChoice::choose(std::span<const PackLight* const> lights, const Box3f& positions, std::size_t count,
                                                     double offset) const {
  // No light that may be chosen is left out, however little it seems to send.
  constexpr double kLeast = 0.05;
  const Vec3d middle = static_cast<Vec3d>(positions.low + positions.high) * 0.5;
  std::vector<double> sums;
  double sum = 0;
  for (const PackLight* light : lights) {
    const Source& source = sources_[light->index];
    const Vec3d to = middle - source.center;
    const double square = std::max({dot(to, to), source.area, 1e-30});
    const double facing = dot(source.normal, source.normal) > 0 ? std::max(dot(source.normal, to) / std::sqrt(square), kLeast) : 1.0;
    sums.push_back(sum += source.power * facing / square);
  }
  std::vector<Chosen> chosen;
  if (!(sum > 0)) return chosen;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = (static_cast<double>(k) + offset) / static_cast<double>(count) * sum;
    const auto place = std::min(static_cast<std::size_t>(std::upper_bound(sums.begin(), sums.end(), at) - sums.begin()), lights.size() - 1);
    if (chosen.empty() || chosen.back().light != lights[place])
      chosen.push_back({lights[place], 0, sum / (sums[place] - (place > 0 ? sums[place - 1] : 0))});
    ++chosen.back().times;
  }
  return chosen;
}

}  // namespace steradian
