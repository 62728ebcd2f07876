#include <algorithm>
#include <cmath>

#include "shadow/rays/shafts.h"

namespace steradian::shadow {

// The hull's projection along an axis is the hull of two rectangles. In each of its four quadrants it has a slanted side if one rectangle
// reaches further in one coordinate and the other in the second.
HullOfBoxes::HullOfBoxes(const Box3d& a, const Box3d& b) : all_(a) {
  all_.add(b);
  for (int axis = 0; axis < 3; ++axis) {
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    for (const int sx : {-1, 1})
      for (const int sy : {-1, 1}) {
        const auto corner = [&](const Box3d& box, int c, int sign) { return coordinate(sign < 0 ? box.low : box.high, c); };
        const double ax = corner(a, x, sx), ay = corner(a, y, sy), bx = corner(b, x, sx), by = corner(b, y, sy);
        const double dx = sx * (ax - bx), dy = sy * (ay - by);
        if (!(dx * dy < 0)) continue;
        const double u = sx * std::fabs(dy), v = sy * std::fabs(dx);
        slants_[count_++] = {u, v, std::max(u * ax + v * ay, u * bx + v * by), x, y};
      }
  }
}

bool HullOfBoxes::may_meet(const Box3d& b) const {
  return all_.meets(b) && std::none_of(slants_, slants_ + count_, [&](const Slant& s) {
           return s.u * coordinate(s.u > 0 ? b.low : b.high, s.x) + s.v * coordinate(s.v > 0 ? b.low : b.high, s.y) > s.offset;
         });
}

bool HullOfBoxes::may_meet(const Vec3d (&corners)[3]) const {
  const auto all = [&](auto outside) { return outside(corners[0]) && outside(corners[1]) && outside(corners[2]); };
  for (int c = 0; c < 3; ++c)
    if (all([&](Vec3d p) { return coordinate(p, c) > coordinate(all_.high, c); }) ||
        all([&](Vec3d p) { return coordinate(p, c) < coordinate(all_.low, c); }))
      return false;
  return std::none_of(slants_, slants_ + count_, [&](const Slant& s) {
    return all([&](Vec3d p) { return s.u * coordinate(p, s.x) + s.v * coordinate(p, s.y) > s.offset; });
  });
}

void TriangleTree::Viewers::take(const std::vector<Vec3d>& points) {
  ++stamp_;
  box_ = {};
  x_.clear();
  y_.clear();
  z_.clear();
  for (const Vec3d& p : points) {
    box_.add(p);
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
  }
}

Interval<double> TriangleTree::Viewers::over(const Plane& plane, std::uint32_t triangle) {
  Interval<double>& range = ranges_[triangle];
  if (stamps_[triangle] == stamp_) return range;
  stamps_[triangle] = stamp_;
  range = {};
  for (std::size_t i = 0; i < x_.size(); ++i)
    range.add(plane.normal.x * x_[i] + plane.normal.y * y_[i] + plane.normal.z * z_[i] - plane.offset);
  return range;
}

TriangleTree::TriangleTree(const EdgeMesh& mesh)
    : mesh_(mesh),
      tree_(
          mesh.triangles.size(), [&](std::uint32_t t) { return box_of(mesh, t); }, Halving{4}) {}

// Returns true if all points and the whole light lie on one side of the triangle's plane.
bool TriangleTree::separates(std::uint32_t triangle, Viewers& viewers, const Box3d& light, double margin) const {
  const Plane& plane = mesh_.planes[triangle];
  const Vec3d c = light.center(), h = light.half(), n = plane.normal;
  const double at = dot(n, c) - plane.offset, reach = std::fabs(n.x) * h.x + std::fabs(n.y) * h.y + std::fabs(n.z) * h.z,
               slack = margin * length(n);
  const Interval<double> points = viewers.over(plane, triangle);
  return (at - reach >= -slack && points.low >= 0) || (at + reach <= slack && points.high <= 0);
}

bool TriangleTree::is_open(Viewers& viewers, const Box3d& light, double margin) const {
  viewers.ranges_.resize(mesh_.triangles.size());
  viewers.stamps_.resize(mesh_.triangles.size());
  const HullOfBoxes hull(viewers.box_, light);
  const auto blocks = [&](std::uint32_t triangle) {
    const auto& t = mesh_.triangles[triangle];
    const Vec3d corners[3] = {mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]};
    return hull.may_meet(corners) && !separates(triangle, viewers, light, margin);
  };
  return !tree_.any_leaf([&](const auto& node) { return hull.may_meet(node.volume); },
                         [&](std::uint32_t first, std::uint32_t last) {
                           return std::any_of(tree_.order().begin() + first, tree_.order().begin() + last, blocks);
                         });
}

