#include "plane/extras/passage.h"

#include <algorithm>
#include <cmath>

#include "plane/exact/intersect.h"
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
  Start start;
  for (int i : world.grid.bodies_near(p)) {
    const auto k = static_cast<std::size_t>(i);
    if (world.extras->matter[k] == Matter::clear || !world.boxes[k].holds(p) || !world.contains(k, p)) continue;
    if (world.extras->matter[k] == Matter::deep)
      start.deep.push_back(i);
    else if (world.scene.bodies[k].light)
      start.light = std::max(start.light, i);
    else
      start.dark = true;
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

}  // namespace steradian::plane
