#include "reference/past_occluders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "lobes/lobe.h"
#include "reference/gauss_kronrod.h"
#include "shapes/body.h"

namespace steradian::reference {
namespace {

using lobes::Lobe;
using lobes::LobeValue;

constexpr double kPi = std::numbers::pi;
constexpr double kUlp = std::numeric_limits<double>::epsilon();

// A half plane that begins at an axis through the point. Its directions are axis cos(theta) + across sin(theta), theta in [0, pi].
struct HalfPlane {
  Vec3d axis, across, normal;

  HalfPlane(const Frame& about, double azimuth)
      : axis(about.z), across(about.x * std::cos(azimuth) + about.y * std::sin(azimuth)), normal(cross(axis, across)) {}
  Vec3d direction(double theta) const { return axis * std::cos(theta) + across * std::sin(theta); }
};

// weight: 0 outside of the light. A contour that runs around a direction twice counts twice.
struct Angles {
  double begin, end, weight = 1;
};

// A segment in the plane of a half plane; x along the axis, y across it.
struct Section {
  struct Place {
    double x, y;
    double angle() const { return std::atan2(y, x); }
  };
  Place a, b;

  Place at(double t) const { return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t}; }
  Section part(double from, double to) const { return {at(from), at(to)}; }

  // Angles of the part on the half plane's side of the axis. None for a segment on the other side, and for one towards the point.
  std::optional<Angles> angles() const {
    if (a.y < 0 && b.y < 0) return {};
    const Place on_axis{at(a.y / (a.y - b.y)).x, 0};
    const double u = (a.y < 0 ? on_axis : a).angle(), v = (b.y < 0 ? on_axis : b).angle();
    if (u == v) return {};
    return Angles{std::min(u, v), std::max(u, v)};
  }
};

Section::Place place_in(const HalfPlane& h, Vec3d v) { return {dot(v, h.axis), dot(v, h.across)}; }

// The place where an edge crosses the half plane's plane; none if both ends are on one side. turns: +1 from the back to the front.
struct HalfPlaneCrossing {
  Section::Place place;
  int turns;
};
std::optional<HalfPlaneCrossing> crossing(const HalfPlane& h, Vec3d p, Vec3d q) {
  const double dp = dot(h.normal, p), dq = dot(h.normal, q);
  if ((dp < 0) == (dq < 0)) return {};
  const double wp = std::fabs(dq), wq = std::fabs(dp);
  return HalfPlaneCrossing{place_in(h, (p * wp + q * wq) / (wp + wq)), dp < 0 ? 1 : -1};
}

// The direction on a curve of [0, 1] that is nearest to another direction.
template <class Curve>
Vec3d nearest_on(const Curve& curve, int probes, Vec3d to) {
  const auto closeness = [&](double t) { return dot(normalized(curve(t)), to); };
  int best = 0;
  for (int i = 1; i <= probes; ++i)
    if (closeness(static_cast<double>(i) / probes) > closeness(static_cast<double>(best) / probes)) best = i;
  double low = std::max(best - 1.0, 0.0) / probes, high = std::min(best + 1.0, static_cast<double>(probes)) / probes;
  for (int i = 0; i < 60; ++i) {
    const double third = (high - low) / 3;
    if (closeness(low + third) < closeness(high - third))
      low += third;
    else
      high -= third;
  }
  return normalized(curve(0.5 * (low + high)));
}

// A light's surface, relative to the point.
class LitSurface {
 public:
  virtual ~LitSurface() = default;
  virtual bool shines() const = 0;  // towards the point
  virtual void add_angles(const HalfPlane& h, std::vector<Angles>& to) const = 0;
  // The angles of a segment that lie between the point and the surface.
  virtual void add_in_front(const HalfPlane& h, const Section& s, const std::vector<Angles>& lit, std::vector<Angles>& to) const = 0;
  // The light's direction that is nearest to another one. The outline of a body is smooth from there.
  virtual Vec3d nearest(Vec3d to) const = 0;
  // Corners at which the outline has kinks.
  virtual void add_corners(std::vector<Vec3d>&) const {}
  // Points whose convex hull contains the light.
  virtual void add_hull(std::vector<Vec3d>& to) const = 0;
};

// A polygon or an ellipse in a plane.
class FlatSurface : public LitSurface {
 public:
  FlatSurface(Vec3d normal, Vec3d place, bool two_sided) : normal_(normal), height_(dot(normal, place)), two_sided_(two_sided) {}

