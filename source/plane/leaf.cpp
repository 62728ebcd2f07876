#include "plane/leaf.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace steradian {
namespace {

float f(double x) { return static_cast<float>(x); }

Vec2d nearest_on(Vec2d a, Vec2d b, Vec2d p) {
  const Vec2d ab = b - a;
  const double l = dot(ab, ab);
  return l > 0 ? a + ab * std::clamp(dot(p - a, ab) / l, 0.0, 1.0) : a;
}

double extent(Vec2d normal, const TileArea& tile) {
  return std::fabs(normal.x) * tile.half.x + std::fabs(normal.y) * tile.half.y;
}

}  // namespace

// Is the point in front of every pixel's axis? For a disk: outside the circle over the point and the centre (Thales).
bool LeafBuilder::ahead(const PlaneEmitter& e, Vec2d v, const TileArea& tile) const {
  if (e.kind == PlaneEmitter::Kind::edge) {
    const Vec2d n = e.normal;
    return dot(n, tile.center - v) - extent(n, tile) > 1e-3;
  }
  const Vec2d away = tile.center - (v + e.a) * 0.5;
  const double clear = 0.5 * length(v - e.a) + tile.radius + 1e-3;
  return dot(away, away) > clear * clear;
}

// A line between emitter and blocker, which do not overlap. False: the blocker is never in front.
bool LeafBuilder::separate(const PlaneEmitter& e, const PlaneBlocker& b, Depth& depth) const {
  const auto through = [&](Vec2d normal, Vec2d p) {
    depth.normal = normal;
    depth.offset = -dot(normal, p);
    return true;
  };
  if (b.kind == PlaneBlocker::Kind::lens) {
    const Vec2d n = (b.center - e.a) / length(b.center - e.a);
    return through(n, b.crossing[0]);
  }
  if (b.kind == PlaneBlocker::Kind::ellipse) {
    const Vec2d at = nearest_on(e.a, e.b, b.center), to = b.center - at;
    const double d = length(to);
    return through(to / d, at + to * ((e.radius + 0.5 * (d - e.radius - b.bound)) / d));
  }
  const Vec2d* v = &frame_.vertices[b.first];
  if (e.kind == PlaneEmitter::Kind::disk) {
    Vec2d best;
    double best_d2 = 1e300;
    for (std::size_t k = 0; k < b.count; ++k) {
      const Vec2d p = nearest_on(v[k], v[(k + 1) % b.count], e.a);
      const double d2 = dot(p - e.a, p - e.a);
      if (d2 < best_d2) best_d2 = d2, best = p;
    }
    return best_d2 > 0 && through((best - e.a) / std::sqrt(best_d2), best);
  }
  const Vec2d n = e.normal;
  const double slack = 1e-8;
  double low = 1e300, high = -1e300;
  for (std::size_t k = 0; k < b.count; ++k) low = std::min(low, dot(n, v[k] - e.a)), high = std::max(high, dot(n, v[k] - e.a));
  if (high <= slack) return false;
  if (low >= -slack) return through(n, e.a);
  double widest = -1e300;
  for (std::size_t k = 0; k < b.count; ++k) {
    const Vec2d p = v[k], q = v[(k + 1) % b.count];
    Vec2d out = Vec2d{q.y - p.y, p.x - q.x} / length(q - p);
    double gap = std::min(dot(out, e.a - p), dot(out, e.b - p));
    if (b.count == 2) {
      // A segment has two outsides.
      const double other = std::min(-dot(out, e.a - p), -dot(out, e.b - p));
      if (other > gap) gap = other, out = -out;
    }
    if (gap > widest) widest = gap, through(-out, p);
  }
  return true;
}

LeafBuilder::Side LeafBuilder::side_of(const Depth& depth, const TileArea& tile) const {
  const double at = dot(depth.normal, tile.center) + depth.offset, reach = extent(depth.normal, tile);
  if (at > reach) return Side::front;
  return at < -reach ? Side::behind : Side::mixed;
}

