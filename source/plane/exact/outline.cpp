#include "plane/exact/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/exact/edge_rows.h"
#include "steradian/error.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

// Position of p along the gradient: 0 at `from`, 1 at `to`.
double gradient_offset(const PlaneGradient& g, Vec2d p) {
  const Vec2d axis = g.to - g.from;
  const double length2 = dot(axis, axis);
  return length2 > 0 ? dot(p - g.from, axis) / length2 : 0;
}

// The two stops around a position; the first or the last one twice, outside of all.
class StopsAround {
 public:
  StopsAround(const PlaneGradient& g, double t) : before_(&g.stops.front()), next_(before_) {
    if (!(t > before_->offset)) return;
    const auto next =
        std::lower_bound(g.stops.begin() + 1, g.stops.end(), t, [](const PlaneStop& stop, double at) { return stop.offset < at; });
    before_ = &*(next - 1);
    next_ = next == g.stops.end() ? before_ : &*next;
  }
  Vec3d radiance_at(double t) const {
    const double width = next_->offset - before_->offset, s = width > 0 ? std::clamp((t - before_->offset) / width, 0.0, 1.0) : 1;
    return before_->radiance * (1 - s) + next_->radiance * s;
  }

 private:
  const PlaneStop *before_, *next_;
};

// Turns every edge so that the body lies to its left. Edges that meet others are split there, and parts within the body are removed. If
// there are too many meetings, edges become two-sided instead, which costs time and changes no value.
void orient(const PlaneBody& body, const EdgeRows& rows, std::vector<Curve>& edges) {
  const std::optional<EdgeRows::Meetings> meetings = rows.meetings();
  if (!meetings) {
    for (Curve& e : edges) e.two_sided = true;
    return;
  }
  const Box2d box = bounds_of(body);
  const double step = 1e-7 * length(box.size());
  std::vector<Curve> pieces;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    Vec2d from = edges[i].a;
    const auto add_to = [&](Vec2d to) {
      if (from == to) return;
      Curve e = edges[i];
      e.a = from;
      e.b = to;
      from = to;
      const Vec2d along = (e.b - e.a) / length(e.b - e.a);
      const Vec2d left{-along.y * step, along.x * step}, middle = (e.a + e.b) * 0.5;
      const bool in_left = rows.contains(middle + left, body.even_odd), in_right = rows.contains(middle - left, body.even_odd);
      if (in_left && in_right) return;
      if (in_left == in_right) e.two_sided = true;
      if (in_right && !in_left) std::swap(e.a, e.b);
      pieces.push_back(e);
    };
    for (Vec2d p : (*meetings)[i]) add_to(p);
    add_to(edges[i].b);
  }
  edges = std::move(pieces);
}

void append_edges(const std::vector<Vec2d>& contour, bool closed, int index, std::vector<Curve>& out) {
  const std::size_t n = contour.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const Vec2d a = contour[i], b = contour[(i + 1) % n];
    if (a == b) continue;
    Curve c;
    c.body = index;
    c.a = a;
    c.b = b;
    c.two_sided = !closed;
    out.push_back(c);
  }
}

Curve arc(const PlaneEllipse& ellipse, double tau0, double span, int index) {
  Curve c;
  c.kind = Curve::Kind::arc;
  c.body = index;
  c.ellipse = ellipse;
  if (cross(ellipse.x, ellipse.y) < 0) c.ellipse.y = -c.ellipse.y;
  c.tau0 = tau0;
  c.tau_span = span;
  c.a = c.ellipse.at(tau0);
  c.b = c.ellipse.at(tau0 + span);
  return c;
}