  bool shines() const final { return height_ < 0 || (height_ > 0 && two_sided_); }
  void add_in_front(const HalfPlane& h, const Section& s, const std::vector<Angles>&, std::vector<Angles>& to) const final {
    const auto depth = [&](Section::Place p) { return (dot(normal_, h.axis) * p.x + dot(normal_, h.across) * p.y) / height_; };
    const double a = depth(s.a), b = depth(s.b);
    if (a >= 1 && b >= 1) return;
    const double t = (1 - a) / (b - a);
    if (const auto angles = s.part(a < 1 ? 0 : t, b < 1 ? 1 : t).angles()) to.push_back(*angles);
  }

 protected:
  bool meets(Vec3d direction) const {
    std::vector<Angles> angles;
    add_angles(HalfPlane(Frame::from_normal(direction), 0), angles);
    return std::any_of(angles.begin(), angles.end(), [](const Angles& a) { return a.begin == 0; });
  }
  bool is_front() const { return height_ < 0; }
  Vec3d normal_;
  double height_;  // of the plane above the point; negative on the lit side

 private:
  bool two_sided_;
};

class PolygonSurface final : public FlatSurface {
 public:
  PolygonSurface(PreparedPolygon polygon, Vec3d from)
      : FlatSurface(polygon.normal, polygon.vertices.front() - from, polygon.two_sided), polygon_(std::move(polygon)) {
    for (Vec3d& v : polygon_.vertices) v = v - from;
  }

  // Counts the contours' turns from the end of the half plane that points away from the light's plane: nothing is lit there.
  void add_angles(const HalfPlane& h, std::vector<Angles>& to) const override {
    struct Step {
      double angle;
      int turns;
    };
    std::vector<Step> steps;
    each_edge([&](Vec3d p, Vec3d q) {
      if (const auto c = crossing(h, p, q); c && c->place.y >= 0) steps.push_back({c->place.angle(), c->turns});
    });
    const bool ascending = dot(normal_, h.axis) / height_ <= 0;
    std::sort(steps.begin(), steps.end(), [&](const Step& a, const Step& b) { return ascending ? a.angle < b.angle : a.angle > b.angle; });
    const int sign = is_front() == ascending ? -1 : 1;
    int winding = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      winding += steps[i].turns * sign;
      const double here = steps[i].angle, next = i + 1 < steps.size() ? steps[i + 1].angle : ascending ? kPi : 0;
      if (winding != 0 && next != here) to.push_back({std::min(here, next), std::max(here, next), static_cast<double>(winding)});
    }
  }

  Vec3d nearest(Vec3d to) const override {
    if (meets(to)) return to;
    Vec3d best{};
    each_edge([&](Vec3d p, Vec3d q) {
      const Vec3d d = nearest_on([&](double t) { return p + (q - p) * t; }, 16, to);
      if (best == Vec3d{} || dot(d, to) > dot(best, to)) best = d;
    });
    return best;
  }
  void add_corners(std::vector<Vec3d>& to) const override { add_hull(to); }
  void add_hull(std::vector<Vec3d>& to) const override { to.insert(to.end(), polygon_.vertices.begin(), polygon_.vertices.end()); }

 private:
  template <class Use>
  void each_edge(const Use& use) const {
    for (std::size_t c = 0; c + 1 < polygon_.contours.size(); ++c)
      for (std::size_t i = polygon_.contours[c]; i < polygon_.contours[c + 1]; ++i)
        use(polygon_.vertices[i], polygon_.vertices[i + 1 < polygon_.contours[c + 1] ? i + 1 : polygon_.contours[c]]);
  }

