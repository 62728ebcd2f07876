#include "reference/fan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace steradian::reference {
namespace {

// Number of turns of the arcs around an axis, counted by azimuth.
int winding_about(const std::vector<Arc>& arcs, Vec3d axis) {
  double turn = 0;
  for (const Arc& arc : arcs) turn += std::atan2(dot(axis, cross(arc.a, arc.b)), dot(arc.a, arc.b) - dot(axis, arc.a) * dot(axis, arc.b));
  return static_cast<int>(std::lround(turn / (2 * std::numbers::pi)));
}

Vec3d arc_point(const Arc& arc, double tau) { return arc.a * std::cos(tau) + cross(arc.normal, arc.a) * std::sin(tau); }

}  // namespace

RegionFan::RegionFan(const SphericalRegion& region, const LobeShape& shape) : shape_(shape) {
  determinant_ = dot(shape.x, cross(shape.y, shape.z));
  inverse_x_ = cross(shape.y, shape.z) / determinant_;
  inverse_y_ = cross(shape.z, shape.x) / determinant_;
  inverse_z_ = cross(shape.x, shape.y) / determinant_;
  half_vectors_ = !(shape.offset == Vec3d{});
  const double across = length(shape.x), along = length(shape.y);
  stretched_ = std::max(across, along) > 2 * std::min(across, along);

  const Vec3d peak{0, 0, 1};
  Vec3d apex = peak;
  double distance = 0;
  if (winding_about(region.arcs, shape.peak) <= 0) {
    distance = std::numbers::pi;
    for (const Arc& arc : region.arcs) {
      const Vec3d candidate = normalized(to_lobe_space(arc_point(arc, nearest_tau(arc, peak)) + shape.offset));
      const double d = std::atan2(std::hypot(candidate.x, candidate.y), candidate.z);
      if (d < distance) {
        distance = d;
        apex = candidate;
      }
    }
  }
  apex_ = Frame::from_normal(apex);

  // At the peak the lobe falls off on the scale of its width. Away from it a power law slows down, and a Gaussian of width w falls as
  // exp(-distance theta / w^2). Beyond 40 widths nothing of it remains in double.
  theta_scale_ = shape.long_tailed ? std::hypot(shape.width, distance) : shape.width / (1 + std::min(distance / shape.width, 40.0));
  for (const Arc& arc : region.arcs) add_triangles(arc);
}

Vec3d RegionFan::to_lobe_space(Vec3d v) const { return {dot(inverse_x_, v), dot(inverse_y_, v), dot(inverse_z_, v)}; }

// Positions at which an arc crosses the two planes through an axis of lobe space. In a space stretched a hundredfold or more, the arc
// passes the axis in a tiny part of its length. Evenly spaced probes would miss that part.
std::vector<double> RegionFan::crossings(const Arc& arc, const Frame& axis) const {
  std::vector<double> taus;
  if (!stretched_) return taus;
  const Vec3d offset = axis.to_local(to_lobe_space(shape_.offset)), begin = axis.to_local(to_lobe_space(arc.a)),
              along = axis.to_local(to_lobe_space(cross(arc.normal, arc.a)));
  const auto solve = [&](double a, double b, double c) {  // a + b cos + c sin = 0
    const double r = std::hypot(b, c);
    if (!(std::fabs(a) < r)) return;
    const double middle = std::atan2(c, b), half = std::acos(-a / r);
    for (double tau : {middle - half, middle + half}) {
      tau -= 2 * std::numbers::pi * std::floor(tau / (2 * std::numbers::pi));
      if (tau > 0 && tau < arc.angle) taus.push_back(tau);
    }
  };
  solve(offset.x, begin.x, along.x);
  solve(offset.y, begin.y, along.y);
  return taus;
}

// An approximation: it only provides a start.
double RegionFan::nearest_tau(const Arc& arc, Vec3d to) const {
  const auto closeness = [&](double tau) { return dot(normalized(to_lobe_space(arc_point(arc, tau) + shape_.offset)), to); };
  constexpr int kProbes = 12;
  std::vector<double> probes = crossings(arc, Frame::from_normal(to));
  for (int i = 0; i <= kProbes; ++i) probes.push_back(arc.angle * i / kProbes);
  std::sort(probes.begin(), probes.end());
  std::size_t best_probe = 0;
  double best_closeness = -2;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const double c = closeness(probes[i]);
    if (c > best_closeness) {
      best_closeness = c;
      best_probe = i;
    }
  }
  // Narrows the interval between the best probe's neighbours by thirds.
  const double best = probes[best_probe];
  double low = probes[best_probe > 0 ? best_probe - 1 : 0], high = probes[std::min(best_probe + 1, probes.size() - 1)];
  for (int i = 0; i < 24; ++i) {
    const double third = (high - low) / 3;
    if (closeness(low + third) < closeness(high - third))
      low += third;
    else
      high -= third;
  }
  const double inner = 0.5 * (low + high);
  return closeness(inner) > best_closeness ? inner : best;
}

