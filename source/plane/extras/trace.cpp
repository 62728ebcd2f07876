#include "plane/extras/trace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "plane/exact/emission.h"
#include "plane/exact/mean_over_directions.h"
#include "plane/exact/outline.h"
#include "plane/extras/extras.h"

namespace steradian::plane {
namespace {

// Length of the part of a path within a body whose curves are given.
double length_within(const World& world, std::span<const Curve* const> curves, Vec2d from, Vec2d u, double way) {
  Curve ray;
  ray.a = from;
  ray.b = from + u;
  thread_local std::vector<double> cuts;
  cuts.assign(1, 0);
  if (way < 1e300) cuts.push_back(way);
  for (const Curve* c : curves) {
    const Crossings crossings = intersect(ray, *c);
    for (int k = 0; k < crossings.count; ++k)
      if (const double r = dot(crossings.at[k] - from, u); r > 0 && r < way) cuts.push_back(r);
  }
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    if (world.contains(static_cast<std::size_t>(curves[0]->body), from + u * (0.5 * (cuts[i] + cuts[i + 1])))) sum += cuts[i + 1] - cuts[i];
  return sum;
}

// Does a path meet a body? The test begins a little after the start: a body that the path starts on and leaves does not count.
bool meets(const World& world, std::span<const Curve* const> curves, Vec2d from, Vec2d u, double way) {
  const auto body = static_cast<std::size_t>(curves[0]->body);
  if (world.contains(body, from + u * 1e-7)) return true;
  return std::any_of(curves.begin(), curves.end(), [&](const Curve* c) {
    const RayHit hit = hit_curve(*c, from, u, c->body);
    return hit.curve != nullptr && hit.distance < way;
  });
}

}  // namespace

Start start_at(const World& world, Vec2d p) {
  const World::Around here = world.around(p);
  Start start;
  start.at = p;
  const auto matter_of = [&](int i) { return world.extras->matter[static_cast<std::size_t>(i)]; };
  const auto lit = [&](int i) { return world.scene.bodies[static_cast<std::size_t>(i)].light.has_value(); };
  start.dark = std::any_of(here.holders.begin(), here.holders.end(),
                           [&](int i) { return matter_of(i) != Matter::clear && matter_of(i) != Matter::deep && !lit(i); });
  if (start.dark) return start;
  const World::Around beside = world.off_outlines(here);
  start.at = beside.at;
  for (int i : beside.holders) {
    if (matter_of(i) == Matter::deep)
      start.deep.push_back(i);
    else if (matter_of(i) != Matter::clear)
      start.light = i;
  }
  return start;
}

bool passes(const World& world, const Start& start, int body) {
  const Matter matter = world.extras->matter[static_cast<std::size_t>(body)];
  if (matter == Matter::clear) return true;
  return matter == Matter::deep && std::find(start.deep.begin(), start.deep.end(), body) != start.deep.end();
}

Vec3d passage(const World& world, const Start& start, std::span<const Curve* const> filters, Vec2d from, Vec2d u, double way) {
  Vec3d share{1, 1, 1};
  for (std::size_t first = 0, last = 0; first < filters.size(); first = last) {
    const int body = filters[first]->body;
    while (last < filters.size() && filters[last]->body == body) ++last;
    if (!passes(world, start, body)) continue;
    const PlaneBody& b = world.scene.bodies[static_cast<std::size_t>(body)];
    const auto curves = filters.subspan(first, last - first);
    if (b.light_depth > 0)
      share *= std::exp(-length_within(world, curves, from, u, way) / b.light_depth);
    else if (meets(world, curves, from, u, way))
      share = share * *b.transmittance;
  }
  return share;
}

namespace {

using std::numbers::pi;

// A direction after reflection at an edge.
Vec2d mirrored(const Curve& edge, Vec2d u) {
  const Vec2d along = (edge.b - edge.a) / length(edge.b - edge.a);
  return along * (2 * dot(along, u)) - u;
}

}  // namespace

// The first curve that ends or reflects a ray. Among coincident edges it is a light's, else the last one in the file.
RayHit Tracer::first_hit(Vec2d from, Vec2d u, const Curve* but) const {
  RayHit best;
  best.distance = std::numeric_limits<double>::infinity();
  for (const Curve* c : curves_) {
    if (c == but || passes(world_, start_, c->body)) continue;
    const RayHit hit = hit_curve(*c, from, u, start_.light);
    if (hit.curve == nullptr) continue;
    const double slack = 1e-10 * hit.distance;
    const bool replaces = best.curve == nullptr || body_of(hit).light.has_value() >= body_of(best).light.has_value();
    if (hit.distance < best.distance - slack || (hit.distance < best.distance + slack && replaces)) best = hit;
  }
  return best;
}

// way: length from the eye to the hit, by a mirror if there is one. Within a light it does not count.
Vec3d Tracer::arriving(const RayHit& hit, Vec2d at, Vec2d u, double way) const {
  const PlaneEmission& light = *body_of(hit).light;
  if (hit.curve->body == start_.light) return radiance_at(light, from_);
  return radiance_along(*hit.curve, light, at - u * way, u, way) * std::exp(-world_.scene.fog_density * way);
}

// Radiance of a ray that hits nothing.
Vec3d Tracer::sky(Vec2d u, const PlaneSun* hard) const {
  if (start_.light >= 0) return {};
  // A mirror shows a sun without width in a different direction.
  if (hard != nullptr) return std::fabs(std::remainder(angle_of(u) - hard->direction, 2 * pi)) < 1e-9 ? hard->radiance : Vec3d{};
  Vec3d sum;
  for (const PlaneSun& sun : world_.scene.suns)
    if (std::fabs(std::remainder(angle_of(u) - sun.direction, 2 * pi)) < sun.half_width) sum += sun.radiance;
  return sum;
}

Vec3d Tracer::look(Vec2d u, const PlaneSun* hard) const {
  const RayHit hit = first_hit(from_, u, nullptr);
  const Vec3d share = passage(world_, start_, curves_, from_, u, hit.distance);
  if (hit.curve == nullptr) return share * sky(u, hard);
  const PlaneBody& body = body_of(hit);
  const Vec2d at = from_ + u * hit.distance;
  if (body.light) return hard != nullptr ? Vec3d{} : share * arriving(hit, at, u, hit.distance);
  if (!body.mirror) return {};
  const Vec2d back = mirrored(*hit.curve, u);
  const RayHit next = first_hit(at, back, hit.curve);
  const Vec3d left = share * *body.mirror * passage(world_, start_, curves_, at, back, next.distance);
  if (next.curve == nullptr) return left * sky(back, hard);
  if (!body_of(next).light || hard != nullptr) return {};
  return left * arriving(next, at + back * next.distance, back, hit.distance + next.distance);
}

PlaneLight Tracer::hard_suns() const {
  PlaneLight sum;
  if (start_.dark || start_.light >= 0) return sum;
  std::vector<Vec2d> directions;
  for (const PlaneSun& sun : world_.scene.suns) {
    if (sun.half_width > 0) continue;
    const Vec2d to = direction_at(sun.direction);
    directions.assign(1, to);
    for (const Curve* c : curves_)
      if (world_.extras->matter[static_cast<std::size_t>(c->body)] == Matter::mirror) {
        const Vec2d u = mirrored(*c, to);
        // Parallel edges show it in the same direction.
        if (std::none_of(directions.begin(), directions.end(), [&](Vec2d d) { return length(d - u) < 1e-9; })) directions.push_back(u);
      }
    for (Vec2d u : directions) {
      const Vec3d arrives = look(u, &sun);
      sum.radiance += arrives;
      sum.moment_x += arrives * u.x;
      sum.moment_y += arrives * u.y;
    }
  }
  return sum;
}

PlaneLight traced_light(const World& world, Vec2d from, const PlaneSampling& sampling) {
  std::vector<const Curve*> curves;
  for (const Curve& c : world.curves) curves.push_back(&c);
  const Tracer tracer(world, curves, from);
  PlaneLight sum = mean_over_directions(from, sampling, [&](Vec2d u) { return tracer.radiance(u); });
  const PlaneLight suns = tracer.hard_suns();
  const double scale = 1 / (2 * pi);
  sum.radiance += suns.radiance * scale;
  sum.moment_x += suns.moment_x * scale;
  sum.moment_y += suns.moment_y * scale;
  return sum;
}

}  // namespace steradian::plane
