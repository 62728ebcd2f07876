#include "render/shadow/pass.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

#include "render/lights/solid_lights.h"
#include "render/shadow/work.h"
#include "shadow/rays/shafts.h"
#include "shadow/region/round_light.h"

namespace steradian {
namespace {

constexpr std::size_t kMostEdges = 32768;  // a group that gathers more takes rays, unless exact is asked for

bool is_disk(const PackLight& light) { return std::holds_alternative<packed::FloatDisk>(light.shape); }

}  // namespace

using shadow::LightFrame;
using shadow::Shaft;
using shadow::Viewpoint;
using Seen = TileShadow::Seen;

ShadowPass::ShadowPass(const Scene& scene, const std::vector<PackLight>& lights, const SceneParts& parts, Shadows mode)
    : packs_(shadow_table_for(active_simd())),
      lanes_(lane_table_for(active_simd())),
      edges_(parts.shadows),
      rays_(*parts.rays),
      mode_(mode),
      lights_(lights),
      mesh_(edges_->mesh),
      tree_(edges_->edges),
      ellipse_(std::make_shared<const std::vector<shadow::Segment>>(shadow::outline_of_ellipse(kRoundCorners))),
      nothing_(std::make_shared<const std::vector<shadow::Segment>>()),
      open_(lights, edges_->triangles, cut_outs_) {
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.is_light_shape || scene.materials[static_cast<std::size_t>(mesh.material)].alpha_mode != AlphaMode::mask) continue;
    Box3d box;
    for (const Vec3f p : mesh.positions) box.add(static_cast<Vec3d>(p));
    cut_outs_.push_back(box);
  }
  std::unordered_map<const AreaLight*, std::size_t> body_of;  // numbers of bodies_of
  for (const AreaLight& light : scene.area_lights)
    if (Body::of(light.shape)) body_of.emplace(&light, body_of.size());
  for (const PackLight& light : lights) {
    Flat flat;
    if (light.is_polygon()) flat.polygon = light.polygon;
    if (is_disk(light)) {
      flat.polygon = prepare_polygon(flat_polygon(*light.area, kRoundCorners));
    }
    if (!flat.polygon.vertices.empty()) flat = flat_of(flat.polygon);
    Solid& solid = solids_.emplace_back();
    if (light.solid != nullptr) {
      solid.light = &light.solid->form;
      solid.own = shadow::triangles_of(*solid.light, mesh_);
      for (const PreparedPolygon& face : light.solid->faces) solid.faces.push_back(flat_of(face));
    }
    if (light.is_round() && !is_disk(light)) {
      flat.body = Body::of(light.area->shape);
      const auto number = body_of.find(light.area);
      if (number != body_of.end() && number->second < mesh_.inside.size()) flat.inside = mesh_.inside[number->second];
      flat.near = edges_->triangles.near(*light.area, flat.inside);
    }
    flats_.push_back(std::move(flat));
  }
}

ShadowPass::Flat ShadowPass::flat_of(const PreparedPolygon& polygon) const {
  Flat flat;
  flat.polygon = polygon;
  for (int s = 0; s < (polygon.two_sided ? 2 : 1); ++s) {
    flat.sides[s] = side_of(polygon, s == 0 ? 1 : -1);
    flat.sides[s]->crossing = shadow::crossing_triangles(mesh_, flat.sides[s]->frame);
  }
  return flat;
}

ShadowPass::Work& ShadowPass::begin(const TilePoints& points, TileShadow& result, ShadowCounts& counts, ShadowTaker* taker) const {
  thread_local Work work;
  work.flat = nullptr;
  work.tube = nullptr;
  work.turned = work.whole_outline = work.cut_outs = work.in_parts = work.in_parts_only = false;
  work.points = &points.points;
  work.result = &result;
  work.counts = &counts;
  work.taker = taker;
  result.clear();
  return work;
}

void ShadowPass::find(const SurfaceTile& tile, const TilePoints& points, const PackLight& light, TileShadow& result, ShadowCounts& counts,
                      ShadowTaker* taker) const {
  Work& work = begin(points, result, counts, taker);
  if (!light.is_area())
    find_punctual(tile, light, work);
  else
    find_area(points.groups, light, work);
  result.batch_parts();
}

void ShadowPass::find_at(const TilePoints& points, const PackLight& light, TileShadow& result, ShadowCounts& counts) const {
  find_area(points.groups, light, begin(points, result, counts, nullptr));
  result.batch_parts();
}

void ShadowPass::find_area(const PointGroups& groups, const PackLight& light, Work& work) const {
  const Flat& flat = flats_[light.index];
  if (light.solid != nullptr)
    find_solid(groups, solids_[light.index], work);
  else if (!flat.polygon.vertices.empty())
    find_flat(groups, light, flat, work);
  else
    find_round(groups, light, flat, work);
}

void ShadowPass::find_punctual(const SurfaceTile& tile, const PackLight& light, Work& work) const {
  const packed::Punctual& source = *std::get_if<packed::Punctual>(&light.shape);
  const bool directional = source.kind == PunctualKind::directional;
  for (std::uint32_t i = 0; i < kTilePixels; ++i) {
    if (tile.material[i] == nullptr) continue;
    const Viewpoint& at = work.at(i);
    const Vec3d to = directional ? -source.direction : source.position - at.position;
    if (!(dot(to, at.normal) > 0)) continue;
    work.result->seen[i] = Seen::none;
    if (at.geometric_normal && !(dot(to, *at.geometric_normal) > 0)) continue;
    ++work.counts->points;
    const bool blocked = directional ? rays_.blocked_towards(at.position, to) : rays_.between(at.position, at.position + to, Casters::all);
    if (!blocked) work.result->seen[i] = Seen::whole;
  }
}

