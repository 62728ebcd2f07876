#include "render/cpu/shadow_pass.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/random.h"
#include "shapes/area_moments.h"
#include "shadow/point_lanes.h"
#include "shadow/round_light.h"
#include "shadow/round_shaft.h"
#include "shadow/visible.h"

namespace steradian {
namespace {

using shadow::EdgeMesh;
using shadow::LightFrame;
using shadow::Shaft;
using shadow::Viewpoint;
using Seen = TileShadow::Seen;

constexpr int kRoundCorners = 24;            // penumbrae of round lights are then 4.5e-5 rms off (docs/shadows.md)
constexpr std::size_t kMostSegments = 2048;  // a point that sees more takes rays, unless exact is asked for
constexpr std::size_t kMostEdges = 32768;    // and a group that gathers more
constexpr int kShareRays = 64;
constexpr double kLift = 1e-6;  // integrals are taken in float

Vec3d get(const TileVector& v, std::size_t i) { return static_cast<Vec3d>(Vec3f{v.x[i], v.y[i], v.z[i]}); }

bool is_disk(const PackLight& light) { return std::holds_alternative<packed::Disk>(light.shape); }

class EmbreeBlockers : public shadow::Blockers {
 public:
  explicit EmbreeBlockers(const RayScene& rays) : rays_(rays) {}
  bool between(Vec3d from, Vec3d to) const override { return rays_.between(from, to); }

 private:
  const RayScene& rays_;
};

bool on_light(const LightFrame& frame, double x, double y) {
  bool inside = false;
  for (const auto& c : frame.contours)
    for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++)
      if ((c[i].y > y) != (c[j].y > y) && x < (c[j].x - c[i].x) * (y - c[i].y) / (c[j].y - c[i].y) + c[i].x) inside = !inside;
  return inside;
}

// Ellipsoids' frames come without.
LightFrame with_contours(LightFrame frame) {
  if (frame.contours.empty()) frame.contours = {shadow::contour_of_ellipse(frame, kRoundCorners)};
  return frame;
}

// How much of the light's box a normal looks on.
enum class Above { all, some, none };
Above above_horizon(const LightFrame& frame, Vec3d position, Vec3d normal) {
  const double middle = dot(frame.origin - position, normal);
  const double reach = std::fabs(dot(frame.axes.x, normal)) * frame.box_x + std::fabs(dot(frame.axes.y, normal)) * frame.box_y;
  return middle - reach > 0 ? Above::all : middle + reach > 0 ? Above::some : Above::none;
}

// From less than ten half diagonals away, no integral takes a light's elements (least_distance2 of shapes/small_light.h).
constexpr double kNeverSmall = 100;

}  // namespace

TilePoints points_for_shadows(const SurfaceTile& tile, Terminator terminator) {
  TilePoints result;
  result.points.resize(kTilePixels);
  std::vector<Vec3d> positions(kTilePixels);
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (tile.material[i] == nullptr) continue;
    const Vec3d position = get(tile.position, i), geometric = get(tile.geometric_normal, i), normal = normalized(get(tile.normal, i));
    Viewpoint& at = result.points[i];
    positions[i] = at.position = position + geometric * shadow::offset_from_surface(position);
    at.normal = normal;
    if (terminator == Terminator::strict && length(normal - geometric) > 1e-5) at.geometric_normal = geometric;
  }
  result.groups = groups_of(tile, positions);
  return result;
}

bool TileShadow::is_plain() const {
  return std::all_of(seen.begin(), seen.end(), [](Seen s) { return s == Seen::whole || s == Seen::dark; });
}

void TileShadow::Batch::clear() {
  slots.clear();
  passes.clear();
  visible.clear();
  all.clear();
}

void TileShadow::clear() {
  seen.fill(Seen::dark);
  parts.clear();
  edges.clear();
  batch_count = 0;
}

