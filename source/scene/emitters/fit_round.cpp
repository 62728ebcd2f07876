#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/emitters/fit_round.h"
#include "scene/emitters/symmetric_matrix.h"
#include "steradian/capsule_light.h"
#include "steradian/vector.h"

namespace steradian::scene {
namespace {

// Measures of a mesh that is symmetric about an axis. They give the axis whatever the triangulation.
struct SymmetricMesh {
  double area = 0;
  Vec3d center;  // centroid of the area
  Vec3d axis;    // the direction that the fewest faces point to
};

Vec3d twice_area(const Triangle& t) { return cross(t[1] - t[0], t[2] - t[0]); }

SymmetricMesh measure(const std::vector<Triangle>& triangles, const std::vector<std::size_t>& part) {
  SymmetricMesh s;
  const Vec3d origin = triangles[part.front()][0];  // avoids cancellation for a part far from the world's origin
  SymmetricMatrix faces(3);
  for (const std::size_t index : part) {
    const Triangle& t = triangles[index];
    const Vec3d n = twice_area(t);
    const double area = length(n) / 2;
    if (!(area > 0)) continue;
    s.area += area;
    s.center += (t[0] + t[1] + t[2] - origin * 3) * (area / 3);
    faces.add_square({n.x, n.y, n.z}, 1 / (4 * area));
  }
  s.center = s.area > 0 ? origin + s.center / s.area : origin;
  const std::vector<double> axis = eigen_system(faces).vectors.front();
  s.axis = {axis[0], axis[1], axis[2]};
  return s;
}

// The largest distance of a corner from its exact place in single precision.
double rounding(Vec3d v) { return 1e-7 * (std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z)); }

}  // namespace

std::optional<Capsule> fit_capsule(const std::vector<Triangle>& triangles, const std::vector<std::size_t>& part) {
  if (part.size() < 64) return {};  // no mesh with fewer faces comes as near as kNearestFace
  const SymmetricMesh s = measure(triangles, part);
  double radius = 0, reach = 0;
  for (const std::size_t index : part)
    for (const Vec3d& v : triangles[index]) {
      const double along = dot(v - s.center, s.axis);
      reach = std::max(reach, std::fabs(along));
      radius = std::max(radius, length(v - s.center - s.axis * along));
    }
  const double half = reach - radius;
  if (!(half > kOnShape * radius) || !std::isfinite(half)) return {};

  const Capsule around = {s.center - s.axis * half, s.center + s.axis * half, radius};
  for (const std::size_t index : part) {
    const Triangle& t = triangles[index];
    for (const Vec3d& v : t)
      if (!(std::fabs(distance_to_axis(around, v) - radius) <= kOnShape * radius + rounding(v))) return {};
    // Compares the plane of a face with the planes that touch the ends of the axis.
    const Vec3d n = normalized(twice_area(t));
    const double plane = std::fabs(dot(t[0] - s.center, n)) - half * std::fabs(dot(n, s.axis));
    if (length(n) > 0 && !(plane >= kNearestFace * radius - rounding(t[0]))) return {};
  }
  const double share = s.area / (4 * std::numbers::pi * radius * (radius + half));
  if (!(share > 0.9 && share < 1.0001)) return {};  // covered once, not twice

  // Solves 4 pi r (r + half) = area.
  const double of_area = s.area / std::numbers::pi / (2 * (half + std::sqrt(half * half + s.area / std::numbers::pi)));
  return Capsule{around.end_a, around.end_b, of_area};
}

namespace {

// Points relative to their mean, in units of their spread, so that the fit is well conditioned wherever they lie.
struct Normalised {
  Vec3d center;
  double scale = 1;
  Vec3d operator()(Vec3d p) const { return (p - center) / scale; }
};

Normalised normalise(const std::vector<Vec3d>& points) {
  Normalised n;
  for (const Vec3d& p : points) n.center += p / static_cast<double>(points.size());
  double square = 0;
  for (const Vec3d& p : points) square += dot(p - n.center, p - n.center) / static_cast<double>(points.size());
  n.scale = std::sqrt(square);
  return n;
}

// The centre of the quadric x'Qx + 2 q.x = 1, its axes and its level at the centre.
struct Center {
  std::vector<double> at;
  double level = 0;
  EigenSystem axes;
};

// None if the quadric is no ellipse or ellipsoid.
std::optional<Center> center_of(const SymmetricMatrix& q, const std::vector<double>& linear) {
  Center c;
  c.at = solve(q, linear);
  for (double& x : c.at) x = -x;
  c.level = 1;
  for (std::size_t i = 0; i < q.n; ++i)
    for (std::size_t j = 0; j < q.n; ++j) c.level += c.at[i] * q(i, j) * c.at[j];
  c.axes = eigen_system(q);
  const bool finite = std::all_of(c.at.begin(), c.at.end(), [](double x) { return std::isfinite(x); });
  if (!finite || !(c.level > 0) || !(c.axes.values.front() > 0)) return {};
  return c;
}

double triangle_area(const Triangle& t) { return length(cross(t[1] - t[0], t[2] - t[0])) / 2; }

// The area of triangles on the unit sphere, divided by the area of the sphere.
double ball_area_share(const std::vector<Triangle>& unit_triangles) {
  double area = 0;
  for (const Triangle& t : unit_triangles) area += triangle_area(t);
  return area / (4 * std::numbers::pi);
}

}  // namespace

