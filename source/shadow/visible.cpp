#include "shadow/visible.h"

#include <algorithm>
#include <cmath>

namespace steradian::shadow {
namespace {

// A region narrower than this share of the light proves nothing by a ray, and counts for as little.
constexpr double kThin = 1.0 / 4096;

struct Place {
  double x = 0, y = 0;
};

bool bounds(const Piece& p, std::int32_t level) { return p.low() <= level && level < p.high(); }

struct Extent {
  double area = 0, perimeter = 0;  // in half sides of the box
};

Extent extent_of(const std::vector<Piece>& pieces, std::int32_t level) {
  Extent e;
  for (const Piece& p : pieces) {
    if (!bounds(p, level)) continue;
    const double area = 0.5 * (p.ax * p.by - p.ay * p.bx);
    e.area += p.left < p.right ? area : -area;
    e.perimeter += std::hypot(p.bx - p.ax, p.by - p.ay);
  }
  return {e.area / kCells / kCells, e.perimeter / kCells};
}

// Distance from a place to the nearest segment.
double clearance(const SegmentSet& set, Place q) {
  double least = INFINITY;
  for (const Segment& s : set.segments) {
    const double fx = s.b.x - s.a.x, fy = s.b.y - s.a.y, x = q.x - s.a.x, y = q.y - s.a.y;
    const double length2 = fx * fx + fy * fy;
    const double t = length2 > 0 ? std::clamp((x * fx + y * fy) / length2, 0.0, 1.0) : 0.0;
    least = std::min(least, std::hypot(x - t * fx, y - t * fy));
  }
  return least;
}

// How far it is from a place along a direction to the next segment but one.
double distance_to_next(const SegmentSet& set, Place from, Place direction, std::uint32_t but) {
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

// A place well inside the region of a level: from the middles of its longest pieces along the normal, half way to what comes
// next. False where there is none, which happens to slivers only.
bool place_inside(const Scratch& scratch, std::int32_t level, Place& result) {
  constexpr int kTrials = 4;
  thread_local std::vector<std::pair<double, const Piece*>> longest;
  longest.clear();
  for (const Piece& p : scratch.pieces) {
    if (!bounds(p, level)) continue;
    const double x = p.bx - p.ax, y = p.by - p.ay;
    longest.push_back({x * x + y * y, &p});
  }
  std::sort(longest.begin(), longest.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  int trials = 0;
  double best = 0;
  for (const auto& [length2, p] : longest) {
    const double scale = (p->left < p->right ? 1 : -1) / std::sqrt(length2);
    const Place inward{-(p->by - p->ay) * scale, (p->bx - p->ax) * scale};
    const Place middle{0.5 * (p->ax + p->bx), 0.5 * (p->ay + p->by)};
    const double distance = distance_to_next(scratch.set, middle, inward, p->segment);
    if (!std::isfinite(distance)) continue;
    const Place q{middle.x + 0.5 * distance * inward.x, middle.y + 0.5 * distance * inward.y};
    // Collinear edges of abutting faces send it to the wrong side.
    if (count_at(scratch.set, q.x, q.y) > level) continue;
    const double room = clearance(scratch.set, q);
    if (room > best) {
      best = room;
      result = q;
    }
    if (++trials == kTrials) break;
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

}  // namespace

void find_visible(const LightFrame& frame, Vec3d from, const Blockers& blockers, Scratch& scratch, VisibleRegion& result) {
  result.boundary.clear();
  result.rays = 0;
  arrange(scratch.set, scratch.pieces);
  std::vector<std::int32_t> levels;
  for (const Piece& p : scratch.pieces)
    if (p.low() < kHidden / 2) levels.push_back(p.low());
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());

  const double z = -frame.to_local(from).z;
  const auto free = [&](Place q) {
    ++result.rays;
    const Vec3d there = frame.to_world({q.x / kCells * frame.box_x, q.y / kCells * frame.box_y, 0});
    return !blockers.between(from, from + (there - from) * std::max((z - frame.eta) / z, 0.0));
  };
  bool thin = false;
  std::int32_t thin_level = 0;
  Place thin_place;
  for (const std::int32_t level : levels) {
    const Extent extent = extent_of(scratch.pieces, level);
    Place q;
    if (!(extent.area > 0) || !place_inside(scratch, level, q)) continue;
    if (extent.area < extent.perimeter * kThin) {
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

WorldPiece relative_to(Vec3d from, const LightFrame& frame, const Boundary& piece) {
  const Vec3d eye = frame.to_local(from);
  const auto world = [&](double x, double y) {
    return frame.axes.to_world({x / kCells * frame.box_x - eye.x, y / kCells * frame.box_y - eye.y, -eye.z});
  };
  return {world(piece.ax, piece.ay), world(piece.bx, piece.by)};
}

}  // namespace steradian::shadow