  PreparedPolygon polygon_;
};

class EllipseSurface final : public FlatSurface {
 public:
  EllipseSurface(const Ellipse& e, Vec3d from, bool two_sided)
      : FlatSurface(normalized(cross(e.x, e.y)), e.center - from, two_sided), ellipse_{e.center - from, e.x, e.y} {}

  // The half plane's plane cuts center + x u + y v where a + b u + c v = 0.
  void add_angles(const HalfPlane& h, std::vector<Angles>& to) const override {
    const double a = dot(h.normal, ellipse_.center), b = dot(h.normal, ellipse_.x), c = dot(h.normal, ellipse_.y), r = std::hypot(b, c);
    if (!(std::fabs(a) < r)) return;
    const double nearest = -a / r, half = std::sqrt((1 - nearest) * (1 + nearest)), u = b / r, v = c / r;
    const auto place = [&](double along) {
      return place_in(h, ellipse_.center + ellipse_.x * (u * nearest - v * along) + ellipse_.y * (v * nearest + u * along));
    };
    if (const auto angles = Section{place(-half), place(half)}.angles()) to.push_back(*angles);
  }
  Vec3d nearest(Vec3d to) const override {
    if (meets(to)) return to;
    return nearest_on([&](double t) { return at(2 * kPi * t); }, 256, to);
  }
  void add_hull(std::vector<Vec3d>& to) const override {
    for (const double u : {-1.0, 1.0})
      for (const double v : {-1.0, 1.0}) to.push_back(ellipse_.center + ellipse_.x * u + ellipse_.y * v);
  }

 private:
  Vec3d at(double angle) const { return ellipse_.center + ellipse_.x * std::cos(angle) + ellipse_.y * std::sin(angle); }

  Ellipse ellipse_;
};

// An ellipsoid or a tube. The axis must meet it.
class BodySurface final : public LitSurface {
 public:
  // The shape relative to the point.
  explicit BodySurface(const Shape& shape) : shape_(shape), body_(Body::of(shape)) {}

  bool shines() const override { return body_ && !body_->contains({}); }
  void add_angles(const HalfPlane& h, std::vector<Angles>& to) const override {
    to.push_back({0, last([&](double theta) { return meets(h.direction(theta)); }, kPi)});
  }
  // The body splits the segment's line into pieces that do not enter it. Each is before or behind it as a whole, where the body is seen.
  void add_in_front(const HalfPlane& h, const Section& s, const std::vector<Angles>& lit, std::vector<Angles>& to) const override {
    const auto in_space = [&](Section::Place p) { return h.axis * p.x + h.across * p.y; };
    const auto add = [&](double from, double until) {
      if (!(from < until)) return;
      const auto angles = s.part(from, until).angles();
      if (!angles || lit.empty() || !(angles->begin < lit.front().end)) return;
      const double theta = 0.5 * (angles->begin + std::min(angles->end, lit.front().end)), c = std::cos(theta), d = std::sin(theta);
      const double slope = (s.b.x - s.a.x) * d - (s.b.y - s.a.y) * c, t = (s.a.y * c - s.a.x * d) / slope;
      const Section::Place p = s.at(t);
      const auto span = body_->span({}, h.direction(theta));
      if (span && p.x * c + p.y * d < span->enters) to.push_back(*angles);
    };
    const auto inside = body_->span(in_space(s.a), in_space(s.b) - in_space(s.a));
    if (!inside || inside->leaves <= 0 || inside->enters >= 1) return add(0, 1);
    add(0, inside->enters);
    add(inside->leaves, 1);
  }
  Vec3d nearest(Vec3d to) const override {
    Vec3d within;
    if (const auto* c = std::get_if<Capsule>(&shape_))
      within = nearest_on([&](double t) { return c->end_a + (c->end_b - c->end_a) * t; }, 64, to);
    else
      within = normalized(std::get<Ellipsoid>(shape_).center);
    if (meets(to)) return to;
    const double reach = std::acos(std::clamp(dot(within, to), -1.0, 1.0));
    const Vec3d aside = normalized(to - within * dot(to, within));
    if (aside == Vec3d{}) return within;
    const auto towards = [&](double angle) { return normalized(within * std::cos(angle) + aside * std::sin(angle)); };
    return towards(last([&](double angle) { return meets(towards(angle)); }, reach));
  }
  void add_hull(std::vector<Vec3d>& to) const override {
    const Box3d& box = body_->box();
    for (int i = 0; i < 8; ++i)
      to.push_back({i & 1 ? box.low.x : box.high.x, i & 2 ? box.low.y : box.high.y, i & 4 ? box.low.z : box.high.z});
  }

