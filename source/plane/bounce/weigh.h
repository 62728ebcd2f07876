// What a visible piece of a wall sends, element by element. Segments in closed form, with t the tangent of the angle from their
// perpendicular:
//
//   u = m t + c,  integral of u^k (nc + ns t) (1 + t^2)^(-3/2) dt from I0 = t/s, I1 = -1/s, I2 = asinh t - t/s,  s = sqrt(1 + t^2);
//
// narrow pieces, on which these cancel, and arcs by Gauss-Legendre, in the tangent of the angle from the piece's middle and in the
// ellipse's own parameter.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "plane/bounce/elements.h"

namespace steradian::plane {

// Abramowitz and Stegun, table 25.4, n = 6: on [-1, 1] to the polynomials of degree 11.
inline constexpr std::array<std::pair<double, double>, 6> kGauss6 = {{{-0.932469514203152, 0.171324492379170},
                                                                      {-0.661209386466265, 0.360761573048139},
                                                                      {-0.238619186083197, 0.467913934572691},
                                                                      {0.238619186083197, 0.467913934572691},
                                                                      {0.661209386466265, 0.360761573048139},
                                                                      {0.932469514203152, 0.171324492379170}}};

class SegmentWeights {
 public:
  SegmentWeights(const Visible& piece, Vec2d from, const Vec2d* normal) {
    const Curve& curve = *piece.curve;
    const Vec2d e = curve.b - curve.a;
    size_ = length(e);
    along_ = e / size_;
    across_ = {-along_.y, along_.x};
    d_ = dot(curve.a - from, across_);
    if (d_ < 0) across_ = -across_, d_ = -d_;
    d_ = std::max(d_, 1e-300);
    foot_ = dot(from - curve.a, along_);
    weighed_ = normal != nullptr;
    if (weighed_) nc_ = dot(*normal, across_), ns_ = dot(*normal, along_);
    first_ = tangent(piece.begin);
    last_ = tangent(piece.end);
    if (first_ > last_) std::swap(first_, last_);
  }

  // Of the curve, where the piece begins and ends: with room for rounding.
  std::pair<double, double> shares() const { return {(first_ * d_ + foot_) / size_ - 1e-9, (last_ * d_ + foot_) / size_ + 1e-9}; }

  // The piece's part that lies between two shares of the curve, with u = -1 and 1 at `low` and `high`.
  template <class F>
  void add(double low, double high, F f) const {
    const double t0 = std::max(first_, (low * size_ - foot_) / d_), t1 = std::min(last_, (high * size_ - foot_) / d_);
    if (!(t1 > t0)) return;
    const double half = 0.5 * (high - low) * size_, m = d_ / half, c = (foot_ - 0.5 * (high + low) * size_) / half;
    const double s0 = std::sqrt(1 + t0 * t0), s1 = std::sqrt(1 + t1 * t1), product = s0 * s1, cosine = 1 + t0 * t1;
    // The tangent of half the angle between the two, without the difference of two angles.
    const double q = (t1 - t0) / (product + cosine);
    double w0 = 0, w1 = 0;
    if (q > 0 && q < kNarrow) {
      add_narrow(q, (t0 * s1 + t1 * s0) / (s0 + s1), m, c, w0, w1);
    } else if (weighed_) {
      const double i0 = t1 / s1 - t0 / s0, i1 = 1 / s0 - 1 / s1, i2 = std::asinh(t1) - std::asinh(t0) - i0;
      w0 = nc_ * i0 + ns_ * i1;
      w1 = m * (nc_ * i1 + ns_ * i2) + c * w0;
    } else {
      w0 = std::atan2(t1 - t0, cosine);
      w1 = m * std::log(s1 / s0) + c * w0;
    }
    f(w0, w1);
  }

 private:
  // The tangent of half an angle of 0.15, below which the closed forms cancel.
  static constexpr double kNarrow = 0.0751;

  // Gauss' rule in the tangent p of the angle from the middle, whose own tangent is t: no trigonometry.
  void add_narrow(double q, double t, double m, double c, double& w0, double& w1) const {
    for (const auto& [x, weight] : kGauss6) {
      const double p = q * x, ahead = 1 - t * p, across = t + p;
      double w = q * weight / (1 + p * p);
      if (weighed_) w *= (nc_ * ahead + ns_ * across) / std::sqrt(ahead * ahead + across * across);
      w0 += w;
      w1 += w * std::clamp(m * across / ahead + c, -1.0, 1.0);
    }
  }

