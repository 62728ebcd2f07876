#include "reference/lit_surface.h"

#include <algorithm>
#include <numbers>

#include "shapes/body.h"

namespace steradian::reference {

Section::Place place_in(const HalfPlane& h, Vec3d v) { return {dot(v, h.axis), dot(v, h.across)}; }

std::optional<HalfPlaneCrossing> crossing(const HalfPlane& h, Vec3d p, Vec3d q) {
  const double dp = dot(h.normal, p), dq = dot(h.normal, q);
  if ((dp < 0) == (dq < 0)) return {};
  const double wp = std::fabs(dq), wq = std::fabs(dp);
  return HalfPlaneCrossing{place_in(h, (p * wp + q * wq) / (wp + wq)), dp < 0 ? 1 : -1};
}

namespace {

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
      const double here = steps[i].angle, next = i + 1 < steps.size() ? steps[i + 1].angle : ascending ? std::numbers::pi : 0;
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
    return nearest_on([&](double t) { return at(2 * std::numbers::pi * t); }, 256, to);
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
    to.push_back({0, last([&](double theta) { return meets(h.direction(theta)); }, std::numbers::pi)});
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

}  // namespace

std::unique_ptr<LitSurface> surface_of(const AreaLight& light, Vec3d from) {
  if (const auto* e = std::get_if<Ellipse>(&light.shape)) return std::make_unique<EllipseSurface>(*e, from, light.two_sided);
  if (!std::holds_alternative<Polygon>(light.shape)) return std::make_unique<BodySurface>(moved(light.shape, from));
  PreparedPolygon polygon = prepare_polygon(flat_polygon(light));
  if (polygon.vertices.empty()) return nullptr;
  return std::make_unique<PolygonSurface>(std::move(polygon), from);
}

}  // namespace steradian::reference
