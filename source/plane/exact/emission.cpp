#include "plane/exact/emission.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "steradian/kernels.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

void add(PlaneLight& sum, Vec3d radiance, double mean, Vec2d moment) {
  sum.radiance += radiance * mean;
  sum.moment_x += radiance * moment.x;
  sum.moment_y += radiance * moment.y;
}

double window(double r, double range) {
  const double q = r / range;
  return q < 1 ? (1 - q * q) * (1 - q * q) : 0;
}

double cosine(const Curve& curve, Vec2d p, Vec2d u) {
  Vec2d along = curve.b - curve.a;
  if (curve.kind == Curve::Kind::arc) {
    const Vec2d t = curve.ellipse.to_unit(p);
    along = curve.ellipse.y * t.x - curve.ellipse.x * t.y;
  }
  return std::fabs(cross(along, u)) / length(along);
}

double profile_at(const PlaneEmission& emission, const Curve& curve, Vec2d p, Vec2d u, double r) {
  switch (emission.profile) {
    case PlaneProfile::uniform: return 1;
    case PlaneProfile::lambert: return cosine(curve, p, u);
    case PlaneProfile::inverse: return 1 / std::max(r, 1e-12);
  }
  return 1;
}

// Gauss-Legendre, eight nodes on [-1, 1]; for each, there is one of the other sign. Abramowitz and Stegun, table 25.4.
constexpr double kNode[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr double kWeight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};

// Segments: every integrand is a polynomial in tan f times a power of cos f. Radiance is linear along the segment, from one end to the
// other, and every radiance that is used lies between those of the ends. So nothing cancels beside a much brighter end.
class SegmentIntegral {
 public:
  SegmentIntegral(const Curve& curve, const PlaneEmission& emission, Vec2d from)
      : emission_(emission), ends_(radiance_ends(emission, curve.a, curve.b)) {
    const Vec2d e = curve.b - curve.a;
    const double size = length(e);
    along_ = e / size;
    normal_ = {-along_.y, along_.x};
    d_ = dot(curve.a - from, normal_);
    if (d_ < 0) normal_ = -normal_, d_ = -d_;
    d_ = std::max(d_, 1e-12);  // fourth powers of tangents stay finite
    low_ = dot(curve.a - from, along_) / d_;
    high_ = low_ + size / d_;
  }

  void add(double begin, double end, PlaneLight& sum) const {
    double from = tangent(direction_at(begin)), to = tangent(direction_at(end));
    if (from > to) std::swap(from, to);
    if (emission_.gradient) {
      // The piece may belong to a longer curve.
      from = std::clamp(from, low_, high_);
      to = std::clamp(to, low_, high_);
    }
    double q = 0;
    if (emission_.range < 1e300) {
      const double reach2 = emission_.range * emission_.range - d_ * d_;
      if (reach2 <= 0) return;
      const double reach = std::sqrt(reach2) / d_;
      from = std::clamp(from, -reach, reach);
      to = std::clamp(to, -reach, reach);
      q = d_ * d_ / (emission_.range * emission_.range);
    }
    if (!(to > from)) return;
    const int k = emission_.profile == PlaneProfile::uniform ? 0 : 1;
    PlaneLight part;
    // Antiderivatives of a narrow piece are much larger than their difference, and eight nodes are exact: the nearest singularity, tan f =
    // i, is at least 26 half lengths away, and the error is of the order 52^-16.
    const double nearest = from > 0 ? from : to < 0 ? to : 0;
    if (to - from <= 0.075 * std::sqrt(1 + nearest * nearest))
      add_nodes(k, from, to, q, part);
    else
      add_closed(k, from, to, q, part);
    const double scale = emission_.profile == PlaneProfile::inverse ? 1 / d_ : 1;
    sum.radiance += part.radiance * scale;
    sum.moment_x += part.moment_x * scale;
    sum.moment_y += part.moment_y * scale;
  }

