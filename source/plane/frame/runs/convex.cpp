#include "plane/frame/runs/convex.h"

#include <algorithm>
#include <cmath>

namespace steradian::plane {
namespace {

constexpr double kOnLine = 1e-9;

double least_along(Vec2d normal, ConvexRegion region) {
  double least = 1e300;
  for (std::size_t k = 0; k < region.count; ++k) least = std::min(least, dot(normal, region.vertices[k]));
  return least;
}

}  // namespace

Gap gap_between(ConvexRegion first, ConvexRegion second, double enough) {
  Gap widest{-1e300, {}, {}};
  // Tests the outer side of every edge of one region, and both sides of a segment.
  const auto look = [&](ConvexRegion own, ConvexRegion other, double sign) {
    for (std::size_t k = 0; k < own.count; ++k) {
      const Vec2d p = own.vertices[k], q = own.vertices[k + 1 < own.count ? k + 1 : 0];
      const double size = length(q - p);
      if (size == 0) continue;
      const Vec2d out = Vec2d{q.y - p.y, p.x - q.x} / size;
      const double width = least_along(out, other) - dot(out, p);
      if (!(width > widest.width)) continue;
      widest = {width, out * sign, p};
      if (width >= enough) return true;
    }
    return false;
  };
  if (!look(first, second, 1)) look(second, first, -1);
  return widest;
}

bool holds(ConvexRegion region, Vec2d p) {
  for (std::size_t k = 0; k < region.count; ++k) {
    const Vec2d a = region.vertices[k], b = region.vertices[k + 1 < region.count ? k + 1 : 0];
    if (cross(b - a, p - a) < -kOnLine * length(b - a)) return false;
  }
  return region.count > 2;
}

Vec2d nearest_of(ConvexRegion region, Vec2d p) {
  Vec2d nearest = region.vertices[0];
  double least = 1e300;
  for (std::size_t k = 0; k < region.count; ++k) {
    const Vec2d a = region.vertices[k], ab = region.vertices[k + 1 < region.count ? k + 1 : 0] - a;
    const double l = dot(ab, ab);
    const Vec2d at = l > 0 ? a + ab * std::clamp(dot(p - a, ab) / l, 0.0, 1.0) : a;
    if (const double d2 = dot(at - p, at - p); d2 < least) least = d2, nearest = at;
  }
  return nearest;
}

std::vector<Chain> convex_chains(const Curve* curves, std::size_t count) {
  std::vector<Chain> chains;
  const auto is_edge = [&](std::size_t i) { return i < count && curves[i].kind == Curve::Kind::segment; };
  for (std::size_t i = 0; i < count;) {
    if (!is_edge(i) || !is_edge(i + 1)) {
      ++i;
      continue;
    }
    // Edges may have been reversed, so that the body lies to their left: continue from the end that the next edge shares.
    std::vector<Vec2d> walk{curves[i].a, curves[i].b};
    if (walk[1] != curves[i + 1].a && walk[1] != curves[i + 1].b) std::swap(walk[0], walk[1]);
    const Vec2d first = walk[1] - walk[0];
    double sign = 0;
    std::size_t next = i + 1;
    for (; is_edge(next) && walk.size() < PaddedOutline::kMost; ++next) {
      const Curve& c = curves[next];
      const Vec2d at = walk.back();
      if (at != c.a && at != c.b) break;
      const Vec2d to = at == c.a ? c.b : c.a, along = to - at, before = at - walk[walk.size() - 2];
      const double turn = cross(before, along);
      if (sign == 0 && turn != 0) sign = turn;
      if (!(turn * sign > 0) || !(dot(first, along) > 0) || !(cross(first, along) * sign > 0)) break;
      walk.push_back(to);
    }
    if (walk.size() > 2) {
      if (sign < 0) std::reverse(walk.begin(), walk.end());
      chains.push_back({i, next - i, std::move(walk)});
    }
    i = std::max(next, i + 1);
  }
  return chains;
}

std::vector<Chain> closed_outlines(const Curve* curves, std::size_t count) {
  std::vector<Chain> outlines;
  for (std::size_t i = 0; i < count;) {
    const std::size_t first = i++;
    if (curves[first].kind != Curve::Kind::segment || i == count || curves[i].kind != Curve::Kind::segment) continue;
    // Edges may have been reversed: the walk leaves the first one by the end that the second one shares.
    const Curve& one = curves[first];
    const bool along = one.b == curves[i].a || one.b == curves[i].b;
    const Vec2d start = along ? one.a : one.b;
    Vec2d at = along ? one.b : one.a;
    std::vector<Vec2d> points{start};
    while (at != start && i < count && curves[i].kind == Curve::Kind::segment && (at == curves[i].a || at == curves[i].b)) {
      points.push_back(at);
      at = at == curves[i].a ? curves[i].b : curves[i].a;
      ++i;
    }
    if (at == start && points.size() > 3) outlines.push_back({first, i - first, hull_around(std::move(points))});
  }
  return outlines;
}

std::vector<Vec2d> hull_around(std::vector<Vec2d> points) {
  // Andrew's monotone chains.
  std::sort(points.begin(), points.end(), [](Vec2d p, Vec2d q) { return p.x != q.x ? p.x < q.x : p.y < q.y; });
  std::vector<Vec2d> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t first = hull.size();
    for (Vec2d p : points) {
      while (hull.size() > first + 1 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace steradian::plane