TileShadow::Batch& TileShadow::batch_with_room() {
  if (batch_count == 0 || batches[batch_count - 1].slots.size() + packed::Pieces::kBlock > kTilePixels) {
    if (batches.size() == batch_count) batches.emplace_back();
    batches[batch_count++].clear();
  }
  return batches[batch_count - 1];
}

void TileShadow::batch_parts() {
  constexpr std::size_t kBlock = packed::Pieces::kBlock;
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.visible.count > b.visible.count; });
  for (std::size_t first = 0; first < parts.size(); first += kBlock) {
    const std::size_t last = std::min(first + kBlock, parts.size());
    Batch& batch = batch_with_room();
    const std::size_t at = batch.slots.size();
    batch.slots.resize(at + kBlock, kNoSlot);
    batch.passes.resize(at + kBlock, 1.0f);
    for (std::size_t i = first; i < last; ++i) {
      batch.slots[at + i - first] = parts[i].slot;
      batch.passes[at + i - first] = parts[i].passes;
    }
    const auto add = [&](packed::Pieces& pieces, Outline Part::*which) {
      std::size_t most = 0;
      for (std::size_t i = first; i < last; ++i) most = std::max(most, (parts[i].*which).count);
      if (most == 0) return;
      pieces.add_block(most);
      for (std::size_t i = first; i < last; ++i) {
        const Outline& outline = parts[i].*which;
        for (std::size_t k = 0; k < most; ++k) {
          // Edges of no length where the list is shorter.
          const Edge& e = edges[outline.first + std::min(k, outline.count - 1)];
          pieces.set_edge(at + i - first, k, k < outline.count ? e.a : e.b, e.b);
        }
        if (outline.elements) pieces.set_elements(at + i - first, *outline.elements, outline.area);
      }
      // The last block's other lanes hold no surface.
      for (std::size_t i = last; i < first + kBlock; ++i)
        for (std::size_t k = 0; k < most; ++k) pieces.set_edge(at + i - first, k, {0, 1, 0}, {0, 1, 0});
    };
    add(batch.visible, &Part::visible);
    add(batch.all, &Part::all);
  }
}

// A tile in work, and its thread's memory.
struct ShadowPass::Work {
  const std::vector<Viewpoint>* points = nullptr;
  TileShadow* result = nullptr;
  ShadowCounts* counts = nullptr;
  shadow::EdgeArrays tile, group;
  shadow::Scratch scratch;
  shadow::VisibleRegion region;
  shadow::PointLanes lanes;
  std::vector<Vec3d> positions;
  std::vector<std::uint32_t> slots, edges, crossing;
  LightFrame base;             // of round lights: in whose coordinates the arrays are
  bool turned = false;         // they are
  bool in_lanes = false;       // the points' sides of the light have one outline
  bool whole_outline = false;  // parts come with their light's polygon
  bool cut_outs = false;       // whether the group's shaft meets any

  const Viewpoint& at(std::uint32_t slot) const { return (*points)[slot]; }
};

ShadowPass::Side ShadowPass::side_of(const PreparedPolygon& polygon, int side) {
  Side result;
  result.side = side;
  result.frame = shadow::light_frame(polygon, side);
  result.outline = std::make_shared<const std::vector<shadow::Segment>>(shadow::outline_segments(result.frame));
  if (on_light(result.frame, 0, 0)) result.middle = result.frame.origin;
  return result;
}

std::optional<ShadowPass::Side> ShadowPass::side_of_round(const PackLight& light, Vec3d position) const {
  if (std::holds_alternative<Capsule>(light.area->shape)) {
    const PreparedPolygon polygon = shadow::polygon_of_round(*light.area, position, kRoundCorners);
    if (polygon.side_of(position) <= 0) return {};
    return side_of(polygon, 1);
  }
  std::optional<LightFrame> frame = shadow::frame_of_ellipsoid(std::get<Ellipsoid>(light.area->shape), position, kRoundCorners);
  if (!frame) return {};
  Side result;
  result.frame = std::move(*frame);
  result.outline = ellipse_;
  result.middle = result.frame.origin;
  return result;
}