bool TriangleTree::is_open_beyond(const LightFrame& frame, Viewers& viewers, const Box3d& light, const std::vector<bool>& but) const {
  viewers.ranges_.resize(mesh_.triangles.size());
  viewers.stamps_.resize(mesh_.triangles.size());
  const HullOfBoxes hull(viewers.box_, light);
  const Vec3d n = frame.axes.z;
  const double plane = dot(n, frame.origin) - frame.eta;
  const auto blocks = [&](std::uint32_t triangle) {
    if (but[triangle]) return false;
    const auto& t = mesh_.triangles[triangle];
    const Vec3d corners[3] = {mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]};
    return std::any_of(corners, corners + 3, [&](Vec3d c) { return dot(n, c) >= plane; }) && hull.may_meet(corners) &&
           !separates(triangle, viewers, light, 0);
  };
  const auto enter = [&](const auto& node) {
    const Vec3d c = node.volume.center(), h = node.volume.half();
    return dot(n, c) + std::fabs(n.x) * h.x + std::fabs(n.y) * h.y + std::fabs(n.z) * h.z >= plane && hull.may_meet(node.volume);
  };
  return !tree_.any_leaf(enter, [&](std::uint32_t first, std::uint32_t last) {
    return std::any_of(tree_.order().begin() + first, tree_.order().begin() + last, blocks);
  });
}

Ball ball_around(const AreaLight& area) {
  if (const auto* c = std::get_if<Capsule>(&area.shape)) return {(c->end_a + c->end_b) * 0.5, length(c->end_b - c->end_a) / 2 + c->radius};
  const auto& e = std::get<Ellipsoid>(area.shape);
  const double x2 = dot(e.x, e.x), y2 = dot(e.y, e.y), z2 = dot(e.z, e.z);
  const double skew = std::fabs(dot(e.x, e.y)) + std::fabs(dot(e.y, e.z)) + std::fabs(dot(e.z, e.x));
  const bool right_angles = skew < 1e-6 * (x2 + y2 + z2);
  return {e.center, right_angles ? std::sqrt(std::max({x2, y2, z2})) * (1 + 1e-5) : std::sqrt(x2 + y2 + z2)};
}

std::optional<LightFrame> frame_behind(const AreaLight& light, const std::vector<Vec3d>& points) {
  const Ball ball = ball_around(light);
  const double radius = 1.5 * ball.radius;  // the box around the polygon has corners
  Vec3d middle{};
  for (const Vec3d& p : points) middle += p / static_cast<double>(points.size());
  const Vec3d axis = ball.center - middle;
  const double distance = length(axis);
  if (!(distance > 0)) return std::nullopt;
  double nearest = INFINITY, farthest = 0, spread = 0;
  LightFrame frame;
  frame.axes = Frame::from_normal(axis / distance);
  for (const Vec3d& p : points) {
    const Vec3d d = frame.axes.to_local(ball.center - p);
    nearest = std::min(nearest, length(d));
    farthest = std::max(farthest, length(d));
    spread = std::max(spread, std::hypot(d.x, d.y));
  }
  if (nearest < 1.2 * radius || distance < 2 * spread) return std::nullopt;
  frame.origin = ball.center + frame.axes.z * radius;
  // Tangent cone from the nearest point, at the square's plane, and its tilt for points off the axis.
  const double tangent = radius / std::sqrt(nearest * nearest - radius * radius), tilt = spread / (distance - spread);
  const double half = (farthest + radius) * (tangent * (1 + tilt) * (1 + tilt)) + radius * tilt;
  frame.half_x = frame.half_y = half;
  frame.box_x = frame.box_y = 1.1 * half;
  return frame;
}

double reach_of_polygon(const AreaLight& area) {
  return (std::holds_alternative<Capsule>(area.shape) ? 3.6 : 1.6) * ball_around(area).radius;
}

std::vector<std::uint32_t> TriangleTree::near(const AreaLight& light, std::span<const std::uint32_t> inside) const {
  const Vec3d center = ball_around(light).center, reach = Box3d::all(reach_of_polygon(light));
  std::vector<std::uint32_t> result = near({center - reach, center + reach});
  std::erase_if(result, [&](std::uint32_t t) { return std::binary_search(inside.begin(), inside.end(), t); });
  return result;
}

std::vector<std::uint32_t> TriangleTree::near(const Box3d& box) const {
  std::vector<std::uint32_t> result = near_box(tree_, box);
  std::erase_if(result, [&](std::uint32_t t) { return !box_of(mesh_, t).meets(box); });
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace steradian::shadow
