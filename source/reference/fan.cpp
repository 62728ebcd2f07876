#include "reference/fan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace steradian::reference {
namespace {

// How often the arcs run around z, counted by azimuth.
int winding_about_z(const std::vector<Arc>& arcs) {
  double turn = 0;
  for (const Arc& arc : arcs)
    turn += std::atan2(arc.a.x * arc.b.y - arc.a.y * arc.b.x, arc.a.x * arc.b.x + arc.a.y * arc.b.y);
  return static_cast<int>(std::lround(turn / (2 * std::numbers::pi)));
}

// Of the arc, the point nearest to z.
Vec3d nearest_to_z(const Arc& arc) {
  const Vec3d foot = normalized(Vec3d{0, 0, 1} - arc.normal * arc.normal.z);
  const bool within = dot(arc.normal, cross(arc.a, foot)) > 0 && dot(arc.normal, cross(foot, arc.b)) > 0;
  if (within) return foot;
  return arc.a.z > arc.b.z ? arc.a : arc.b;
}

constexpr std::size_t kNoArc = static_cast<std::size_t>(-1);

}  // namespace

Fan::Fan(const SphericalRegion& region, const LobeShape& shape)
    : column_x_(shape.x), column_y_(shape.y), column_z_(shape.peak) {
  const Vec3d yz = cross(column_y_, column_z_), zx = cross(column_z_, column_x_), xy = cross(column_x_, column_y_);
  determinant_ = dot(column_x_, yz);
  const auto stretched = [&](Vec3d w) { return normalized(Vec3d{dot(yz, w), dot(zx, w), dot(xy, w)} / determinant_); };

  std::vector<Arc> arcs;
  arcs.reserve(region.arcs.size());
  for (const Arc& arc : region.arcs) {
    const Vec3d a = stretched(arc.a), b = stretched(arc.b);
    // Normals of planes go the other way: by the transpose.
    const Vec3d n = normalized(Vec3d{dot(column_x_, arc.normal), dot(column_y_, arc.normal), dot(column_z_, arc.normal)});
    arcs.push_back({a, b, n, std::atan2(dot(n, cross(a, b)), dot(a, b))});
  }

  apex_ = {0, 0, 1};
  std::size_t apex_arc = kNoArc;
  if (winding_about_z(arcs) <= 0) {
    double nearest = -2;
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      const Vec3d candidate = nearest_to_z(arcs[i]);
      if (candidate.z > nearest) {
        nearest = candidate.z;
        apex_ = candidate;
        apex_arc = i;
      }
    }
  }

  // The scale on which the lobe falls off from the apex: its width at its peak; off the peak a power law slows down, and
  // a Gaussian of width w falls as exp(-distance theta / w^2). Beyond 40 widths nothing of it is left in double.
  const double distance = std::atan2(std::hypot(apex_.x, apex_.y), apex_.z);
  theta_scale_ = shape.long_tailed ? std::hypot(shape.width, distance)
                                   : shape.width / (1 + std::min(distance / shape.width, 40.0));

  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const Arc& arc = arcs[i];
    const double sine = dot(arc.normal, apex_);
    // An arc through the apex spans nothing with it.
    if (i == apex_arc || apex_ == arc.a || apex_ == arc.b || std::fabs(sine) < 1e-20) continue;
    FanTriangle t;
    Vec3d foot = normalized(apex_ - arc.normal * sine);
    if (length(foot) < 0.5) foot = arc.a;  // the apex is the circle's pole: every point is nearest
    const Vec3d along = cross(arc.normal, foot);
    t.sine = sine;
    t.cosine = dot(foot, apex_);
    t.tau_scale = std::fabs(sine);
    t.x = normalized(cross(along, apex_)) * std::copysign(1.0, sine);
    t.y = along;
    const double tau = std::atan2(dot(along, arc.a), dot(foot, arc.a));
    const double begin = std::asinh(tau / t.tau_scale), end = std::asinh((tau + arc.angle) / t.tau_scale);
    const auto add = [&](double from, double to) {
      t.u_begin = from;
      t.u_end = to;
      if (to > from) triangles_.push_back(t);
    };
    if (begin < 0 && end > 0) {
      add(begin, 0);
      add(0, end);
    } else {
      add(begin, end);
    }
  }
}

Fan::Ray Fan::ray(const FanTriangle& t, double u) const {
  const double tau = t.tau_scale * std::sinh(u);
  const double tau_speed = t.tau_scale * std::cosh(u);
  const double sin_tau = std::sin(tau), cos_tau = std::cos(tau);
  // The arc's point in the frame (x, y, apex); sin(theta) from its own terms, which do not cancel.
  const double along_x = std::fabs(t.sine) * cos_tau, along_y = sin_tau;
  const double sine2 = along_x * along_x + along_y * along_y;
  const double sine = std::sqrt(sine2);
  const double theta = std::atan2(sine, t.cosine * cos_tau);
  Ray ray;
  ray.along = (t.x * along_x + t.y * along_y) / sine;
  ray.v_scale = std::asinh(theta / theta_scale_);
  ray.arc_speed = tau_speed;
  ray.measure = t.sine / sine2 * tau_speed * ray.v_scale;
  return ray;
}

FanPoint Fan::at(const Ray& ray, double v) const {
  const double e = std::exp(v * ray.v_scale);
  const double theta = theta_scale_ * 0.5 * (e - 1 / e);
  const double theta_speed = theta_scale_ * 0.5 * (e + 1 / e);
  const double sine = std::sin(theta);
  const Vec3d w = apex_ * std::cos(theta) + ray.along * sine;
  const Vec3d l = column_x_ * w.x + column_y_ * w.y + column_z_ * w.z;
  const double scale = 1 / length(l);
  return {l * scale, determinant_ * scale * scale * scale * ray.measure * theta_speed * sine};
}

}  // namespace steradian::reference
