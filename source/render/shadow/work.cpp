// The shadow pass for the points of a group: sixteen at a time, before round lights, and one by one.
#include "render/shadow/work.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <utility>

#include "render/shadow/side.h"
#include "shadow/rays/shafts.h"
#include "shadow/region/light_frame.h"
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
    const bool simple = !work.in_parts_only && side.middle && dot(*side.middle - at.position, at.normal) > 0 && !is_cut(side.frame, at);
    points[k] = {&side.frame, &at, side.outline.get(), !simple};
  }
  work.lanes.find(lanes_, work.group, work.turned ? work.base : sides[0]->frame, work.turned, {points, count});
  const std::uint32_t occluded = work.lanes.occluded(), found = work.lanes.found(), none = work.lanes.none(), thin = work.lanes.thin();
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
    rays.set(k, at.position, side.frame.way(at.position, open ? *side.middle : work.lanes.place(k)));
    asked |= bit(k);
    if (open || (!work.in_parts_only && (occluded & bit(k)) == 0 && !is_cut(side.frame, at))) whole |= bit(k);
  }
  const std::uint32_t free = asked & ~rays_.blocked_among(rays, asked);
  for (std::size_t k = 0; k < count; ++k) {
    if ((free & bit(k)) != 0) work.result->seen[slots[k]] = (whole & bit(k)) != 0 ? Seen::whole : Seen::part;
    if ((thin & (none | asked) & ~free & bit(k)) == 0) continue;
    const Vec3d from = work.at(slots[k]).position;
    if (!rays_.between(from, from + sides[k]->frame.way(from, work.lanes.thin_place(k)))) find_point(*sides[k], slots[k], work);
  }
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

// The shadow pass for round lights: each point sees a polygon of its own.

using shadow::LightFrame;
using shadow::Shaft;
using shadow::Viewpoint;
using Seen = TileShadow::Seen;

namespace {

// Beside a tube, its polygon's plane is that of the rectangle between the ends (shadow::parts_of_tube). In the directions of an end, plane
// and part differ near the end alone: rays that graze the end of radius r meet the plane within r (1 + s / d) of it, for a point at
// distance d from the axis and s along it from the end. With s / d of at most kOblique that is 4 r, and half as much again is a margin.
constexpr double kEndReach = 6, kOblique = 3;

bool is_near_end(const Capsule& tube, const Box3d& box) {
  const Vec3d reach = Box3d::all(kEndReach * tube.radius);
  return box.meets({tube.end_a - reach, tube.end_a + reach}) || box.meets({tube.end_b - reach, tube.end_b + reach});
}

// True for points beyond an end, and for those that see the tube nearly along its axis.
bool is_oblique(const Capsule& tube, Vec3d position) {
  const Vec3d axis = tube.end_b - tube.end_a, to = position - tube.end_a;
  const double size = length(axis);
  if (!(size > 0)) return true;
  const double along = dot(to, axis) / size, across = length(to - axis * (along / size));
  return along < 0 || along > size || std::max(along, size - along) > kOblique * across;
}

Box3d box_around(const std::vector<Vec3d>& positions) {
  Box3d box;
  for (const Vec3d& p : positions) box.add(p);
  return box;
}

}  // namespace

void ShadowPass::find_round(const PointGroups& groups, const PackLight& light, const Flat& flat, Work& work) const {
  work.whole_outline = true;
  work.turned = true;
  work.flat = &flat;
  work.tube = std::get_if<Capsule>(&light.area->shape);
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
    std::optional<Shaft> together;
    if (behind) together.emplace(*behind, work.positions, work.up, shadow::Sections::anywhere);
    work.gathered = false;
    for (const auto& slots : with_light) find_round_group(light, flat, slots, together ? &*together : nullptr, work);
  }
}

// Fills work.tile with the edges and triangles that points with a view of a round light need.
void ShadowPass::gather_round(const Flat& flat, const Shaft& shaft, Work& work) const {
  tree_.gather(packs_, shaft, work.edges);
  // The planes differ from point to point: any triangle near the light may cross one of them.
  work.find_crossing(shaft, mesh_, flat.near);
  work.tile.assign(mesh_, work.base, work.edges, work.crossing, flat.inside);
}

