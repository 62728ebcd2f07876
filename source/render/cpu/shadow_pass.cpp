#include "render/cpu/shadow_pass.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/random.h"
#include "shadow/round_light.h"
#include "shadow/visible_part.h"

namespace steradian {
namespace {

using shadow::EdgeMesh;
using shadow::LightFrame;
using shadow::Shaft;
using shadow::Viewpoint;
using Seen = TileShadow::Seen;

constexpr int kRoundCorners = 24;           // penumbrae of round lights are then 4.5e-5 rms off (docs/shadows.md)
constexpr std::size_t kMostSegments = 512;  // a point that sees more takes rays, unless exact is asked for
constexpr std::size_t kMostEdges = 4096;    // and a group that gathers more
constexpr int kShareRays = 64;
constexpr double kLift = 1e-6;  // integrals are taken in float

Vec3d get(const TileVector& v, std::size_t i) { return static_cast<Vec3d>(Vec3f{v.x[i], v.y[i], v.z[i]}); }

// Groups of 8 x 8 pixels: four blocks of slots.
std::uint32_t group_of(std::uint32_t slot) {
  constexpr std::uint32_t kBlocks = kTileSide / 4;
  const std::uint32_t block = slot / 16;
  return block / kBlocks / 2 * (kBlocks / 2) + block % kBlocks / 2;
}
constexpr std::uint32_t kGroups = kTilePixels / 64;

bool is_disk(const PackLight& light) { return std::holds_alternative<packed::Disk>(light.shape); }

class EmbreeBlockers : public shadow::Blockers {
 public:
  explicit EmbreeBlockers(const RayScene& rays) : rays_(rays) {}
  bool between(Vec3d from, Vec3d to) const override { return rays_.between(from, to); }

 private:
  const RayScene& rays_;
};

// Splits points where a gap is wider than 35 % of their box: a shaft around both sides of a depth edge holds too much.
void split(std::vector<std::uint32_t> slots, const std::vector<Viewpoint>& points, std::vector<std::vector<std::uint32_t>>& groups) {
  Vec3d low{INFINITY, INFINITY, INFINITY}, high = -low;
  for (const std::uint32_t s : slots) {
    const Vec3d p = points[s].position;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3d size = high - low;
  const auto along = [&](std::uint32_t s) {
    const Vec3d p = points[s].position;
    return size.x >= size.y && size.x >= size.z ? p.x : size.y >= size.z ? p.y : p.z;
  };
  const double longest = std::max({size.x, size.y, size.z});
  std::vector<std::uint32_t> order = slots;
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return along(a) < along(b); });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (along(order[i]) - along(order[i - 1]) > 0.35 * longest && longest > 0) {
      const auto middle = order.begin() + static_cast<std::ptrdiff_t>(i);
      split({order.begin(), middle}, points, groups);
      split({middle, order.end()}, points, groups);
      return;
    }
  groups.push_back(std::move(slots));
}

struct Ball {
  Vec3d center;
  double radius = 0;
};

// Holds a sphere, ellipsoid or tube.
Ball ball_around(const AreaLight& area) {
  if (const auto* c = std::get_if<Capsule>(&area.shape)) return {(c->end_a + c->end_b) * 0.5, length(c->end_b - c->end_a) / 2 + c->radius};
  const auto& e = std::get<Ellipsoid>(area.shape);
  const double x2 = dot(e.x, e.x), y2 = dot(e.y, e.y), z2 = dot(e.z, e.z);
  const double skew = std::fabs(dot(e.x, e.y)) + std::fabs(dot(e.y, e.z)) + std::fabs(dot(e.z, e.x));
  const bool right_angles = skew < 1e-6 * (x2 + y2 + z2);
  return {e.center, right_angles ? std::sqrt(std::max({x2, y2, z2})) * (1 + 1e-5) : std::sqrt(x2 + y2 + z2)};
}

// A frame whose shaft holds a round light for all points of a group: a square behind its bounding ball.
std::optional<LightFrame> frame_behind(const PackLight& light, const std::vector<Vec3d>& points) {
  const Ball ball = ball_around(*light.area);
  const double radius = 1.5 * ball.radius;  // the box around the polygon has corners
  Vec3d middle{};
  for (const Vec3d& p : points) middle += p / static_cast<double>(points.size());
  const Vec3d axis = ball.center - middle;
  const double distance = length(axis);
  if (!(distance > 0)) return std::nullopt;
  double nearest = INFINITY, farthest = 0, spread = 0;
  LightFrame frame;
  frame.axes = Frame::from_normal(axis / distance);
  for (const Vec3d& p : points) {
    const Vec3d d = frame.axes.to_local(ball.center - p);
    nearest = std::min(nearest, length(d));
    farthest = std::max(farthest, length(d));
    spread = std::max(spread, std::hypot(d.x, d.y));
  }
  if (nearest < 1.2 * radius || distance < 2 * spread) return std::nullopt;
  frame.origin = ball.center + frame.axes.z * radius;
  // The tangent cone from the nearest point, at the square's plane, and its tilt for points off the axis.
  const double tangent = radius / std::sqrt(nearest * nearest - radius * radius), tilt = spread / (distance - spread);
  const double half = (farthest + radius) * (tangent * (1 + tilt) * (1 + tilt)) + radius * tilt;
  frame.half_x = frame.half_y = half;
  frame.box_x = frame.box_y = 1.1 * half;
  return frame;
}

// Triangles whose box meets that of a round light, enlarged: the polygon's box in its plane reaches beyond the ball.
std::vector<std::uint32_t> triangles_near(const EdgeMesh& mesh, const AreaLight& area) {
  const Ball ball = ball_around(area);
  const double reach = 1.6 * ball.radius;
  std::vector<std::uint32_t> result;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d a = mesh.vertices[mesh.triangles[t][0]] - ball.center, b = mesh.vertices[mesh.triangles[t][1]] - ball.center,
                c = mesh.vertices[mesh.triangles[t][2]] - ball.center;
    const auto apart = [&](double x, double y, double z) { return std::min({x, y, z}) > reach || std::max({x, y, z}) < -reach; };
    if (!apart(a.x, b.x, c.x) && !apart(a.y, b.y, c.y) && !apart(a.z, b.z, c.z)) result.push_back(t);
  }
  return result;
}

}  // namespace

