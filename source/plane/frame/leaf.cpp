#include "plane/frame/leaf.h"

#include <algorithm>
#include <cmath>

namespace steradian::plane {
namespace {

float f(double x) { return static_cast<float>(x); }

Vec2d nearest_on(Vec2d a, Vec2d b, Vec2d p) {
  const Vec2d ab = b - a;
  const double l = dot(ab, ab);
  return l > 0 ? a + ab * std::clamp(dot(p - a, ab) / l, 0.0, 1.0) : a;
}

}  // namespace

DepthLine LeafBuilder::Depth::line() const { return {f(normal.x), f(normal.y), f(offset)}; }

void LeafBuilder::enter(const TileArea& tile) {
  tile_ = tile;
  ++tile_number_;
  pool_count_ = 0;
  shadows_.enter(tile);
}

double LeafBuilder::extent(Vec2d normal) const { return std::fabs(normal.x) * tile_.half.x + std::fabs(normal.y) * tile_.half.y; }

// The hull of tile and emitter: lines that touch the circles about both, moved in to touch the rectangle and the
// emitter themselves.
SeenLight LeafBuilder::see(const Emitter& e) const {
  SeenLight seen;
  seen.edge = e.kind == Emitter::Kind::edge;
  seen.normal = e.normal;
  seen.at = light_.a;
  seen.margin = (seen.edge ? extent(e.normal) : tile_.radius) + 1e-3;
  const Vec2d axis = light_.center;
  const double d = std::sqrt(std::max(dot(axis, axis), 1e-300));
  const double sine = std::clamp((tile_.radius - light_.bound) / d, -0.99, 0.99), cosine = std::sqrt(1 - sine * sine);
  const Vec2d along = axis / d, left{-along.y, along.x};
  const auto side = [&](HullSide& h, Vec2d normal, Vec2d forward) {
    const double at_a = dot(normal, light_.a), at_b = dot(normal, light_.b);
    h.normal = normal;
    h.forward = forward;
    h.offset = std::max(std::max(at_a, at_b) + light_.radius, extent(normal)) + 1e-9 * d;
    h.limit = dot(forward, at_a > at_b ? light_.a : light_.b);
    if (extent(forward) > h.limit) h.limit = -1e300;  // the tile is not before the light: nothing is known
  };
  side(seen.high, left * cosine + along * sine, along * cosine - left * sine);
  side(seen.low, along * sine - left * cosine, along * cosine + left * sine);
  return seen;
}

bool LeafBuilder::passes_by(Vec2d center, double radius) const {
  return dot(seen_.low.normal, center) - seen_.low.offset > radius || dot(seen_.high.normal, center) - seen_.high.offset > radius;
}

// A line between emitter and blocker, which do not overlap.
LeafBuilder::Depth LeafBuilder::depth_of_round(const Blocker& b, Vec2d center) const {
  const bool lens = b.kind == Blocker::Kind::lens;
  const Vec2d at = lens ? light_.a : nearest_on(light_.a, light_.b, center), to = center - at;
  const double d = length(to);
  const Vec2d normal = to / d;
  const Vec2d through = lens ? b.crossing[0] - tile_.center : at + to * ((light_.radius + 0.5 * (d - light_.radius - b.bound)) / d);
  return {normal, -dot(normal, through)};
}

// False: the blocker is never in front.
bool LeafBuilder::depth_of(const Silhouette& s, Depth& depth) const {
  const int count = s.count;
  const auto next = [&](int k) { return s.at(k + 1 < count ? k + 1 : 0); };
  const auto through = [&](Vec2d normal, Vec2d p) {
    depth.normal = normal;
    depth.offset = -dot(normal, p);
    return true;
  };
  if (!seen_.edge) {
    Vec2d best;
    double best_d2 = 1e300;
    for (int k = 0; k < count; ++k) {
      const Vec2d p = nearest_on(s.at(k), next(k), light_.a);
      const double d2 = dot(p - light_.a, p - light_.a);
      if (d2 < best_d2) best_d2 = d2, best = p;
    }
    return best_d2 > 0 && through((best - light_.a) / std::sqrt(best_d2), best);
  }
  const Vec2d n = seen_.normal;
  const double slack = 1e-8;
  double low = 1e300, high = -1e300;
  for (int k = 0; k < count; ++k) low = std::min(low, dot(n, s.at(k) - light_.a)), high = std::max(high, dot(n, s.at(k) - light_.a));
  if (high <= slack) return false;
  if (low >= -slack) return through(n, light_.a);
  double widest = -1e300;
  for (int k = 0; k < count; ++k) {
    const Vec2d p = s.at(k), q = next(k);
    Vec2d out = Vec2d{q.y - p.y, p.x - q.x} / length(q - p);
    double gap = std::min(dot(out, light_.a - p), dot(out, light_.b - p));
    if (count == 2) {
      // A segment has two outsides.
      const double other = std::min(-dot(out, light_.a - p), -dot(out, light_.b - p));
      if (other > gap) gap = other, out = -out;
    }
    if (gap > widest) widest = gap, through(-out, p);
  }
  return true;
}

LeafBuilder::Side LeafBuilder::side_of(const Depth& depth) const {
  const double reach = extent(depth.normal);
  if (depth.offset > reach) return Side::front;
  return depth.offset < -reach ? Side::behind : Side::mixed;
}

// By the line half way between the emitter's bounding circle and this one.
LeafBuilder::Side LeafBuilder::side_of_circle(Vec2d center, double radius) const {
  const Vec2d to = center - light_.center;
  const double d = length(to);
  if (d <= light_.bound + radius) return Side::mixed;
  const double at = -dot(to, light_.center) - 0.5 * d * (d + light_.bound - radius), reach = extent(to);
  if (at > reach) return Side::front;
  return at < -reach ? Side::behind : Side::mixed;
}

// Where in the pool; -1: all of the tile lies within the blocker.
int LeafBuilder::silhouette(int blocker) {
  auto& [tile, slot] = slots_[static_cast<std::size_t>(blocker)];
  if (tile == tile_number_) return slot;
  tile = tile_number_;
  slot = static_cast<int>(pool_count_);
  if (pool_count_ == pool_.size()) pool_.resize(2 * pool_count_ + 64);
  Silhouette& s = pool_[pool_count_];
  const Blocker& b = frame_.blockers[static_cast<std::size_t>(blocker)];
  s.center = b.center - tile_.center;
  s.radius = b.bound;
  if (b.kind == Blocker::Kind::convex) {
    table_.outline(frame_.outlines[static_cast<std::size_t>(b.outline)], tile_, s);
    s.kind = s.count == 2 ? Silhouette::Kind::segment : Silhouette::Kind::polygon;
    if (s.begins == 0 || s.ends == 0) return slot = -1;
  } else {
    const Vec2d left = Vec2d{-s.center.y, s.center.x} * (s.radius / length(s.center)), begin = s.center - left, end = s.center + left;
    s.kind = Silhouette::Kind::disk;
    s.count = 2;
    for (int k = 0; k < 2; ++k) s.x[k] = k == 0 ? begin.x : end.x, s.y[k] = k == 0 ? begin.y : end.y;
    s.begins = 1;
    s.ends = 2;
  }
  ++pool_count_;
  return slot;
}

void LeafBuilder::add_convex(int blocker) {
  const Blocker& b = frame_.blockers[static_cast<std::size_t>(blocker)];
  Side side = side_of_circle(b.center - tile_.center, b.bound);
  if (side == Side::behind) return;
  const int slot = silhouette(blocker);
  if (slot < 0) return;
  const Silhouette& s = pool_[static_cast<std::size_t>(slot)];
  const VertexMarks marks = table_.mark(s, seen_);
  const unsigned outer = s.begins | s.ends;
  if ((outer & ~marks.past_low) == 0 || (outer & ~marks.past_high) == 0) return;  // passes by
  Depth depth;
  if (side == Side::mixed) {
    if (!depth_of(s, depth)) return;
    side = side_of(depth);
    if (side == Side::behind) return;
  }
  if (side == Side::mixed) {
    shadows_.take_deep(slot, marks.ahead, depth.line());
    return;
  }
  // Any one vertex that is ahead and beside the light will do; vertices elsewhere only if they all are.
  const bool from_low = (s.begins & ~marks.beside_low) == 0 || (outer & marks.beside_low & marks.ahead) != 0;
  const bool to_high = (s.ends & ~marks.beside_high) == 0 || (outer & marks.beside_high & marks.ahead) != 0;
  shadows_.take_front(slot, marks.ahead, from_low, to_high);
}

void LeafBuilder::add_round(int blocker) {
  const Blocker& b = frame_.blockers[static_cast<std::size_t>(blocker)];
  const Vec2d center = b.center - tile_.center;
  if (passes_by(center, b.bound)) return;
  const Depth depth = depth_of_round(b, center);
  const bool lens = b.kind == Blocker::Kind::lens;
  const Side side = side_of(depth);
  if (!lens && side == Side::behind) return;
  if (!lens && side == Side::front && b.round && ahead(center, b.bound)) {
    // A point of it beside the light is enough.
    const auto beside = [&](const HullSide& h) { return dot(h.normal, center) - h.offset > -b.bound && dot(h.forward, center) < h.limit; };
    shadows_.take_front(silhouette(blocker), 3, beside(seen_.low), beside(seen_.high));
    return;
  }
  TileRound r;
  const double det = cross(b.x_axis, b.y_axis);
  r.cx = f(center.x);
  r.cy = f(center.y);
  r.xx = f(b.x_axis.x);
  r.xy = f(b.x_axis.y);
  r.yx = f(b.y_axis.x);
  r.yy = f(b.y_axis.y);
  r.ux = f(b.y_axis.y / det);
  r.uy = f(-b.y_axis.x / det);
  r.vx = f(-b.x_axis.y / det);
  r.vy = f(b.x_axis.x / det);
  r.depth_x = f(depth.normal.x);
  r.depth_y = f(depth.normal.y);
  r.depth_c = f(depth.offset);
  if (!lens) {
    shadows_.take(r, b.bound);
    return;
  }
  TileLens l;
  l.round = r;
  for (int k = 0; k < 2; ++k) {
    l.x[k] = f(b.crossing[k].x - tile_.center.x);
    l.y[k] = f(b.crossing[k].y - tile_.center.y);
    l.lx[k] = f(b.light_normal[k].x);
    l.ly[k] = f(b.light_normal[k].y);
    l.bx[k] = f(b.blocker_normal[k].x);
    l.by[k] = f(b.blocker_normal[k].y);
  }
  shadows_.take(l);
}

// Is a disk in front of every pixel's axis? As for vertices.
bool LeafBuilder::ahead(Vec2d v, double radius) const {
  const double clear = seen_.margin + radius;
  if (seen_.edge) return -dot(seen_.normal, v) > clear;
  const double side = dot(v, seen_.at) - clear * clear;
  const Vec2d apart = v - seen_.at;
  return side > 0 && side * side > clear * clear * dot(apart, apart);
}

TileLight LeafBuilder::light_of(const Emitter& e) const {
  const PlaneEmission& emission = *frame_.world->scene.bodies[static_cast<std::size_t>(e.body)].light;
  TileLight light{};
  light.inverse_range = emission.range < 1e300 ? f(1 / emission.range) : 0;
  light.profile = static_cast<int>(emission.profile);
  Vec3d from = emission.radiance, slope;
  if (seen_.edge) {
    light.edge = true;
    const Vec2d n = seen_.normal, t{n.y, -n.x};
    light.nx = f(n.x);
    light.ny = f(n.y);
    light.begin = f(dot(light_.b, t));
    light.end = f(dot(light_.a, t));
    from = e.radiance.b;
    slope = (e.radiance.a - e.radiance.b) / length(e.b - e.a);
    light.linear = slope.x != 0 || slope.y != 0 || slope.z != 0;
  }
  light.x = f(light_.a.x);
  light.y = f(light_.a.y);
  light.radius = f(light_.radius);
  light.red = f(from.x);
  light.green = f(from.y);
  light.blue = f(from.z);
  light.red_slope = f(slope.x);
  light.green_slope = f(slope.y);
  light.blue_slope = f(slope.z);
  return light;
}

LeafBuilder::Result LeafBuilder::build(const Emitter& e, const int* blockers, std::size_t count) {
  light_ = {e.a - tile_.center, e.b - tile_.center, e.center - tile_.center, e.radius, e.bound};
  seen_ = see(e);
  shadows_.clear(pool_, light_.center);
  for (std::size_t i = 0; i < count; ++i) {
    if (frame_.blockers[static_cast<std::size_t>(blockers[i])].kind == Blocker::Kind::convex)
      add_convex(blockers[i]);
    else
      add_round(blockers[i]);
  }
  if (shadows_.hidden()) return {{}, false};
  TileLight light = light_of(e);
  shadows_.write(light);
  const std::size_t needed = 32 * shadows_.intervals();
  if (scratch_.size() < needed) scratch_.resize(2 * needed);
  light.scratch = scratch_.data();
  return {light, true};
}

}  // namespace steradian::plane
