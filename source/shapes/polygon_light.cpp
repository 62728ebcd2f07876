#include "steradian/polygon_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "shapes/area_moments.h"
#include "shapes/polygon.h"
#include "steradian/error.h"

namespace steradian {
namespace {

using Contour = std::vector<Vec3d>;

// Newell's normal times twice the area, about an origin of its own, so that a small light far away retains its digits.
Vec3d area_vector(const Contour& contour) {
  Vec3d sum{};
  for (std::size_t i = 1; i + 1 < contour.size(); ++i) sum += cross(contour[i] - contour[0], contour[i + 1] - contour[0]);
  return sum * 0.5;
}

LightQuarters quarters_of(const PreparedPolygon& light) {
  const Frame plane = Frame::from_normal(light.normal);
  AreaMoments m;
  for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
    const std::size_t begin = light.contours[c], end = light.contours[c + 1];
    for (std::size_t i = begin, j = end - 1; i < end; j = i++) {
      const Vec3d a = light.vertices[j] - light.centroid, b = light.vertices[i] - light.centroid;
      m.add(dot(a, plane.x), dot(a, plane.y), dot(b, plane.x), dot(b, plane.y));
    }
  }
  if (std::fabs(m.area) > 0) return quarters_of(m, light.centroid, plane.x, plane.y);
  LightQuarters nowhere;
  nowhere.center = light.centroid;
  return nowhere;
}

Contour without_repeats(const Contour& contour) {
  Contour result;
  for (const Vec3d& v : contour)
    if (result.empty() || !(v == result.back())) result.push_back(v);
  while (result.size() > 1 && result.front() == result.back()) result.pop_back();
  return result;
}

void check_contour(const Contour& contour, const std::string& name) {
  if (contour.size() < 3) throw Error(name, "a polygon needs at least 3 vertices, here are " + std::to_string(contour.size()));
  for (std::size_t i = 0; i < contour.size(); ++i)
    if (!is_finite(contour[i])) throw Error(name + "[" + std::to_string(i) + "]", "a coordinate is not finite");
}

void check_plane(const Contour& contour, const std::string& name, Vec3d origin, Vec3d normal, double tolerance) {
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec3d& v = contour[i];
    // Coordinates have the rounding of single precision, which grows with the distance from the origin.
    const double rounding = 2e-7 * (std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z));
    const double off = std::fabs(dot(v - origin, normal));
    if (off > tolerance + rounding)
      throw Error(name + "[" + std::to_string(i) + "]", "the vertex is " + std::to_string(off) + " off the polygon's plane",
                  "a light must be flat; split it into triangles");
  }
}

}  // namespace

int PreparedPolygon::side_of(Vec3d p) const {
  if (vertices.empty()) return 0;
  const double height = dot(p - centroid, normal);
  // The point is nearer to the plane than the rounding of the inputs: the outline is reliable from neither side.
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * (length(p) + length(centroid));
  if (std::fabs(height) <= rounding) return 0;
  return (height > 0) - (height < 0);
}

PreparedPolygon prepare_polygon(const PolygonLight& light) {
  check_contour(light.vertices, "vertices");
  for (std::size_t h = 0; h < light.holes.size(); ++h) check_contour(light.holes[h], "holes[" + std::to_string(h) + "]");
  if (!is_finite(light.radiance)) throw Error("radiance", "a component is not finite");

  PreparedPolygon result;
  result.radiance = light.radiance;
  result.two_sided = light.two_sided;
  result.contours.push_back(0);
  const Contour outline = without_repeats(light.vertices);
  for (const Vec3d& v : outline) result.centroid += v / static_cast<double>(outline.size());
  double size = 0;
  for (const Vec3d& v : outline) size = std::max(size, length(v - result.centroid));

  const Vec3d area = area_vector(outline);
  // An outline thinner than rounding encloses nothing.
  if (outline.size() < 3 || !(length(area) > 1e-14 * size * size)) return result;
  result.normal = normalized(area);
  result.area = length(area);
  // The thinner the outline, the less its numbers determine its plane: the area's rounding tilts the normal.
  const double tolerance = size * (1e-5 + 16 * std::numeric_limits<double>::epsilon() * size * size / result.area);
  check_plane(outline, "vertices", result.centroid, result.normal, tolerance);

  const auto append = [&](const Contour& contour, bool reversed) {
    if (reversed)
      result.vertices.insert(result.vertices.end(), contour.rbegin(), contour.rend());
    else
      result.vertices.insert(result.vertices.end(), contour.begin(), contour.end());
    result.contours.push_back(result.vertices.size());
  };
  append(outline, true);
  for (std::size_t h = 0; h < light.holes.size(); ++h) {
    const Contour hole = without_repeats(light.holes[h]);
    if (hole.size() < 3) continue;
    check_plane(hole, "holes[" + std::to_string(h) + "]", result.centroid, result.normal, tolerance);
    const double along = dot(area_vector(hole), result.normal);
    result.area -= std::fabs(along);
    append(hole, along < 0);  // in walk order a hole runs counter-clockwise as seen from the lit side
  }
  result.area = std::max(result.area, 0.0);
  result.quarters = quarters_of(result);
  return result;
}

}  // namespace steradian
