#include "render/shadow/side.h"

#include <cmath>

#include "shadow/edges/edge_arrays.h"
#include "shadow/region/round_light.h"

namespace steradian {

using shadow::LightFrame;

bool on_light(const LightFrame& frame, double x, double y) {
  bool inside = false;
  for (const auto& c : frame.contours)
    for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++)
      if ((c[i].y > y) != (c[j].y > y) && x < (c[j].x - c[i].x) * (y - c[i].y) / (c[j].y - c[i].y) + c[i].x) inside = !inside;
  return inside;
}

LightFrame with_contours(LightFrame frame) {
  if (frame.contours.empty()) frame.contours = {shadow::contour_of_ellipse(frame, kRoundCorners)};
  return frame;
}

Above above_horizon(const LightFrame& frame, Vec3d position, Vec3d normal) {
  const double middle = dot(frame.origin - position, normal);
  const double reach = std::fabs(dot(frame.axes.x, normal)) * frame.box_x + std::fabs(dot(frame.axes.y, normal)) * frame.box_y;
  return middle - reach > 0 ? Above::all : middle + reach > 0 ? Above::some : Above::none;
}

LightSide side_of(const PreparedPolygon& polygon, int side) {
  LightSide result;
  result.side = side;
  result.frame = shadow::light_frame(polygon, side);
  result.outline = std::make_shared<const std::vector<shadow::Segment>>(shadow::outline_segments(result.frame));
  if (on_light(result.frame, 0, 0)) result.middle = result.frame.origin;
  return result;
}

std::optional<LightSide> side_of_round(const PackLight& light, Vec3d position,
                                       const std::shared_ptr<const std::vector<shadow::Segment>>& ellipse) {
  if (std::holds_alternative<Capsule>(light.area->shape)) {
    const PreparedPolygon polygon = shadow::polygon_of_round(*light.area, position, kRoundCorners);
    if (polygon.side_of(position) <= 0) return {};
    return side_of(polygon, 1);
  }
  std::optional<LightFrame> frame = shadow::frame_of_ellipsoid(std::get<Ellipsoid>(light.area->shape), position, kRoundCorners);
  if (!frame) return {};
  LightSide result;
  result.frame = std::move(*frame);
  result.outline = ellipse;
  result.middle = result.frame.origin;
  return result;
}

}  // namespace steradian
