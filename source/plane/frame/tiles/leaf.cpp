#include "plane/frame/tiles/leaf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/frame/emitters.h"
#include "plane/frame/runs/overlap.h"

namespace steradian::plane {
namespace {

float f(double x) { return static_cast<float>(x); }

// Number of nodes of Gauss' rule in the angle of incidence, 0 for more than sixteen. `d` is the eye's distance in the space where the
// ellipse is the unit circle. `stretch` is its longer half axis over the other, `span` the arc's part of the unit circle, `reach` the
// longer half axis over the light's range.
//
// The error is at most 3e-6 of a light all around: largest differences from 100 nodes, over parts of the outline, with linear radiance,
// Lambert, 1/r and a range. If the range ends on the outline, 12 nodes are within 1e-6.
int nodes_for(double d, double stretch, double span, bool lambert, bool within_range, double reach) {
  const bool round = stretch < 1 + 1e-9;
  if (!within_range && 5 * reach > 1) return 0;
  if (lambert && !round) return stretch > 3 || d < 3 ? 0 : stretch > 2 ? 16 : 12;
  const double x = d / stretch;
  if (x < (round ? 1.15 : 1.2)) return 0;
  // The angle of incidence is the sum of the place on the unit circle and psi; it is at least d times psi.
  const double widest = span / (1 - 1 / d);
  if (!within_range) return 12;
  if (widest < 1.2 ? x > 1.6 : widest < 1.7 && x > 4) return 4;
  if (widest < 1.7 || x > (round ? 3 : 4)) return 6;
  return x > (round ? 1.5 : 2.4) ? 8 : 12;
}

// An edge of size 1 at this distance from one of its ends is at least 5 from a pixel: TilePart::small.
constexpr double kSmallParts = 6;

}  // namespace

DepthLine LeafBuilder::Depth::line() const { return {f(normal.x), f(normal.y), f(offset)}; }

void LeafBuilder::enter(const TileRectangle& tile) {
  tile_ = tile;
  ++tile_number_;
  pool_count_ = 0;
  shadows_.enter(tile);
}

double LeafBuilder::extent(Vec2d normal) const { return std::fabs(normal.x) * tile_.half.x + std::fabs(normal.y) * tile_.half.y; }

// The hull of tile and emitter: lines that touch the circles around both, moved in to touch the rectangle and the emitter themselves.
SeenEmitter LeafBuilder::see(const Emitter& e) const {
  SeenEmitter seen;
  seen.edge = e.kind == Emitter::Kind::edge;
  seen.normal = is_run(e) ? -view_of(e, tile_).axis : e.normal;
  seen.at = light_.a;
  seen.margin = (seen.edge ? extent(seen.normal) : tile_.radius) + 1e-3;
  const Vec2d axis = light_.center;
  // If some pixel may lie within the bounding circle of an ellipse, slopes are not relative to its centre: see TileArc.
  if (e.kind == Emitter::Kind::arc && length(axis) <= e.bound + tile_.radius) seen.margin = 1e30;
  const double d = std::sqrt(std::max(dot(axis, axis), 1e-300));
  const double sine = std::clamp((tile_.radius - light_.bound) / d, -0.99, 0.99), cosine = std::sqrt(1 - sine * sine);
  const Vec2d along = axis / d, left{-along.y, along.x};
  const auto side = [&](HullSide& h, Vec2d normal, Vec2d forward) {
    const double at_a = dot(normal, light_.a), at_b = dot(normal, light_.b);
    Vec2d furthest = at_a > at_b ? light_.a : light_.b;
    double at_furthest = std::max(at_a, at_b) + light_.radius;
    if (!light_.hull.empty()) {
      at_furthest = -1e300;
      for (Vec2d v : light_.hull)
        if (const double at = dot(normal, v); at > at_furthest) at_furthest = at, furthest = v;
    }
    h.normal = normal;
    h.forward = forward;
    h.offset = std::max(at_furthest, extent(normal)) + 1e-9 * d;
    h.limit = dot(forward, furthest);
    if (seen.edge) h.least = extent(forward);
    if (extent(forward) > h.limit) h.limit = -1e300;  // the tile is not in front of the light: nothing is known
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
  if (b.line >= 0) {
    const DividingLine& line = frame_.lines[static_cast<std::size_t>(b.line)];
    return {line.normal, -dot(line.normal, line.point - tile_.center)};
  }
  const bool run = !light_.hull.empty();
  const double radius = run ? 0 : light_.radius;
  const Vec2d at = run ? nearest_of({light_.hull.data(), light_.hull.size()}, center) : nearest_on_segment(light_.a, light_.b, center),
              to = center - at;
  const double d = length(to);
  const Vec2d normal = to / d;
  const Vec2d through = at + to * ((radius + 0.5 * (d - radius - b.bound)) / d);
  return {normal, -dot(normal, through)};
}

LeafBuilder::Depth LeafBuilder::depth_of_run(int blocker) {
  if (known_lines_.empty()) known_lines_.resize(1024);
  KnownLine& known =
      known_lines_[(static_cast<std::size_t>(emitter_ - frame_.emitters.data()) * 67 + static_cast<std::size_t>(blocker)) % 1024];
  if (known.run != emitter_ || known.blocker != blocker) {
    const Blocker& b = frame_.blockers[static_cast<std::size_t>(blocker)];
    const Gap gap = gap_between(region_of(*emitter_), {&frame_.vertices[b.first], b.count});
    known = {emitter_, blocker, {gap.normal, gap.point}};
  }
  return {known.line.normal, -dot(known.line.normal, known.line.point - tile_.center)};
}

// Returns false if the blocker is never in front.
bool LeafBuilder::depth_of(int blocker, Depth& depth) {
  if (!light_.hull.empty()) {
    depth = depth_of_run(blocker);
    return true;
  }
  const Blocker& b = frame_.blockers[static_cast<std::size_t>(blocker)];
  const int count = static_cast<int>(b.count);
  const auto at = [&](int k) { return frame_.vertices[b.first + static_cast<std::size_t>(k)] - tile_.center; };
  const auto next = [&](int k) { return at(k + 1 < count ? k + 1 : 0); };
  const auto through = [&](Vec2d normal, Vec2d p) {
    depth.normal = normal;
    depth.offset = -dot(normal, p);
    return true;
  };
  if (!seen_.edge) {
    // In the space where the light is the unit circle: the line through the blocker's nearest point.
    const PlaneEllipse& space = light_.ellipse;
    Vec2d best;
    double best_d2 = 1e300;
    for (int k = 0; k < count; ++k) {
      const Vec2d p = nearest_on_segment(space.to_unit(at(k)), space.to_unit(next(k)), {0, 0});
      const double d2 = dot(p, p);
      if (d2 < best_d2) best_d2 = d2, best = p;
    }
    const Vec2d normal{space.y.y * best.x - space.x.y * best.y, space.x.x * best.y - space.y.x * best.x};
    return best_d2 > 0 && through(normal / length(normal), space.center + space.x * best.x + space.y * best.y);
  }
  const Vec2d n = seen_.normal;
  const double slack = 1e-8;
  Interval<double> heights;
  for (int k = 0; k < count; ++k) heights.add(dot(n, at(k) - light_.a));
  if (heights.high <= slack) return false;
  if (heights.low >= -slack) return through(n, light_.a);
  double widest = -1e300;
  for (int k = 0; k < count; ++k) {
    const Vec2d p = at(k), q = next(k);
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

// Decides by the line half way between the emitter's bounding circle and this one.
LeafBuilder::Side LeafBuilder::side_of_circle(Vec2d center, double radius) const {
  const Vec2d to = center - light_.center;
  const double d = length(to);
  if (d <= light_.bound + radius) return Side::mixed;
  const double at = -dot(to, light_.center) - 0.5 * d * (d + light_.bound - radius), reach = extent(to);
  if (at > reach) return Side::front;
  return at < -reach ? Side::behind : Side::mixed;
}

// Index in the pool; -1: all of the tile lies within the blocker.
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
  if (b.kind == Blocker::Kind::convex && b.outline < 0) {
    s.kind = Silhouette::Kind::polygon;
    if (!outline_of_many(b, s)) return slot = -1;
  } else if (b.kind == Blocker::Kind::convex) {
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

// As SilhouetteTable::outline, with only those vertices in which some pixel may see the blocker begin or end. Returns false if the tile is
// not outside, or if they are too many.
bool LeafBuilder::outline_of_many(const Blocker& b, Silhouette& s) const {
  const Vec2d* v = &frame_.vertices[b.first];
  const auto face = [&](std::size_t k) {
    const Vec2d p = v[k], along = v[k + 1 < b.count ? k + 1 : 0] - p, out{along.y, -along.x};
    const double height = dot(out, tile_.center - p), reach = extent(out);
    return height > reach ? Facing::all : height < -reach ? Facing::none : Facing::some;
  };
  s.count = 0;
  s.begins = s.ends = 0;
  s.outside = false;
  Facing before = face(b.count - 1);
  for (std::size_t k = 0; k < b.count; ++k) {
    const Facing now = face(k);
    s.outside = s.outside || now == Facing::all;
    const bool begins = before != Facing::none && now != Facing::all, ends = before != Facing::all && now != Facing::none;
    before = now;
    if (!begins && !ends) continue;
    if (s.count == Silhouette::kMost) return false;
    const unsigned bit = 1u << s.count;
    s.x[s.count] = v[k].x - tile_.center.x;
    s.y[s.count] = v[k].y - tile_.center.y;
    s.begins = static_cast<std::uint16_t>(s.begins | (begins ? bit : 0));
    s.ends = static_cast<std::uint16_t>(s.ends | (ends ? bit : 0));
    ++s.count;
  }
  return s.outside && s.begins != 0 && s.ends != 0;
}

void LeafBuilder::add_convex(int blocker) {
  const Blocker& b = frame_.blockers[static_cast<std::size_t>(blocker)];
  Side side = side_of_circle(b.center - tile_.center, b.bound);
  if (side == Side::behind) return;
  const int slot = silhouette(blocker);
  if (b.edges != 0 && (slot < 0 || !pool_[static_cast<std::size_t>(slot)].outside)) {
    for_each_part(frame_.blockers, blocker, [&](int part) { add_convex(part); });
    return;
  }
  if (slot < 0) return;
  const Silhouette& s = pool_[static_cast<std::size_t>(slot)];
  const VertexMarks marks = table_.mark(s, seen_);
  const unsigned outer = s.begins | s.ends;
  if ((outer & ~marks.past_low) == 0 || (outer & ~marks.past_high) == 0) return;  // it does not touch the light
  Depth depth;
  if (side == Side::mixed) {
    if (!depth_of(blocker, depth)) return;
    side = side_of(depth);
    if (side == Side::behind) return;
  }
  if (side == Side::mixed) {
    shadows_.take_deep(slot, marks.ahead, depth.line());
    return;
  }
  // One vertex that is ahead and beside the light is enough; vertices elsewhere count only if all of them are.
  const bool from_low = (s.begins & ~marks.beside_low) == 0 || (outer & marks.beside_low & marks.ahead) != 0;
  const bool to_high = (s.ends & ~marks.beside_high) == 0 || (outer & marks.beside_high & marks.ahead) != 0;
  shadows_.take_front(slot, marks.ahead, from_low, to_high);
}

TileRound LeafBuilder::round_of(const PlaneEllipse& e) const {
  TileRound r{};
  const double det = cross(e.x, e.y);
  r.cx = f(e.center.x);
  r.cy = f(e.center.y);
  r.xx = f(e.x.x);
  r.xy = f(e.x.y);
  r.yx = f(e.y.x);
  r.yy = f(e.y.y);
  r.ux = f(e.y.y / det);
  r.uy = f(-e.y.x / det);
  r.vx = f(-e.x.y / det);
  r.vy = f(e.x.x / det);
  return r;
}

void LeafBuilder::add_lens(const Blocker& b) {
  const Lens& lens = frame_.lenses[static_cast<std::size_t>(b.lens)];
  TileLens l{};
  l.round = round_of({b.center - tile_.center, b.x_axis, b.y_axis});
  l.count = lens.count;
  for (int k = 0; k < lens.count; ++k) {
    const Lens::Crossing& c = lens.crossings[k];
    const Vec2d at = c.at - tile_.center;
    l.crossings[k] = {f(at.x), f(at.y), f(c.light_normal.x), f(c.light_normal.y), f(c.blocker_normal.x), f(c.blocker_normal.y), c.begins};
  }
  shadows_.take(l);
}

void LeafBuilder::add_round(int blocker) {
  const Blocker& b = frame_.blockers[static_cast<std::size_t>(blocker)];
  const Vec2d center = b.center - tile_.center;
  if (passes_by(center, b.bound)) return;
  if (b.kind == Blocker::Kind::lens) return add_lens(b);
  const Depth depth = depth_of_round(b, center);
  const Side side = side_of(depth);
  if (side == Side::behind) return;
  if (side == Side::front && b.round && ahead(center, b.bound)) {
    // One point of it beside the light is enough.
    const auto beside = [&](const HullSide& h) {
      const double along = dot(h.forward, center);
      return dot(h.normal, center) - h.offset > -b.bound && along < h.limit && along > h.least;
    };
    shadows_.take_front(silhouette(blocker), 3, beside(seen_.low), beside(seen_.high));
    return;
  }
  TileRound r = round_of({center, b.x_axis, b.y_axis});
  r.depth_x = f(depth.normal.x);
  r.depth_y = f(depth.normal.y);
  r.depth_c = f(depth.offset);
  shadows_.take(r, b.bound);
}

// Is a disk in front of every pixel's axis? The test is as for vertices.
bool LeafBuilder::ahead(Vec2d v, double radius) const {
  const double clear = seen_.margin + radius;
  if (seen_.edge) return -dot(seen_.normal, v) > clear;
  const double side = dot(v, seen_.at) - clear * clear;
  const Vec2d apart = v - seen_.at;
  return side > 0 && side * side > clear * clear * dot(apart, apart);
}

TileArc LeafBuilder::arc_of(const Emitter& e) const {
  TileArc arc{};
  const auto unit = [](double tau) { return Vec2d{std::cos(tau), std::sin(tau)}; };
  const double last = e.tau0 + e.tau_span;
  const Vec2d u0 = unit(e.tau0), u1 = unit(last), um = unit(e.tau0 + 0.5 * e.tau_span);
  const Vec2d p0 = light_.ellipse.at(e.tau0), p1 = light_.ellipse.at(last);
  arc.x0 = f(p0.x);
  arc.y0 = f(p0.y);
  arc.x1 = f(p1.x);
  arc.y1 = f(p1.y);
  arc.u0 = f(u0.x);
  arc.v0 = f(u0.y);
  arc.u1 = f(u1.x);
  arc.v1 = f(u1.y);
  arc.um = f(um.x);
  arc.vm = f(um.y);
  arc.least_cosine = f(std::cos(0.5 * e.tau_span));
  arc.whole = e.whole;
  arc.between_tangents = seen_.margin > 1e29;
  const double det = cross(e.ellipse.x, e.ellipse.y);
  arc.det = f(det);
  arc.det_if_round = is_round(e.ellipse) ? arc.det : 0;
  const PlaneEmission& emission = emission_of(frame_, e);
  const double stretch = is_round(e.ellipse) ? 1 : stretch_of(e.ellipse), longer = std::sqrt(det * stretch);
  arc.nodes = nodes_for(length(light_.ellipse.to_unit({0, 0})) - tile_.radius * stretch / longer, stretch, e.tau_span,
                        emission.profile == PlaneProfile::lambert, length(light_.center) + e.bound + tile_.radius < emission.range,
                        longer / emission.range);
  arc.ramp_x = f(e.ramp.x);
  arc.ramp_y = f(e.ramp.y);
  arc.ramp_c = f(e.ramp_at_center);
  return arc;
}

namespace {

// The spot as seen from where its light arrives, with the axis reversed.
TileSpot spot_of(const PlaneEmission& emission) {
  TileSpot spot{};
  const Vec2d axis = -emission.spot_axis;
  const double half = emission.spot_half_angle, c = std::cos(half), s = std::sin(half);
  spot.present = (axis.x != 0 || axis.y != 0) && half < std::numbers::pi;
  if (!spot.present) return spot;
  const Vec2d a = axis / length(axis);
  spot.wide = half > 0.5 * std::numbers::pi;
  spot.low_x = f(a.x * c + a.y * s);
  spot.low_y = f(a.y * c - a.x * s);
  spot.high_x = f(a.x * c - a.y * s);
  spot.high_y = f(a.y * c + a.x * s);
  return spot;
}

}  // namespace

TileLight LeafBuilder::light_of(const Emitter& e) const {
  const PlaneEmission& emission = emission_of(frame_, e);
  TileLight light{};
  light.inverse_range = emission.range < 1e300 ? f(1 / emission.range) : 0;
  light.profile = static_cast<int>(emission.profile);
  light.spot = spot_of(emission);
  Vec3d from = emission.radiance, to = from;
  if (e.kind == Emitter::Kind::arc) {
    light.kind = TileKind::arc;
    light.arc = arc_of(e);
    from = e.radiance.a;
    to = e.radiance.b;
  }
  if (seen_.edge) {
    light.kind = TileKind::edge;
    const Vec2d n = seen_.normal, t{n.y, -n.x};
    light.nx = f(n.x);
    light.ny = f(n.y);
    light.begin = f(dot(light_.b, t));
    light.end = f(dot(light_.a, t));
    from = e.radiance.b;
    to = is_run(e) ? from : e.radiance.a;
  } else {
    light.shape = round_of(light_.ellipse);
  }
  light.linear = from.x != to.x || from.y != to.y || from.z != to.z;
  light.x = f(light_.a.x);
  light.y = f(light_.a.y);
  light.radius = f(light_.radius);
  light.red = f(from.x);
  light.green = f(from.y);
  light.blue = f(from.z);
  light.red_end = f(to.x);
  light.green_end = f(to.y);
  light.blue_end = f(to.z);
  return light;
}

void LeafBuilder::look_at_edges(const Emitter& run) {
  edges_.clear();
  const auto add = [&](const Emitter& e) { edges_.push_back({&e, e.a, e.b, facing(e, tile_)}); };
  if (!is_run(run)) return add(run);
  if (run.shape == Emitter::RunShape::around) {
    for (std::size_t k = 0; k < run.hull.size(); ++k) {
      const Vec2d a = run.hull[k], b = run.hull[k + 1 < run.hull.size() ? k + 1 : 0], along = b - a;
      edges_.push_back({nullptr, a, b, facing(a, Vec2d{along.y, -along.x} / length(along), tile_)});
    }
    return;
  }
  for (const Emitter* e = &run + 1; e < &run + run.group; ++e)
    if (!is_run(*e)) add(*e);
}

// Places at which a pixel of the tile may see the run begin and end. For a bowl they are the chord's ends, for others the corners between
// edges that face the pixel and edges that do not.
void LeafBuilder::add_corners(const Emitter& run, TileLight& light) {
  low_corners_.clear();
  high_corners_.clear();
  const auto corner = [&](Vec2d p) { return TileVertex{f(p.x - tile_.center.x), f(p.y - tile_.center.y)}; };
  const std::size_t count = edges_.size();
  if (run.shape == Emitter::RunShape::bowl) {
    low_corners_.push_back(corner(run.b));
    high_corners_.push_back(corner(run.a));
  } else {
    for (std::size_t k = 0; k < count; ++k) {
      if (edges_[k].facing == Facing::none) continue;
      const bool closed = run.shape == Emitter::RunShape::closed || run.shape == Emitter::RunShape::around;
      const Facing before = k > 0    ? edges_[k - 1].facing
                            : closed ? edges_[count - 1].facing
                                     : Facing::none,
                   after = k + 1 < count ? edges_[k + 1].facing
                           : closed      ? edges_[0].facing
                                         : Facing::none;
      if (before != Facing::all) high_corners_.push_back(corner(edges_[k].a));
      if (after != Facing::all) low_corners_.push_back(corner(edges_[k].b));
    }
  }
  light.low_corners = low_corners_.data();
  light.low_corner_count = static_cast<int>(low_corners_.size());
  light.high_corners = high_corners_.data();
  light.high_corner_count = static_cast<int>(high_corners_.size());
  // For a bulge or a closed run, all edges that face a pixel are entirely visible.
  light.all_parts_seen = run.shape != Emitter::RunShape::bowl ||
                         std::all_of(edges_.begin(), edges_.end(), [](const SeenEdge& e) { return e.facing == Facing::all; });
}

void LeafBuilder::add_parts(TileLight& light) {
  parts_.clear();
  for (const SeenEdge& seen : edges_) {
    if (seen.facing == Facing::none) continue;
    const Emitter& e = *seen.edge;
    const Vec2d a = e.a - tile_.center, b = e.b - tile_.center, n = e.normal, t{n.y, -n.x};
    const double size = length(e.b - e.a), least = kSmallParts * size + tile_.radius;
    const Vec3d from = e.radiance.b, to = e.radiance.a;
    const bool small = seen.facing == Facing::all && length(a) > least && length(b) > least;
    parts_.push_back({f(a.x), f(a.y), f(n.x), f(n.y), f(dot(b, t)), f(dot(a, t)), f(from.x), f(from.y), f(from.z), f(to.x), f(to.y),
                      f(to.z), f(b.x), f(b.y), f(a.x), f(a.y), small});
  }
  light.parts = parts_.data();
  light.part_count = static_cast<int>(parts_.size());
}

LeafBuilder::Result LeafBuilder::build(const Emitter& e, const int* blockers, std::size_t count) {
  light_.a = e.a - tile_.center;
  light_.b = e.b - tile_.center;
  light_.center = e.center - tile_.center;
  light_.radius = e.radius;
  light_.bound = e.bound;
  light_.hull.clear();
  if (is_run(e))
    for (Vec2d v : e.hull) light_.hull.push_back(v - tile_.center);
  if (e.kind != Emitter::Kind::edge) {
    light_.ellipse = ellipse_of(e);
    light_.ellipse.center = light_.center;
  }
  emitter_ = &e;
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
  if (seen_.edge) {
    look_at_edges(e);
    light.all_parts_seen = true;
    if (is_run(e)) {
      light.linear = e.wall || emission_of(frame_, e).gradient.has_value();
      add_corners(e, light);
    }
    if (light.linear || light.profile != 0 || light.inverse_range > 0) add_parts(light);
  }
  const std::size_t needed = 32 * shadows_.intervals();
  if (scratch_.size() < needed) scratch_.resize(2 * needed);
  light.scratch = scratch_.data();
  return {light, true};
}

}  // namespace steradian::plane