float LeafBuilder::depth_at(const Depth& depth, const TileArea& tile) {
  return f(depth.offset + dot(depth.normal, tile.center));
}

// The lines that touch the circles about tile and emitter, moved in to touch the rectangle and the emitter themselves.
LeafBuilder::Hull LeafBuilder::hull_of(const PlaneEmitter& e, const TileArea& tile) {
  const Vec2d axis = e.center - tile.center;
  const double d2 = std::max(dot(axis, axis), 1e-300), d = std::sqrt(d2);
  const double sine = std::clamp((tile.radius - e.bound) / d, -0.99, 0.99), cosine = std::sqrt(1 - sine * sine);
  const Vec2d along = axis / d, left{-along.y, along.x};
  const auto support = [&](Vec2d n) {
    const double light = std::max(dot(n, e.a), dot(n, e.b)) + e.radius;
    return std::max(light, dot(n, tile.center) + extent(n, tile)) + 1e-9 * d;
  };
  Hull hull;
  hull.high_normal = left * cosine + along * sine;
  hull.low_normal = along * sine - left * cosine;
  hull.high_offset = support(hull.high_normal);
  hull.low_offset = support(hull.low_normal);
  return hull;
}

void LeafBuilder::add_convex(const PlaneEmitter& e, const PlaneBlocker& b, const TileArea& tile) {
  if (dot(hull_.low_normal, b.center) - b.bound > hull_.low_offset) return;
  if (dot(hull_.high_normal, b.center) - b.bound > hull_.high_offset) return;
  // First the line between the bounding circles, which settles most; then the exact one.
  Depth depth;
  Side side = Side::mixed;
  const Vec2d to = b.center - e.center;
  const double d = length(to), gap = d - e.bound - b.bound;
  if (gap > 0) {
    depth.normal = to / d;
    depth.offset = -dot(depth.normal, e.center) - e.bound - 0.5 * gap;
    side = side_of(depth, tile);
  }
  if (side == Side::mixed) {
    if (!separate(e, b, depth)) return;
    side = side_of(depth, tile);
  }
  if (side == Side::behind) return;
  const Vec2d* v = &frame_.vertices[b.first];
  // How much of the tile sees an edge's outer face: 1 all, -1 nothing, 0 a part.
  const auto facing = [&](std::size_t k) {
    const Vec2d p = v[k], q = v[(k + 1) % b.count], out{q.y - p.y, p.x - q.x};
    const double at = dot(out, tile.center - p), reach = extent(out, tile);
    return at > reach ? 1 : at < -reach ? -1 : 0;
  };
  int faces[8];
  for (std::size_t k = 0; k < b.count; ++k) faces[k] = b.count == 2 && k == 1 ? -faces[0] : facing(k);
  add_silhouette(e, b, faces, depth, side, tile);
}