  double tangent(double angle) const {
    const Vec2d u{std::cos(angle), std::sin(angle)};
    return dot(u, along_) / std::max(dot(u, across_), 1e-15);
  }
  Vec2d along_, across_;
  double size_, d_, foot_, first_, last_, nc_ = 0, ns_ = 0;
  bool weighed_;
};

// Of an arc's part between two places tau; halved until it is no longer than 0.7 of its distance.
inline void add_arc(const Curve& curve, const Element& e, Vec2d from, const Vec2d* normal, double low, double high, double& w0,
                    double& w1) {
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  const Vec2d to_middle = curve.ellipse.at(middle) - from, across = curve.ellipse.y * std::cos(middle) - curve.ellipse.x * std::sin(middle);
  if (4 * half * half * dot(across, across) > 0.5 * dot(to_middle, to_middle) && half > 1e-4) {
    add_arc(curve, e, from, normal, low, middle, w0, w1);
    add_arc(curve, e, from, normal, middle, high, w0, w1);
    return;
  }
  for (const auto& [x, weight] : kGauss6) {
    const double tau = middle + half * x;
    const Vec2d to = curve.ellipse.at(tau) - from, step = curve.ellipse.y * std::cos(tau) - curve.ellipse.x * std::sin(tau);
    double w = half * weight * std::fabs(cross(to, step)) / dot(to, to);
    if (normal != nullptr) w *= dot(*normal, to) / length(to);
    w0 += w;
    w1 += w * dot(to + from - e.middle, e.along) / e.half;
  }
}

// Calls f(element, w0, w1) with the integrals over the piece's directions of 1 and u, times the cosine from `normal` where there is one.
template <class F>
void weigh(const World& world, const Elements& elements, const Visible& piece, Vec2d from, const Vec2d* normal, F f) {
  const Curve& curve = *piece.curve;
  const auto [first, last] = elements.of(piece, world);
  if (first == last) return;
  if (curve.kind == Curve::Kind::segment) {
    const SegmentWeights weights(piece, from, normal);
    const auto [low, high] = weights.shares();
    const auto of_curve = elements.all().begin();
    const auto at = std::partition_point(of_curve + static_cast<std::ptrdiff_t>(first), of_curve + static_cast<std::ptrdiff_t>(last),
                                         [low = low](const Element& e) { return e.to <= low; });
    for (auto k = static_cast<std::size_t>(at - of_curve); k < last && elements.all()[k].from < high; ++k) {
      const Element& e = elements.all()[k];
      weights.add(e.from, e.to, [&](double w0, double w1) { f(k, w0, w1); });
    }
    return;
  }
  // Where on the arc the piece's ends are; what is seen of it is less than half of the ellipse.
  const double middle_angle = 0.5 * (piece.begin + piece.end);
  const auto tau_of = [&](double angle) {
    const Vec2d u{std::cos(angle), std::sin(angle)};
    const Vec2d at = curve.ellipse.to_unit(from + u * distance_along(curve, piece.back, from, u));
    return std::atan2(at.y, at.x);
  };
  const auto near = [](double tau, double to) { return tau + 2 * std::numbers::pi * std::round((to - tau) / (2 * std::numbers::pi)); };
  const double middle = near(tau_of(middle_angle), curve.tau0 + 0.5 * curve.tau_span);
  double tau0 = near(tau_of(piece.begin), middle), tau1 = near(tau_of(piece.end), middle);
  if (tau0 > tau1) std::swap(tau0, tau1);
  for (std::size_t k = first; k < last; ++k) {
    const Element& e = elements.all()[k];
    for (int turn = -1; turn <= 1; ++turn) {  // an outline that is whole has no first place
      const double shift = 2 * std::numbers::pi * turn;
      const double low = std::max(tau0, curve.tau0 + curve.tau_span * e.from + shift),
                   high = std::min(tau1, curve.tau0 + curve.tau_span * e.to + shift);
      if (!(high > low)) continue;
      double w0 = 0, w1 = 0;
      add_arc(curve, e, from, normal, low, high, w0, w1);
      f(k, w0, w1);
    }
  }
}

}  // namespace steradian::plane