// Adds a triangle for each place where the arc passes the apex or is nearest to it, up to half the way to the next.
void RegionFan::add_triangles(const Arc& arc) {
  std::vector<double> anchors = crossings(arc, apex_);
  anchors.push_back(nearest_tau(arc, apex_.z));
  std::sort(anchors.begin(), anchors.end());
  double from = 0;
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    const double to = i + 1 < anchors.size() ? 0.5 * (anchors[i] + anchors[i + 1]) : arc.angle;
    add_triangle(arc, anchors[i], from, to);
    from = to;
  }
}

void RegionFan::add_triangle(const Arc& arc, double tau, double from, double to) {
  Triangle t;
  t.nearest = arc_point(arc, tau);
  t.along = cross(arc.normal, t.nearest);
  // The scale along the arc is the distance to the apex, or the lobe's width where the arc is closer. It is divided by the speed of the arc
  // in lobe space.
  const Vec3d p = to_lobe_space(t.nearest + shape_.offset), speed = to_lobe_space(t.along);
  const double size = length(p);
  const Vec3d direction = apex_.to_local(p / size);
  const double distance = std::atan2(std::hypot(direction.x, direction.y), direction.z);
  const double across = length(cross(p / size, speed)) / size;
  t.tau_scale = std::clamp(std::hypot(distance, theta_scale_) / std::max(across, 1e-300), 1e-12, 1.0);
  const double begin = std::asinh((from - tau) / t.tau_scale), end = std::asinh((to - tau) / t.tau_scale);
  if (begin < 0) {
    t.u_begin = begin;
    t.u_end = 0;
    triangles_.push_back(t);
  }
  if (end > 0) {
    t.u_begin = 0;
    t.u_end = end;
    triangles_.push_back(t);
  }
}

RegionFan::Ray RegionFan::ray(const Triangle& t, double u) const {
  const double e = std::exp(u);
  const double tau = t.tau_scale * 0.5 * (e - 1 / e), tau_speed = t.tau_scale * 0.5 * (e + 1 / e);
  const double sine = std::sin(tau), cosine = std::cos(tau);
  const Vec3d p = apex_.to_local(to_lobe_space(t.nearest * cosine + t.along * sine + shape_.offset));
  const Vec3d dp = apex_.to_local(to_lobe_space(t.along * cosine - t.nearest * sine));
  const double r2 = p.x * p.x + p.y * p.y, r = std::sqrt(r2);
  Ray ray{};
  ray.arc_speed = tau_speed;
  if (!(r > 0)) return ray;  // the arc passes through the apex: the triangle is empty
  ray.across = (apex_.x * p.x + apex_.y * p.y) / r;
  ray.v_scale = std::asinh(std::atan2(r, p.z) / theta_scale_);
  ray.measure = (p.x * dp.y - p.y * dp.x) / r2 * tau_speed * ray.v_scale;
  return ray;
}

RegionFan::Point RegionFan::at(const Ray& ray, double v) const {
  const double e = std::exp(v * ray.v_scale);
  const double theta = theta_scale_ * 0.5 * (e - 1 / e), theta_speed = theta_scale_ * 0.5 * (e + 1 / e);
  const double sine = std::sin(theta);
  const Vec3d w = apex_.z * std::cos(theta) + ray.across * sine;
  const Vec3d stretched = shape_.x * w.x + shape_.y * w.y + shape_.z * w.z;
  const double scale = 1 / length(stretched);
  const double measure = determinant_ * scale * scale * scale * ray.measure * theta_speed * sine;
  const Vec3d m = stretched * scale;
  if (!half_vectors_) return {m, measure};
  const double v_dot_h = dot(shape_.offset, m);
  return {normalized(m * (2 * v_dot_h) - shape_.offset), 4 * v_dot_h * measure};
}

}  // namespace steradian::reference
