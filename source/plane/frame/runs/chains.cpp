#include "plane/frame/runs/chains.h"

#include <algorithm>
#include <cmath>

namespace steradian::plane {

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

}  // namespace steradian::plane