// A tile in work.
struct ShadowPass::Work {
  const std::vector<Viewpoint>& points;
  TileShadow& result;
  ShadowCounts& counts;
  EmbreeBlockers blockers;
  shadow::LocalEdges<double> local;
  shadow::Scratch scratch;
  shadow::VisibleRegion region;
  std::vector<std::uint32_t> edges, crossing;
  bool cut_outs = false;  // whether the group's shaft meets any
};

ShadowPass::ShadowPass(const Scene& scene, const std::vector<PackLight>& lights, const RayScene& rays, Shadows mode)
    : rays_(rays), mode_(mode), lights_(lights), mesh_(shadow::build_edges(scene)), tree_(mesh_) {
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
        flat.sides[s].emplace();
        flat.sides[s]->frame = shadow::light_frame(flat.polygon, s == 0 ? 1 : -1);
        flat.sides[s]->crossing = shadow::crossing_triangles(mesh_, flat.sides[s]->frame);
      }
    if (light.is_round() && !is_disk(light)) flat.near = triangles_near(mesh_, *light.area);
    flats_.push_back(std::move(flat));
  }
}

void ShadowPass::find(const SurfaceTile& tile, const PackLight& light, TileShadow& result, ShadowCounts& counts) const {
  result.seen.fill(Seen::none);
  result.parts.clear();
  result.wholes = 0;
  thread_local std::vector<Viewpoint> points(kTilePixels);
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (tile.material[i] == nullptr) continue;
    const Vec3d position = get(tile.position, i), geometric = get(tile.geometric_normal, i), normal = normalized(get(tile.normal, i));
    points[i].position = position + geometric * shadow::offset_from_surface(position);
    points[i].normal = normal;
    points[i].geometric_normal.reset();
    if (length(normal - geometric) > 1e-5) points[i].geometric_normal = geometric;
  }
  Work work{points, result, counts, EmbreeBlockers(rays_), {}, {}, {}, {}, {}, false};
  const auto number = static_cast<std::size_t>(&light - lights_.data());
  if (!light.is_area())
    find_punctual(tile, light, work);
  else if (light.is_polygon() || is_disk(light))
    find_flat(tile, light, flats_[number], work);
  else
    find_round(tile, light, work);
  for (const Seen s : result.seen) result.wholes += s == Seen::whole;
}

void ShadowPass::find_punctual(const SurfaceTile& tile, const PackLight& light, Work& work) const {
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (tile.material[i] == nullptr) continue;
    const Viewpoint& at = work.points[i];
    const packed::Punctual& source = *std::get_if<packed::Punctual>(&light.shape);
    const bool directional = source.kind == PunctualKind::directional;
    const Vec3d to = directional ? -source.direction : source.position - at.position;
    if (!(dot(to, at.normal) > 0) || (at.geometric_normal && !(dot(to, *at.geometric_normal) > 0))) continue;
    ++work.counts.points;
    const bool blocked = directional ? rays_.blocked_towards(at.position, to) : rays_.between(at.position, at.position + to, Casters::all);
    if (!blocked) work.result.seen[i] = Seen::whole;
  }
}