void ShadowPass::find_round_group(const PackLight& light, const Flat& flat, const std::vector<std::uint32_t>& slots, const Shaft* together,
                                  Work& work) const {
  work.take(slots);
  const std::optional<LightFrame> behind = shadow::frame_behind(*light.area, work.positions);
  const shadow::Ball ball = shadow::ball_around(*light.area);
  const Box3d box = box_around(work.positions);
  const int axis = box.longest_side();
  if (!behind && together == nullptr && coordinate(box.size(), axis) > ball.radius) {
    // The group is too wide for a frame behind the light, but its halves may have one.
    const double middle = coordinate(box.center(), axis);
    std::array<std::vector<std::uint32_t>, 2> halves;
    for (const std::uint32_t i : slots) halves[coordinate(work.at(i).position, axis) < middle ? 0 : 1].push_back(i);
    for (const auto& half : halves)
      if (!half.empty()) find_round_group(light, flat, half, nullptr, work);
    return;
  }
  const Shaft shaft = behind ? Shaft(*behind, work.positions, work.up, shadow::Sections::anywhere)
                             : Shaft(ball.center, shadow::reach_of_polygon(*light.area), work.positions, work.up);
  work.cut_outs = meets_cut_outs(shaft);
  work.find_crossing(shaft, mesh_, flat.near);
  const std::vector<std::uint32_t>& crossing = work.crossing;
  const auto crowds_end = [&](std::uint32_t t) { return is_near_end(*work.tube, shadow::box_of(mesh_, t)); };
  work.in_parts = work.tube != nullptr && !crossing.empty() &&
                  (std::any_of(crossing.begin(), crossing.end(), crowds_end) ||
                   std::any_of(slots.begin(), slots.end(), [&](std::uint32_t i) { return is_oblique(*work.tube, work.at(i).position); }));
  std::deque<LightSide> sides;  // find_group keeps addresses
  const SideAt side_at = [&](std::uint32_t i) {
    std::optional<LightSide> side = side_of_round(light, *flat.body, work.at(i).position, ellipse_);
    if (side) sides.push_back(std::move(*side));
    return side ? &sides.back() : nullptr;
  };
  if (is_taken(slots, work.base, &flat, shaft, flat.near, side_at, work)) return;
  if (together == nullptr || !std::exchange(work.gathered, true)) gather_round(flat, together != nullptr ? *together : shaft, work);
  work.group.assign_needed(packs_, mesh_, work.tile, work.base, shaft);
  find_group(slots, side_at, work);
}

// The shadow pass for a single point.

namespace {

constexpr std::size_t kMostSegments = 2048;  // a point that sees more takes rays, unless exact is asked for
constexpr double kLift = 1e-6;               // integrals are computed in float

}  // namespace

using shadow::Viewpoint;
using Seen = TileShadow::Seen;

void ShadowPass::take_rays(const LightSide& side, std::uint32_t slot, Work& work) const {
  ++work.counts->fallback;
  work.result->seen[slot] = Seen::share;
  work.result->share[slot] = static_cast<float>(share_by_rays(rays_, side, work.at(slot)));
}

// Finds the visible part of a tube that stands close to triangles, in its flat parts. Their edges are drawn into the plane of its side.
void ShadowPass::find_in_tube(const LightSide& side, const std::vector<LightSide>& parts, std::uint32_t slot, Work& work) const {
  const Viewpoint& at = work.at(slot);
  const Vec3d eye = side.frame.to_local(at.position);
  work.visible.clear();
  work.all.clear();
  bool is_whole = true;
  for (const LightSide& part : parts) {
    shadow::SegmentSet& set = work.scratch.set;
    work.group.see_turned(packs_, work.base, part.frame, at, *part.outline, set);
    if (set.occluders > kMostSegments && mode_ != Shadows::exact) {
      take_rays(side, slot, work);
      return;
    }
    if (set.occluders == 0) shadow::add_surroundings(part.frame, at, *part.outline, set);
    find_visible_on_packs(packs_, part.frame, at.position, RayBlockers(rays_), work.scratch, work.region);
    is_whole = is_whole && set.occluders == 0 && !work.region.boundary.empty() && !is_cut(part.frame, at);
    const auto drawn = [&](double x, double y) {
      const Vec3d p = side.frame.to_local(part.frame.to_world({x, y, 0}));
      const double t = -eye.z / std::max(p.z - eye.z, -1e-6 * eye.z);
      return shadow::Corner{eye.x + (p.x - eye.x) * t, eye.y + (p.y - eye.y) * t};
    };
    const auto add = [&](std::vector<Work::PlaneEdge>& to, double ax, double ay, double bx, double by) {
      const shadow::Corner a = drawn(ax, ay), b = drawn(bx, by);
      to.push_back({a.x, a.y, b.x, b.y});
    };
    const double x = part.frame.box_x / shadow::kCells, y = part.frame.box_y / shadow::kCells;
    for (const shadow::Boundary& b : work.region.boundary) add(work.visible, b.ax * x, b.ay * y, b.bx * x, b.by * y);
    for (const auto& c : part.frame.contours)
      for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++) add(work.all, c[j].x, c[j].y, c[i].x, c[i].y);
  }
  if (is_whole)
    work.result->seen[slot] = Seen::whole;
  else if (!work.visible.empty())
    add_part(side, slot, work);
}

// Finds the visible part; work.scratch holds the point's segments.
void ShadowPass::find_in_segments(const LightSide& side, std::uint32_t slot, Work& work) const {
  const Viewpoint& at = work.at(slot);
  find_visible_on_packs(packs_, side.frame, at.position, RayBlockers(rays_), work.scratch, work.region);
  if (work.region.boundary.empty()) return;
  if (work.scratch.set.occluders == 0 && !work.in_parts_only && !is_cut(side.frame, at)) {
    work.result->seen[slot] = Seen::whole;
    return;
  }
  work.visible.clear();
  work.all.clear();
  const double x = side.frame.box_x / shadow::kCells, y = side.frame.box_y / shadow::kCells;
  for (const shadow::Boundary& b : work.region.boundary) work.visible.push_back({b.ax * x, b.ay * y, b.bx * x, b.by * y});
  if (work.whole_outline)
    for (const auto& c : with_contours(side.frame).contours)
      for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++) work.all.push_back({c[j].x, c[j].y, c[i].x, c[i].y});
  add_part(side, slot, work);
}

