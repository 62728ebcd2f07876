// Contribution of a visible piece of a wall, element by element: the integrals of 1 and of the place u over its directions. They are times
// the cosine at the receiving wall, if there is one. For segments, with t the tangent of the angle from their perpendicular and s = sqrt(1
// + t^2):
//
//   u = m t + c,  integral of u^k (nc + ns t) s^-3 dt from I0 = t/s, I1 = -1/s, I2 = asinh t - t/s,
//                 integral of u^k s^-2 dt             from atan t, log s.
//
// Arcs use Gauss-Legendre in the ellipse's own parameter.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "plane/bounce/elements.h"
#include "plane/bounce/rows.h"

namespace steradian::plane {

// Abramowitz and Stegun, table 25.4, n = 6: exact on [-1, 1] for the polynomials of degree 11.
inline constexpr std::array<std::pair<double, double>, 6> kGauss6 = {{{-0.93246951420315203, 0.17132449237917035},
                                                                      {-0.66120938646626451, 0.36076157304813861},
                                                                      {-0.23861918608319691, 0.46791393457269105},
                                                                      {0.23861918608319691, 0.46791393457269105},
                                                                      {0.66120938646626451, 0.36076157304813861},
                                                                      {0.93246951420315203, 0.17132449237917035}}};

// A piece of a segment, between two directions, and the ends of the elements in it.
class SeenPiece {
 public:
  SeenPiece(const Curve& curve, Vec2d from, Vec2d begin, Vec2d end, const BoundaryElements& elements,
            std::pair<std::size_t, std::size_t> side) {
    const Vec2d e = curve.b - curve.a;
    size_ = length(e);
    along_ = e / size_;
    across_ = {-along_.y, along_.x};
    distance_ = dot(curve.a - from, across_);
    if (distance_ < 0) across_ = -across_, distance_ = -distance_;
    distance_ = std::max(distance_, 1e-12);
    foot_ = dot(from - curve.a, along_);
    begin_ = tangent(begin);
    end_ = tangent(end);
    if (begin_ > end_) std::swap(begin_, end_);
    // With a margin for rounding.
    const double low = (begin_ * distance_ + foot_) / size_ - 1e-9, high = (end_ * distance_ + foot_) / size_ + 1e-9;
    spans_ = elements.spans().data();
    first_ = last_ = static_cast<std::size_t>(
        std::partition_point(spans_ + side.first, spans_ + side.second, [low](const ElementSpan& span) { return span.to <= low; }) -
        spans_);
    while (last_ < side.second && spans_[last_].from < high) ++last_;
  }

  std::size_t first() const { return first_; }
  std::size_t last() const { return last_; }

  // Calls f(t) for the ends of the visible part of each element: two of them, which neighbours share, except at gaps.
  template <class F>
  void for_each_end(F f) const {
    const double scale = size_ / distance_, shift = foot_ / distance_;
    double t = begin_;
    for (std::size_t k = first_; k < last_; ++k) {
      if (k == first_ || spans_[k].from != spans_[k - 1].to) f(t = std::max(t, std::min(end_, spans_[k].from * scale - shift)));
      f(t = std::max(t, std::min(end_, spans_[k].to * scale - shift)));
    }
  }

  // Calls f(element, w0, w1) for every element. The primitive is a function of the ends' numbers, in their order, whose differences are the
  // integrals of 1 and t. The error is a few ulp of 1; for the second, that times the distance in elements.
  template <class Primitive, class F>
  void for_each_weight(std::size_t end, Primitive primitive, F f) const {
    const double scale = 2 / size_;
    std::array<double, 2> a{}, b{};
    for (std::size_t k = first_; k < last_; ++k) {
      const ElementSpan& span = spans_[k];
      a = k == first_ || span.from != spans_[k - 1].to ? primitive(end++) : b;
      b = primitive(end++);
      const double w0 = b[0] - a[0];
      const double w1 = scale * span.per_share * (distance_ * (b[1] - a[1]) + (foot_ - 0.5 * (span.to + span.from) * size_) * w0);
      f(k, w0, w1);
    }
  }

  // Integrals of 1 and t times the cosine, up to an end.
  std::array<double, 2> with_cosine(const EndValues& end, Vec2d normal) const {
    const double nc = dot(normal, across_), ns = dot(normal, along_);
    return {nc * end.sine - ns * end.cosine, ns * (end.area - end.sine) - nc * end.cosine};
  }

 private:
  double tangent(Vec2d u) const { return dot(u, along_) / std::max(dot(u, across_), 1e-15); }
  Vec2d along_, across_;
  double size_, distance_, foot_, begin_, end_;
  const ElementSpan* spans_;
  std::size_t first_, last_;
};

// Adds an arc's part between two places tau. It is halved until it is no longer than a tenth of its distance: Gauss' rule is then accurate
// to 1e-14.
inline void add_arc(const Curve& curve, const BoundaryElement& e, Vec2d from, const Vec2d* normal, double low, double high, double& w0,
                    double& w1) {
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  const Vec2d to_middle = curve.ellipse.at(middle) - from, across = curve.ellipse.y * std::cos(middle) - curve.ellipse.x * std::sin(middle);
  if (4 * half * half * dot(across, across) > 0.01 * dot(to_middle, to_middle) && half > 1e-4) {
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

// Calls f(element, w0, w1) with the integrals over the piece's directions of 1 and u, times the cosine from `normal` if there is one.
template <class F>
void weigh(const World& world, const BoundaryElements& elements, const Visible& piece, Vec2d from, const Vec2d* normal, F f) {
  const Curve& curve = *piece.curve;
  const auto [first, last] = elements.of(piece, world);
  if (first == last) return;
  if (curve.kind == Curve::Kind::segment) {
    const SeenPiece seen(curve, from, {std::cos(piece.begin), std::sin(piece.begin)}, {std::cos(piece.end), std::sin(piece.end)}, elements,
                         {first, last});
    thread_local std::vector<double> ends;
    ends.clear();
    seen.for_each_end([&](double t) { ends.push_back(t); });
    const auto primitive = [&](std::size_t k) -> std::array<double, 2> {
      const double t = ends[k], s = std::sqrt(1 + t * t);
      if (normal != nullptr) return seen.with_cosine({t / s, 1 / s, std::asinh(t)}, *normal);
      return {std::atan(t), std::log(s)};
    };
    seen.for_each_weight(0, primitive, f);
    return;
  }
  // Places of the piece's ends on the arc; the visible part is less than half of the ellipse.
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
    const BoundaryElement& e = elements.all()[k];
    for (int turn = -1; turn <= 1; ++turn) {  // a whole outline has no first place
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
