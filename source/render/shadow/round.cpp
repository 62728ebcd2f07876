// The shadow pass for round lights: each point sees a polygon of its own.
#include <algorithm>
#include <array>
#include <cmath>

#include "render/shadow/work.h"
#include "shadow/region/box.h"
#include "shadow/rays/round_shaft.h"

namespace steradian {

using shadow::coordinate;
using shadow::LightFrame;
using shadow::Shaft;
using shadow::Viewpoint;
using Seen = TileShadow::Seen;

namespace {

shadow::Box box_around(const std::vector<Vec3d>& positions) {
  shadow::Box box;
  for (const Vec3d& p : positions) box.add(p);
  return box;
}

}  // namespace

void ShadowPass::find_round(const PointGroups& groups, const PackLight& light, const Flat& flat, Work& work) const {
  work.whole_outline = true;
  work.turned = true;
  work.in_lanes = std::holds_alternative<Ellipsoid>(light.area->shape);
  const shadow::Ball ball = shadow::ball_around(*light.area);
  work.base.origin = ball.center;
  work.base.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const std::vector<std::uint32_t>& cluster : groups.clusters) {
    std::vector<std::vector<std::uint32_t>> with_light;
    work.take({});
    for (const std::uint32_t g : cluster) {
      work.slots.clear();
      for (const std::uint32_t i : groups.groups[g]) {
        const Viewpoint& at = work.at(i);
        if (dot(ball.center - at.position, at.normal) <= -ball.radius) continue;
        work.result->seen[i] = Seen::none;
        if (at.geometric_normal && dot(ball.center - at.position, *at.geometric_normal) <= -ball.radius) continue;
        work.slots.push_back(i);
      }
      work.add(work.slots);
      if (!work.slots.empty()) with_light.push_back(work.slots);
    }
    if (with_light.empty()) continue;
    // Gathers once for the cluster if one frame holds it; otherwise, each group gathers by itself.
    const std::optional<LightFrame> behind = shadow::frame_behind(*light.area, work.positions);
    const bool together = behind.has_value();
    if (together) gather_round(flat, Shaft(*behind, work.positions, work.up, shadow::Sections::anywhere), work);
    for (const auto& slots : with_light) find_round_group(light, flat, slots, together, work);
  }
}

// Fills work.tile with the edges and triangles that points with a view of a round light need.
void ShadowPass::gather_round(const Flat& flat, const Shaft& shaft, Work& work) const {
  tree_.gather(packs_, shaft, work.edges);
  // The planes differ from point to point: any triangle near the light may cross one of them.
  work.crossing.clear();
  for (const std::uint32_t t : flat.near)
    if (shaft.needs_triangle(mesh_, t)) work.crossing.push_back(t);
  work.tile.assign(mesh_, work.base, work.edges, work.crossing);
}

void ShadowPass::find_round_group(const PackLight& light, const Flat& flat, const std::vector<std::uint32_t>& slots, bool together,
                                  Work& work) const {
  work.take(slots);
  const std::optional<LightFrame> behind = shadow::frame_behind(*light.area, work.positions);
  const shadow::Ball ball = shadow::ball_around(*light.area);
  const shadow::Box box = box_around(work.positions);
  const int axis = longest_side(box);
  if (!behind && !together && coordinate(box.high - box.low, axis) > ball.radius) {
    // The group is too wide for a frame behind the light, but its halves may have one.
    const double middle = coordinate(box.low + box.high, axis) / 2;
    std::array<std::vector<std::uint32_t>, 2> halves;
    for (const std::uint32_t i : slots) halves[coordinate(work.at(i).position, axis) < middle ? 0 : 1].push_back(i);
    for (const auto& half : halves)
      if (!half.empty()) find_round_group(light, flat, half, false, work);
    return;
  }
  const Shaft shaft = behind ? Shaft(*behind, work.positions, work.up, shadow::Sections::anywhere)
                             : Shaft(ball.center, shadow::reach_of_polygon(*light.area), work.positions, work.up);
  work.cut_outs = meets_cut_outs(shaft);
  if (!together) gather_round(flat, shaft, work);
  work.group.assign_needed(packs_, mesh_, work.tile, work.base, shaft);
  std::array<std::optional<LightSide>, shadow::kPoints> sides;
  std::size_t next = 0;
  find_group(
      slots,
      [&](std::uint32_t i) {
        std::optional<LightSide>& side = sides[next];
        side = side_of_round(light, work.at(i).position, ellipse_);
        if (!side) return static_cast<const LightSide*>(nullptr);
        next = (next + 1) % sides.size();
        return static_cast<const LightSide*>(&*side);
      },
      work);
}

}  // namespace steradian