 private:
  double tangent(Vec2d u) const { return dot(u, along_) / std::max(dot(u, normal_), 1e-15); }

  Vec3d radiance_at_tangent(double t) const {
    const double share = std::clamp((t - low_) / (high_ - low_), 0.0, 1.0);
    return ends_.a * (1 - share) + ends_.b * share;
  }

  void add_nodes(int k, double from, double to, double q, PlaneLight& sum) const {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    for (int i = 0; i < 4; ++i)
      for (double sign : {-1.0, 1.0}) {
        const double t = middle + half * sign * kNode[i], sec2 = 1 + t * t, cosine = 1 / std::sqrt(sec2), window = 1 - q * sec2;
        const double weight = half * kWeight[i] * window * window / sec2 * (k == 0 ? 1 : cosine);
        plane::add(sum, radiance_at_tangent(t), weight, (normal_ + along_ * t) * (cosine * weight));
      }
  }

  // A linear function's integral is its value at the centroid times the measure.
  void add_closed(int k, double from, double to, double q, PlaneLight& sum) const {
    const auto moment = [&](int j) { return normal_ * integral(j, k + 1, from, to, q) + along_ * integral(j + 1, k + 1, from, to, q); };
    const double mean = integral(0, k, from, to, q);
    const Vec2d first = moment(0);
    if (!emission_.gradient) {
      plane::add(sum, emission_.radiance, mean, first);
      return;
    }
    sum.radiance += radiance_at_tangent(std::clamp(integral(1, k, from, to, q) / mean, from, to)) * mean;
    const Vec2d second = moment(1);
    const double size = high_ - low_;
    plane::add(sum, ends_.a, 0, (first * high_ - second) / size);
    plane::add(sum, ends_.b, 0, (second - first * low_) / size);
  }

  static double integral(int j, int k, double from, double to, double q) {
    Kernels<double> kernel;
    const double f0 = std::atan(from), f1 = std::atan(to);
    const auto term = [&](int power) { return (kernel.plane_term(j, power, to, f1) - kernel.plane_term(j, power, from, f0)).v; };
    double sum = term(k);
    // Far along the edge, both ends' antiderivatives round to the same.
    if (j == 0 && k == 0) sum = std::atan2(to - from, 1 + from * to);
    if (j == 0 && k == 1 && from * to > 0) {
      const double c0 = 1 / std::sqrt(1 + from * from), c1 = 1 / std::sqrt(1 + to * to), c = c0 * c1;
      sum = (to - from) * c * (c0 + c1) / (1 + (1 + from * to) * c);
    }
    return q == 0 ? sum : sum - 2 * q * term(k - 2) + q * q * term(k - 4);
  }

  const PlaneEmission& emission_;
  RadianceEnds ends_;
  Vec2d along_, normal_;
  double d_, low_, high_;  // tangents of the curve's ends
};

// Arcs in the parameter tau, in which nothing is singular at the tangents: 8-point Gauss-Legendre on pieces with little turn and no longer
// than their distance.
class ArcQuadrature {
 public:
  ArcQuadrature(const Curve& curve, const PlaneEmission& emission, Vec2d from) : curve_(curve), emission_(emission), from_(from) {}

  void add(double begin, double end, bool back, PlaneLight& sum) const {
    const int parts = 1 + static_cast<int>((end - begin) / 1.0);
    for (int i = 0; i < parts; ++i) {
      const double t0 = parameter(begin + (end - begin) * i / parts, back);
      // The near side runs clockwise. Rounding may reverse a narrow part: it is empty, not all the way around.
      const double sign = back ? 1 : -1, turn = sign * (parameter(begin + (end - begin) * (i + 1) / parts, back) - t0);
      double span = turn < 0 ? turn + 2 * pi : turn;
      if (span > 2 * pi - 1e-9) span = 0;
      const double t1 = t0 + sign * span;
      if (emission_.gradient)
        add_between_stops(t0, t1, sum);
      else
        add_part(t0, t1, 0, sum);
    }
  }

