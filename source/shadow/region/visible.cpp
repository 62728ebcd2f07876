#include "shadow/region/visible.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace steradian::shadow {
namespace {

// A region narrower than this fraction of the light proves nothing by a ray, and counts for as little.
constexpr double kThin = 1.0 / 4096;

struct RegionPoint {
  double x = 0, y = 0;
};

bool bounds(const Piece& p, std::int32_t level) { return p.low() <= level && level < p.high(); }

struct RegionExtent {
  double area = 0, perimeter = 0;  // in half sides of the box
};

RegionExtent extent_of(const std::vector<Piece>& pieces, std::int32_t level) {
  RegionExtent e;
  for (const Piece& p : pieces) {
    if (!bounds(p, level)) continue;
    const double area = 0.5 * (p.ax * p.by - p.ay * p.bx);
    e.area += p.left < p.right ? area : -area;
    const double x = p.bx - p.ax, y = p.by - p.ay;
    e.perimeter += std::sqrt(x * x + y * y);
  }
  return {e.area / kCells / kCells, e.perimeter / kCells};
}

bool is_thin(const RegionExtent& e) { return e.area < e.perimeter * kThin; }

// Queries on the segments that the search for a position makes, one by one.
struct ByScalars {
  const SegmentSet& set;

  // Distance from a position to the nearest segment.
  double clearance(RegionPoint q) const {
    double least2 = INFINITY;
    for (const Segment& s : set.segments) {
      const double fx = s.b.x - s.a.x, fy = s.b.y - s.a.y, x = q.x - s.a.x, y = q.y - s.a.y;
      const double length2 = fx * fx + fy * fy;
      const double t = length2 > 0 ? std::clamp((x * fx + y * fy) / length2, 0.0, 1.0) : 0.0;
      const double rx = x - t * fx, ry = y - t * fy;
      least2 = std::min(least2, rx * rx + ry * ry);
    }
    return std::sqrt(least2);
  }
  // Distance from a position along a direction to the next segment other than `but`.
  double distance_to_next(RegionPoint from, RegionPoint direction, std::uint32_t but) const {
    double nearest = INFINITY;
    for (std::uint32_t i = 0; i < set.segments.size(); ++i) {
      if (i == but) continue;
      const Segment& s = set.segments[i];
      const double fx = s.b.x - s.a.x, fy = s.b.y - s.a.y;
      const double x = s.a.x - from.x, y = s.a.y - from.y;
      const double det = direction.x * fy - direction.y * fx;
      if (det == 0) continue;
      const double distance = (x * fy - y * fx) / det, t = (x * direction.y - y * direction.x) / det;
      if (distance > 0 && t >= 0 && t <= 1) nearest = std::min(nearest, distance);
    }
    return nearest;
  }
  bool lies_within(RegionPoint q, std::int32_t level) const { return count_at(set, q.x, q.y) <= level; }
};

// The same queries on packs.
struct ByPacks {
  const SegmentSet& set;
  const SegmentArrays& arrays;
  const ShadowTable& packs;
  SegmentView view = arrays.view();