ShadowPass::ShadowPass(const Scene& scene, const std::vector<PackLight>& lights, const RayScene& rays, Shadows mode)
    : packs_(shadow_table_for(active_simd())),
      lanes_(lane_table_for(active_simd())),
      rays_(rays),
      mode_(mode),
      lights_(lights),
      mesh_(shadow::build_edges(scene)),
      tree_(mesh_),
      ellipse_(std::make_shared<const std::vector<shadow::Segment>>(shadow::outline_of_ellipse(kRoundCorners))) {
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.is_light_shape || scene.materials[static_cast<std::size_t>(mesh.material)].alpha_mode != AlphaMode::mask) continue;
    Box box{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (const Vec3f p : mesh.positions) {
      const auto q = static_cast<Vec3d>(p);
      box.low = {std::min(box.low.x, q.x), std::min(box.low.y, q.y), std::min(box.low.z, q.z)};
      box.high = {std::max(box.high.x, q.x), std::max(box.high.y, q.y), std::max(box.high.z, q.z)};
    }
    cut_outs_.push_back(box);
  }
  for (const PackLight& light : lights) {
    Flat flat;
    if (light.is_polygon()) flat.polygon = light.polygon;
    if (is_disk(light)) {
      flat.polygon = prepare_polygon(flat_polygon(*light.area, kRoundCorners));
    }
    if (!flat.polygon.vertices.empty())
      for (int s = 0; s < (flat.polygon.two_sided ? 2 : 1); ++s) {
        flat.sides[s] = side_of(flat.polygon, s == 0 ? 1 : -1);
        flat.sides[s]->crossing = shadow::crossing_triangles(mesh_, flat.sides[s]->frame);
      }
    if (light.is_round() && !is_disk(light)) flat.near = shadow::triangles_near(mesh_, *light.area);
    flats_.push_back(std::move(flat));
  }
}

