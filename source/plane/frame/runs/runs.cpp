#include "plane/frame/runs/runs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace steradian::plane {
namespace {

using std::numbers::pi;
using RunShape = Emitter::RunShape;

constexpr double kMostTurnOfRun = 2 * pi / 3;  // for a run that is not closed
constexpr double kStraight = 1e-9;             // smaller turns count as none
constexpr std::size_t kParts = 4;              // number of parts of a run
constexpr double kLeastHeight = 1e-3;          // least height of the tile over every line, so that floats decide it safely

double turn_between(const Emitter& a, const Emitter& b) {
  const Vec2d u = a.b - a.a, v = b.b - b.a;
  return std::atan2(cross(u, v), dot(u, v));
}

double distance_from_segment(Vec2d a, Vec2d b, Vec2d p) {
  const Vec2d ab = b - a;
  const double l = dot(ab, ab);
  return length(p - a - ab * (l > 0 ? std::clamp(dot(p - a, ab) / l, 0.0, 1.0) : 0));
}

// Appends the run of edges [first, first + count), or the single edge, and all emitters that it represents.
void append(const Emitter* first, std::size_t count, std::vector<Emitter>& to) {
  if (count == 1) {
    to.push_back(*first);
    return;
  }
  const std::size_t at = to.size();
  Emitter run = *first;
  run.b = first[count - 1].b;
  const Vec2d along = run.b - run.a;
  const double size = length(along);
  double bend = 0;
  for (std::size_t k = 1; k < count; ++k) {
    run.radius = std::max(run.radius, distance_from_segment(run.a, run.b, first[k].a));
    bend += cross(first[k].a - run.a, along);
  }
  run.shape = bend < 0 ? RunShape::bowl : RunShape::bulge;
  run.hull = {run.a};
  if (run.radius > kStraight * size)
    for (std::size_t k = 1; k < count; ++k) run.hull.push_back(first[k].a);
  run.hull.push_back(run.b);
  if (bend < 0) std::reverse(run.hull.begin(), run.hull.end());
  run.center = (run.a + run.b) * 0.5;
  run.bound = 0;
  for (Vec2d v : run.hull) run.bound = std::max(run.bound, length(v - run.center));
  const bool flat = size > 0 && run.radius < size;
  if (flat) {
    run.normal = Vec2d{along.y, -along.x} / size;
    to.push_back(run);
  }
  const std::size_t parts = std::min(count, kParts);
  for (std::size_t i = 0; i < parts; ++i) {
    const std::size_t from = i * count / parts, end = (i + 1) * count / parts;
    append(first + from, end - from, to);
  }
  if (flat) to[at].group = to.size() - at;
}

// Appends a sequence of an outline's edges, as runs that turn one way.
void append_chains(const std::vector<Emitter>& strand, std::vector<Emitter>& to) {
  for (std::size_t i = 0; i < strand.size();) {
    double turned = 0;
    std::size_t end = i + 1;
    for (; end < strand.size(); ++end) {
      const double turn = turn_between(strand[end - 1], strand[end]);
      const bool other_way = std::fabs(turn) > kStraight && std::fabs(turned) > kStraight && turn * turned < 0;
      if (other_way || std::fabs(turned + turn) > kMostTurnOfRun) break;
      turned += turn;
    }
    append(&strand[i], end - i, to);
    i = end;
  }
}

// Is only the angle of a light that is visible what counts?
bool is_even(const World& world, const Emitter& e) {
  const PlaneEmission& light = *world.scene.bodies[static_cast<std::size_t>(e.body)].light;
  return light.profile == PlaneProfile::uniform && !light.gradient && !light.is_spot() && !(light.range < 1e300);
}

// Appends the edges of the hull that are none of the outline.
void append_lids(const Emitter around, const std::vector<Emitter>& edges, std::vector<Emitter>& to) {
  std::vector<std::pair<Vec2d, Vec2d>> own;
  const auto before = [](const auto& p, const auto& q) {
    return std::tie(p.first.x, p.first.y, p.second.x, p.second.y) < std::tie(q.first.x, q.first.y, q.second.x, q.second.y);
  };
  for (const Emitter& e : edges) own.emplace_back(e.a, e.b);
  std::sort(own.begin(), own.end(), before);
  for (std::size_t k = 0; k < around.hull.size(); ++k) {
    const Vec2d a = around.hull[k], b = around.hull[k + 1 < around.hull.size() ? k + 1 : 0];
    if (std::binary_search(own.begin(), own.end(), std::pair{a, b}, before)) continue;
    Emitter lid;
    lid.kind = Emitter::Kind::edge;
    lid.body = around.body;
    lid.a = b;
    lid.b = a;
    lid.radiance = {-around.radiance.a, -around.radiance.b};
    lid.curve = static_cast<std::size_t>(-1);
    lid.center = (a + b) * 0.5;
    lid.bound = 0.5 * length(b - a);
    lid.normal = Vec2d{lid.b.y - lid.a.y, lid.a.x - lid.b.x} / length(b - a);
    lid.range = around.range;
    lid.lid = true;
    to.push_back(lid);
  }
}

// Appends a whole outline. A concave outline is one run if its light is even.
void append_outline(const World& world, const std::vector<Emitter>& edges, std::vector<Emitter>& to) {
  double least = 1e300, turned = 0, area = 0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const double turn = turn_between(edges[k], edges[k + 1 < edges.size() ? k + 1 : 0]);
    least = std::min(least, turn);
    turned += turn;
    area += cross(edges[k].a - edges[0].a, edges[k].b - edges[0].a);
  }
  const bool convex = least >= -kStraight && std::fabs(turned - 2 * pi) < 1e-6;
  const bool hole = !convex && area < 0, around = !convex && !hole;
  if (around && (edges.front().wall || !is_even(world, edges.front()))) return append_chains(edges, to);
  const std::size_t at = to.size();
  Emitter run = edges.front();
  run.shape = convex ? RunShape::closed : hole ? RunShape::hole : RunShape::around;
  Box2d box;
  for (const Emitter& e : edges) box.add(e.a), run.hull.push_back(e.a);
  if (around) run.hull = hull_around(run.hull);
  if (hole) run.hull = {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
  run.a = run.b = run.center = box.center();
  run.normal = {};
  run.bound = 0;
  for (Vec2d v : run.hull) run.bound = std::max(run.bound, length(v - run.center));
  run.radius = run.bound;
  to.push_back(run);
  if (around) append_lids(to[at], edges, to);
  append_chains(edges, to);
  to[at].group = to.size() - at;
}

template <class F>
void for_each_edge(const Emitter* run, F f) {
  for (std::size_t k = 1; k < run->group; ++k)
    if (!is_run(run[k]) && !run[k].lid) f(run[k]);
}

// Edges of light in the order along outlines, with the body to the left: the next edge begins at the end of the last. If several do, as at
// a crossing, the sharpest turn to the left leads around the same part of the body.
class OutlineWalk {
 public:
  OutlineWalk(const World& world, const std::vector<Emitter>& emitters) : world_(world), emitters_(emitters), done_(emitters.size(), 0) {
    for (std::size_t i = 0; i < emitters.size(); ++i)
      if (emitters[i].kind == Emitter::Kind::edge) by_begin_.push_back(i);
    by_end_ = by_begin_;
    std::sort(by_begin_.begin(), by_begin_.end(), [&](std::size_t i, std::size_t k) { return key(i, true) < key(k, true); });
    std::sort(by_end_.begin(), by_end_.end(), [&](std::size_t i, std::size_t k) { return key(i, false) < key(k, false); });
  }

