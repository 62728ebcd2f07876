#include "exchange/pairs/edge_pair.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exchange/pairs/gauss_rules.h"

namespace steradian::exchange {
namespace {

constexpr double kUnit = 0x1p-53;  // rounding of one operation
// A panel that is this fraction of its edge needs no smaller ones: x ln x, the worst that an edge has, is integrated there with an error of
// the square of this fraction.
constexpr double kShortestPanel = 1e-9;
// Contact at both ends takes about a thousand inner integrals. More are asked by numbers that leave the range of double alone; all of such
// a panel is then its error.
constexpr int kMostInnerIntegrals = 100'000;
// Directions are parallel if the sine between them is rounding.
constexpr double kParallel = 1e-14;
// Lines meet if they pass each other by the rounding of their coordinates. Below this sine, the meeting point is badly known.
constexpr double kMeets = 1e-14, kLeastSine = 0.02;

// x times ln(r2) / 2; 0 where both vanish.
double times_log(double x, double r2) { return r2 > 0 ? 0.5 * x * std::log(r2) : 0.0; }

struct EdgeLine {
  Vec3d start, along;  // along: unit
  double length;
};
EdgeLine line_of(Vec3d a, Vec3d b) {
  const double l = length(b - a);
  return {a, (b - a) / l, l};
}

// The inner integral over Q at one place of P, with the sum of its terms' sizes, which the rounding follows.
struct Inner {
  double value, size;
};
Inner inner_integral(Vec3d at, const EdgeLine& q) {
  const Vec3d w = at - q.start;
  const double foot = dot(w, q.along);
  const Vec3d off = w - q.along * foot;
  const double h2 = dot(off, off), h = std::sqrt(h2), x0 = -foot, x1 = q.length - foot;
  const double end = times_log(x1, h2 + x1 * x1), start = times_log(x0, h2 + x0 * x0);
  const double turn = h > 0 ? h * std::atan2(q.length * h, h2 + x0 * x1) : 0.0;
  return {end - start - q.length + turn, std::fabs(end) + std::fabs(start) + q.length + 4 * (std::fabs(x0) + std::fabs(x1)) + 4 * turn};
}

// A pair of complex places s +- i d at which the inner integral, as a function of the place on P, is not analytic.
struct Pole {
  double s, d;
};

// Sum of the half axes of the ellipse through a place with foci at the ends of a panel, by half the panel.
double ellipse_through(const Pole& pole, double middle, double half) {
  const double x = (pole.s - middle) / half, y = pole.d / half;
  const double a = 0.5 * (std::hypot(x - 1, y) + std::hypot(x + 1, y));
  return a + std::sqrt(std::max(a * a - 1, 0.0));
}

class OuterIntegral {
 public:
  OuterIntegral(const EdgeLine& p, const EdgeLine& q, double tolerance) : p_(p), q_(q), tolerance_(tolerance / p.length) {
    for (const Vec3d& end : {q.start, q.start + q.along * q.length}) {
      const Vec3d w = end - p.start;
      const double s = dot(w, p.along);
      add_pole(s, length(w - p.along * s));
    }
    // The nearest point of Q's line: a singularity only where it lies on Q itself (docs/theory/view_factors.md).
    const Vec3d normal = cross(p.along, q.along);
    const double sine2 = dot(normal, normal);
    if (sine2 > kParallel * kParallel) {
      const Vec3d w = q.start - p.start;
      const double s = dot(cross(w, q.along), normal) / sine2, t = dot(cross(w, p.along), normal) / sine2;
      if (t > -kShortestPanel * q.length && t < (1 + kShortestPanel) * q.length) add_pole(s, std::fabs(dot(w, normal)) / sine2);
    }
  }

  // True if one panel is not enough.
  bool needs_panels() const { return nodes_for(0.5 * p_.length, 0.5 * p_.length) == 0; }

  LogIntegral integrate() {
    panel(0, p_.length);
    return {value_, error_ + kUnit * size_, evaluations_};
  }

 private:
  void add_pole(double s, double d) { poles_[pole_count_++] = {s, d}; }

  // Bound of the error of n nodes on a panel, by Trefethen, "Approximation theory and approximation practice", 2013, theorem 19.3:
  // 64/15 M rho^-2n / (1 - rho^-2) on [-1, 1]. M: bound of the inner integral on the ellipse, by the farthest distance there.
  double bound_of(double rho, int n, double middle, double half) const {
    const double reach = 0.5 * half * (rho + 1 / rho);
    const double far = length(p_.start + p_.along * middle - q_.start) + q_.length + reach;
    const double largest = 2 * far * (std::fabs(std::log(far)) + std::numbers::pi);
    return half * (64.0 / 15) * largest * std::pow(rho, -2 * n) / (1 - 1 / (rho * rho));
  }
  double rho_of(double middle, double half) const {
    double rho = 64;  // far singularities: a larger ellipse only makes the bound of the inner integral larger
    for (int i = 0; i < pole_count_; ++i) rho = std::min(rho, ellipse_through(poles_[i], middle, half));
    return rho;
  }
  // Nodes that a panel needs; 0: more than there are.
  int nodes_for(double middle, double half) const {
    const double rho = rho_of(middle, half), enough = 2 * half * tolerance_;
    if (!(rho > 1 + 1e-6)) return 0;
    const double first = bound_of(rho, 0, middle, half);
    const int n = std::max(1, static_cast<int>(std::ceil(std::log(first / enough) / (2 * std::log(rho)))));
    return n > kMostNodes ? 0 : n;
  }

