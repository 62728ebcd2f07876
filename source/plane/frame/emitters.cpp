#include "plane/frame/emitters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "plane/frame/runs/runs.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

// In the space where an ellipse is round, floats lose precision with the ratio of its half axes: 1e-7 times this in a direction.
constexpr double kThinnestEmitter = 60;

// An arc on which the gradient lies between two stops: radiance runs from one to the other.
void set_ramp(const PlaneGradient& g, Emitter& arc) {
  const Vec2d along = g.to - g.from;
  const double length2 = dot(along, along);
  const auto offset = [&](Vec2d at) { return length2 > 0 ? dot(at - g.from, along) / length2 : 0; };
  const double t = offset(arc.ellipse.at(arc.tau0 + 0.5 * arc.tau_span));
  auto next = std::find_if(g.stops.begin(), g.stops.end(), [&](const PlaneStop& stop) { return t < stop.offset; });
  const auto before = next == g.stops.begin() ? next : next - 1;
  if (next == g.stops.end()) next = before;
  arc.radiance = {before->radiance, next->radiance};
  if (before == next) return;
  const double width = next->offset - before->offset;
  arc.ramp = along / (length2 * width);
  arc.ramp_at_center = (offset(arc.ellipse.center) - before->offset) / width;
}

class Taking {
 public:
  Taking(const World& world, std::size_t body) : world_(world), body_(body), light_(*world.scene.bodies[body].light) {}

  std::optional<std::vector<Emitter>> run() {
    const bool plain = light_.profile == PlaneProfile::uniform && !light_.gradient && !light_.is_spot();
    for (std::size_t c = world_.first_curve[body_]; c < world_.first_curve[body_ + 1]; ++c) {
      const Curve& curve = world_.curves[c];
      if (curve.kind == Curve::Kind::segment) {
        add_edges(c, false);
      } else if (is_full_circle(curve) && plain) {
        Emitter e;
        e.a = e.b = curve.ellipse.center;
        e.radius = length(curve.ellipse.x);
        add(e);
      } else {
        if (stretch_of(curve.ellipse) > kThinnestEmitter) return {};
        add_arcs(curve);
      }
    }
    for (std::size_t c = world_.first_curve[body_ + 1]; c-- > world_.first_curve[body_];)
      if (world_.curves[c].kind == Curve::Kind::segment && world_.curves[c].two_sided) add_edges(c, true);
    return with_runs(world_, result_);
  }

 private:
  std::vector<double> cuts_of(const Curve& curve) const {
    return light_.gradient ? gradient_cuts(*light_.gradient, curve) : std::vector<double>{0, 1};
  }

  // Adds the edge, cut at the gradient's stops, so that radiance is linear on each part.
  void add_edges(std::size_t index, bool other_side) {
    const Curve& curve = world_.curves[index];
    const std::vector<double> cuts = cuts_of(curve);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const std::size_t k = other_side ? cuts.size() - 2 - i : i;
      const Curve part = part_of(curve, cuts[k], cuts[k + 1]);
      if (part.a == part.b) continue;
      Emitter e;
      e.kind = Emitter::Kind::edge;
      e.a = other_side ? part.b : part.a;
      e.b = other_side ? part.a : part.b;
      e.curve = index;
      e.radiance = radiance_ends(light_, e.a, e.b);
      add(e);
    }
  }

  void add_arcs(const Curve& curve) {
    const std::vector<double> cuts = cuts_of(curve);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      Curve part = part_of(curve, cuts[k], cuts[k + 1]);
      const bool whole = part.tau_span > 2 * pi - 1e-9;
      // If less than half the outline is visible from a point, that part is one piece.
      const int pieces = whole ? 1 : static_cast<int>(std::ceil(part.tau_span / pi - 1e-9));
      for (int i = 0; i < pieces; ++i) {
        Emitter e;
        e.kind = Emitter::Kind::arc;
        e.ellipse = part.ellipse;
        e.a = e.b = part.ellipse.center;
        e.radius = is_round(part.ellipse) ? length(part.ellipse.x)
                                          : std::sqrt(dot(part.ellipse.x, part.ellipse.x) + dot(part.ellipse.y, part.ellipse.y));
        e.whole = whole;
        e.tau_span = part.tau_span / pieces;
        e.tau0 = part.tau0 + i * e.tau_span;
        e.radiance = {light_.radiance, light_.radiance};
        if (light_.gradient) set_ramp(*light_.gradient, e);
        add(e);
      }
    }
  }

  void add(Emitter e) {
    const Vec2d along = e.b - e.a;
    const double size = length(along);
    e.body = static_cast<int>(body_);
    e.center = (e.a + e.b) * 0.5;
    e.bound = e.radius + 0.5 * size;
    if (size > 0) e.normal = Vec2d{along.y, -along.x} / size;
    e.range = light_.range;
    result_.push_back(e);
  }

  const World& world_;
  std::size_t body_;
  const PlaneEmission& light_;
  std::vector<Emitter> result_;
};

}  // namespace