void ShadowPass::find_flat(const PointGroups& groups, const PackLight& light, const Flat& flat, Work& work) const {
  work.whole_outline = is_disk(light);
  for (const std::vector<std::uint32_t>& cluster : groups.clusters) {
    std::vector<const std::vector<std::uint32_t>*> slots;
    for (const std::uint32_t g : cluster) slots.push_back(&groups.groups[g]);
    for (const std::optional<LightSide>& side : flat.sides)
      if (side) find_side(slots, flat.polygon, *side, work);
  }
}

// Finds what the groups of a cluster see of one side of a flat light.
void ShadowPass::find_side(const std::vector<const std::vector<std::uint32_t>*>& groups, const PreparedPolygon& polygon,
                           const LightSide& side, Work& work) const {
  // The slots of each group that may see this side of the light.
  std::vector<std::vector<std::uint32_t>> with_light;
  work.take({});
  for (const std::vector<std::uint32_t>* group : groups) {
    work.slots.clear();
    for (const std::uint32_t i : *group) {
      const Viewpoint& at = work.at(i);
      if (polygon.side_of(at.position) != side.side) continue;
      if (above_horizon(side.frame, at.position, at.normal) == Above::none) continue;
      work.result->seen[i] = Seen::none;
      if (at.geometric_normal && above_horizon(side.frame, at.position, *at.geometric_normal) == Above::none) continue;
      work.slots.push_back(i);
    }
    work.add(work.slots);
    if (!work.slots.empty()) with_light.push_back(work.slots);
  }
  if (with_light.empty()) return;
  const Shaft shaft(side.frame, work.positions, work.up);
  work.gathered = false;
  const SideAt side_at = [&](std::uint32_t) { return &side; };
  for (const auto& slots : with_light) {
    work.take(slots);
    const Shaft of_group(side.frame, work.positions, work.up);
    work.cut_outs = meets_cut_outs(of_group);
    if (is_taken(slots, side.frame, &side, of_group, side.crossing, side_at, work)) continue;
    if (!std::exchange(work.gathered, true)) {
      tree_.gather(packs_, shaft, work.edges);
      work.find_crossing(shaft, mesh_, side.crossing);
      work.tile.assign(mesh_, side.frame, work.edges, work.crossing);
    }
    work.group.assign_needed(packs_, mesh_, work.tile, side.frame, of_group);
    find_group(slots, side_at, work);
  }
}

bool ShadowPass::is_taken(const std::vector<std::uint32_t>& slots, const LightFrame& frame, const void* key, const Shaft& shaft,
                          const std::vector<std::uint32_t>& crossing, const SideAt& side_at, Work& work) const {
  if (work.taker == nullptr || work.cut_outs || work.in_parts || work.in_parts_only) return false;
  if (work.flat != nullptr && !work.flat->inside.empty()) return false;
  work.find_crossing(shaft, mesh_, crossing);
  if (!work.taker->find({mesh_, shaft, work.crossing, frame, work.turned, key, work.whole_outline, slots, *work.points, side_at}))
    return false;
  for (const std::uint32_t i : slots) work.result->seen[i] = Seen::elsewhere;
  return true;
}

void ShadowPass::find_group(const std::vector<std::uint32_t>& slots, const SideAt& side_at, Work& work) const {
  const bool by_rays = work.group.edge_count() > kMostEdges && mode_ != Shadows::exact && !work.in_parts_only;
  const bool empty = work.group.empty() && !work.in_parts_only;
  if (!by_rays && !empty && !work.cut_outs && !work.in_parts) {
    const LightSide* sides[shadow::kPoints];
    std::uint32_t of[shadow::kPoints];
    std::size_t count = 0;
    for (std::size_t i = 0; i <= slots.size(); ++i) {
      if (count == shadow::kPoints || (i == slots.size() && count > 0)) {
        find_lanes(sides, of, count, work);
        count = 0;
      }
      if (i == slots.size()) break;
      sides[count] = side_at(slots[i]);
      of[count] = slots[i];
      if (sides[count] == nullptr) continue;
      // A tube's polygon may lack a corner that coincides with another one.
      if (sides[count]->outline->size() == sides[0]->outline->size())
        ++count;
      else
        find_point(*sides[count], slots[i], work);
    }
    return;
  }
  std::optional<bool> free;
  for (const std::uint32_t i : slots) {
    const LightSide* side = side_at(i);
    if (side == nullptr) continue;
    const Viewpoint& at = work.at(i);
    if (by_rays) {
      ++work.counts->points;
      take_rays(*side, i, work);
      continue;
    }
    if (!empty) {
      find_point(*side, i, work);
      continue;
    }
    // Without occluders, the result of one point's ray holds for all points.
    if (!free) {
      work.scratch.set.clear();
      shadow::add_surroundings(side->frame, at, *side->outline, work.scratch.set);
      find_visible_on_packs(packs_, side->frame, at.position, RayBlockers(rays_), work.scratch, work.region);
      if (work.region.rays > 0) free = !work.region.boundary.empty();
    }
    if (!free) continue;  // the light is below this point's horizons
    if (*free && is_cut(side->frame, at)) {
      find_point(*side, i, work);
      continue;
    }
    ++work.counts->points;
    if (!*free) continue;
    work.result->seen[i] = Seen::whole;
    if (work.cut_outs) pass_cut_outs(*side, i, work);
  }
}

bool ShadowPass::meets_cut_outs(const Shaft& shaft) const {
  return std::any_of(cut_outs_.begin(), cut_outs_.end(), [&](const Box3d& b) { return shaft.may_meet(b); });
}

}  // namespace steradian
