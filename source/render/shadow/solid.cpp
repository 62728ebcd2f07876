// The shadow pass for solid lights: closed meshes that shine evenly, each of which has one outline.
#include "render/lights/solid_lights.h"
#include "render/shadow/work.h"

namespace steradian {

using shadow::LightFrame;
using shadow::Shaft;
using shadow::Viewpoint;
using Seen = TileShadow::Seen;

namespace {

// Points nearer to each other than this fraction of the light's radius see it alike, unless they are in its midst.
constexpr double kFarApart = 0.02;

Box3d box_of(const std::vector<Vec3d>& positions) {
  Box3d box;
  for (const Vec3d& p : positions) box.add(p);
  return box;
}

}  // namespace

// Gathers what the work's positions need for a solid light. Returns none if they see it exactly in no frame.
std::optional<LightSide> ShadowPass::gather_solid(const Solid& solid, Work& work) const {
  const std::vector<LightFrame> frames = shadow::frames_of(*solid.light, box_of(work.positions));
  work.viewers.take(work.positions);
  const auto frame = std::find_if(frames.begin(), frames.end(), [&](const LightFrame& f) {
    return edges_->triangles.is_open_beyond(f, work.viewers, solid.light->box, solid.own);
  });
  if (frame == frames.end()) return {};
  LightSide side;
  side.frame = *frame;
  side.outline = nothing_;
  const Shaft shaft(*frame, work.positions, work.up);
  tree_.gather(packs_, shaft, work.edges);
  const Vec3d x = frame->axes.x * frame->box_x, y = frame->axes.y * frame->box_y;
  Box3d around;
  for (const Vec3d& corner : {x + y, x - y, -x + y, -x - y}) around.add(frame->origin + corner);
  const Vec3d margin = Box3d::all(2 * frame->eta);
  work.crossing.clear();
  for (const std::uint32_t t : edges_->triangles.near({around.low - margin, around.high + margin}))
    if (shadow::crosses(mesh_, *frame, t) && shaft.needs_triangle(mesh_, t)) work.crossing.push_back(t);
  work.tile.assign(mesh_, *frame, work.edges, work.crossing);
  return side;
}

void ShadowPass::find_solid(const PointGroups& groups, const Solid& solid, Work& work) const {
  work.in_parts_only = true;
  for (const std::vector<std::uint32_t>& cluster : groups.clusters) {
    work.take({});
    for (const std::uint32_t g : cluster) work.add(groups.groups[g]);
    if (work.positions.empty()) continue;
    if (const std::optional<LightSide> together = gather_solid(solid, work)) {
      for (const std::uint32_t g : cluster) find_solid_group(groups.groups[g], *solid.light, *together, work);
      continue;
    }
    std::vector<std::vector<std::uint32_t>> without_frame(cluster.size());
    for (std::size_t g = 0; g < cluster.size(); ++g) without_frame[g] = find_solid_alone(groups.groups[cluster[g]], solid, work);
    std::vector<const std::vector<std::uint32_t>*> left;
    for (const auto& slots : without_frame)
      if (!slots.empty()) left.push_back(&slots);
    if (left.empty()) continue;
    for (const Flat& face : solid.faces)
      if (face.sides[0]) find_side(left, face.polygon, *face.sides[0], work);
  }
}

// Finds what the slots of a group see that has no frame in common with its neighbours. Returns the slots without any frame.
std::vector<std::uint32_t> ShadowPass::find_solid_alone(const std::vector<std::uint32_t>& slots, const Solid& solid, Work& work) const {
  work.take(slots);
  if (const std::optional<LightSide> side = gather_solid(solid, work)) {
    find_solid_group(slots, *solid.light, *side, work);
    return {};
  }
  const Box3d box = box_of(work.positions);
  const int axis = box.longest_side();
  if (slots.size() == 1 || !(coordinate(box.size(), axis) > kFarApart * solid.light->box.radius())) return slots;
  std::array<std::vector<std::uint32_t>, 2> halves;
  for (const std::uint32_t i : slots) halves[coordinate(work.at(i).position, axis) < coordinate(box.center(), axis) ? 0 : 1].push_back(i);
  std::vector<std::uint32_t> without_frame;
  for (const auto& half : halves) {
    if (half.empty()) continue;
    const std::vector<std::uint32_t> more = find_solid_alone(half, solid, work);
    without_frame.insert(without_frame.end(), more.begin(), more.end());
  }
  return without_frame;
}

void ShadowPass::find_solid_group(const std::vector<std::uint32_t>& all, const shadow::SolidLight& light, const LightSide& side,
                                  Work& work) const {
  std::vector<std::uint32_t> slots;
  for (const std::uint32_t i : all) {
    const Viewpoint& at = work.at(i);
    if (above_horizon(side.frame, at.position, at.normal) == Above::none) continue;
    work.result->seen[i] = Seen::none;
    if (at.geometric_normal && above_horizon(side.frame, at.position, *at.geometric_normal) == Above::none) continue;
    slots.push_back(i);
  }
  if (slots.empty()) return;
  work.take(slots);
  const Shaft shaft(side.frame, work.positions, work.up);
  work.cut_outs = meets_cut_outs(shaft);
  work.group.assign_needed(packs_, mesh_, work.tile, side.frame, shaft);
  work.group.add_light(mesh_, side.frame, light, shadow::contours_from(light, box_of(work.positions)));
  find_group(
      slots, [&](std::uint32_t) { return &side; }, work);
}

}  // namespace steradian