 private:
  bool meets(Vec3d direction) const {
    const auto span = body_->span({}, direction);
    return span && span->enters > 0;
  }
  // The end of an interval that begins at 0.
  template <class Inside>
  static double last(const Inside& inside, double outside) {
    double in = 0, out = outside;
    for (int i = 0; i < 64 && in < out; ++i) {
      const double middle = 0.5 * (in + out);
      if (middle == in || middle == out) break;
      (inside(middle) ? in : out) = middle;
    }
    return in;
  }

  Shape shape_;
  std::optional<Body> body_;
};

Shape moved(Shape shape, Vec3d from) {
  if (auto* e = std::get_if<Ellipsoid>(&shape)) e->center -= from;
  if (auto* c = std::get_if<Capsule>(&shape)) c->end_a -= from, c->end_b -= from;
  return shape;
}

std::unique_ptr<LitSurface> surface_of(const AreaLight& light, Vec3d from) {
  if (const auto* e = std::get_if<Ellipse>(&light.shape)) return std::make_unique<EllipseSurface>(*e, from, light.two_sided);
  if (!std::holds_alternative<Polygon>(light.shape)) return std::make_unique<BodySurface>(moved(light.shape, from));
  PreparedPolygon polygon = prepare_polygon(flat_polygon(light));
  if (polygon.vertices.empty()) return nullptr;
  return std::make_unique<PolygonSurface>(std::move(polygon), from);
}

// True if the point lies in the triangle's plane, to the rounding of the corners; within: and inside the triangle.
bool touches(const Blocker& t, Vec3d from, bool& within) {
  const Vec3d a = t[0] - from, b = t[1] - from, c = t[2] - from, n = cross(b - a, c - a);
  const double size = length(n), largest = std::max({length(t[0]), length(t[1]), length(t[2]), length(from)});
  within = false;
  if (!(size > 0)) return true;
  if (std::fabs(dot(n, a)) > 8 * kUlp * largest * size) return false;
  constexpr double kInside = 1e-9;
  const double area = size * kInside;
  within = dot(cross(a, b), n) / size > area && dot(cross(b, c), n) / size > area && dot(cross(c, a), n) / size > area;
  return true;
}

// Finds triangles that block nothing of a light: behind the point, beside the rectangle around the light's hull in a plane before the
// point, or below a horizon.
class Shield {
 public:
  Shield(const LitSurface& light, const std::vector<Vec3d>& horizons) : horizons_(horizons) {
    std::vector<Vec3d> hull;
    light.add_hull(hull);
    Vec3d middle;
    for (const Vec3d& v : hull) middle += normalized(v);
    if (length(middle) < 1e-3) return;
    about_ = Frame::from_normal(normalized(middle));
    knows_ = true;
    for (const Vec3d& v : hull) {
      const Vec3d l = about_.to_local(v);
      if (!(l.z > 1e-6 * length(l))) knows_ = false;
      light_.add(Vec3d{l.x / l.z, l.y / l.z, 0});
    }
  }

  bool is_free(const Blocker& b) const {
    const auto all = [&](auto&& holds) { return holds(b[0]) && holds(b[1]) && holds(b[2]); };
    for (const Vec3d& plane : horizons_)
      if (all([&](Vec3d v) { return dot(v, plane) < 0; })) return true;
    if (!knows_ || all([&](Vec3d v) { return dot(v, about_.z) <= 0; })) return knows_;
    if (!all([&](Vec3d v) { return dot(v, about_.z) > 0; })) return false;
    Box3d box;
    for (const Vec3d& v : b) {
      const Vec3d l = about_.to_local(v);
      box.add(Vec3d{l.x / l.z, l.y / l.z, 0});
    }
    return !box.meets(light_);
  }