// A convex blocker by the vertices in which it may begin and end, seen counter-clockwise.
void LeafBuilder::add_silhouette(const PlaneEmitter& e, const PlaneBlocker& b, const int* faces, const Depth& depth, Side side,
                                 const TileArea& tile) {
  const Vec2d* v = &frame_.vertices[b.first];
  const std::size_t count = b.count;
  Vec2d begins[8], ends[8];
  std::size_t begin_count = 0, end_count = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const int before = faces[(k + count - 1) % count], after = faces[k];
    if (before >= 0 && after <= 0) begins[begin_count++] = v[k];
    if (before <= 0 && after >= 0) ends[end_count++] = v[k];
  }
  if (begin_count == 0 || end_count == 0) return;  // all of the tile lies within the blocker
  const auto all = [](const Vec2d* p, std::size_t n, auto test) { return std::all_of(p, p + n, test); };
  const auto low = [&](Vec2d p) { return hull_.beyond_low(p); };
  const auto high = [&](Vec2d p) { return hull_.beyond_high(p); };
  const bool from_low = all(begins, begin_count, low), to_high = all(ends, end_count, high);
  if ((from_low && all(ends, end_count, low)) || (to_high && all(begins, begin_count, high))) return;  // passes by
  const bool front = side == Side::front;
  if (front && from_low && to_high) {
    hidden_ = true;
    return;
  }
  const auto in_front = [&](Vec2d p) { return ahead(e, p, tile); };
  const auto local = [&](Vec2d p) { return TileVertex{f(p.x - tile.center.x), f(p.y - tile.center.y)}; };
  const auto vertices = [&] {
    const TileSpan span{static_cast<int>(span_vertices_.size()), static_cast<int>(begin_count), static_cast<int>(end_count)};
    std::transform(begins, begins + begin_count, std::back_inserter(span_vertices_), local);
    std::transform(ends, ends + end_count, std::back_inserter(span_vertices_), local);
    return span;
  };
  const bool ordered = front && (from_low || all(begins, begin_count, in_front)) && (to_high || all(ends, end_count, in_front));
  if (!ordered && count == 2) {
    const TileVertex p = local(v[0]), q = local(v[1]);
    (front ? chords_ : deep_).push_back({p.x, p.y, q.x, q.y, f(depth.normal.x), f(depth.normal.y), depth_at(depth, tile)});
  } else if (!ordered) {
    bodies_.push_back({vertices(), !front, f(depth.normal.x), f(depth.normal.y), depth_at(depth, tile)});
  } else if (from_low) {
    std::transform(ends, ends + end_count, std::back_inserter(lows_), local);
  } else if (to_high) {
    std::transform(begins, begins + begin_count, std::back_inserter(highs_), local);
  } else {
    spans_.push_back(vertices());
  }
}

void LeafBuilder::add_round(const PlaneEmitter& e, const PlaneBlocker& b, const TileArea& tile) {
  Depth depth;
  if (!separate(e, b, depth)) return;
  const bool lens = b.kind == PlaneBlocker::Kind::lens;
  if (!lens && side_of(depth, tile) == Side::behind) return;
  TileRound r;
  const Vec2d c = b.center - tile.center;
  const double det = cross(b.x_axis, b.y_axis);
  r.cx = f(c.x);
  r.cy = f(c.y);
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
  r.depth_c = depth_at(depth, tile);
  if (!lens) {
    rounds_.push_back(r);
    return;
  }
  TileLens l;
  l.round = r;
  for (int k = 0; k < 2; ++k) {
    l.x[k] = f(b.crossing[k].x - tile.center.x);
    l.y[k] = f(b.crossing[k].y - tile.center.y);
    l.lx[k] = f(b.light_normal[k].x);
    l.ly[k] = f(b.light_normal[k].y);
    l.bx[k] = f(b.blocker_normal[k].x);
    l.by[k] = f(b.blocker_normal[k].y);
  }
  lenses_.push_back(l);
}

// Drops what others of the list cover from all of the tile. False where nothing of the light is left: a blocker that
// begins before the light ends behind where one that ends behind the light begins.
//
// Whether b is seen counter-clockwise of a from a point is the sign of a function affine in the point, so that the
// tile's corners answer for all of it.
bool LeafBuilder::merge_ends(const TileArea& tile) {
  const auto follows = [&](float ax, float ay, float bx, float by) {
    const double dx = static_cast<double>(bx - ax), dy = static_cast<double>(by - ay);
    const double at = static_cast<double>(ax) * static_cast<double>(by) - static_cast<double>(ay) * static_cast<double>(bx);
    // cross(a - p, b - p) = cross(a, b) - cross(p, b - a)
    return at >= std::fabs(dy) * tile.half.x + std::fabs(dx) * tile.half.y;
  };
  for (const TileVertex& low : lows_)
    for (const TileVertex& high : highs_)
      if (follows(high.x, high.y, low.x, low.y)) return false;
  const auto covered = [&](const TileVertex* v, int count) {
    for (const TileVertex& low : lows_)
      if (std::all_of(v, v + count, [&](const TileVertex& p) { return follows(p.x, p.y, low.x, low.y); })) return true;
    for (const TileVertex& high : highs_)
      if (std::all_of(v, v + count, [&](const TileVertex& p) { return follows(high.x, high.y, p.x, p.y); })) return true;
    return false;
  };
  const auto chord_covered = [&](const TileItem& item) {
    const TileVertex ends[] = {{item.px, item.py}, {item.qx, item.qy}};
    return covered(ends, 2);
  };
  const auto span_covered = [&](const TileSpan& s) { return covered(&span_vertices_[static_cast<std::size_t>(s.first)], s.begins + s.ends); };
  std::erase_if(spans_, span_covered);
  std::erase_if(bodies_, [&](const TileBody& body) { return span_covered(body.vertices); });
  std::erase_if(chords_, chord_covered);
  std::erase_if(deep_, chord_covered);
  return true;
}