// Adds the part of the light whose edges are in work.visible, of the outline in work.all.
void ShadowPass::add_part(const LightSide& side, std::uint32_t slot, Work& work) const {
  const Viewpoint& at = work.at(slot);
  ++work.counts->parts;
  work.result->seen[slot] = Seen::part;
  TileShadow::Part part;
  part.slot = slot;
  const Vec3d eye = side.frame.to_local(at.position);
  // Makes an outline of edges between places in the light's plane. Its edges are relative to the point.
  const auto outline_of = [&](const std::vector<Work::PlaneEdge>& all) {
    TileShadow::Outline outline;
    std::vector<TileShadow::Edge>& edges = work.result->edges;
    outline.first = edges.size();
    AreaMoments moments;
    const auto corner = [&](double x, double y) { return static_cast<Vec3f>(side.frame.axes.to_world({x - eye.x, y - eye.y, -eye.z})); };
    for (const auto& [ax, ay, bx, by] : all) {
      moments.add(ax, ay, bx, by);
      edges.push_back({corner(ax, ay), corner(bx, by)});
    }
    outline.count = edges.size() - outline.first;
    const double extent2 = side.frame.half_x * side.frame.half_x + side.frame.half_y * side.frame.half_y;
    if (moments.area > 0 && dot(eye, eye) > kNeverSmall * extent2) {
      outline.elements = quarters_of(moments, side.frame.origin - at.position, side.frame.axes.x, side.frame.axes.y);
      outline.area = side.frame.axes.z * -moments.area;
    }
    return outline;
  };
  part.visible = outline_of(work.visible);
  // Edges are lifted to the horizon, so that no rounding puts one below it.
  for (std::size_t i = part.visible.first; i < part.visible.first + part.visible.count; ++i)
    for (Vec3f* v : {&work.result->edges[i].a, &work.result->edges[i].b}) {
      const auto d = static_cast<Vec3d>(*v);
      const double least = kLift * length(d), height = dot(d, at.normal);
      if (height < least) *v = static_cast<Vec3f>(d + at.normal * (least - height));
    }
  if (!work.all.empty()) part.all = outline_of(work.all);
  work.result->parts.push_back(part);
}

void ShadowPass::find_point(const LightSide& side, std::uint32_t slot, Work& work) const {
  const Viewpoint& at = work.at(slot);
  ++work.counts->points;
  if (work.in_parts) {
    find_in_tube(side, sides_of_tube(*work.tube, *work.flat->body, at.position), slot, work);
    if (work.cut_outs && work.result->seen[slot] != Seen::none) pass_cut_outs(side, slot, work);
    return;
  }
  shadow::SegmentSet& set = work.scratch.set;
  if (work.turned)
    work.group.see_turned(packs_, work.base, side.frame, at, *side.outline, set);
  else
    work.group.see(packs_, side.frame, at, *side.outline, set);
  if (set.occluders > kMostSegments && mode_ != Shadows::exact && !work.in_parts_only) {
    take_rays(side, slot, work);
    return;
  }
  // Without segments to arrange, one ray to any place of the light above the horizons decides.
  const auto sees = [&](Vec3d normal) { return dot(*side.middle - at.position, normal) > 0; };
  if (set.occluders == 0 && !work.in_parts_only && side.middle && sees(at.normal) && !is_cut(side.frame, at)) {
    if (!rays_.between(at.position, at.position + side.frame.way(at.position, *side.middle))) work.result->seen[slot] = Seen::whole;
  } else {
    if (set.occluders == 0) shadow::add_surroundings(side.frame, at, *side.outline, set);
    find_in_segments(side, slot, work);
  }
  if (work.cut_outs && work.result->seen[slot] != Seen::none) pass_cut_outs(side, slot, work);
}

// Applies the fraction that cut-outs let through of the light that a slot sees. For a part, work still holds its levels.
void ShadowPass::pass_cut_outs(const LightSide& side, std::uint32_t slot, Work& work) const {
  const Viewpoint& at = work.at(slot);
  const bool part = work.result->seen[slot] == Seen::part;
  const bool by_levels = part && work.tube == nullptr;  // a tube's parts have levels of their own
  const double share =
      by_levels ? share_past_cut_outs(rays_, side, at, work.scratch.set, work.region) : share_past_cut_outs(rays_, side, at);
  if (share == 1) return;
  if (part) {
    work.result->parts.back().passes = static_cast<float>(share);
  } else {
    work.result->seen[slot] = Seen::share;
    work.result->share[slot] = static_cast<float>(share);
  }
}

}  // namespace steradian