  bool is_done(std::size_t i) const { return done_[i] != 0; }
  bool is_two_sided(std::size_t i) const { return world_.curves[emitters_[i].curve].two_sided; }

  // All edges of the outline of an edge, from its beginning or, for a closed outline, from that edge on.
  std::vector<Emitter> strand_of(std::size_t edge) {
    std::size_t first = edge;
    for (std::size_t before = neighbour(first, false), steps = 0; before != kNone && before != edge && steps < emitters_.size(); ++steps)
      first = before, before = neighbour(first, false);
    if (neighbour(first, false) == edge) first = edge;
    std::vector<Emitter> strand;
    for (std::size_t i = first; i != kNone; i = neighbour(i, true)) {
      strand.push_back(emitters_[i]);
      done_[i] = 1;
    }
    return strand;
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  // Key of the edge's beginning or end.
  std::tuple<int, double, double> key(std::size_t i, bool begin) const {
    const Vec2d p = begin ? emitters_[i].a : emitters_[i].b;
    return {emitters_[i].body, p.x, p.y};
  }
  std::size_t neighbour(std::size_t i, bool after) const {
    const std::vector<std::size_t>& others = after ? by_begin_ : by_end_;
    const auto at = key(i, !after);
    std::size_t best = kNone;
    double best_turn = -1e300;
    for (auto k =
             std::lower_bound(others.begin(), others.end(), at, [&](std::size_t other, const auto&p) { return key(other, after) < p; });
         k != others.end() && key(*k, after) == at; ++k) {
      if (done_[*k] != 0 || is_two_sided(*k) != is_two_sided(i)) continue;
      double turn = after ? turn_between(emitters_[i], emitters_[*k]) : turn_between(emitters_[*k], emitters_[i]);
      // A line that emits light to both sides goes straight on.
      if (is_two_sided(i)) turn = -std::fabs(turn);
      if (turn > best_turn) best_turn = turn, best = *k;
    }
    return best;
  }

  const World& world_;
  const std::vector<Emitter>& emitters_;
  std::vector<char> done_;
  std::vector<std::size_t> by_begin_, by_end_;
};

}  // namespace

std::vector<Emitter> with_runs(const World& world, const std::vector<Emitter>& emitters) {
  std::vector<Emitter> result;
  OutlineWalk walk(world, emitters);
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    if (emitters[i].kind != Emitter::Kind::edge) {
      result.push_back(emitters[i]);
      continue;
    }
    // If several edges meet, the way on from a strand's beginning may miss the edge from which the beginning was found.
    while (!walk.is_done(i)) {
      const std::vector<Emitter> strand = walk.strand_of(i);
      if (!walk.is_two_sided(i) && strand.size() > 2 && strand.back().b == strand.front().a)
        append_outline(world, strand, result);
      else
        append_chains(strand, result);
    }
  }
  return result;
}