LeafBuilder::Result LeafBuilder::build(const PlaneEmitter& e, const int* blockers, std::size_t count, const TileArea& tile) {
  hull_ = hull_of(e, tile);
  hidden_ = false;
  lows_.clear();
  highs_.clear();
  spans_.clear();
  bodies_.clear();
  span_vertices_.clear();
  chords_.clear();
  deep_.clear();
  rounds_.clear();
  lenses_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const PlaneBlocker& b = frame_.blockers[static_cast<std::size_t>(blockers[i])];
    if (b.kind == PlaneBlocker::Kind::convex)
      add_convex(e, b, tile);
    else
      add_round(e, b, tile);
    if (hidden_) return {{}, false};
  }
  if (!merge_ends(tile)) return {{}, false};
  const PlaneEmission& emission = *frame_.world->scene.bodies[static_cast<std::size_t>(e.body)].light;
  TileLight light{};
  light.inverse_range = emission.range < 1e300 ? f(1 / emission.range) : 0;
  light.profile = static_cast<int>(emission.profile);
  Vec3d from = emission.radiance, slope;
  if (e.kind == PlaneEmitter::Kind::disk) {
    const Vec2d c = e.a - tile.center;
    light.x = f(c.x);
    light.y = f(c.y);
    light.radius = f(e.radius);
  } else {
    light.edge = true;
    const Vec2d n = e.normal, t{n.y, -n.x}, a = e.a - tile.center, b = e.b - tile.center;
    light.nx = f(n.x);
    light.ny = f(n.y);
    light.x = f(a.x);
    light.y = f(a.y);
    light.begin = f(dot(b, t));
    light.end = f(dot(a, t));
    // The curve's ends by place: a two-sided curve also serves an emitter that runs the other way.
    const bool same = e.a == e.curve->a;
    const Vec3d at_a = same ? e.curve->radiance_a : e.curve->radiance_b, at_b = same ? e.curve->radiance_b : e.curve->radiance_a;
    from = at_b;
    slope = (at_a - at_b) / length(e.b - e.a);
    light.linear = slope.x != 0 || slope.y != 0 || slope.z != 0;
  }
  light.red = f(from.x);
  light.green = f(from.y);
  light.blue = f(from.z);
  light.red_slope = f(slope.x);
  light.green_slope = f(slope.y);
  light.blue_slope = f(slope.z);

  const auto items = [](const auto& list) { return static_cast<int>(list.size()); };
  light.lows = lows_.data();
  light.low_count = items(lows_);
  light.highs = highs_.data();
  light.high_count = items(highs_);
  light.spans = spans_.data();
  light.span_count = items(spans_);
  light.bodies = bodies_.data();
  light.body_count = items(bodies_);
  light.span_vertices = span_vertices_.data();
  light.chords = chords_.data();
  light.chord_count = items(chords_);
  light.deep = deep_.data();
  light.deep_count = items(deep_);
  light.rounds = rounds_.data();
  light.round_count = items(rounds_);
  light.lenses = lenses_.data();
  light.lens_count = items(lenses_);
  const std::size_t needed = 32 * (spans_.size() + bodies_.size() + chords_.size() + deep_.size() + rounds_.size() + 2 * lenses_.size());
  if (scratch_.size() < needed) scratch_.resize(2 * needed);
  light.scratch = scratch_.data();
  return {light, true};
}

}  // namespace steradian
