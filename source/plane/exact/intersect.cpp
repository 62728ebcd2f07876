#include "plane/exact/intersect.h"

#include <cmath>

namespace steradian::plane {
namespace {

double evaluate(const double* c, int degree, double x) {
  double p = c[degree];
  for (int k = degree - 1; k >= 0; --k) p = p * x + c[k];
  return p;
}

// The root between two points of opposite sign, by bisection to the last bit.
double bisect(const double* c, int degree, double low, double high, bool rising) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    if ((evaluate(c, degree, middle) < 0) == rising)
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

Crossings segment_segment(const Curve& s, const Curve& t) {
  const Vec2d d = s.b - s.a, e = t.b - t.a;
  const double det = cross(d, e);
  Crossings result;
  if (std::fabs(det) <= 1e-14 * length(d) * length(e)) return result;  // parallel
  result.at[result.count++] = s.a + d * (cross(t.a - s.a, e) / det);
  return result;
}

Crossings segment_arc(const Curve& s, const Curve& arc) {
  const Vec2d p = arc.ellipse.to_unit(s.a), d = arc.ellipse.to_unit(s.b) - p;
  const double a = dot(d, d), b = dot(p, d), c = dot(p, p) - 1;
  const double det = b * b - a * c;
  Crossings result;
  if (!(det >= 0) || !(a > 0)) return result;
  const double q = -(b + std::copysign(std::sqrt(det), b));
  result.at[result.count++] = s.a + (s.b - s.a) * (q / a);
  if (q != 0) result.at[result.count++] = s.a + (s.b - s.a) * (c / q);
  return result;
}

bool is_circle(const Ellipse& e) {
  const double xx = dot(e.x, e.x);
  return std::fabs(xx - dot(e.y, e.y)) <= 1e-14 * xx && std::fabs(dot(e.x, e.y)) <= 1e-14 * xx;
}

Crossings circle_circle(const Ellipse& a, const Ellipse& b) {
  const Vec2d to = b.center - a.center;
  const double d2 = dot(to, to), r2 = dot(a.x, a.x), s2 = dot(b.x, b.x);
  Crossings result;
  if (!(d2 > 0)) return result;
  const double along = 0.5 * (d2 + r2 - s2) / d2, across2 = r2 / d2 - along * along;
  if (!(across2 >= 0)) return result;
  const Vec2d middle = a.center + to * along, side = Vec2d{-to.y, to.x} * std::sqrt(across2);
  result.at[result.count++] = middle + side;
  result.at[result.count++] = middle - side;
  return result;
}

// With the first ellipse as the unit circle of t = tan(tau / 2), the second one's equation is a quartic. Each of two charts covers half the
// circle, so that t stays within [-1, 1].
Crossings arc_arc(const Curve& first, const Curve& second) {
  const Ellipse& e = first.ellipse;
  const Vec2d m = second.ellipse.to_unit(e.center), x = second.ellipse.to_unit(e.center + e.x) - m,
              y = second.ellipse.to_unit(e.center + e.y) - m;
  Crossings result;
  for (double sign : {1.0, -1.0}) {
    // |m + sign (x cos + y sin)|^2 - 1, cos = (1 - t^2) / (1 + t^2), sin = 2 t / (1 + t^2), times (1 + t^2)^2
    const double xx = dot(x, x), yy = dot(y, y), xy = dot(x, y), k = dot(m, m) - 1;
    const double mx = sign * dot(m, x), my = sign * dot(m, y);
    const double c[5] = {k + 2 * mx + xx, 4 * my + 4 * xy, 2 * k - 2 * xx + 4 * yy, 4 * my - 4 * xy, k - 2 * mx + xx};
    const Roots roots = real_roots(c, 4, -1, 1);
    for (int i = 0; i < roots.count && result.count < 4; ++i) {
      const double t = roots.at[i], s = 1 / (1 + t * t);
      result.at[result.count++] = e.center + (e.x * (1 - t * t) + e.y * (2 * t)) * (sign * s);
    }
  }
  return result;
}

}  // namespace

// Between neighbouring extrema a polynomial is monotone; the extrema are the roots of the derivative.
Roots real_roots(const double* c, int degree, double low, double high) {
  Roots result;
  if (degree == 0) return result;
  double derivative[4] = {};
  for (int k = 1; k <= degree; ++k) derivative[k - 1] = k * c[k];
  const Roots extrema = real_roots(derivative, degree - 1, low, high);
  double left = low, at_left = evaluate(c, degree, low);
  for (int i = 0; i <= extrema.count; ++i) {
    const double right = i < extrema.count ? extrema.at[i] : high, at_right = evaluate(c, degree, right);
    if ((at_left < 0) != (at_right < 0) && result.count < 4) result.at[result.count++] = bisect(c, degree, left, right, at_left < 0);
    left = right;
    at_left = at_right;
  }
  return result;
}

Crossings intersect(const Curve& a, const Curve& b) {
  const bool a_arc = a.kind == Curve::Kind::arc, b_arc = b.kind == Curve::Kind::arc;
  if (!a_arc && !b_arc) return segment_segment(a, b);
  if (!a_arc) return segment_arc(a, b);
  if (!b_arc) return segment_arc(b, a);
  if (is_circle(a.ellipse) && is_circle(b.ellipse)) return circle_circle(a.ellipse, b.ellipse);
  return arc_arc(a, b);
}

}  // namespace steradian::plane
