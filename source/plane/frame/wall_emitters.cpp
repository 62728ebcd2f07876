#include "plane/frame/wall_emitters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plane/frame/emitters.h"
#include "plane/frame/runs/runs.h"

namespace steradian::plane {
namespace {

Emitter edge_of(const World& world, const Element& element) {
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

Emitter arc_of(const Curve& curve, const Element& element) {
  Emitter e;
  e.kind = Emitter::Kind::arc;
  e.ellipse = curve.ellipse;
  e.a = e.b = e.center = curve.ellipse.center;
  const double xx = dot(curve.ellipse.x, curve.ellipse.x), yy = dot(curve.ellipse.y, curve.ellipse.y);
  e.radius = e.bound = is_round(curve.ellipse) ? std::sqrt(xx) : std::sqrt(xx + yy);
  e.tau0 = curve.tau0 + curve.tau_span * element.from;
  e.tau_span = curve.tau_span * (element.to - element.from);
  e.ramp = element.along / element.half;
  e.radiance.a = element.constant + element.slope * dot(e.ramp, e.center - element.middle);
  e.radiance.b = element.slope;
  return e;
}

}  // namespace

std::vector<Emitter> wall_emitters(const PlaneBounces::Impl& bounces, WallLight what) {
  const World& world = *bounces.world;
  std::vector<Emitter> result;
  for (const Element& given : bounces.elements.all()) {
    Element element = given;
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