 private:
  double parameter(double angle, bool back) const {
    const Vec2d u = direction_at(angle);
    return angle_of(curve_.ellipse.to_unit(from_ + u * distance_along(curve_, back, from_, u)));
  }

  // The integral is cut at the gradient's stops: the integrand is smooth in between.
  void add_between_stops(double t0, double t1, PlaneLight& sum) const {
    std::vector<double> cuts{t0};
    for (double cut : gradient_cuts(*emission_.gradient, curve_)) {
      double tau = curve_.tau0 + cut * curve_.tau_span;
      tau -= 2 * pi * std::floor((tau - std::min(t0, t1)) / (2 * pi));
      if (tau < std::max(t0, t1)) cuts.push_back(tau);
    }
    std::sort(cuts.begin() + 1, cuts.end());
    if (t1 < t0) std::reverse(cuts.begin() + 1, cuts.end());
    cuts.push_back(t1);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) add_part(cuts[i], cuts[i + 1], 0, sum);
  }

  void add_part(double t0, double t1, int depth, PlaneLight& sum) const {
    const PlaneEllipse& e = curve_.ellipse;
    const auto along = [&](double tau) { return e.y * std::cos(tau) - e.x * std::sin(tau); };
    const Vec2d p = e.at(t0) - from_, q = e.at(t1) - from_, d0 = along(t0), d1 = along(t1);
    // Singularities are at the point, and where the curve turns: in terms of half the part, they are at least 3 away from its middle. Eight
    // nodes are then off by the order of 5.8^-16.
    const bool long_part = length(q - p) > std::min(length(p), length(q)), turns = std::fabs(cross(d0, d1)) > 0.4 * dot(d0, d1);
    if (depth < 40 && (std::fabs(t1 - t0) > 0.4 || turns || long_part)) {
      add_part(t0, 0.5 * (t0 + t1), depth + 1, sum);
      add_part(0.5 * (t0 + t1), t1, depth + 1, sum);
      return;
    }
    for (int i = 0; i < 4; ++i)
      for (double sign : {-1.0, 1.0}) {
        const double tau = 0.5 * (t0 + t1) + 0.5 * (t1 - t0) * sign * kNode[i];
        const Vec2d hit = e.at(tau), v = hit - from_, dv = along(tau);
        const double r = length(v), d_angle = std::fabs(cross(v, dv)) / (r * r);
        const Vec2d u = v / r;
        const double w = window(r, emission_.range) * profile_at(emission_, curve_, hit, u, r);
        const double weight = 0.5 * std::fabs(t1 - t0) * kWeight[i] * d_angle * w;
        plane::add(sum, radiance_at(emission_, hit), weight, u * weight);
      }
  }

  const Curve& curve_;
  const PlaneEmission& emission_;
  Vec2d from_;
};

bool is_circular(const PlaneEllipse& e) {
  const double xx = dot(e.x, e.x), yy = dot(e.y, e.y);
  return std::fabs(xx - yy) <= 1e-12 * xx && std::fabs(dot(e.x, e.y)) <= 1e-12 * xx;
}

// Range window on a circle of uniform radiance: the difference of the antiderivative between the two directions.
double circle_window(const Curve& curve, double range, Vec2d from, double begin, double end) {
  Kernels<double> kernel;
  const Vec2d c = (curve.ellipse.center - from) / range;
  const double d2 = dot(c, c), d = std::sqrt(d2), rho2 = dot(curve.ellipse.x, curve.ellipse.x) / (range * range);
  if (d - std::sqrt(rho2) >= 1) return 0;
  // Law of cosines: the angle at which the near side of the circle leaves the range, if it does before the tangent.
  const double farthest = d2 - rho2 <= 1 ? pi / 2 : std::acos(std::min((d2 + 1 - rho2) / (2 * d), 1.0));
  const auto antiderivative = [&](double angle) {
    const Vec2d u = direction_at(angle);
    double psi = std::atan2(cross(c, u), dot(c, u));
    psi = std::clamp(psi, -farthest, farthest);
    const double s = std::sin(psi), x = std::clamp(d * s, -std::sqrt(rho2), std::sqrt(rho2));
    const double chord = std::sqrt(std::max(rho2 - x * x, 0.0));
    return kernel.plane_disk_window_integral(d2, rho2, d, std::cos(psi), s, psi, chord, std::atan2(x, chord)).v;
  };
  return antiderivative(end) - antiderivative(begin);
}

