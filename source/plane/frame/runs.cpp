#include "plane/frame/runs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace steradian::plane {
namespace {

constexpr double kMostTurn = std::numbers::pi / 3;  // of a run: its edges face much the same points
constexpr double kSharpest = std::numbers::pi / 8;  // of one corner
constexpr std::size_t kParts = 4;                   // that a run is taken apart in
constexpr double kLeastHeight = 1e-3;               // of the tile over every line: floats must not doubt it

double turn_between(const Emitter& a, const Emitter& b) {
  const Vec2d u = a.b - a.a, v = b.b - b.a;
  return std::atan2(cross(u, v), dot(u, v));
}

double distance_from_segment(Vec2d a, Vec2d b, Vec2d p) {
  const Vec2d ab = b - a;
  return length(p - a - ab * std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0));
}

// Appends the run of edges [first, first + count), or the edge, and all that it stands for.
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
  for (std::size_t k = 1; k < count; ++k) run.radius = std::max(run.radius, size > 0 ? distance_from_segment(run.a, run.b, first[k].a) : 0);
  run.center = (run.a + run.b) * 0.5;
  run.bound = run.radius + 0.5 * size;
  const bool flat = size > 0 && run.radius < 0.5 * size;
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

template <class F>
void for_each_edge(const Emitter* run, F f) {
  for (std::size_t k = 1; k < run->group; ++k)
    if (!is_run(run[k])) f(run[k]);
}

}  // namespace

std::vector<Emitter> with_runs(const std::vector<Emitter>& emitters) {
  std::vector<Emitter> result;
  for (std::size_t i = 0; i < emitters.size();) {
    std::size_t end = i + 1;
    double turned = 0;
    // Outlines that run clockwise come with their edges turned round: each then begins where the next one ends.
    bool backwards = false;
    for (; end < emitters.size() && emitters[end].kind == Emitter::Kind::edge && emitters[i].kind == Emitter::Kind::edge; ++end) {
      const Emitter &before = emitters[end - 1], &next = emitters[end];
      const bool back = before.a == next.b && !(before.b == next.a);
      if (!back && !(before.b == next.a)) break;
      if (end > i + 1 && back != backwards) break;
      backwards = back;
      const double turn = back ? turn_between(next, before) : turn_between(before, next);
      if (std::fabs(turn) > kSharpest || std::fabs(turned + turn) > kMostTurn) break;
      turned += turn;
    }
    std::vector<Emitter> run(emitters.begin() + static_cast<std::ptrdiff_t>(i), emitters.begin() + static_cast<std::ptrdiff_t>(end));
    if (backwards) std::reverse(run.begin(), run.end());
    append(run.data(), run.size(), result);
    i = end;
  }
  return result;
}

Facing facing(const Emitter* run, const TileArea& tile) {
  bool some = false, all = true;
  const auto look = [&](const Emitter& e) {
    const double height = dot(e.normal, tile.center - e.a),
                 reach = std::fabs(e.normal.x) * tile.half.x + std::fabs(e.normal.y) * tile.half.y;
    some = some || height + reach > 0;
    all = all && height - reach > kLeastHeight;
  };
  for_each_edge(run, look);
  if (!some) return Facing::none;
  look(*run);
  return all ? Facing::all : Facing::some;
}

bool crosses_run(const Emitter* run, Vec2d p, Vec2d q) {
  const auto strictly = [&](Vec2d a, Vec2d b) {
    const Vec2d d = q - p, along = b - a;
    return cross(along, p - a) * cross(along, q - a) < 0 && cross(d, a - p) * cross(d, b - p) < 0;
  };
  bool crosses = strictly(run->a, run->b);
  // Is the middle between chord and edges? By the crossings of a ray, so that ends that touch the run do not count.
  const Vec2d middle = (p + q) * 0.5;
  bool inside = false;
  const auto pass = [&](Vec2d a, Vec2d b) {
    if ((a.y > middle.y) == (b.y > middle.y)) return;
    if (middle.x < a.x + (middle.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  };
  pass(run->a, run->b);
  for_each_edge(run, [&](const Emitter& e) {
    crosses = crosses || strictly(e.a, e.b);
    pass(e.a, e.b);
  });
  return crosses || inside;
}

}  // namespace steradian::plane