  static float single(double x) { return static_cast<float>(x); }
  double clearance(RegionPoint q) const { return std::sqrt(static_cast<double>(packs.clearance2(view, single(q.x), single(q.y)))); }
  double distance_to_next(RegionPoint from, RegionPoint direction, std::uint32_t but) const {
    const float d =
        packs.distance_to_next(view, single(from.x), single(from.y), single(direction.x), single(direction.y), arrays.place[but]);
    return d < 1e29f ? static_cast<double>(d) : std::numeric_limits<double>::infinity();
  }
  bool lies_within(RegionPoint q, std::int32_t level) const {
    const float y = single(q.y);
    std::int32_t count = packs.count_at(view, single(q.x), y);
    if (count == kUncertain) return false;
    count += set.base;
    for (const LeftEvent& event : set.events)
      if (static_cast<float>(event.y) < y) count += event.weight;
    return (set.layered ? without_layers(count) : count) <= level;
  }
};

// Finds a position well inside the region of a level: from the middles of its longest pieces along the normal, half way to the next
// segment. Returns false if there is none, which happens to slivers only.
template <class By>
bool place_inside(const By& by, const std::vector<Piece>& pieces, std::int32_t level, RegionPoint& result) {
  constexpr int kTrials = 4;
  constexpr double kRoomEnough = kCells / 32.0;
  thread_local std::vector<std::pair<double, const Piece*>> longest;
  longest.clear();
  for (const Piece& p : pieces) {
    if (!bounds(p, level)) continue;
    const double x = p.bx - p.ax, y = p.by - p.ay;
    longest.push_back({x * x + y * y, &p});
  }
  std::sort(longest.begin(), longest.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  int trials = 0;
  double best = 0;
  for (const auto& [length2, p] : longest) {
    const double scale = (p->left < p->right ? 1 : -1) / std::sqrt(length2);
    const RegionPoint inward{-(p->by - p->ay) * scale, (p->bx - p->ax) * scale};
    const RegionPoint middle{0.5 * (p->ax + p->bx), 0.5 * (p->ay + p->by)};
    const double distance = by.distance_to_next(middle, inward, p->segment);
    if (!std::isfinite(distance)) continue;
    const RegionPoint q{middle.x + 0.5 * distance * inward.x, middle.y + 0.5 * distance * inward.y};
    // Collinear edges of abutting faces can put it on the wrong side.
    if (!by.lies_within(q, level)) continue;
    const double room = by.clearance(q);
    if (room > best) {
      best = room;
      result = q;
    }
    if (++trials == kTrials || best > kRoomEnough) break;
  }
  return trials > 0 && best > 0;
}

void take(const Scratch& scratch, std::int32_t level, VisibleRegion& result) {
  result.level = level;
  for (const Piece& p : scratch.pieces) {
    if (!bounds(p, level)) continue;
    const Source source = scratch.set.segments[p.segment].source;
    if (p.left < p.right)
      result.boundary.push_back({p.ax, p.ay, p.bx, p.by, source, p.segment});
    else
      result.boundary.push_back({p.bx, p.by, p.ax, p.ay, source, p.segment});
  }
}

// Finds the visible region of scratch.pieces.
template <class By>
void find_in_pieces(const By& by, const LightFrame& frame, Vec3d from, const Blockers& blockers, Scratch& scratch, VisibleRegion& result) {
  result.boundary.clear();
  result.rays = 0;
  if (scratch.set.layered)
    for (Piece& p : scratch.pieces) p.left = without_layers(p.left), p.right = without_layers(p.right);
  std::vector<std::int32_t>& levels = scratch.levels;
  levels.clear();
  for (const Piece& p : scratch.pieces)
    if (p.low() < kHidden / 2 && std::find(levels.begin(), levels.end(), p.low()) == levels.end()) levels.push_back(p.low());
  std::sort(levels.begin(), levels.end());

  const auto free = [&](RegionPoint q) {
    ++result.rays;
    const Vec3d there = frame.to_world({q.x / kCells * frame.box_x, q.y / kCells * frame.box_y, 0});
    return !blockers.between(from, from + frame.way(from, there));
  };
  bool thin = false;
  std::int32_t thin_level = 0;
  RegionPoint thin_place;
  for (const std::int32_t level : levels) {
    const RegionExtent extent = extent_of(scratch.pieces, level);
    RegionPoint q;
    if (!(extent.area > 0) ||
        !(place_inside(by, scratch.pieces, level, q) || place_inside(ByScalars{scratch.set}, scratch.pieces, level, q)))
      continue;
    if (is_thin(extent)) {
      thin = true;
      thin_level = level;
      thin_place = q;
      continue;
    }
    if (free(q)) return take(scratch, level, result);
    break;
  }
  if (thin && free(thin_place)) take(scratch, thin_level, result);
}

}  // namespace

void find_visible(const LightFrame& frame, Vec3d from, const Blockers& blockers, Scratch& scratch, VisibleRegion& result) {
  arrange(scratch.set, scratch.pieces);
  find_in_pieces(ByScalars{scratch.set}, frame, from, blockers, scratch, result);
}

void find_visible_on_packs(const ShadowTable& packs, const LightFrame& frame, Vec3d from, const Blockers& blockers, Scratch& scratch,
                           VisibleRegion& result) {
  arrange(packs, scratch.set, scratch.arrays, scratch.pieces);
  find_in_pieces(ByPacks{scratch.set, scratch.arrays, packs}, frame, from, blockers, scratch, result);
}

Width width_of(const SegmentSet& set, const std::vector<Piece>& pieces, std::int32_t level, double& x, double& y) {
  const RegionExtent extent = extent_of(pieces, level);
  RegionPoint q;
  if (!(extent.area > 0) || !place_inside(ByScalars{set}, pieces, level, q)) return Width::none;
  x = q.x;
  y = q.y;
  return is_thin(extent) ? Width::thin : Width::wide;
}

WorldPiece relative_to(Vec3d from, const LightFrame& frame, const Boundary& piece) {
  const Vec3d eye = frame.to_local(from);
  const auto world = [&](double x, double y) {
    return frame.axes.to_world({x / kCells * frame.box_x - eye.x, y / kCells * frame.box_y - eye.y, -eye.z});
  };
  return {world(piece.ax, piece.ay), world(piece.bx, piece.by)};
}

}  // namespace steradian::shadow