 private:
  const std::vector<Vec3d>& horizons_;
  Frame about_;
  Box3d light_;
  bool knows_ = false;
};

struct Integral {
  LobeValue value;
  double error = 0, magnitude = 0;  // weighted sums over the two scalars
  double boundary = 0;              // the lobe at the ends of the visible angles

  void add(const Integral& b, double factor) {
    value += b.value * factor;
    error += b.error * factor;
    magnitude += b.magnitude * factor;
    boundary += b.boundary * factor;
  }
};

class Slices {
 public:
  Slices(const LitSurface& light, std::vector<Blocker> blockers, std::vector<Vec3d> planes, const Lobe& lobe, const Frame& frame,
         const EmissionFactor& emission)
      : light_(light),
        blockers_(std::move(blockers)),
        planes_(std::move(planes)),
        lobe_(lobe),
        frame_(frame),
        emission_(emission),
        factors_(lobe.largest_factors()) {
    const lobes::LobeShape shape = lobe.shape();
    const Vec3d peak = normalized(frame.to_world(shape.peak));
    about_ = Frame::from_normal(light.nearest(peak));
    scale_ = std::clamp(2 * shape.width * std::min(length(shape.x), length(shape.y)), 1e-9, 1.0);
  }

  // Halves the range of azimuths with the largest error until the bound is small enough.
  Integral run(const ReferenceOptions& options) {
    std::vector<double> azimuths;
    for (int i = 0; i <= kFirst; ++i) azimuths.push_back(2 * kPi * i / kFirst);
    std::vector<Vec3d> corners;
    light_.add_corners(corners);
    for (const Blocker& b : blockers_) corners.insert(corners.end(), b.begin(), b.end());
    if (corners.size() <= kMostCorners)
      for (const Vec3d& c : corners) {
        const double azimuth = std::atan2(dot(c, about_.y), dot(c, about_.x));
        azimuths.push_back(azimuth < 0 ? azimuth + 2 * kPi : azimuth);
      }
    std::sort(azimuths.begin(), azimuths.end());
    for (std::size_t i = 0; i + 1 < azimuths.size(); ++i)
      if (azimuths[i] < azimuths[i + 1]) push(over(azimuths[i], azimuths[i + 1]));
    Integral sum = total();
    for (int round = 0; evaluations_ < options.max_evaluations && !heap_.empty(); ++round) {
      if (sum.error <= std::max(options.absolute_error, options.relative_error * weighted(sum.value))) {
        sum = total();  // running sums carry the rounding of all terms that were removed
        if (sum.error <= std::max(options.absolute_error, options.relative_error * weighted(sum.value))) break;
      }
      std::pop_heap(heap_.begin(), heap_.end());
      const Range worst = heap_.back();
      heap_.pop_back();
      const double middle = 0.5 * (worst.begin + worst.end);
      if (!(worst.begin < middle && middle < worst.end)) {  // the range is one number wide
        heap_.push_back(worst);
        break;
      }
      sum.add(worst.integral, -1);
      for (const auto& [begin, end] : {std::pair{worst.begin, middle}, std::pair{middle, worst.end}}) {
        const Range half = over(begin, end);
        sum.add(half.integral, 1);
        push(half);
      }
    }
    return total();
  }

 private:
  static constexpr int kFirst = 16;
  static constexpr std::size_t kMostCorners = 1024;

  // A range of azimuths.
  struct Range {
    double begin, end;
    Integral integral;
    friend bool operator<(const Range& a, const Range& b) { return a.integral.error < b.integral.error; }
  };

  double weighted(LobeValue v) const { return std::fabs(v.plain) * factors_.plain + std::fabs(v.fresnel) * factors_.fresnel; }

