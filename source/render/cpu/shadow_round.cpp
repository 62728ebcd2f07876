// The shadow pass before round lights: each point looks at a polygon of its own.
#include <array>
#include <numeric>

#include "render/cpu/shadow_work.h"
#include "shadow/round_shaft.h"

namespace steradian {

using shadow::LightFrame;
using shadow::Shaft;
using shadow::Viewpoint;
using Seen = TileShadow::Seen;

void ShadowPass::find_round(const SurfaceTile& tile, const PointGroups& groups, const PackLight& light, const Flat& flat,
                            Work& work) const {
  work.whole_outline = true;
  work.turned = true;
  work.in_lanes = std::holds_alternative<Ellipsoid>(light.area->shape);
  const shadow::Ball ball = shadow::ball_around(*light.area);
  work.base.origin = ball.center;
  work.base.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const std::vector<std::uint32_t>& cluster : groups.clusters) {
    std::vector<std::vector<std::uint32_t>> with_light;
    work.positions.clear();
    for (const std::uint32_t g : cluster) {
      work.slots.clear();
      for (const std::uint32_t i : groups.groups[g]) {
        const Viewpoint& at = work.at(i);
        if (tile.material[i]->unlit || dot(ball.center - at.position, at.normal) <= -ball.radius) continue;
        work.result->seen[i] = Seen::none;
        if (at.geometric_normal && dot(ball.center - at.position, *at.geometric_normal) <= -ball.radius) continue;
        work.slots.push_back(i);
        work.positions.push_back(at.position);
      }
      if (!work.slots.empty()) with_light.push_back(work.slots);
    }
    if (with_light.empty()) continue;
    // For all of the cluster where a frame holds it; else each group gathers by itself.
    const bool together = gather_round(light, flat, work.positions, work);
    for (const auto& slots : with_light) find_round_group(light, flat, slots, together, work);
  }
}

// Fills work.tile with what points that see a round light need. False where no shaft holds them: then with everything.
bool ShadowPass::gather_round(const PackLight& light, const Flat& flat, const std::vector<Vec3d>& positions, Work& work) const {
  const std::optional<LightFrame> behind = shadow::frame_behind(*light.area, positions);
  if (!behind) return false;
  const Shaft shaft(*behind, positions, shadow::Sections::anywhere);
  tree_.gather(mesh_, shaft, work.edges);
  // Planes differ from point to point: any triangle near the light may cross one.
  work.crossing.clear();
  for (const std::uint32_t t : flat.near)
    if (shaft.needs_triangle(mesh_, t)) work.crossing.push_back(t);
  work.tile.assign(mesh_, work.base, work.edges, work.crossing);
  return true;
}

void ShadowPass::find_round_group(const PackLight& light, const Flat& flat, const std::vector<std::uint32_t>& slots, bool together,
                                  Work& work) const {
  std::vector<Vec3d> positions;
  for (const std::uint32_t i : slots) positions.push_back(work.at(i).position);
  const std::optional<LightFrame> behind = shadow::frame_behind(*light.area, positions);
  work.cut_outs = !cut_outs_.empty();
  if (behind && (together || gather_round(light, flat, positions, work))) {
    const Shaft shaft(*behind, positions, shadow::Sections::anywhere);
    work.cut_outs = meets_cut_outs(shaft);
    work.group.assign_needed(packs_, mesh_, work.tile, work.base, shaft);
  } else {
    work.edges.resize(mesh_.edges.size());
    std::iota(work.edges.begin(), work.edges.end(), 0u);
    work.crossing.resize(mesh_.triangles.size());
    std::iota(work.crossing.begin(), work.crossing.end(), 0u);
    work.group.assign(mesh_, work.base, work.edges, work.crossing);
  }
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