std::optional<Ellipsoid> fit_ellipsoid(const std::vector<Triangle>& triangles, const std::vector<std::size_t>& part) {
  if (part.size() < 64) return {};  // no mesh with fewer faces comes as near as kNearestFace
  std::vector<Vec3d> points;
  for (const std::size_t t : part)
    for (const Vec3d& v : triangles[t]) points.push_back(v);
  const Normalised local = normalise(points);
  if (!(local.scale > 0) || !std::isfinite(local.scale)) return {};

  // Least squares fit of x'Qx + 2 q.x = 1 to the corners.
  SymmetricMatrix normal(9);
  std::vector<double> right(9, 0.0), row;
  for (const Vec3d& p : points) {
    const Vec3d v = local(p);
    row = {v.x * v.x, v.y * v.y, v.z * v.z, 2 * v.y * v.z, 2 * v.z * v.x, 2 * v.x * v.y, 2 * v.x, 2 * v.y, 2 * v.z};
    normal.add_square(row);
    for (std::size_t i = 0; i < row.size(); ++i) right[i] += row[i];
  }
  const std::vector<double> c = solve(normal, right);
  SymmetricMatrix q(3);
  q.entries = {c[0], c[5], c[4], c[5], c[1], c[3], c[4], c[3], c[2]};
  const std::optional<Center> center = center_of(q, {c[6], c[7], c[8]});
  if (!center) return {};

  // Half axes. to_unit maps a corner to the unit sphere.
  const Vec3d at = {center->at[0], center->at[1], center->at[2]};
  Vec3d axis[3];
  double half[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<double>& v = center->axes.vectors[i];
    axis[i] = {v[0], v[1], v[2]};
    half[i] = std::sqrt(center->level / center->axes.values[i]);
  }
  const auto to_unit = [&](Vec3d p) {
    const Vec3d v = local(p) - at;
    return Vec3d{dot(v, axis[0]) / half[0], dot(v, axis[1]) / half[1], dot(v, axis[2]) / half[2]};
  };
  std::vector<Triangle> unit_triangles;
  for (const std::size_t t : part) {
    const Triangle u = {to_unit(triangles[t][0]), to_unit(triangles[t][1]), to_unit(triangles[t][2])};
    for (const Vec3d& corner : u)
      if (!(std::fabs(length(corner) - 1) <= kOnShape)) return {};
    const Vec3d n = cross(u[1] - u[0], u[2] - u[0]);
    if (length(n) > 0 && !(std::fabs(dot(u[0], n)) >= kNearestFace * length(n))) return {};
    unit_triangles.push_back(u);
  }
  const double share = ball_area_share(unit_triangles);
  if (!(share > 0.9 && share < 1.0001)) return {};  // covered once, not twice

  const double size = local.scale * std::sqrt(share);
  if (dot(axis[0], cross(axis[1], axis[2])) < 0) axis[2] = -axis[2];
  return Ellipsoid{local.center + at * local.scale, axis[0] * (half[0] * size), axis[1] * (half[1] * size), axis[2] * (half[2] * size)};
}

std::optional<Ellipse> fit_ellipse(const std::vector<Vec3d>& outline) {
  if (outline.size() < 16) return {};  // see above
  const Normalised local = normalise(outline);
  if (!(local.scale > 0) || !std::isfinite(local.scale)) return {};
  Vec3d area{};
  for (std::size_t i = 0; i < outline.size(); ++i) area += cross(local(outline[i]), local(outline[(i + 1) % outline.size()])) / 2;
  if (!(length(area) > 0)) return {};
  const Frame frame = Frame::from_normal(normalized(area));

  SymmetricMatrix normal(5);
  std::vector<double> right(5, 0.0), row;
  for (const Vec3d& p : outline) {
    const Vec3d v = frame.to_local(local(p));
    row = {v.x * v.x, v.y * v.y, 2 * v.x * v.y, 2 * v.x, 2 * v.y};
    normal.add_square(row);
    for (std::size_t i = 0; i < row.size(); ++i) right[i] += row[i];
  }
  const std::vector<double> c = solve(normal, right);
  SymmetricMatrix q(2);
  q.entries = {c[0], c[2], c[2], c[1]};
  const std::optional<Center> center = center_of(q, {c[3], c[4]});
  if (!center) return {};

  Vec3d axis[2];
  double half[2];
  for (std::size_t i = 0; i < 2; ++i) {
    axis[i] = {center->axes.vectors[i][0], center->axes.vectors[i][1], 0};
    half[i] = std::sqrt(center->level / center->axes.values[i]);
  }
  const Vec3d at = {center->at[0], center->at[1], 0};
  const auto to_unit = [&](Vec3d p) {
    const Vec3d v = frame.to_local(local(p)) - at;
    return Vec3d{dot(v, axis[0]) / half[0], dot(v, axis[1]) / half[1], 0};
  };
  double unit_area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3d a = to_unit(outline[i]), b = to_unit(outline[(i + 1) % outline.size()]);
    if (!(std::fabs(length(a) - 1) <= kOnShape)) return {};
    const double twice = a.x * b.y - a.y * b.x;
    if (!(std::fabs(twice) >= kNearestFace * length(b - a))) return {};
    unit_area += twice / 2;
  }
  const double share = std::fabs(unit_area) / std::numbers::pi;
  if (!(share > 0.9 && share < 1.0001)) return {};

  const double size = local.scale * std::sqrt(share);
  Vec3d x = frame.to_world(axis[0]) * (half[0] * size), y = frame.to_world(axis[1]) * (half[1] * size);
  if (dot(cross(x, y), area) < 0) y = -y;
  return Ellipse{local.center + frame.to_world(at) * local.scale, x, y};
}

}  // namespace steradian::scene