void ShadowPass::find_flat(const SurfaceTile& tile, const PackLight& light, const Flat& flat, Work& work) const {
  std::vector<std::uint32_t> of_side[2];
  for (std::uint32_t i = 0; i < kTilePixels; ++i) {
    if (tile.material[i] == nullptr || tile.material[i]->unlit) continue;
    const int side = flat.polygon.side_of(work.points[i].position);
    if (side == 0 || (side < 0 && !flat.polygon.two_sided)) continue;
    of_side[side > 0 ? 0 : 1].push_back(i);
  }
  for (int s = 0; s < 2; ++s) {
    if (of_side[s].empty() || !flat.sides[s]) continue;
    const LightFrame& frame = flat.sides[s]->frame;
    // What the tile needs, of which each group takes its part.
    std::vector<Vec3d> positions;
    for (const std::uint32_t i : of_side[s]) positions.push_back(work.points[i].position);
    std::vector<std::uint32_t> edges;
    tree_.gather(mesh_, Shaft(frame, positions), edges);
    for (std::uint32_t g = 0; g < kGroups; ++g) {
      std::vector<std::uint32_t> slots;
      for (const std::uint32_t i : of_side[s])
        if (group_of(i) == g) slots.push_back(i);
      if (slots.empty()) continue;
      std::vector<std::vector<std::uint32_t>> groups;
      split(std::move(slots), work.points, groups);
      for (const auto& group : groups) find_group(light, flat, s == 0 ? 1 : -1, edges, group, work);
    }
  }
}

bool ShadowPass::is_cut(const LightFrame& frame, const Viewpoint& at) const {
  if (!at.geometric_normal) return false;
  for (const double x : {-frame.box_x, frame.box_x})
    for (const double y : {-frame.box_y, frame.box_y})
      if (!(dot(frame.to_world({x, y, 0}) - at.position, *at.geometric_normal) > 0)) return true;
  return false;
}

void ShadowPass::find_point(const PreparedPolygon& polygon, const LightFrame& frame, int side, std::uint32_t slot, bool round,
                            Work& work) const {
  const Viewpoint& at = work.points[slot];
  ++work.counts.points;
  work.local.see(at, work.scratch.set);
  const std::size_t occluders = work.scratch.set.occluders;
  if (occluders > kMostSegments && mode_ != Shadows::exact) {
    ++work.counts.fallback;
    work.result.seen[slot] = Seen::share;
    work.result.share[slot] = share_by_rays(frame, at);
    return;
  }
  find_visible(frame, at.position, work.blockers, work.scratch, work.region);
  if (work.region.boundary.empty()) return;
  if (occluders == 0 && !is_cut(frame, at)) {
    work.result.seen[slot] = Seen::whole;
    if (work.cut_outs) pass_cut_outs(frame, slot, work);
    return;
  }
  ++work.counts.parts;
  work.result.seen[slot] = Seen::part;
  TileShadow::Part part;
  part.slot = slot;
  part.position = at.position;
  part.visible = shadow::light_of(work.region, polygon, frame, side, at, kLift);
  if (round) part.all = polygon;
  work.result.parts.push_back(std::move(part));
  if (work.cut_outs) pass_cut_outs(frame, slot, work);
}

void ShadowPass::find_group(const PackLight& light, const Flat& flat, int side, const std::vector<std::uint32_t>& edges,
                            const std::vector<std::uint32_t>& slots, Work& work) const {
  const Flat::Side& of = *flat.sides[side > 0 ? 0 : 1];
  std::vector<Vec3d> positions;
  for (const std::uint32_t i : slots) positions.push_back(work.points[i].position);
  const Shaft shaft(of.frame, positions);
  work.cut_outs = meets_cut_outs(shaft);
  work.edges.clear();
  for (const std::uint32_t e : edges)
    if (shaft.needs(mesh_, e)) work.edges.push_back(e);
  work.crossing.clear();
  for (const std::uint32_t t : of.crossing)
    if (shaft.needs_triangle(mesh_, t)) work.crossing.push_back(t);
  const bool round = is_disk(light) || light.textured != nullptr;

  if (work.edges.size() > kMostEdges && mode_ != Shadows::exact) {
    for (const std::uint32_t i : slots) {
      ++work.counts.points;
      ++work.counts.fallback;
      work.result.seen[i] = Seen::share;
      work.result.share[i] = share_by_rays(of.frame, work.points[i]);
    }
    return;
  }
  work.local.assign(mesh_, of.frame, work.edges, work.crossing);
  if (!work.edges.empty() || !work.crossing.empty()) {
    for (const std::uint32_t i : slots) find_point(flat.polygon, of.frame, side, i, round, work);
    return;
  }
  // Nothing can come between: what one point's ray finds, all find.
  std::optional<bool> free;
  for (const std::uint32_t i : slots) {
    const Viewpoint& at = work.points[i];
    if (!free) {
      work.local.see(at, work.scratch.set);
      find_visible(of.frame, at.position, work.blockers, work.scratch, work.region);
      if (work.region.rays > 0) free = !work.region.boundary.empty();
    }
    if (!free) continue;  // below this point's horizons
    if (*free && is_cut(of.frame, at)) {
      find_point(flat.polygon, of.frame, side, i, round, work);
      continue;
    }
    ++work.counts.points;
    if (*free) work.result.seen[i] = Seen::whole;
    if (*free && work.cut_outs) pass_cut_outs(of.frame, i, work);
  }
}