void check(const PlaneBody& body, int index) {
  const std::string place = body.name.empty() ? "body " + std::to_string(index) : "body '" + body.name + "'";
  const auto finite = [&](Vec2d p) {
    // Squares and products of larger coordinates leave no digits for a pixel.
    if (!is_finite(p) || std::fabs(p.x) > 1e9 || std::fabs(p.y) > 1e9)
      throw Error(place, "a coordinate is not finite or beyond a million times the picture's size", "move or scale it");
  };
  for (const auto& contour : body.contours)
    for (Vec2d p : contour) finite(p);
  finite(body.center);
  finite(body.x_axis);
  finite(body.y_axis);
  if (!(body.radius >= 0) || body.radius > 1e9) throw Error(place, "the radius is not a number from 0 to 1e9");
  if (body.light) {
    const PlaneEmission& e = *body.light;
    if (!is_finite(e.radiance)) throw Error(place, "the radiance is not finite");
    if (!(e.range > 0)) throw Error(place, "the range must be positive");
    if (e.gradient && e.gradient->stops.empty()) throw Error(place, "the gradient has no stops");
    if (!(e.spot_half_angle >= 0 && e.spot_half_angle <= pi + 1e-9)) throw Error(place, "the spot's half angle must be within 0 and pi");
  }
}

}  // namespace

Vec3d radiance_at(const PlaneEmission& emission, Vec2d p) {
  if (!emission.gradient) return emission.radiance;
  const double t = gradient_offset(*emission.gradient, p);
  return StopsAround(*emission.gradient, t).radiance_at(t);
}

std::vector<double> gradient_cuts(const PlaneGradient& gradient, const Curve& c) {
  std::vector<double> cuts{0};
  const auto cut = [&](double t) {
    if (t > 1e-9 && t < 1 - 1e-9) cuts.push_back(t);
  };
  if (c.kind == Curve::Kind::segment) {
    const double from = gradient_offset(gradient, c.a), to = gradient_offset(gradient, c.b);
    for (const PlaneStop& stop : gradient.stops) cut((stop.offset - from) / (to - from));
  } else {
    // On an ellipse the offset is a constant plus a cosine of tau.
    const double middle = gradient_offset(gradient, c.ellipse.center);
    const double x = gradient_offset(gradient, c.ellipse.center + c.ellipse.x) - middle;
    const double y = gradient_offset(gradient, c.ellipse.center + c.ellipse.y) - middle;
    for (const PlaneStop& stop : gradient.stops) {
      const double cosine = (stop.offset - middle) / std::hypot(x, y);
      if (!(std::fabs(cosine) < 1)) continue;
      for (double sign : {-1.0, 1.0}) {
        double along = std::atan2(y, x) + sign * std::acos(cosine) - c.tau0;
        along -= 2 * pi * std::floor(along / (2 * pi));
        cut(along / c.tau_span);
      }
    }
  }
  cuts.push_back(1);
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

Curve part_of(const Curve& c, double from, double to) {
  Curve piece = c;
  if (c.kind == Curve::Kind::segment) {
    piece.a = c.a + (c.b - c.a) * from;
    piece.b = c.a + (c.b - c.a) * to;
  } else {
    piece.tau0 = c.tau0 + c.tau_span * from;
    piece.tau_span = c.tau_span * (to - from);
    piece.a = c.ellipse.at(piece.tau0);
    piece.b = c.ellipse.at(piece.tau0 + piece.tau_span);
  }
  return piece;
}

RadianceEnds radiance_ends(const PlaneEmission& emission, Vec2d a, Vec2d b) {
  if (!emission.gradient) return {emission.radiance, emission.radiance};
  // The stops around its middle: at an end, two of them may share an offset.
  const PlaneGradient& gradient = *emission.gradient;
  const StopsAround around(gradient, gradient_offset(gradient, (a + b) * 0.5));
  return {around.radiance_at(gradient_offset(gradient, a)), around.radiance_at(gradient_offset(gradient, b))};
}

std::vector<Curve> outline_of(const PlaneBody& body, int index) {
  check(body, index);
  std::vector<Curve> curves;
  switch (body.shape) {
    case PlaneBody::Shape::polygon:
      for (const auto& contour : body.contours) append_edges(contour, true, index, curves);
      orient(body, EdgeRows(body.contours), curves);
      break;
    case PlaneBody::Shape::polyline:
      for (const auto& contour : body.contours) append_edges(contour, false, index, curves);
      break;
    case PlaneBody::Shape::ellipse:
      // Thinner than rounding: nothing to hit.
      if (std::fabs(cross(body.x_axis, body.y_axis)) > 1e-18)
        curves.push_back(arc({body.center, body.x_axis, body.y_axis}, 0, 2 * pi, index));
      break;
    case PlaneBody::Shape::capsule: {
      if (!(body.radius > 0)) break;
      const Vec2d p = body.contours.at(0).at(0), q = body.contours.at(0).at(1);
      const double length_pq = length(q - p), r = body.radius;
      const Vec2d along = length_pq > 0 ? (q - p) / length_pq : Vec2d{1, 0}, left{-along.y, along.x};
      const Curve last = arc({q, along * r, left * r}, -pi / 2, pi, index), first = arc({p, along * r, left * r}, pi / 2, pi, index);
      if (length_pq > 0) {
        // They share their ends to the last bit.
        append_edges({first.b, last.a}, false, index, curves);
        append_edges({last.b, first.a}, false, index, curves);
        for (Curve& c : curves) c.two_sided = false;
      }
      curves.push_back(last);
      curves.push_back(first);
      break;
    }
  }
  return curves;
}

bool contains(const PlaneBody& body, Vec2d p) {
  switch (body.shape) {
    case PlaneBody::Shape::polyline: return false;
    case PlaneBody::Shape::ellipse: {
      if (std::fabs(cross(body.x_axis, body.y_axis)) <= 1e-18) return false;
      const Vec2d u = PlaneEllipse{body.center, body.x_axis, body.y_axis}.to_unit(p);
      return dot(u, u) <= 1;
    }
    case PlaneBody::Shape::capsule: {
      const Vec2d a = body.contours[0][0], ab = body.contours[0][1] - a;
      const double t = dot(ab, ab) > 0 ? std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0) : 0;
      const Vec2d away = p - a - ab * t;
      return body.radius > 0 && dot(away, away) <= body.radius * body.radius;
    }
    case PlaneBody::Shape::polygon: break;
  }
  Winding winding(p);
  for (const auto& contour : body.contours)
    for (std::size_t i = 0; i < contour.size(); ++i) winding.add(contour[i], contour[i + 1 < contour.size() ? i + 1 : 0]);
  return winding.within(body.even_odd);
}

