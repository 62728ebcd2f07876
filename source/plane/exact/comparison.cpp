// The methods of the plane for comparison: the literature's heuristic `par`, and rays, `sampled` and `marched`.
//
// Qiu, "Probabilistic Angular Radiance": the published heuristic, as written.
//
// Every body is the convex hull of its outline, represented by the chord between its two tangent vertices. Two key rays decide which of two
// overlapping intervals is nearer. Other lights do not block. The paper leaves two points open: if a key ray is endless, and how merged
// intervals merge again. Here key rays are segments (endless rays err by 22 %), and intervals are united repeatedly.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/exact/emission.h"
#include "plane/exact/mean_over_directions.h"
#include "plane/exact/world.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

struct SeenTangents {
  Vec2d first, second;  // relative to the point
  double begin, end;    // angles; end may exceed pi
};

double wrapped(double angle) { return angle - 2 * pi * std::floor((angle + pi) / (2 * pi)); }

// The vertices that represent a body: for arcs, the tangent points and the ends.
void add_vertices(const Curve& c, Vec2d from, std::vector<Vec2d>& out) {
  out.push_back(c.a - from);
  out.push_back(c.b - from);
  if (c.kind == Curve::Kind::segment) return;
  const Vec2d p = c.ellipse.to_unit(from);
  const double d = length(p);
  if (d <= 1) return;
  for (double sign : {-1.0, 1.0}) {
    double tau = angle_of(p) + sign * std::acos(1 / d);
    double along = tau - c.tau0;
    along -= 2 * pi * std::floor(along / (2 * pi));
    if (along <= c.tau_span) out.push_back(c.ellipse.at(tau) - from);
  }
}

bool tangents_of(const World& world, std::size_t body, Vec2d from, std::vector<Vec2d>& vertices, SeenTangents& out) {
  vertices.clear();
  for (std::size_t c = world.first_curve[body]; c < world.first_curve[body + 1]; ++c) {
    const Curve& curve = world.curves[c];
    // A whole circle has no ends: its tangent points are enough.
    const std::size_t before = vertices.size();
    add_vertices(curve, from, vertices);
    if (curve.kind == Curve::Kind::arc && curve.tau_span > 2 * pi - 1e-9 && vertices.size() > before + 2)
      vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(before), vertices.begin() + static_cast<std::ptrdiff_t>(before) + 2);
  }
  if (vertices.empty()) return false;
  Vec2d middle;
  for (Vec2d v : vertices) middle = middle + v / static_cast<double>(vertices.size());
  const double axis = angle_of(middle);
  double low = pi, high = -pi;
  for (Vec2d v : vertices) {
    const double angle = wrapped(angle_of(v) - axis);
    if (angle < low) low = angle, out.first = v;
    if (angle > high) high = angle, out.second = v;
  }
  if (high - low <= pi) {
    out.begin = axis + low;
    out.end = axis + high;
    return true;
  }
  // From within the hull every direction is covered. The extreme two are then those with the largest angle between them, which is at most
  // pi: in the paper it is the acos of a dot product.
  double widest = -1;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const double turn = std::atan2(cross(vertices[i], vertices[k]), dot(vertices[i], vertices[k]));
      if (turn <= widest) continue;
      widest = turn;
      out.first = vertices[i];
      out.second = vertices[k];
    }
  out.begin = angle_of(out.first);
  out.end = out.begin + widest;
  return true;
}

// Does the segment from the origin to `key` cross the segment a, b?
bool crosses(Vec2d key, Vec2d a, Vec2d b) {
  const double origin_side = cross(b - a, -a), key_side = cross(b - a, key - a);
  return cross(key, a) * cross(key, b) <= 0 && origin_side * key_side <= 0;
}

bool blocks(const SeenTangents& light, const SeenTangents& body, Interval<double> in_light, double begin, double end) {
  const bool body_within = begin > in_light.low && end < in_light.high;
  if (body_within) return !crosses(body.first, light.first, light.second) && !crosses(body.second, light.first, light.second);
  return crosses(light.first, body.first, body.second) || crosses(light.second, body.first, body.second);
}

}  // namespace

PlaneLight par_light(const World& world, Vec2d from, ParOverlaps overlaps) {
  PlaneLight sum;
  std::vector<Vec2d> vertices;
  std::vector<std::pair<bool, SeenTangents>> bodies(world.scene.bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!world.scene.bodies[i].light) bodies[i].first = tangents_of(world, i, from, vertices, bodies[i].second);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto& light = world.scene.bodies[i].light;
    SeenTangents seen;
    if (!light || !tangents_of(world, i, from, vertices, seen)) continue;
    const Interval<double> whole{seen.begin, seen.end};
    std::vector<Interval<double>> blocked;
    for (const auto& [present, body] : bodies) {
      if (!present) continue;
      for (double turn : {-2 * pi, 0.0, 2 * pi}) {
        const double begin = body.begin + turn, end = body.end + turn;
        if (end <= whole.low || begin >= whole.high) continue;
        if (blocks(seen, body, whole, begin, end)) blocked.push_back({std::max(begin, whole.low), std::min(end, whole.high)});
      }
    }
    // On a line, the repeated union of pairs is a sweep.
    std::sort(blocked.begin(), blocked.end(), [](Interval<double> a, Interval<double> b) { return a.low < b.low; });
    double dark = 0, reach = whole.low;
    for (const Interval<double>& b : blocked) {
      dark += std::max(b.high - std::max(b.low, reach), 0.0);
      if (overlaps == ParOverlaps::merged) reach = std::max(reach, b.high);
    }
    const Vec3d radiance = light->gradient ? radiance_at(*light, (light->gradient->from + light->gradient->to) * 0.5) : light->radiance;
    sum.radiance += radiance * (std::max(whole.high - whole.low - dark, 0.0) / (2 * pi));
  }
  return sum;
}

// Rays: stratified ones against the curves themselves, and ones that march along the signed distance.

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

PlaneLight sampled_light(const World& world, Vec2d from, int inside, const PlaneSampling& sampling) {
  return mean_over_directions(from, sampling, [&](Vec2d u) -> Vec3d {
    const RayHit hit = world.grid.first_hit(from, u, inside);
    if (hit.curve == nullptr || !body_of(world, *hit.curve).light) return {};
    const PlaneEmission& light = *body_of(world, *hit.curve).light;
    if (hit.curve->body == inside) return radiance_at(light, from);
    return radiance_along(*hit.curve, light, from, u, hit.distance);
  });
}

// Hart, "Sphere tracing", 1996: step by the distance to the nearest surface until it is within a hundredth of a unit.
PlaneLight marched_light(const World& world, Vec2d from, int inside, const PlaneSampling& sampling) {
  constexpr double kHit = 0.01;
  constexpr int kMostSteps = 256;
  if (inside >= 0) return sampled_light(world, from, inside, sampling);
  Box2d all;
  for (const Box2d& box : world.boxes) all.add(box);
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