void add_clipped(const Visible& v, const PlaneEmission& emission, Vec2d from, EmissionParts parts, PlaneLight& sum) {
  const Curve& curve = *v.curve;
  const bool plain = emission.profile == PlaneProfile::uniform && !emission.gradient;
  const bool in_range = !(emission.range < 1e300);
  if (plain && in_range) {
    const double s0 = std::sin(v.begin), s1 = std::sin(v.end), c0 = std::cos(v.begin), c1 = std::cos(v.end);
    add(sum, emission.radiance, v.end - v.begin, {s1 - s0, c0 - c1});
  } else if (curve.kind == Curve::Kind::segment) {
    if (!emission.gradient) {
      SegmentIntegral(curve, emission, from).add(v.begin, v.end, sum);
      return;
    }
    const std::vector<double> cuts = gradient_cuts(*emission.gradient, curve);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      SegmentIntegral(part_of(curve, cuts[i], cuts[i + 1]), emission, from).add(v.begin, v.end, sum);
  } else {
    PlaneLight part;
    const bool closed = plain && !v.back && is_circular(curve.ellipse);
    if (!closed || parts == EmissionParts::radiance_and_moments) ArcQuadrature(curve, emission, from).add(v.begin, v.end, v.back, part);
    if (closed) part.radiance = emission.radiance * circle_window(curve, emission.range, from, v.begin, v.end);
    sum.radiance += part.radiance;
    sum.moment_x += part.moment_x;
    sum.moment_y += part.moment_y;
  }
}

}  // namespace

bool within_spot(const PlaneEmission& emission, Vec2d u) {
  if (!emission.is_spot()) return true;
  const Vec2d axis = -emission.spot_axis;
  return std::fabs(std::atan2(cross(axis, u), dot(axis, u))) <= emission.spot_half_angle;
}

void add_emission(const Visible& piece, const PlaneEmission& emission, Vec2d from, EmissionParts parts, PlaneLight& sum) {
  if (!emission.is_spot()) {
    add_clipped(piece, emission, from, parts, sum);
    return;
  }
  // The spot's directions from the point, around the reversed axis; once, and one turn to either side.
  const double middle = angle_of(-emission.spot_axis), half = emission.spot_half_angle;
  for (double turn : {-2 * pi, 0.0, 2 * pi}) {
    Visible clipped = piece;
    clipped.begin = std::max(piece.begin, middle - half + turn);
    clipped.end = std::min(piece.end, middle + half + turn);
    if (clipped.end > clipped.begin) add_clipped(clipped, emission, from, parts, sum);
  }
}

void add_interior(const Visible& v, const PlaneEmission& emission, Vec2d from, PlaneLight& sum) {
  add(sum, radiance_at(emission, from), v.end - v.begin, {std::sin(v.end) - std::sin(v.begin), std::cos(v.begin) - std::cos(v.end)});
}

Vec3d radiance_along(const Curve& curve, const PlaneEmission& emission, Vec2d from, Vec2d u, double r) {
  if (!within_spot(emission, u)) return {};
  const Vec2d hit = from + u * r;
  return radiance_at(emission, hit) * (window(r, emission.range) * profile_at(emission, curve, hit, u, r));
}

}  // namespace steradian::plane