void ShadowPass::find_round(const SurfaceTile& tile, const PackLight& light, Work& work) const {
  for (std::uint32_t g = 0; g < kGroups; ++g) {
    std::vector<std::uint32_t> slots;
    for (std::uint32_t i = 0; i < kTilePixels; ++i)
      if (group_of(i) == g && tile.material[i] != nullptr && !tile.material[i]->unlit) slots.push_back(i);
    if (slots.empty()) continue;
    std::vector<std::vector<std::uint32_t>> groups;
    split(std::move(slots), work.points, groups);
    for (const auto& group : groups) find_round_group(light, group, work);
  }
}

void ShadowPass::find_round_group(const PackLight& light, const std::vector<std::uint32_t>& slots, Work& work) const {
  std::vector<Vec3d> positions;
  for (const std::uint32_t i : slots) positions.push_back(work.points[i].position);
  work.edges.clear();
  work.crossing.clear();
  if (const std::optional<LightFrame> behind = frame_behind(light, positions)) {
    const Shaft shaft(*behind, positions);
    work.cut_outs = meets_cut_outs(shaft);
    tree_.gather(mesh_, shaft, work.edges);
    // Planes differ from point to point: any triangle near the light may cross one.
    for (const std::uint32_t t : flats_[static_cast<std::size_t>(&light - lights_.data())].near)
      if (shaft.needs_triangle(mesh_, t)) work.crossing.push_back(t);
  } else {
    work.cut_outs = !cut_outs_.empty();
    for (std::uint32_t e = 0; e < mesh_.edges.size(); ++e) work.edges.push_back(e);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) work.crossing.push_back(t);
  }
  bool is_first = true;
  for (const std::uint32_t i : slots) {
    const Viewpoint& at = work.points[i];
    const PreparedPolygon polygon = shadow::polygon_of_round(*light.area, at.position, kRoundCorners);
    if (polygon.side_of(at.position) <= 0) continue;
    const int side = 1;
    const LightFrame frame = shadow::light_frame(polygon, side);
    if (is_first) work.local.assign(mesh_, frame, work.edges, work.crossing);
    if (!is_first) work.local.move_to(mesh_, frame);
    is_first = false;
    find_point(polygon, frame, side, i, true, work);
  }
}

bool ShadowPass::meets_cut_outs(const Shaft& shaft) const {
  return std::any_of(cut_outs_.begin(), cut_outs_.end(), [&](const Box& b) { return shaft.may_meet_box(b.low, b.high); });
}

namespace {

bool on_light(const LightFrame& frame, double x, double y) {
  bool inside = false;
  for (const auto& c : frame.contours)
    for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++)
      if ((c[i].y > y) != (c[j].y > y) && x < (c[j].x - c[i].x) * (y - c[i].y) / (c[j].y - c[i].y) + c[i].x) inside = !inside;
  return inside;
}

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

float ShadowPass::share_by_rays(const LightFrame& frame, const Viewpoint& at) const {
  return static_cast<float>(stratified_share(
      frame, at, [&](double x, double y) { return on_light(frame, x, y); },
      [&](Vec3d to) {
        if (at.geometric_normal && !(dot(to, *at.geometric_normal) > 0)) return false;
        return !rays_.between(at.position, at.position + to, Casters::all);
      }));
}

// What cut-outs let through of what a slot sees. A part's levels are still in work.
void ShadowPass::pass_cut_outs(const LightFrame& frame, std::uint32_t slot, Work& work) const {
  const Viewpoint& at = work.points[slot];
  const bool part = work.result.seen[slot] == Seen::part;
  const auto counts = [&](double x, double y) {
    if (!part) return on_light(frame, x, y);
    const double scale_x = shadow::kCells / frame.box_x, scale_y = shadow::kCells / frame.box_y;
    return count_at(work.scratch.set, x * scale_x, y * scale_y) <= work.region.level;
  };
  const double share =
      stratified_share(frame, at, counts, [&](Vec3d to) { return !rays_.between(at.position, at.position + to, Casters::cut_outs); });
  if (share == 1) return;
  if (part) {
    work.result.parts.back().passes = static_cast<float>(share);
  } else {
    work.result.seen[slot] = Seen::share;
    work.result.share[slot] = static_cast<float>(share);
  }
}

}  // namespace steradian