void ShadowPass::find(const SurfaceTile& tile, const TilePoints& points, const PackLight& light, TileShadow& result,
                      ShadowCounts& counts) const {
  thread_local Work work;
  work.turned = work.whole_outline = work.cut_outs = false;
  work.in_lanes = true;
  work.points = &points.points;
  work.result = &result;
  work.counts = &counts;
  result.clear();
  const Flat& flat = flats_[light.index];
  if (!light.is_area())
    find_punctual(tile, light, work);
  else if (!flat.polygon.vertices.empty())
    find_flat(tile, points.groups, light, flat, work);
  else
    find_round(tile, points.groups, light, flat, work);
  result.batch_parts();
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

void ShadowPass::find_flat(const SurfaceTile& tile, const PointGroups& groups, const PackLight& light, const Flat& flat, Work& work) const {
  work.whole_outline = is_disk(light) || light.textured != nullptr;
  std::vector<std::vector<std::uint32_t>> with_light;
  for (const std::vector<std::uint32_t>& cluster : groups.clusters) {
    for (const std::optional<Side>& side : flat.sides) {
      if (!side) continue;
      // The slots of each group that may see this side of the light.
      with_light.clear();
      work.positions.clear();
      for (const std::uint32_t g : cluster) {
        work.slots.clear();
        for (const std::uint32_t i : groups.groups[g]) {
          const Viewpoint& at = work.at(i);
          if (tile.material[i]->unlit || flat.polygon.side_of(at.position) != side->side) continue;
          if (above_horizon(side->frame, at.position, at.normal) == Above::none) continue;
          work.result->seen[i] = Seen::none;
          if (at.geometric_normal && above_horizon(side->frame, at.position, *at.geometric_normal) == Above::none) continue;
          work.slots.push_back(i);
          work.positions.push_back(at.position);
        }
        if (!work.slots.empty()) with_light.push_back(work.slots);
      }
      if (with_light.empty()) continue;
      const Shaft shaft(side->frame, work.positions);
      tree_.gather(mesh_, shaft, work.edges);
      work.crossing.clear();
      for (const std::uint32_t t : side->crossing)
        if (shaft.needs_triangle(mesh_, t)) work.crossing.push_back(t);
      work.tile.assign(mesh_, side->frame, work.edges, work.crossing);
      for (const auto& slots : with_light) {
        work.positions.clear();
        for (const std::uint32_t i : slots) work.positions.push_back(work.at(i).position);
        const Shaft of_group(side->frame, work.positions);
        work.cut_outs = meets_cut_outs(of_group);
        work.group.assign_needed(packs_, mesh_, work.tile, side->frame, of_group);
        find_group(
            slots, [&](std::uint32_t) { return &*side; }, work);
      }
    }
  }
}

bool ShadowPass::is_cut(const LightFrame& frame, const Viewpoint& at) const {
  return at.geometric_normal && above_horizon(frame, at.position, *at.geometric_normal) != Above::all;
}

void ShadowPass::take_rays(const Side& side, std::uint32_t slot, Work& work) const {
  ++work.counts->fallback;
  work.result->seen[slot] = Seen::share;
  work.result->share[slot] = share_by_rays(side, work.at(slot));
}

// The segments are those of the point.
void ShadowPass::find_in_segments(const Side& side, std::uint32_t slot, Work& work) const {
  const Viewpoint& at = work.at(slot);
  find_visible_on_packs(packs_, side.frame, at.position, EmbreeBlockers(rays_), work.scratch, work.region);
  if (work.region.boundary.empty()) return;
  if (work.scratch.set.occluders == 0 && !is_cut(side.frame, at)) {
    work.result->seen[slot] = Seen::whole;
    return;
  }
  ++work.counts->parts;
  work.result->seen[slot] = Seen::part;
  TileShadow::Part part;
  part.slot = slot;
  const Vec3d eye = side.frame.to_local(at.position);
  // Edges between places of the light's plane, relative to the point.
  const auto outline_of = [&](auto each_edge) {
    TileShadow::Outline outline;
    std::vector<TileShadow::Edge>& edges = work.result->edges;
    outline.first = edges.size();
    AreaMoments moments;
    each_edge([&](double ax, double ay, double bx, double by) {
      moments.add(ax, ay, bx, by);
      const auto corner = [&](double x, double y) { return static_cast<Vec3f>(side.frame.axes.to_world({x - eye.x, y - eye.y, -eye.z})); };
      edges.push_back({corner(ax, ay), corner(bx, by)});
    });
    outline.count = edges.size() - outline.first;
    const double extent2 = side.frame.half_x * side.frame.half_x + side.frame.half_y * side.frame.half_y;
    if (moments.area > 0 && dot(eye, eye) > kNeverSmall * extent2) {
      outline.elements = quarters_of(moments, side.frame.origin - at.position, side.frame.axes.x, side.frame.axes.y);
      outline.area = side.frame.axes.z * -moments.area;
    }
    return outline;
  };
  part.visible = outline_of([&](auto edge) {
    const double x = side.frame.box_x / shadow::kCells, y = side.frame.box_y / shadow::kCells;
    for (const shadow::Boundary& b : work.region.boundary) edge(b.ax * x, b.ay * y, b.bx * x, b.by * y);
  });
  // Lifted to the horizon, so that no rounding puts an edge below.
  for (std::size_t i = part.visible.first; i < part.visible.first + part.visible.count; ++i)
    for (Vec3f* v : {&work.result->edges[i].a, &work.result->edges[i].b}) {
      const auto d = static_cast<Vec3d>(*v);
      const double least = kLift * length(d), height = dot(d, at.normal);
      if (height < least) *v = static_cast<Vec3f>(d + at.normal * (least - height));
    }
  if (work.whole_outline)
    part.all = outline_of([&](auto edge) {
      for (const auto& c : with_contours(side.frame).contours)
        for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++) edge(c[j].x, c[j].y, c[i].x, c[i].y);
    });
  work.result->parts.push_back(part);
}