  void panel(double from, double to) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    int n = nodes_for(middle, half);
    const bool is_short = !(half > 0.5 * kShortestPanel * p_.length), is_last = is_short || evaluations_ > kMostInnerIntegrals;
    if (n == 0 && !is_last) {
      panel(from, middle);
      panel(middle, to);
      return;
    }
    if (n == 0) {
      n = kMostNodes;
      if (is_short) error_ += 4 * half * half;
    } else {
      error_ += bound_of(rho_of(middle, half), n, middle, half);
    }
    const GaussRule& rule = gauss_rule(n);
    const double size_before = size_;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const Inner g = inner_integral(p_.start + p_.along * (from + 2 * half * rule.node[i]), q_);
      value_ += 2 * half * rule.weight[i] * g.value;
      size_ += 2 * half * rule.weight[i] * g.size;
    }
    if (is_last && !is_short) error_ += size_ - size_before;
    evaluations_ += n;
  }

  EdgeLine p_, q_;
  double tolerance_;  // by length of P
  Pole poles_[3];
  int pole_count_ = 0;
  double value_ = 0, error_ = 0, size_ = 0;
  int evaluations_ = 0;
};

// The second antiderivative of ln(h^2 + x^2) / 2.
double second_antiderivative(double x, double h) {
  const double h2 = h * h, r2 = h2 + x * x;
  const double log = r2 > 0 ? (x * x - h2) * std::log(r2) : 0.0;
  return (log - 3 * x * x + (h > 0 ? 4 * h * x * std::atan(x / h) : 0.0)) / 4;
}

}  // namespace

bool lines_are_parallel(Vec3d p0, Vec3d p1, Vec3d q0, Vec3d q1) {
  const Vec3d u = p1 - p0, v = q1 - q0, n = cross(u, v);
  return dot(n, n) <= kParallel * kParallel * dot(u, u) * dot(v, v);
}

double parallel_log_integral(Vec3d p0, Vec3d p1, Vec3d q0, Vec3d q1) {
  const EdgeLine p = line_of(p0, p1), q = line_of(q0, q1);
  const double same = dot(p.along, q.along) < 0 ? -1 : 1, a = p.length, b = q.length;
  const Vec3d w = p0 - q0;
  const double x0 = dot(w, p.along), h = length(w - p.along * x0);
  const auto psi = [h](double x) { return second_antiderivative(x, h); };
  return -same * (psi(x0 + a - same * b) - psi(x0 + a) - psi(x0 - same * b) + psi(x0));
}

bool lines_meet(Vec3d p0, Vec3d p1, Vec3d q0, Vec3d q1) {
  const EdgeLine p = line_of(p0, p1), q = line_of(q0, q1);
  const Vec3d n = cross(p.along, q.along);
  const double sine = length(n), size = p.length + q.length + length(q0 - p0);
  return sine >= kLeastSine && std::fabs(dot(q0 - p0, n)) <= kMeets * size * sine;
}

double meeting_log_integral(Vec3d p0, Vec3d p1, Vec3d q0, Vec3d q1) {
  const EdgeLine p = line_of(p0, p1), q = line_of(q0, q1);
  const Vec3d n = cross(p.along, q.along), w = q0 - p0;
  const double sine2 = dot(n, n), sine = std::sqrt(sine2), c = dot(p.along, q.along);
  // Places from the meeting point, along each line.
  const double x0 = -dot(cross(w, q.along), n) / sine2, y0 = -dot(cross(w, p.along), n) / sine2;
  const auto part = [sine](double x, double l, double r2) {
    if (!(r2 > 0)) return 0.0;
    const double d = std::fabs(x) * sine;
    return 0.25 * x * (l * std::log(r2) - 3 * l + (d > 0 ? 2 * d * std::atan(l / d) : 0.0));
  };
  const auto corner = [&](double x, double y) {
    const Vec3d between = p.along * x - q.along * y;
    const double r2 = dot(between, between);
    return part(x, y - c * x, r2) + part(y, x - c * y, r2);
  };
  const double x1 = x0 + p.length, y1 = y0 + q.length;
  return corner(x1, y1) - corner(x1, y0) - corner(x0, y1) + corner(x0, y0);
}

LogIntegral integrate_log(Vec3d p0, Vec3d p1, Vec3d q0, Vec3d q1, double tolerance) {
  OuterIntegral outer(line_of(p0, p1), line_of(q0, q1), tolerance);
  if (outer.needs_panels()) {
    const double size = length(p1 - p0) + length(q1 - q0) + length(p0 - q0), size2 = size * size * (4 + std::fabs(std::log(size)));
    if (lines_are_parallel(p0, p1, q0, q1)) return {parallel_log_integral(p0, p1, q0, q1), 8 * kUnit * size2, 4};
    if (lines_meet(p0, p1, q0, q1)) {
      // The distance of the meeting point is known with a rounding of the size over the sine.
      const EdgeLine p = line_of(p0, p1), q = line_of(q0, q1);
      const Vec3d n = cross(p.along, q.along), w = q0 - p0;
      const double sine2 = dot(n, n);
      const double far = size + std::fabs(dot(cross(w, q.along), n)) / sine2 + std::fabs(dot(cross(w, p.along), n)) / sine2;
      const double error = 8 * kUnit * far * far * (4 + std::fabs(std::log(far))) / sine2;
      if (error <= tolerance || error <= 64 * kUnit * size2) return {meeting_log_integral(p0, p1, q0, q1), error, 8};
    }
  }
  return outer.integrate();
}

}  // namespace steradian::exchange
