#include "scene/fit_ellipsoid.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "steradian/vector.h"

namespace steradian::scene {
namespace {

// Points about their mean, in units of their spread, so that the fit is well conditioned wherever they lie.
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

double triangle_area(const Triangle& t) { return length(cross(t[1] - t[0], t[2] - t[0])) / 2; }

// The area of triangles on the unit sphere over that of the sphere.
double ball_area_share(const std::vector<Triangle>& unit_triangles) {
  double area = 0;
  for (const Triangle& t : unit_triangles) area += triangle_area(t);
  return area / (4 * std::numbers::pi);
}

}  // namespace

std::optional<Ellipsoid> fit_ellipsoid(const std::vector<Triangle>& triangles, const std::vector<std::size_t>& part) {
  if (part.size() < 64) return {};  // no mesh of fewer faces comes as near as kNearestFace
  std::vector<Vec3d> points;
  for (const std::size_t t : part)
    for (const Vec3d& v : triangles[t]) points.push_back(v);
  const Normalised local = normalise(points);
  if (!(local.scale > 0) || !std::isfinite(local.scale)) return {};

  // Least squares of x'Qx + 2 q.x = 1 over the corners.
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 1> right = Eigen::Matrix<double, 9, 1>::Zero();
  for (const Vec3d& p : points) {
    const Vec3d v = local(p);
    Eigen::Matrix<double, 9, 1> row;
    row << v.x * v.x, v.y * v.y, v.z * v.z, 2 * v.y * v.z, 2 * v.z * v.x, 2 * v.x * v.y, 2 * v.x, 2 * v.y, 2 * v.z;
    normal += row * row.transpose();
    right += row;
  }
  const Eigen::Matrix<double, 9, 1> c = normal.ldlt().solve(right);
  Eigen::Matrix3d q;
  q << c(0), c(5), c(4), c(5), c(1), c(3), c(4), c(3), c(2);
  const Eigen::Vector3d linear(c(6), c(7), c(8));
  const Eigen::Vector3d middle = -q.ldlt().solve(linear);
  const double level = 1 + middle.dot(q * middle);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(q);
  if (!middle.allFinite() || !(level > 0) || !(eigen.eigenvalues().minCoeff() > 0)) return {};

  // Half axes; to_unit takes a corner to the unit sphere.
  const Vec3d at = {middle(0), middle(1), middle(2)};
  Vec3d axis[3];
  double half[3];
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d v = eigen.eigenvectors().col(i);
    axis[i] = {v(0), v(1), v(2)};
    half[i] = std::sqrt(level / eigen.eigenvalues()(i));
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
  if (!(share > 0.9 && share < 1.0001)) return {};  // walked once around, not twice

  const double size = local.scale * std::sqrt(share);
  if (dot(axis[0], cross(axis[1], axis[2])) < 0) axis[2] = -axis[2];
  return Ellipsoid{local.center + at * local.scale, axis[0] * (half[0] * size), axis[1] * (half[1] * size), axis[2] * (half[2] * size)};
}

std::optional<Ellipse> fit_ellipse(const std::vector<Vec3d>& outline) {
  if (outline.size() < 16) return {};  // as above
  const Normalised local = normalise(outline);
  if (!(local.scale > 0) || !std::isfinite(local.scale)) return {};
  Vec3d area{};
  for (std::size_t i = 0; i < outline.size(); ++i) area += cross(local(outline[i]), local(outline[(i + 1) % outline.size()])) / 2;
  if (!(length(area) > 0)) return {};
  const Frame frame = Frame::from_normal(normalized(area));

  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 5, 1> right = Eigen::Matrix<double, 5, 1>::Zero();
  for (const Vec3d& p : outline) {
    const Vec3d v = frame.to_local(local(p));
    Eigen::Matrix<double, 5, 1> row;
    row << v.x * v.x, v.y * v.y, 2 * v.x * v.y, 2 * v.x, 2 * v.y;
    normal += row * row.transpose();
    right += row;
  }
  const Eigen::Matrix<double, 5, 1> c = normal.ldlt().solve(right);
  Eigen::Matrix2d q;
  q << c(0), c(2), c(2), c(1);
  const Eigen::Vector2d linear(c(3), c(4));
  const Eigen::Vector2d middle = -q.ldlt().solve(linear);
  const double level = 1 + middle.dot(q * middle);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(q);
  if (!middle.allFinite() || !(level > 0) || !(eigen.eigenvalues().minCoeff() > 0)) return {};

  Vec3d axis[2];
  double half[2];
  for (int i = 0; i < 2; ++i) {
    axis[i] = {eigen.eigenvectors()(0, i), eigen.eigenvectors()(1, i), 0};
    half[i] = std::sqrt(level / eigen.eigenvalues()(i));
  }
  const Vec3d at = {middle(0), middle(1), 0};
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