void ShadowPass::find_point(const Side& side, std::uint32_t slot, Work& work) const {
  const Viewpoint& at = work.at(slot);
  ++work.counts->points;
  shadow::SegmentSet& set = work.scratch.set;
  if (work.turned)
    work.group.see_turned(packs_, work.base, side.frame, at, *side.outline, set);
  else
    work.group.see(packs_, side.frame, at, *side.outline, set);
  if (set.occluders > kMostSegments && mode_ != Shadows::exact) {
    take_rays(side, slot, work);
    return;
  }
  // Nothing to arrange: one ray to any place of the light above the horizons decides.
  const auto sees = [&](Vec3d normal) { return dot(*side.middle - at.position, normal) > 0; };
  if (set.occluders == 0 && side.middle && sees(at.normal) && !is_cut(side.frame, at)) {
    const double z = -side.frame.to_local(at.position).z;
    const Vec3d to = (*side.middle - at.position) * std::max((z - side.frame.eta) / z, 0.0);
    if (!rays_.between(at.position, at.position + to)) work.result->seen[slot] = Seen::whole;
  } else {
    if (set.occluders == 0) shadow::add_surroundings(side.frame, at, *side.outline, set);
    find_in_segments(side, slot, work);
  }
  if (work.cut_outs && work.result->seen[slot] != Seen::none) pass_cut_outs(side, slot, work);
}

