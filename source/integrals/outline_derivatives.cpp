#include "integrals/outline_derivatives.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "integrals/curved_light.h"
#include "reference/gauss_kronrod.h"
#include "shapes/polygon.h"
#include "steradian/capsule_light.h"

namespace steradian {
namespace {

using ByChannel = OutlineDerivatives::ByChannel;

ByChannel operator+(const ByChannel& a, const ByChannel& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
ByChannel operator*(const ByChannel& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
ByChannel turned(Vec3d arm, const ByChannel& a) { return {cross(arm, a[0]), cross(arm, a[1]), cross(arm, a[2])}; }

// A vector that is linear in the two coordinates of a piece, or that of a number.
template <class T>
struct Linear {
  T constant{}, by_first{}, by_second{};
};

// A piece of the outline: p = constant + by_first u + by_second w, relative to the point, in walk order. An arc has u = cos t and w = sin
// t. A straight piece runs from by_first to by_second and has no constant.
struct OutlinePiece {
  Linear<Vec3d> place;
  bool is_arc = false;
  double begin = 0, end = 0;  // of t
};

// Integrals of the density times p x dp / |p|^3 along a piece, and the same times its two coordinates. The derivative by a vector that
// moves the piece in proportion to a coordinate is that moment.
struct Moments {
  ByChannel constant{}, first{}, second{};

  friend Moments operator+(const Moments& a, const Moments& b) { return {a.constant + b.constant, a.first + b.first, a.second + b.second}; }
  friend Moments operator*(const Moments& a, double s) { return {a.constant * s, a.first * s, a.second * s}; }
  double largest() const {
    double result = 0;
    for (const ByChannel* moment : {&constant, &first, &second})
      for (const Vec3d& v : *moment) result = std::max(result, length(v));
    return result;
  }
  ByChannel along(const Linear<double>& motion) const {
    return constant * motion.constant + first * motion.by_first + second * motion.by_second;
  }
  Vec3d along(const Linear<Vec3d>& motion) const {
    const auto one = [&](std::size_t c) {
      return dot(constant[c], motion.constant) + dot(first[c], motion.by_first) + dot(second[c], motion.by_second);
    };
    return {one(0), one(1), one(2)};
  }
};

class PieceMoments {
 public:
  PieceMoments(const OutlinePiece& piece, const ShadingPoint& at, const LobeAxis& lobe, const LobeDensity& density)
      : piece_(piece), at_(at), lobe_(lobe), density_(density) {
    if (piece_.is_arc) return;
    // The parameter of a straight piece is the angle from its start: a long piece is seen under a finite angle.
    const Vec3d a = piece_.place.by_first, b = piece_.place.by_second;
    along_a_ = normalized(a);
    across_ = normalized(cross(a, b));
    aside_ = cross(across_, along_a_);
    piece_.begin = 0;
    piece_.end = std::atan2(dot(normalized(b), aside_), dot(normalized(b), along_a_));
  }

  Moments integral() {
    if (!(piece_.end > piece_.begin) || (!piece_.is_arc && across_ == Vec3d{})) return {};
    std::vector<double> ends = {piece_.begin};
    for (const double t : crossings_of_the_horizon())
      if (t > ends.back() && t < piece_.end) ends.push_back(t);
    ends.push_back(piece_.end);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (!(dot(direction(0.5 * (ends[i] + ends[i + 1])), at_.normal) > 0)) continue;
      const int count = 1 + static_cast<int>((ends[i + 1] - ends[i]) / kLongest);
      for (int k = 0; k < count; ++k)
        split_about_the_lobe(ends[i] + (ends[i + 1] - ends[i]) * k / count, ends[i] + (ends[i + 1] - ends[i]) * (k + 1) / count, 0);
    }
    double scale = 0;
    for (const Interval& interval : intervals_) scale += interval.value.largest();
    Moments sum;
    for (const Interval& interval : intervals_) sum = sum + refined(interval, kPrecision * scale, 0);
    return sum;
  }

 private:
  static constexpr double kLongest = 0.4, kPrecision = 1e-10;
  static constexpr int kDepth = 40, kMostHalvings = 20'000;

  struct Interval {
    double from, to;
    Moments value;
    double error;
  };

  Vec3d place(double t) const { return piece_.place.constant + piece_.place.by_first * std::cos(t) + piece_.place.by_second * std::sin(t); }
  Vec3d direction(double t) const { return piece_.is_arc ? normalized(place(t)) : along_a_ * std::cos(t) + aside_ * std::sin(t); }

  // In ascending order.
  std::vector<double> crossings_of_the_horizon() const {
    const auto height = [&](Vec3d v) { return dot(v, at_.normal); };
    const double c = piece_.is_arc ? height(piece_.place.constant) : 0;
    const double x = height(piece_.is_arc ? piece_.place.by_first : along_a_), y = height(piece_.is_arc ? piece_.place.by_second : aside_);
    const double size = std::hypot(x, y);
    if (!(size > std::fabs(c))) return {};
    const double middle = std::atan2(y, x), half = std::acos(-c / size);
    std::vector<double> result;
    for (double t : {middle - half, middle + half}) {
      t = piece_.begin + std::fmod(t - piece_.begin, 2 * std::numbers::pi);
      if (t < piece_.begin) t += 2 * std::numbers::pi;
      result.push_back(t);
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  // The lobe is as narrow as its width at its axis, and no narrower than the distance from there elsewhere.
  void split_about_the_lobe(double from, double to, int depth) {
    const double middle = 0.5 * (from + to);
    const Vec3d here = direction(middle);
    const double half = std::max(length(direction(from) - here), length(direction(to) - here));
    if (depth < kDepth && half > 2 * (std::max(length(here - lobe_.axis) - half, 0.0) + lobe_.width)) {
      split_about_the_lobe(from, middle, depth + 1);
      split_about_the_lobe(middle, to, depth + 1);
    } else {
      intervals_.push_back(evaluated(from, to));
    }
  }

  Moments at(double t) const {
    const Vec3d w = direction(t);
    const double c = std::cos(t), s = std::sin(t);
    Vec3d moved;
    double constant = 1, first = c, second = s;
    if (piece_.is_arc) {
      const Vec3d p = place(t);
      const double distance = length(p);
      moved = cross(p, piece_.place.by_second * c - piece_.place.by_first * s) / distance / distance / distance;
    } else {
      // p = (1 - k) a + k b lies at the distance r along w: 1/r and the coordinates over r are linear in w.
      const double a = length(piece_.place.by_first), b = length(piece_.place.by_second), sine = std::sin(piece_.end);
      moved = across_;
      first = std::sin(piece_.end - t) / (a * sine);
      second = s / (b * sine);
      constant = first + second;
    }
    const Vec3d f = density_(w);
    const ByChannel one = {moved * f.x, moved * f.y, moved * f.z};
    return {one * constant, one * first, one * second};
  }

  Interval evaluated(double from, double to) const {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    Moments kronrod, gauss;
    for (const reference::KronrodNode& node : reference::kKronrodNodes) {
      const Moments value = at(middle + half * node.x);
      kronrod = kronrod + value * (node.kronrod * half);
      if (node.gauss > 0) gauss = gauss + value * (node.gauss * half);
    }
    return {from, to, kronrod, (kronrod + gauss * -1.0).largest()};
  }
  // Roundings of a very narrow lobe may never come within the tolerance: then the halvings end.
  Moments refined(const Interval& interval, double tolerance, int depth) {
    if (depth == kDepth || halvings_ == kMostHalvings || !(interval.error > tolerance)) return interval.value;
    ++halvings_;
    const double middle = 0.5 * (interval.from + interval.to);
    return refined(evaluated(interval.from, middle), tolerance, depth + 1) + refined(evaluated(middle, interval.to), tolerance, depth + 1);
  }

  OutlinePiece piece_;
  const ShadingPoint& at_;
  const LobeAxis& lobe_;
  const LobeDensity& density_;
  Vec3d along_a_, aside_, across_;
  std::vector<Interval> intervals_;
  int halvings_ = 0;
};

// The outline of each shape. The light lies relative to the point, which is the origin.
class OutlineIntegrals {
 public:
  OutlineIntegrals(const AreaLight& light, const ShadingPoint& at, const LobeAxis& lobe, const LobeDensity& density)
      : light_(light), at_(at), lobe_(lobe), density_(density) {}

  OutlineDerivatives operator()(const Polygon& polygon) {
    const PolygonLight stored = flat_polygon(light_);
    result_.by_vector.resize(polygon.vertices.size());
    for (const auto& hole : polygon.holes) result_.by_vector.resize(result_.by_vector.size() + hole.size());
    const PreparedPolygon prepared = prepare_polygon(stored);
    const int side = shapes::lit_side(prepared, {});
    if (side == 0) return std::move(result_);
    const std::vector<std::size_t> stored_index = stored_vertices(stored, prepared);
    for (std::size_t contour = 0; contour + 1 < prepared.contours.size(); ++contour) {
      const std::size_t first = prepared.contours[contour], end = prepared.contours[contour + 1];
      for (std::size_t i = first; i < end; ++i) {
        const std::size_t next = i + 1 < end ? i + 1 : first;
        // A prepared polygon runs clockwise as seen from its lit side.
        const Moments m = moments({{{}, prepared.vertices[i], prepared.vertices[next]}, false, 0, 0}, -side);
        move(stored_index[i], m, {0, 1, 0});
        move(stored_index[next], m, {0, 0, 1});
      }
    }
    return std::move(result_);
  }

  // The points of a disk move with its centre and axes.
  OutlineDerivatives operator()(const Ellipse& e) {
    result_.by_vector.resize(3);
    const double height = -dot(e.center, cross(e.x, e.y));
    if (height == 0 || (height < 0 && !light_.two_sided)) return std::move(result_);
    const Moments m = moments(whole({e.center, e.x, e.y}), height > 0 ? 1 : -1);
    move(0, m, {1, 0, 0});
    move(1, m, {0, 1, 0});
    move(2, m, {0, 0, 1});
    return std::move(result_);
  }

  // The sight lines touch the surface. So the points of the surface that are the outline now move it, wherever else it goes on the surface.
  OutlineDerivatives operator()(const Ellipsoid& e) {
    result_.by_vector.resize(4);
    const std::optional<Ellipse> outline = silhouette(e, {});
    if (!outline) return std::move(result_);
    const Moments m = moments(whole({outline->center, outline->x, outline->y}), 1);
    move(0, m, {1, 0, 0});
    const double volume = dot(cross(e.x, e.y), e.z);
    const auto coordinate = [&](Vec3d dual) {
      return Linear<double>{dot(dual, outline->center - e.center) / volume, dot(dual, outline->x) / volume, dot(dual, outline->y) / volume};
    };
    move(1, m, coordinate(cross(e.y, e.z)));
    move(2, m, coordinate(cross(e.z, e.x)));
    move(3, m, coordinate(cross(e.x, e.y)));
    return std::move(result_);
  }

  // Two arcs of the balls about the ends, and two straight pieces between them; or one circle, if one ball covers the rest.
  OutlineDerivatives operator()(const Capsule& c) {
    result_.by_vector.resize(2);
    if (!(distance_to_axis(c, {}) > c.radius)) return std::move(result_);
    const Vec3d span = c.end_b - c.end_a, axis = normalized(span);
    const Vec3d off_axis = c.end_a - axis * dot(c.end_a, axis);
    const double off = length(off_axis);
    if (axis == Vec3d{} || !(off > c.radius)) {
      const bool a_is_nearer = length(c.end_a) < length(c.end_b);
      add_ball(a_is_nearer ? 0 : 1, a_is_nearer ? c.end_a : c.end_b, c.radius, {}, {});
      return std::move(result_);
    }
    // The unit normals where a plane through the point touches the tube, on its two sides.
    const Vec3d down = off_axis / -off, aside = cross(axis, down);
    const double cosine = c.radius / off, sine = std::sqrt((1 - cosine) * (1 + cosine));
    const Vec3d left = down * cosine - aside * sine, right = down * cosine + aside * sine;
    add_ball(0, c.end_a, c.radius, left, right);
    add_straight(c, right, false);
    add_ball(1, c.end_b, c.radius, right, left);
    add_straight(c, left, true);
    return std::move(result_);
  }

  OutlineDerivatives operator()(const Line&) {
    result_.by_vector.resize(2);
    return std::move(result_);
  }

 private:
  static OutlinePiece whole(const Linear<Vec3d>& place) { return {place, true, 0, 2 * std::numbers::pi}; }

  // Moments with the part inside on the side that the sign tells, with the light's radiance.
  Moments moments(const OutlinePiece& piece, int sign) {
    const Moments m = PieceMoments(piece, at_, lobe_, density_).integral() * sign;
    const Vec3d& r = light_.radiance;
    const auto with_radiance = [&](const ByChannel& v) { return ByChannel{v[0] * r.x, v[1] * r.y, v[2] * r.z}; };
    const Moments result = {with_radiance(m.constant), with_radiance(m.first), with_radiance(m.second)};
    result_.position = result_.position + result.constant * -1.0;
    result_.turn = result_.turn + turned(piece.place.constant, result.constant) + turned(piece.place.by_first, result.first) +
                   turned(piece.place.by_second, result.second);
    return result;
  }
  void move(std::size_t which, const Moments& m, const Linear<double>& motion) {
    result_.by_vector[which] = result_.by_vector[which] + m.along(motion);
  }

  // The part of a ball's outline that runs from one unit normal to another, or all of it.
  void add_ball(std::size_t end, Vec3d center, double radius, Vec3d from, Vec3d to) {
    const double distance = length(center), cosine = radius / distance, sine = std::sqrt((1 - cosine) * (1 + cosine));
    const Frame frame = Frame::from_normal(center / -distance);  // z towards the point
    const Linear<Vec3d> normal = {frame.z * cosine, frame.x * sine, frame.y * sine};
    OutlinePiece piece = whole({center + normal.constant * radius, normal.by_first * radius, normal.by_second * radius});
    if (!(from == to)) {
      const auto angle = [&](Vec3d n) { return std::atan2(dot(n, frame.y), dot(n, frame.x)); };
      piece.begin = angle(from);
      piece.end = angle(to);
      if (piece.end < piece.begin) piece.end += 2 * std::numbers::pi;
    }
    const Moments m = moments(piece, 1);
    move(end, m, {1, 0, 0});
    result_.by_radius += m.along(normal);
  }
  void add_straight(const Capsule& c, Vec3d normal, bool back) {
    const Vec3d a = c.end_a + normal * c.radius, b = c.end_b + normal * c.radius;
    const Moments m = moments({{{}, back ? b : a, back ? a : b}, false, 0, 0}, 1);
    move(back ? 1 : 0, m, {0, 1, 0});
    move(back ? 0 : 1, m, {0, 0, 1});
    result_.by_radius += m.along(Linear<Vec3d>{normal, {}, {}});
  }

  const AreaLight& light_;
  const ShadingPoint& at_;
  const LobeAxis& lobe_;
  const LobeDensity& density_;
  OutlineDerivatives result_;
};

}  // namespace

OutlineDerivatives outline_derivatives(const AreaLight& light, const ShadingPoint& at, const LobeAxis& lobe, const LobeDensity& density) {
  double unit = 1;
  const AreaLight seen = methods::seen_from(light, at.position, &unit);
  OutlineDerivatives result = std::visit(OutlineIntegrals(seen, at, lobe, density), seen.shape);
  for (ByChannel& v : result.by_vector) v = v * (1 / unit);
  result.by_radius = result.by_radius / unit;
  result.position = result.position * (1 / unit);
  return result;
}

}  // namespace steradian
