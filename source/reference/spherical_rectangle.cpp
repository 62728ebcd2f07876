#include "reference/spherical_rectangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace steradian::reference {

SphericalRectangle::SphericalRectangle(Vec3d corner, Vec3d edge_x, Vec3d edge_y)
    : x_(normalized(edge_x)), y_(normalized(edge_y)), z_(cross(x_, y_)) {
  z0_ = dot(corner, z_);
  if (z0_ > 0) {
    z_ = -z_;
    z0_ = -z0_;
  }
  x0_ = dot(corner, x_);
  y0_ = dot(corner, y_);
  x1_ = x0_ + length(edge_x);
  y1_ = y0_ + length(edge_y);
  if (!(z0_ < 0) || !(x1_ > x0_) || !(y1_ > y0_)) return;

  // The normals of the four planes through the edges have one component along a side and one along z. The inner angles between neighbours
  // depend on the z components alone.
  const auto nz = [&](double side) { return side / std::hypot(z0_, side); };
  const double n0 = -nz(y0_), n1 = nz(x1_), n2 = nz(y1_), n3 = -nz(x0_);
  const auto angle = [](double a, double b) { return std::acos(std::clamp(-a * b, -1.0, 1.0)); };
  const double g0 = angle(n0, n1), g1 = angle(n1, n2), g2 = angle(n2, n3), g3 = angle(n3, n0);
  b0_ = n0;
  b1_ = n2;
  k_ = 2 * std::numbers::pi - g2 - g3;
  solid_angle_ = std::max(g0 + g1 - k_, 0.0);
}

Vec3d SphericalRectangle::sample(double u, double v) const {
  if (!(solid_angle_ > 0)) return {};
  const double au = u * solid_angle_ + k_;
  const double fu = (std::cos(au) * b0_ - b1_) / std::sin(au);
  double cu = std::copysign(1.0, fu) / std::sqrt(fu * fu + b0_ * b0_);
  cu = std::clamp(cu, -1.0, 1.0);
  const double x = std::clamp(-cu * z0_ / std::sqrt(std::max(1 - cu * cu, 1e-300)), x0_, x1_);
  const double d = std::hypot(x, z0_);
  const double h0 = y0_ / std::hypot(d, y0_), h1 = y1_ / std::hypot(d, y1_);
  const double h = h0 + v * (h1 - h0);
  const double y = h * h < 1 ? std::clamp(h * d / std::sqrt(1 - h * h), y0_, y1_) : y1_;
  return normalized(x_ * x + y_ * y + z_ * z0_);
}

double SphericalRectangle::pdf(Vec3d direction) const {
  const double z = dot(direction, z_);
  if (!(solid_angle_ > 0) || !(z < 0)) return 0;
  const double x = dot(direction, x_) * z0_ / z, y = dot(direction, y_) * z0_ / z;
  return x >= x0_ && x <= x1_ && y >= y0_ && y <= y1_ ? 1 / solid_angle_ : 0;
}

}  // namespace steradian::reference