  void push(const Range& range) {
    heap_.push_back(range);
    std::push_heap(heap_.begin(), heap_.end());
  }
  Integral total() const {
    Integral sum;
    for (const Range& r : heap_) sum.add(r.integral, 1);
    return sum;
  }

  double error_of(const std::array<LobeValue, kKronrodPoints>& f, LobeValue kronrod, LobeValue gauss, double half) const {
    const LobeValue mean = kronrod * 0.5, difference = (kronrod - gauss) * half;
    LobeValue variation;
    for (std::size_t i = 0; i < f.size(); ++i)
      variation +=
          LobeValue{std::fabs(f[i].plain - mean.plain), std::fabs(f[i].fresnel - mean.fresnel)} * (kKronrodNodes[i].kronrod * half);
    return weighted(
        {error_estimate(std::fabs(difference.plain), variation.plain), error_estimate(std::fabs(difference.fresnel), variation.fresnel)});
  }

  Range over(double begin, double end) {
    Range range{begin, end, {}};
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
    std::array<LobeValue, kKronrodPoints> values;
    LobeValue kronrod, gauss;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const KronrodNode& node = kKronrodNodes[i];
      const Integral slice = along(HalfPlane(about_, middle + half * node.x));
      values[i] = slice.value;
      kronrod += slice.value * node.kronrod;
      gauss += slice.value * node.gauss;
      range.integral.add(slice, node.kronrod * half);
    }
    range.integral.error += error_of(values, kronrod, gauss, half);
    return range;
  }

  // The lobe over the visible angles of a half plane.
  Integral along(const HalfPlane& h) {
    lit_.clear(), blocked_.clear();
    light_.add_angles(h, lit_);
    Integral sum;
    if (lit_.empty()) return sum;
    double lowest = 0, highest = kPi;
    for (const Vec3d& plane : planes_) {
      const double turned = std::atan2(dot(plane, h.across), dot(plane, h.axis));
      const double shift = turned < -0.5 * kPi ? 2 * kPi : 0;
      lowest = std::max(lowest, turned + shift - 0.5 * kPi);
      highest = std::min(highest, turned + shift + 0.5 * kPi);
    }
    for (const Blocker& b : blockers_) {
      std::array<std::optional<HalfPlaneCrossing>, 3> c;
      for (std::size_t i = 0; i < 3; ++i) c[i] = crossing(h, b[i], b[(i + 1) % 3]);
      const std::size_t missed = !c[0] ? 0 : !c[1] ? 1 : 2;
      const auto &first = c[(missed + 1) % 3], &second = c[(missed + 2) % 3];
      if (!first || !second) continue;
      if (first->place.y < 0 && second->place.y < 0) continue;
      light_.add_in_front(h, {first->place, second->place}, lit_, blocked_);
    }
    std::sort(blocked_.begin(), blocked_.end(), [](const Angles& a, const Angles& b) { return a.begin < b.begin; });
    for (const Angles& lit : lit_) {
      double begin = std::max(lit.begin, lowest);
      const double end = std::min(lit.end, highest);
      for (const Angles& b : blocked_) {
        if (b.begin > begin) add_visible(h, begin, std::min(b.begin, end), lit.weight, sum);
        begin = std::max(begin, b.end);
      }
      add_visible(h, begin, end, lit.weight, sum);
    }
    return sum;
  }

  // Angles are scale sinh(w): near the axis, where the lobe may have its peak, they are dense.
  void add_visible(const HalfPlane& h, double begin, double end, double weight, Integral& sum) {
    if (!(begin < end)) return;
    struct Piece {
      double begin, end;
      int depth;
    };
    const auto lobe_at = [&](double w) -> LobeValue {
      const double theta = scale_ * std::sinh(w);
      const Vec3d direction = h.direction(theta);
      double factor = std::sin(theta) * scale_ * std::cosh(w);
      if (emission_) factor *= emission_(direction);
      return lobe_.evaluate(frame_.to_local(direction)) * factor;
    };
    for (const double theta : {begin, end}) sum.boundary += weighted(lobe_.evaluate(frame_.to_local(h.direction(theta)))) * std::sin(theta);
    std::vector<Piece> pieces = {{std::asinh(begin / scale_), std::asinh(end / scale_), 0}};
    Integral result;
    while (!pieces.empty()) {
      const Piece p = pieces.back();
      pieces.pop_back();
      const double middle = 0.5 * (p.begin + p.end), half = 0.5 * (p.end - p.begin);
      std::array<LobeValue, kKronrodPoints> values;
      LobeValue kronrod, gauss;
      for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = lobe_at(middle + half * kKronrodNodes[i].x);
        kronrod += values[i] * kKronrodNodes[i].kronrod;
        gauss += values[i] * kKronrodNodes[i].gauss;
      }
      evaluations_ += kKronrodPoints;
      const double error = error_of(values, kronrod, gauss, half), magnitude = weighted(kronrod * half);
      largest_ = std::max(largest_, magnitude);
      if (error <= 1e-12 * magnitude || error <= 1e-14 * largest_ || p.depth == kDeepest) {
        result.value += kronrod * half;
        result.error += error;
        result.magnitude += magnitude;
        continue;
      }
      pieces.push_back({middle, p.end, p.depth + 1});
      pieces.push_back({p.begin, middle, p.depth + 1});
    }
    sum.value += result.value * weight;
    sum.error += result.error * std::fabs(weight);
    sum.magnitude += result.magnitude * std::fabs(weight);
  }
  static constexpr int kDeepest = 20;

  const LitSurface& light_;
  const std::vector<Blocker> blockers_;
  const std::vector<Vec3d> planes_;
  const Lobe& lobe_;
  const Frame frame_;
  const EmissionFactor& emission_;
  const LobeValue factors_;
  Frame about_;
  double scale_;        // angle from the axis at which the lobe falls off
  double largest_ = 0;  // magnitude of a piece so far
  int evaluations_ = 0;
  std::vector<Range> heap_;
  std::vector<Angles> lit_, blocked_;
};

}  // namespace

