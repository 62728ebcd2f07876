// The shadow pass for sixteen points at a time.
#include <algorithm>

#include "render/shadow/work.h"
#include "shapes/area_moments.h"

namespace steradian {

using shadow::Viewpoint;
using Seen = TileShadow::Seen;

// Finds the visible parts for up to sixteen slots. They are neighbours in the tile's order, so that they see nearly the same edges.
void ShadowPass::find_lanes(const LightSide* const* sides, const std::uint32_t* slots, std::size_t count, Work& work) const {
  shadow::PointLanes::Point points[shadow::kPoints];
  RayScene::Sixteen rays;
  std::uint32_t asked = 0, whole = 0;
  const auto bit = [](std::size_t lane) { return 1u << lane; };
  for (std::size_t k = 0; k < count; ++k) {
    const LightSide& side = *sides[k];
    const Viewpoint& at = work.at(slots[k]);
    const bool simple = side.middle && dot(*side.middle - at.position, at.normal) > 0 && !is_cut(side.frame, at);
    points[k] = {&side.frame, &at, !simple};
  }
  work.lanes.find(lanes_, work.group, work.turned ? work.base : sides[0]->frame, work.turned, {points, count}, *sides[0]->outline);
  const std::uint32_t occluded = work.lanes.occluded(), found = work.lanes.found(), none = work.lanes.none();
  for (std::size_t k = 0; k < count; ++k) {
    const LightSide& side = *sides[k];
    const Viewpoint& at = work.at(slots[k]);
    const bool open = (occluded & bit(k)) == 0 && !points[k].arranged;
    if (!open && (none & bit(k)) != 0) {
      ++work.counts->points;
      continue;
    }
    if (!open && (found & bit(k)) == 0) {
      find_point(side, slots[k], work);
      continue;
    }
    ++work.counts->points;
    const double z = -side.frame.to_local(at.position).z;
    const Vec3d to = ((open ? *side.middle : work.lanes.place(k)) - at.position) * std::max((z - side.frame.eta) / z, 0.0);
    rays.set(k, at.position, to);
    asked |= bit(k);
    if (open || ((occluded & bit(k)) == 0 && !is_cut(side.frame, at))) whole |= bit(k);
  }
  const std::uint32_t free = asked & ~rays_.blocked_among(rays, asked);
  for (std::size_t k = 0; k < count; ++k)
    if ((free & bit(k)) != 0) work.result->seen[slots[k]] = (whole & bit(k)) != 0 ? Seen::whole : Seen::part;
  if ((free & ~whole) != 0) add_lanes(sides, slots, count, free & ~whole, work);
}

// Adds the edges of lanes that see a part of the light.
void ShadowPass::add_lanes(const LightSide* const* sides, const std::uint32_t* slots, std::size_t count, std::uint32_t lanes,
                           Work& work) const {
  TileShadow::Batch& batch = work.result->batch_with_room();
  const std::size_t first = batch.slots.size();
  batch.slots.resize(first + shadow::kPoints, kNoSlot);
  batch.passes.resize(first + shadow::kPoints, 1.0f);
  const auto bits = static_cast<shadow::LaneBits>(lanes);
  float* edges = batch.visible.add_block(work.lanes.count_edges(lanes_, bits));
  work.lanes.write_edges(lanes_, bits, edges);
  std::size_t corners = 0;
  if (work.whole_outline) {
    for (const auto& c : with_contours(sides[0]->frame).contours) corners += c.size();
    batch.all.add_block(corners);
  }
  for (std::size_t k = 0; k < shadow::kPoints; ++k) {
    if ((lanes >> k & 1) == 0 || k >= count) {
      for (std::size_t i = 0; i < corners; ++i) batch.all.set_edge(first + k, i, {0, 1, 0}, {0, 1, 0});
      continue;
    }
    ++work.counts->parts;
    batch.slots[first + k] = slots[k];
    const LightSide& side = *sides[k];
    const Viewpoint& at = work.at(slots[k]);
    const Vec3d eye = side.frame.to_local(at.position);
    const double extent2 = side.frame.half_x * side.frame.half_x + side.frame.half_y * side.frame.half_y;
    const bool small = dot(eye, eye) > kNeverSmall * extent2;
    const auto set_elements = [&](packed::Pieces& pieces, const AreaMoments& moments) {
      if (small && moments.area > 0)
        pieces.set_elements(first + k, quarters_of(moments, side.frame.origin - at.position, side.frame.axes.x, side.frame.axes.y),
                            side.frame.axes.z * -moments.area);
    };
    AreaMoments visible, all;
    if (small) work.lanes.each_edge(k, [&](double ax, double ay, double bx, double by) { visible.add(ax, ay, bx, by); });
    set_elements(batch.visible, visible);
    if (corners == 0) continue;
    std::size_t number = 0;
    const auto corner = [&](const shadow::Corner& c) {
      return static_cast<Vec3f>(side.frame.axes.to_world({c.x - eye.x, c.y - eye.y, -eye.z}));
    };
    for (const auto& c : with_contours(side.frame).contours) {
      Vec3f last = corner(c.back());
      for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++) {
        const Vec3f next = corner(c[i]);
        batch.all.set_edge(first + k, number++, last, next);
        all.add(c[j].x, c[j].y, c[i].x, c[i].y);
        last = next;
      }
    }
    set_elements(batch.all, all);
  }
}

}  // namespace steradian