Box2d bounds_of(const PlaneBody& body) {
  Box2d box;
  switch (body.shape) {
    case PlaneBody::Shape::ellipse: {
      const Vec2d half{std::hypot(body.x_axis.x, body.y_axis.x), std::hypot(body.x_axis.y, body.y_axis.y)};
      box.add(body.center - half);
      box.add(body.center + half);
      break;
    }
    default:
      for (const auto& contour : body.contours)
        for (Vec2d p : contour) {
          box.add(p - Vec2d{body.radius, body.radius});
          box.add(p + Vec2d{body.radius, body.radius});
        }
  }
  const double margin = 0x1p-44 * std::max({-box.low.x, -box.low.y, box.high.x, box.high.y});
  return {box.low - Vec2d{margin, margin}, box.high + Vec2d{margin, margin}};
}

}  // namespace steradian::plane

namespace steradian {

PlaneBody plane_polygon(std::vector<Vec2d> vertices) {
  PlaneBody body;
  body.contours.push_back(std::move(vertices));
  return body;
}

PlaneBody plane_circle(Vec2d center, double radius) {
  PlaneBody body;
  body.shape = PlaneBody::Shape::ellipse;
  body.center = center;
  body.x_axis = {radius, 0};
  body.y_axis = {0, radius};
  return body;
}

}  // namespace steradian

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

bool is_circle(const PlaneEllipse& e) {
  const double xx = dot(e.x, e.x);
  return std::fabs(xx - dot(e.y, e.y)) <= 1e-14 * xx && std::fabs(dot(e.x, e.y)) <= 1e-14 * xx;
}

Crossings circle_circle(const PlaneEllipse& a, const PlaneEllipse& b) {
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
  const PlaneEllipse& e = first.ellipse;
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