bool is_round(const PlaneEllipse& e) {
  const double xx = dot(e.x, e.x);
  return std::fabs(xx - dot(e.y, e.y)) <= 1e-12 * xx && std::fabs(dot(e.x, e.y)) <= 1e-12 * xx;
}

double stretch_of(const PlaneEllipse& e) {
  const double sum = dot(e.x, e.x) + dot(e.y, e.y), det = cross(e.x, e.y);
  const double root = std::sqrt(std::max(sum * sum - 4 * det * det, 0.0));
  return std::sqrt((sum + root) / std::max(sum - root, 1e-300));
}

bool is_full_circle(const Curve& c) { return c.kind == Curve::Kind::arc && c.tau_span > 2 * pi - 1e-9 && is_round(c.ellipse); }

std::optional<std::vector<Emitter>> emitters_of(const World& world, std::size_t body) { return Taking(world, body).run(); }

namespace {

Emitter edge_of(const World& world, const BoundaryElement& element) {
  Emitter e;
  e.kind = Emitter::Kind::edge;
  const auto [a, b] = ends_of(world, element);
  e.a = element.back ? b : a;
  e.b = element.back ? a : b;
  e.center = element.middle;
  e.bound = element.half;
  e.normal = element.normal;
  const Vec3d at_from = element.constant - element.slope, at_to = element.constant + element.slope;
  e.radiance.a = element.back ? at_to : at_from;
  e.radiance.b = element.back ? at_from : at_to;
  return e;
}

Emitter arc_of(const Curve& curve, const BoundaryElement& element) {
  Emitter e;
  e.kind = Emitter::Kind::arc;
  e.ellipse = curve.ellipse;
  e.a = e.b = e.center = curve.ellipse.center;
  const double xx = dot(curve.ellipse.x, curve.ellipse.x), yy = dot(curve.ellipse.y, curve.ellipse.y);
  e.radius = e.bound = is_round(curve.ellipse) ? std::sqrt(xx) : std::sqrt(xx + yy);
  e.tau0 = curve.tau0 + curve.tau_span * element.from;
  e.tau_span = curve.tau_span * (element.to - element.from);
  e.ramp = element.along / (2 * element.half);
  e.ramp_at_center = dot(e.ramp, e.center - element.middle) + 0.5;
  e.radiance = {element.constant - element.slope, element.constant + element.slope};
  return e;
}

}  // namespace

std::vector<Emitter> wall_emitters(const PlaneBounces::Impl& bounces, WallLight what) {
  const World& world = *bounces.world;
  std::vector<Emitter> result;
  for (const BoundaryElement& given : bounces.elements.all()) {
    BoundaryElement element = given;
    if (what == WallLight::error) element.constant = given.error, element.slope = {};
    const Curve& curve = world.curves[element.curve];
    Emitter e = curve.kind == Curve::Kind::segment ? edge_of(world, element) : arc_of(curve, element);
    e.body = curve.body;
    e.curve = element.curve;
    e.wall = true;
    e.range = std::numeric_limits<double>::infinity();
    result.push_back(e);
  }
  return with_runs(world, result);
}

}  // namespace steradian::plane