ReferenceResult radiance_past(std::span<const Blocker> blockers, const AreaLight& light, const ShadingPoint& at, Vec3d horizon,
                              const Material& material, const ReferenceOptions& options, const EmissionFactor& emission) {
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  const Lobe lobe(lobes::in_frame(material, frame), frame.to_local(at.view));
  const std::unique_ptr<LitSurface> surface = surface_of(light, at.position);
  if (!lobe.above_surface() || !surface || !surface->shines()) return {};

  std::vector<Vec3d> planes = {at.normal, normalized(horizon)};
  for (const Vec3d& plane : lobe.ending_planes())
    if (!(plane == Vec3d{})) planes.push_back(frame.to_world(plane));
  std::vector<Blocker> free;
  double magnification = 1;
  for (const Blocker& b : blockers) {
    bool within;
    if (touches(b, at.position, within)) {
      const Vec3d n = normalized(cross(b[1] - b[0], b[2] - b[0]));
      if (const double side = dot(n, planes[1]); within && std::fabs(side) > 1e-12) planes.push_back(side > 0 ? n : -n);
      continue;
    }
    free.push_back({b[0] - at.position, b[1] - at.position, b[2] - at.position});
    for (int i = 0; i < 3; ++i) magnification = std::max(magnification, (length(at.position) + length(b[i])) / length(free.back()[i]));
  }
  const Shield shield(*surface, planes);
  std::erase_if(free, [&](const Blocker& b) { return shield.is_free(b); });
  Slices slices(*surface, std::move(free), std::move(planes), lobe, frame, emission);
  const Integral sum = slices.run(options);
  const Vec3d brightness = light.emission ? light.emission->intensity : light.radiance;
  const double scale = std::max({std::fabs(brightness.x), std::fabs(brightness.y), std::fabs(brightness.z)});
  const double rounding = kUlp * (4 * (8 + lobe.sensitivity()) * sum.magnitude + 4 * magnification * sum.boundary);
  return {lobe.radiance(sum.value) * brightness, (sum.error + rounding) * scale};
}

}  // namespace steradian::reference
