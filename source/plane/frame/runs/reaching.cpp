#include "plane/frame/runs/reaching.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/exact/outline.h"
#include "plane/frame/emitters.h"
#include "plane/frame/runs/overlap.h"

namespace steradian::plane {
namespace {

// Position of a point along a curve, from 0 at its start to 1 at its end; beyond 1 if it is not on the curve.
double place_on(const Curve& c, Vec2d p) {
  if (c.kind == Curve::Kind::segment) return dot(p - c.a, c.b - c.a) / dot(c.b - c.a, c.b - c.a);
  const Vec2d unit = c.ellipse.to_unit(p);
  const double turned = std::fmod(std::atan2(unit.y, unit.x) - c.tau0, 2 * std::numbers::pi);
  return (turned < 0 ? turned + 2 * std::numbers::pi : turned) / c.tau_span;
}

Vec2d middle_of(const Curve& c) { return c.kind == Curve::Kind::segment ? (c.a + c.b) * 0.5 : c.ellipse.at(c.tau0 + 0.5 * c.tau_span); }

class Finding {
 public:
  Finding(FrameScene& frame, const BlockerBins& bins, Budget& budget, const std::function<void(std::uint64_t)>& spend)
      : frame_(frame), world_(*frame.world), bins_(bins), budget_(budget), spend_(spend) {}

  void run() {
    frame_.interior.resize(world_.scene.bodies.size());
    for (std::size_t i = 0; i < world_.scene.bodies.size(); ++i) find(i);
  }

  void find(std::size_t i) {
    frame_.interior[i] = {};
    if (!body(i).light || world_.first_curve[i] == world_.first_curve[i + 1]) return;
    const Box2d& mine = world_.boxes[i];
    std::vector<std::size_t> others{i};
    const Vec2d middle = mine.center();
    bins_.for_each_within(frame_.blockers, middle, mine.radius(), [&](int k) {
      spend_(20);
      const std::size_t o = static_cast<std::size_t>(frame_.blockers[static_cast<std::size_t>(k)].body);
      if (!world_.boxes[o].meets(mine)) return;
      if (!may_be_inside(i, frame_.blockers[static_cast<std::size_t>(k)])) return;
      others.push_back(o);
    });
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    if (others.size() == 1) return;  // nothing inside: the light alone
    LightInterior& inside = frame_.interior[i];
    std::size_t reaching = 0;
    for (std::size_t o : others) reaching += world_.first_curve[o + 1] - world_.first_curve[o];
    spend_(20 * reaching);
    budget_.take_memory(world_.scene.name, "what reaches into its lights", reaching * (sizeof(Curve*) + sizeof(Curve)));
    const auto add = [&](std::size_t o) {
      for (std::size_t c = world_.first_curve[o]; c < world_.first_curve[o + 1]; ++c)
        if (o == i || may_reach_into(i, world_.curves[c])) inside.curves.push_back(&world_.curves[c]);
    };
    add(i);
    inside.own = inside.curves.size();
    for (std::size_t o : others)
      if (o != i) add(o);
    if (body(i).shape == PlaneBody::Shape::polygon) {
      inside.in_polygon = true;
      for (std::size_t c = inside.own; c < inside.curves.size(); ++c) add_parts_within(i, *inside.curves[c], inside.parts);
      inside.curves.resize(inside.parts.empty() ? 0 : inside.own);
      return;
    }
    const Curve& own = world_.curves[world_.first_curve[i]];
    inside.by_chords = is_full_circle(own) && std::all_of(inside.curves.begin(), inside.curves.end(), [&](const Curve* c) {
                         return c == &own || (c->kind == Curve::Kind::segment && !body(static_cast<std::size_t>(c->body)).light);
                       });
    if (inside.by_chords) {
      for (const Curve* c : inside.curves) {
        if (c == &own) continue;
        if (const std::optional<Curve> part = clipped_to_circle(*c, own.ellipse)) inside.chords.push_back(*part);
      }
      return;
    }
    inside.by_parts = is_full_circle(own) && std::all_of(inside.curves.begin(), inside.curves.end(), [&](const Curve* c) {
                        return c->kind == Curve::Kind::segment || is_full_circle(*c);
                      });
    if (!inside.by_parts) return;
    for (const Curve* c : inside.curves) {
      if (c == &own) continue;
      const std::optional<Curve> part =
          c->kind == Curve::Kind::segment ? clipped_to_circle(*c, own.ellipse) : circle_clipped_to_circle(*c, own.ellipse);
      if (part) inside.parts.push_back(*part);
    }
  }