// Up to sixteen slots at once; side by side in the tile's order, so that they see nearly the same edges.
void ShadowPass::find_lanes(const Side* const* sides, const std::uint32_t* slots, std::size_t count, Work& work) const {
  shadow::PointLanes::Point points[shadow::kPoints];
  RayScene::Sixteen rays;
  std::uint32_t asked = 0, whole = 0;
  const auto bit = [](std::size_t lane) { return 1u << lane; };
  for (std::size_t k = 0; k < count; ++k) {
    const Side& side = *sides[k];
    const Viewpoint& at = work.at(slots[k]);
    const bool simple = side.middle && dot(*side.middle - at.position, at.normal) > 0 && !is_cut(side.frame, at);
    points[k] = {&side.frame, &at, !simple};
  }
  work.lanes.find(lanes_, work.group, work.turned ? work.base : sides[0]->frame, work.turned, {points, count}, *sides[0]->outline);
  const std::uint32_t occluded = work.lanes.occluded(), found = work.lanes.found(), none = work.lanes.none();
  for (std::size_t k = 0; k < count; ++k) {
    const Side& side = *sides[k];
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

// The edges of lanes that see a part.
void ShadowPass::add_lanes(const Side* const* sides, const std::uint32_t* slots, std::size_t count, std::uint32_t lanes, Work& work) const {
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
    const Side& side = *sides[k];
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

// work.group holds what the group needs. side_at(slot): a pointer to the side of the light that it sees, or null; it may be the same
// for all, or stay valid for sixteen calls.
template <class SideAt>
void ShadowPass::find_group(const std::vector<std::uint32_t>& slots, SideAt side_at, Work& work) const {
  const bool by_rays = work.group.edge_count() > kMostEdges && mode_ != Shadows::exact;
  const bool empty = work.group.empty();
  if (!by_rays && !empty && work.in_lanes && !work.cut_outs && !work.group.has_crossing()) {
    const Side* sides[shadow::kPoints];
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
      if (sides[count] != nullptr) ++count;
    }
    return;
  }
  std::optional<bool> free;
  for (const std::uint32_t i : slots) {
    const Side* side = side_at(i);
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
    // Nothing can come between: what one point's ray finds, all find.
    if (!free) {
      work.scratch.set.clear();
      shadow::add_surroundings(side->frame, at, *side->outline, work.scratch.set);
      find_visible_on_packs(packs_, side->frame, at.position, EmbreeBlockers(rays_), work.scratch, work.region);
      if (work.region.rays > 0) free = !work.region.boundary.empty();
    }
    if (!free) continue;  // below this point's horizons
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
  std::array<std::optional<Side>, shadow::kPoints> sides;
  std::size_t next = 0;
  find_group(
      slots,
      [&](std::uint32_t i) {
        std::optional<Side>& side = sides[next];
        side = side_of_round(light, work.at(i).position);
        if (!side) return static_cast<const Side*>(nullptr);
        next = (next + 1) % sides.size();
        return static_cast<const Side*>(&*side);
      },
      work);
}

bool ShadowPass::meets_cut_outs(const Shaft& shaft) const {
  return std::any_of(cut_outs_.begin(), cut_outs_.end(), [&](const Box& b) { return shaft.may_meet_box(b.low, b.high); });
}

namespace {

// The share of a light by stratified rays, weighted by what each place sends to a diffuse surface: of the places that count,
// those that are open. counts(x, y) in the light's frame, open(to) for the way there, short of the light.
template <class Counts, class Open>
double stratified_share(const LightFrame& frame, const Viewpoint& at, Counts counts, Open open) {
  constexpr int kSide = 8;
  static_assert(kSide * kSide == kShareRays);
  // Of the position, so that no result depends on tiles or threads.
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  reference::Random random(bits(at.position.x) ^ (bits(at.position.y) << 1) ^ (bits(at.position.z) << 2));
  const double height = -frame.to_local(at.position).z;
  double all = 0, arrives = 0;
  for (int i = 0; i < kShareRays; ++i) {
    const double u = random.uniform(), v = random.uniform();
    const double x = (2 * (i % kSide + u) / kSide - 1) * frame.half_x;
    const double y = (2 * (i / kSide + v) / kSide - 1) * frame.half_y;
    if (!counts(x, y)) continue;
    const Vec3d to = frame.to_world({x, y, 0}) - at.position;
    const double cosine = dot(to, at.normal);
    if (!(cosine > 0)) continue;
    const double d2 = dot(to, to), weight = cosine / (d2 * d2);
    all += weight;
    if (open(to * std::max((height - frame.eta) / height, 0.0))) arrives += weight;
  }
  return all > 0 ? arrives / all : 1.0;
}

}  // namespace

float ShadowPass::share_by_rays(const Side& of, const Viewpoint& at) const {
  const LightFrame frame = with_contours(of.frame);
  return static_cast<float>(stratified_share(
      frame, at, [&](double x, double y) { return on_light(frame, x, y); },
      [&](Vec3d to) {
        if (at.geometric_normal && !(dot(to, *at.geometric_normal) > 0)) return false;
        return !rays_.between(at.position, at.position + to, Casters::all);
      }));
}

// What cut-outs let through of what a slot sees. A part's levels are still in work.
void ShadowPass::pass_cut_outs(const Side& side, std::uint32_t slot, Work& work) const {
  const LightFrame frame = with_contours(side.frame);
  const Viewpoint& at = work.at(slot);
  const bool part = work.result->seen[slot] == Seen::part;
  const auto counts = [&](double x, double y) {
    if (!part) return on_light(frame, x, y);
    const double scale_x = shadow::kCells / frame.box_x, scale_y = shadow::kCells / frame.box_y;
    return count_at(work.scratch.set, x * scale_x, y * scale_y) <= work.region.level;
  };
  const double share =
      stratified_share(frame, at, counts, [&](Vec3d to) { return !rays_.between(at.position, at.position + to, Casters::cut_outs); });
  if (share == 1) return;
  if (part) {
    work.result->parts.back().passes = static_cast<float>(share);
  } else {
    work.result->seen[slot] = Seen::share;
    work.result->share[slot] = static_cast<float>(share);
  }
}

}  // namespace steradian
