#include "reference/spherical_region.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

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

namespace {

// Sutherland, Hodgman, "Reentrant polygon clipping", 1974; on rays, so that vertices may also lie behind the point.
void clip(const std::vector<Vec3d>& contour, Vec3d plane, std::vector<Vec3d>& result) {
  result.clear();
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec3d& p = contour[i == 0 ? contour.size() - 1 : i - 1];
    const Vec3d& q = contour[i];
    const double dp = dot(p, plane), dq = dot(q, plane);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
      const double wp = std::fabs(dq), wq = std::fabs(dp);
      Vec3d x = (p * wp + q * wq) / (wp + wq);
      x = x - plane * dot(x, plane);  // exactly on the plane: later code relies on it not being below
      result.push_back(x);
    }
    if (dq >= 0) result.push_back(q);
  }
}

using Edge = std::pair<Vec3d, Vec3d>;

// The same for edges in any order that together are closed. A segment along the plane from or to the first crossing replaces the part that
// each crossing cuts off; segments there and back cancel.
std::vector<Edge> clip(const std::vector<Edge>& edges, Vec3d plane) {
  std::vector<Edge> result;
  std::optional<Vec3d> anchor;
  for (const auto& [p, q] : edges) {
    const double dp = dot(p, plane), dq = dot(q, plane);
    if (dp < 0 && dq < 0) continue;
    if (dp >= 0 && dq >= 0) {
      result.push_back({p, q});
      continue;
    }
    const double wp = std::fabs(dq), wq = std::fabs(dp);
    Vec3d x = (p * wp + q * wq) / (wp + wq);
    x = x - plane * dot(x, plane);
    result.push_back(dp < 0 ? Edge{x, q} : Edge{p, x});
    if (!anchor) anchor = x;
    result.push_back(dp < 0 ? Edge{*anchor, x} : Edge{x, *anchor});
  }
  return result;
}

void add_arc(Vec3d p, Vec3d q, std::vector<Arc>& arcs) {
  const Vec3d a = normalized(p), b = normalized(q);
  // The cross product uses the difference: a x b would cancel for a tiny light.
  const Vec3d n = cross(a, (q - p) / std::max(length(q), 1e-300));
  const double sine = length(n);
  if (sine > 0) arcs.push_back({a, b, n / sine, std::atan2(sine, dot(a, b))});
}

}  // namespace

void SphericalRegion::assign(const PreparedPolygon& light, Vec3d position, const Frame& frame, const Vec3d* planes, int plane_count) {
  arcs.clear();
  magnification = 1;
  const int side = light.side_of(position);
  if (side == 0 || (side < 0 && !light.two_sided)) return;

  std::vector<Edge> pieces;  // contours of two vertices
  for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
    contour_.clear();
    for (std::size_t i = light.contours[c]; i < light.contours[c + 1]; ++i) {
      const Vec3d v = light.vertices[i] - position;
      const double distance = length(v);
      if (distance > 0) magnification = std::max(magnification, (length(position) + length(light.vertices[i])) / distance);
      contour_.push_back(frame.to_local(v));
    }
    if (contour_.size() == 2) {
      pieces.push_back(side < 0 ? Edge{contour_[1], contour_[0]} : Edge{contour_[0], contour_[1]});
      continue;
    }
    for (int i = 0; i < plane_count; ++i) {
      clip(contour_, planes[i], clipped_);
      contour_.swap(clipped_);
    }
    const std::size_t first = arcs.size();
    for (std::size_t i = 0; i < contour_.size(); ++i) {
      const Vec3d& p = contour_[i];
      const Vec3d& q = contour_[i + 1 == contour_.size() ? 0 : i + 1];
      add_arc(p, q, arcs);
    }
    if (side < 0) {
      for (std::size_t i = first; i < arcs.size(); ++i) {
        std::swap(arcs[i].a, arcs[i].b);
        arcs[i].normal = -arcs[i].normal;
      }
    }
  }
  for (int i = 0; i < plane_count && !pieces.empty(); ++i) pieces = clip(pieces, planes[i]);
  for (const auto& [p, q] : pieces) add_arc(p, q, arcs);
}

void SphericalRegion::assign_above_horizon(const PreparedPolygon& light, Vec3d position, const Frame& frame) {
  const Vec3d horizon{0, 0, 1};
  assign(light, position, frame, &horizon, 1);
}

}  // namespace steradian::reference