 private:
  const PlaneBody& body(std::size_t i) const { return world_.scene.bodies[i]; }

  // Exact for round lights and among polygons; others use their boxes.
  bool may_be_inside(std::size_t light, const Blocker& b) {
    if (b.body == static_cast<int>(light)) return true;
    const Curve& curve = world_.curves[world_.first_curve[light]];
    if (b.kind == Blocker::Kind::convex && body(light).shape == PlaneBody::Shape::polygon) return reaches_into(light, b);
    if (!is_full_circle(curve)) return true;
    Emitter disk;
    disk.a = disk.b = disk.center = curve.ellipse.center;
    disk.radius = length(curve.ellipse.x);
    if (b.kind != Blocker::Kind::convex) return length(disk.center - b.center) < disk.radius + b.bound - kTouching;
    return overlaps(disk, &frame_.vertices[b.first], b.count);
  }

  bool may_reach_into(std::size_t light, const Curve& c) {
    if (body(light).shape != PlaneBody::Shape::polygon || c.kind != Curve::Kind::segment) return true;
    Blocker edge;
    edge.first = frame_.vertices.size();
    edge.count = 2;
    frame_.vertices.insert(frame_.vertices.end(), {c.a, c.b});
    const bool reaches = reaches_into(light, edge);
    frame_.vertices.resize(edge.first);
    return reaches;
  }

  // Adds the parts of a curve within a polygon, between its crossings with the outline.
  void add_parts_within(std::size_t polygon, const Curve& c, std::vector<Curve>& parts) {
    std::vector<double> cuts{0, 1};
    spend_(10 * (world_.first_curve[polygon + 1] - world_.first_curve[polygon]));
    for (std::size_t k = world_.first_curve[polygon]; k < world_.first_curve[polygon + 1]; ++k) {
      const Curve& edge = world_.curves[k];
      const Vec2d along = edge.b - edge.a;
      const Crossings crossings = intersect(c, edge);
      for (int i = 0; i < crossings.count; ++i) {
        const double at = dot(crossings.at[i] - edge.a, along) / dot(along, along);
        if (at >= -1e-9 && at <= 1 + 1e-9) cuts.push_back(std::clamp(place_on(c, crossings.at[i]), 0.0, 1.0));
      }
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      if (cuts[k] >= cuts[k + 1]) continue;
      const Curve part = part_of(c, cuts[k], cuts[k + 1]);
      if (world_.contains(polygon, middle_of(part))) parts.push_back(part);
    }
  }

  bool reaches_into(std::size_t polygon, const Blocker& b) {
    for (std::size_t k = 0; k < b.count; ++k) {
      const Vec2d p = frame_.vertices[b.first + k], q = frame_.vertices[b.first + (k + 1) % b.count];
      spend_(30 + 2 * (world_.first_curve[polygon + 1] - world_.first_curve[polygon]));
      if (world_.contains(polygon, p)) return true;
      for (std::size_t c = world_.first_curve[polygon]; c < world_.first_curve[polygon + 1]; ++c) {
        const Curve& edge = world_.curves[c];
        const Vec2d along = edge.b - edge.a, d = q - p;
        const bool apart = cross(along, p - edge.a) * cross(along, q - edge.a) > 0 || cross(d, edge.a - p) * cross(d, edge.b - p) > 0;
        if (!apart) return true;
      }
      if (b.count == 2) return world_.contains(polygon, q);
    }
    // The polygon lies within the body: nothing of the body's outline is inside it.
    return false;
  }

  FrameScene& frame_;
  const World& world_;
  const BlockerBins& bins_;
  Budget& budget_;
  const std::function<void(std::uint64_t)>& spend_;
};

}  // namespace

void find_interiors(FrameScene& frame, const BlockerBins& bins, Budget& budget, const std::function<void(std::uint64_t)>& spend) {
  Finding(frame, bins, budget, spend).run();
}

void find_interior(FrameScene& frame, std::size_t body, const BlockerBins& bins, Budget& budget,
                   const std::function<void(std::uint64_t)>& spend) {
  Finding(frame, bins, budget, spend).find(body);
}

}  // namespace steradian::plane
