// Moments of a plane region by its boundary, and the four elements with the same moments (kernels/outline/light_elements.glsl).
#pragma once

#include <algorithm>
#include <cmath>

#include "steradian/polygon_light.h"

namespace steradian {

// Moments of the area up to the second, about the plane point `origin` in the plane's own coordinates. The boundary's edges may come in any
// order.
struct AreaMoments {
  double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  // Adds the triangle from the origin to two corners, with the sign of their order.
  void add(double ax, double ay, double bx, double by) {
    const double twice = ax * by - ay * bx;
    area += twice / 2;
    x += twice * (ax + bx) / 6;
    y += twice * (ay + by) / 6;
    xx += twice * (ax * ax + ax * bx + bx * bx) / 12;
    xy += twice * (2 * ax * ay + ax * by + bx * ay + 2 * bx * by) / 24;
    yy += twice * (ay * ay + ay * by + by * by) / 12;
  }
};

// Four elements with these moments. x, y: the plane's axes, perpendicular unit vectors. The area must not be 0.
inline LightQuarters quarters_of(const AreaMoments& m, Vec3d origin, Vec3d x_axis, Vec3d y_axis) {
  const double x = m.x / m.area, y = m.y / m.area;
  const double xx = m.xx / m.area - x * x, xy = m.xy / m.area - x * y, yy = m.yy / m.area - y * y;
  // Principal axes; each point stands at the deviation along its axis times the square root of 2.
  const double middle = (xx + yy) / 2, apart = std::hypot((xx - yy) / 2, xy), turn = 0.5 * std::atan2(2 * xy, xx - yy);
  const double c = std::cos(turn), s = std::sin(turn);
  LightQuarters quarters;
  quarters.center = origin + x_axis * x + y_axis * y;
  quarters.reach_a = (x_axis * c + y_axis * s) * std::sqrt(2 * std::max(middle + apart, 0.0));
  quarters.reach_b = (y_axis * c - x_axis * s) * std::sqrt(2 * std::max(middle - apart, 0.0));
  return quarters;
}

}  // namespace steradian