RunView view_of(const Emitter& run, const TileRectangle& tile) {
  RunView best{{}, -1e300};
  const auto look = [&](Vec2d axis) {
    double least = 1e300;
    for (Vec2d v : run.hull) least = std::min(least, dot(axis, v - tile.center));
    least -= std::fabs(axis.x) * tile.half.x + std::fabs(axis.y) * tile.half.y;
    if (least > best.least) best = {axis, least};
  };
  const Vec2d to = run.center - tile.center;
  const double d = length(to);
  if (d > 0) look(to / d);
  if (d > 2 * run.bound + 2 * tile.radius) return best;
  if (run.normal.x != 0 || run.normal.y != 0) look(-run.normal);
  const Vec2d near = nearest_of(region_of(run), tile.center) - tile.center;
  if (const double l = length(near); l > 0) look(near / l);
  for (const Vec2d axis : {Vec2d{1, 0}, Vec2d{-1, 0}, Vec2d{0, 1}, Vec2d{0, -1}}) look(axis);
  return best;
}

bool is_within_hull(const Emitter& run, const TileRectangle& tile) {
  for (std::size_t k = 0; k < run.hull.size(); ++k) {
    const Vec2d a = run.hull[k], along = run.hull[k + 1 < run.hull.size() ? k + 1 : 0] - a,
                inwards = Vec2d{-along.y, along.x} / length(along);
    if (facing(a, inwards, tile) != Facing::all) return false;
  }
  return true;
}

std::size_t count_lids(const Emitter* run) {
  std::size_t count = 0;
  while (1 + count < run->group && run[1 + count].lid) ++count;
  return count;
}

Facing facing(Vec2d point, Vec2d normal, const TileRectangle& tile) {
  const double height = dot(normal, tile.center - point), reach = std::fabs(normal.x) * tile.half.x + std::fabs(normal.y) * tile.half.y;
  if (height + reach <= 0) return Facing::none;
  return height - reach > kLeastHeight ? Facing::all : Facing::some;
}

Facing seen_as_one(const Emitter* run, const TileRectangle& tile) {
  const bool apart = view_of(*run, tile).least > kLeastHeight;
  switch (run->shape) {
    case RunShape::closed:
    case RunShape::around: return apart ? Facing::all : Facing::some;
    case RunShape::hole: return apart ? Facing::none : Facing::some;
    case RunShape::bowl:
      // From behind the chord, everything that enters the hull has crossed the run from its other side.
      if (apart && facing(*run, tile) == Facing::none) return Facing::none;
      break;
    case RunShape::bulge: break;
  }
  bool some = false;
  for_each_edge(run, [&](const Emitter& e) { some = some || facing(e, tile) != Facing::none; });
  if (!some) return Facing::none;
  return apart && facing(*run, tile) == Facing::all ? Facing::all : Facing::some;
}

namespace {

// Counts the crossings of a ray, so that ends that touch the edge do not count.
void pass(Vec2d a, Vec2d b, Vec2d p, bool& inside) {
  if ((a.y > p.y) == (b.y > p.y)) return;
  if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
}

}  // namespace

bool is_within_outline(const Emitter* run, Vec2d p) {
  bool inside = false;
  for_each_edge(run, [&](const Emitter& e) { pass(e.a, e.b, p, inside); });
  return inside;
}

bool crosses_run(const Emitter* run, Vec2d p, Vec2d q) {
  const auto strictly = [&](Vec2d a, Vec2d b) {
    const Vec2d d = q - p, along = b - a;
    return cross(along, p - a) * cross(along, q - a) < 0 && cross(d, a - p) * cross(d, b - p) < 0;
  };
  bool crosses = strictly(run->a, run->b);
  for_each_edge(run, [&](const Emitter& e) { crosses = crosses || strictly(e.a, e.b); });
  // Is the middle between chord and edges?
  const Vec2d middle = (p + q) * 0.5;
  bool inside = is_within_outline(run, middle);
  pass(run->a, run->b, middle, inside);
  return crosses || inside;
}

}  // namespace steradian::plane
