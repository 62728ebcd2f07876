// Rays: stratified ones against the curves themselves, and ones that march along the signed distance.
#include <algorithm>
#include <cmath>

#include "plane/exact/emission.h"
#include "plane/exact/mean_over_directions.h"
#include "plane/exact/world.h"

namespace steradian::plane {
namespace {

const PlaneBody& body_of(const World& world, const Curve& c) { return world.scene.bodies[static_cast<std::size_t>(c.body)]; }

// Never more than the distance: exact for segments and circles; ellipses are scaled by the smaller half axis.
double distance_bound(const Curve& c, Vec2d p) {
  if (c.kind == Curve::Kind::segment) return distance_to_segment(p, c.a, c.b);
  const double xx = dot(c.ellipse.x, c.ellipse.x), yy = dot(c.ellipse.y, c.ellipse.y), xy = dot(c.ellipse.x, c.ellipse.y);
  // Smaller singular value of [x y].
  const double half = 0.5 * (xx + yy), small2 = half - std::sqrt(std::max(half * half - (xx * yy - xy * xy), 0.0));
  return std::fabs(length(c.ellipse.to_unit(p)) - 1) * std::sqrt(std::max(small2, 0.0));
}

}  // namespace

PlaneLight sampled_light(const World& world, Vec2d from, const PlaneSampling& sampling) {
  const int inside = world.inside(from).body;
  return mean_over_directions(from, sampling, [&](Vec2d u) -> Vec3d {
    const RayHit hit = world.grid.first_hit(from, u, inside);
    if (hit.curve == nullptr || !body_of(world, *hit.curve).light) return {};
    const PlaneEmission& light = *body_of(world, *hit.curve).light;
    if (hit.curve->body == inside) return radiance_at(light, from);
    return radiance_along(*hit.curve, light, from, u, hit.distance);
  });
}

// Hart, "Sphere tracing", 1996: step by the distance to the nearest surface until it is within a hundredth of a unit.
PlaneLight marched_light(const World& world, Vec2d from, const PlaneSampling& sampling) {
  constexpr double kHit = 0.01;
  constexpr int kMostSteps = 256;
  const int inside = world.inside(from).body;
  if (inside >= 0) return sampled_light(world, from, sampling);
  Box all;
  for (const Box& box : world.boxes) {
    all.add(box.low);
    all.add(box.high);
  }
  const double reach = length({std::max(from.x - all.low.x, all.high.x - from.x), std::max(from.y - all.low.y, all.high.y - from.y)});
  return mean_over_directions(from, sampling, [&](Vec2d u) -> Vec3d {
    double r = 0;
    for (int step = 0; step < kMostSteps && r <= reach; ++step) {
      const Vec2d p = from + u * r;
      double nearest = 1e300;
      const Curve* curve = nullptr;
      for (const Curve& c : world.curves) {
        const double d = distance_bound(c, p);
        if (d < nearest || (d == nearest && body_of(world, c).light)) nearest = d, curve = &c;
      }
      if (curve == nullptr) return {};
      if (nearest < kHit) {
        const auto& light = body_of(world, *curve).light;
        return light ? radiance_along(*curve, *light, from, u, std::max(r, kHit)) : Vec3d{};
      }
      r += nearest;
    }
    return {};
  });
}

}  // namespace steradian::plane
