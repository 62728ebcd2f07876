// Textured lines: edges with a gradient that has a stop at every texel. Queries and frames integrate them in closed form.
#include <cmath>

#include "steradian/error.h"
#include "steradian/plane.h"

namespace steradian {

std::vector<PlaneBody> plane_textured_line(const std::vector<Vec2d>& points, const std::vector<Vec3d>& texels,
                                           const PlaneEmission& emission) {
  double whole = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) whole += length(points[i + 1] - points[i]);
  if (!(whole > 0) || std::isinf(whole)) throw Error("textured line", "has no length", "give it two points or more");
  if (texels.empty()) throw Error("textured line", "has no texels", "give one or more colours");
  const double last = static_cast<double>(texels.size() - 1);
  const auto texel_at = [&](double place) {
    const double t = std::fmin(std::fmax(place / whole, 0), 1) * last, k = std::fmin(std::floor(t), std::fmax(last - 1, 0));
    const auto index = static_cast<std::size_t>(k);
    return last == 0 ? texels[0] : texels[index] * (1 - (t - k)) + texels[index + 1] * (t - k);
  };
  std::vector<PlaneBody> lines;
  double begin = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double size = length(points[i + 1] - points[i]), end = begin + size;
    if (!(size > 0)) continue;
    PlaneGradient gradient{points[i], points[i + 1], {{0, texel_at(begin)}}};
    for (double k = std::floor(begin / whole * last) + 1; k / last * whole < end && last > 0; ++k)
      gradient.stops.push_back({(k / last * whole - begin) / size, texels[static_cast<std::size_t>(k)]});
    gradient.stops.push_back({1, texel_at(end)});
    PlaneBody line;
    line.shape = PlaneBody::Shape::polyline;
    line.contours = {{points[i], points[i + 1]}};
    line.light = emission;
    line.light->gradient = std::move(gradient);
    lines.push_back(std::move(line));
    begin = end;
  }
  return lines;
}

}  // namespace steradian
