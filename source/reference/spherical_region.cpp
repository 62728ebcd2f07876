#include "reference/spherical_region.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace steradian::reference {
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
