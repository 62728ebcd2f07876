#include "render/lights/light_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/lights/solid_lights.h"
#include "steradian/area_light.h"  // luminance

namespace steradian {

LightChoice::LightChoice(const std::vector<PackLight>& lights) {
  for (const PackLight& light : lights) {
    Source& source = sources_.emplace_back();
    if (light.area == nullptr) continue;
    const AreaLight& area = *light.area;
    Vec3d normal;
    if (light.solid != nullptr) {
      const Box3d& box = light.solid->form.box;
      source.center = box.center();
      source.area = dot(box.size(), box.size());
    } else if (light.is_polygon()) {
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
    if (light.solid == nullptr && area.is_flat() && !area.two_sided && source.area > 0) source.normal = normalized(normal);
    source.power = luminance(area.radiance) * source.area;
  }
}

double LightChoice::sent(std::size_t index, const Vec3d& to) const {
  // No light that may be chosen is left out, however little it seems to send.
  constexpr double kLeast = 0.05;
  const Source& source = sources_[index];
  const Vec3d way = to - source.center;
  const double square = std::max({dot(way, way), source.area, 1e-30});
  const double facing = dot(source.normal, source.normal) > 0 ? std::max(dot(source.normal, way) / std::sqrt(square), kLeast) : 1.0;
  return source.power * facing / square;
}

std::size_t LightChoice::dim_count(std::span<const PackLight* const> lights, const Box3f& positions, double fraction) const {
  std::vector<double> each;
  double all = 0;
  for (const PackLight* light : lights) all += each.emplace_back(sent(light->index, static_cast<Vec3d>(positions.center())));
  std::sort(each.begin(), each.end());
  std::size_t count = 0;
  for (double sum = 0; count < each.size() && (sum += each[count]) <= fraction * all;) ++count;
  return count;
}

std::vector<LightChoice::Chosen> LightChoice::choose(std::span<const PackLight* const> lights, const Box3f& positions, std::size_t count,
                                                     double offset) const {
  std::vector<double> sums;
  double sum = 0;
  for (const PackLight* light : lights) sums.push_back(sum += sent(light->index, static_cast<Vec3d>(positions.center())));
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
