// Bodies that may matter to the points of a disk: curves between it and lights, direct or by a mirror, and towards suns.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "plane/exact/world.h"
#include "plane/extras/sun.h"

namespace steradian::plane {

struct BodyDisk {
  Vec2d center;
  double radius = 0;
};
BodyDisk disk_of(const Curve& curve);

// A range of directions, less than half a turn wide, and tests of what may be visible in it. The tests have a margin for rounding.
class ViewFan {
 public:
  ViewFan(Vec2d from, Vec2d low, Vec2d high) : from_(from), low_(low), high_(high) {}
  // The fan of an edge.
  ViewFan(Vec2d from, const Curve& edge) : from_(from), low_(edge.a - from), high_(edge.b - from) {
    if (cross(low_, high_) < 0) std::swap(low_, high_);
    low_ = low_ / length(low_);
    high_ = high_ / length(high_);
  }
  bool may_hold(const BodyDisk& disk) const {
    const Vec2d to = disk.center - from_;
    const double reach = disk.radius * (1 + 1e-9) + 1e-6;
    return cross(low_, to) >= -reach && cross(high_, to) <= reach && dot(low_ + high_, to) >= -2 * reach;
  }

 private:
  Vec2d from_, low_, high_;  // unit vectors
};

// One edge of a mirror, from one side. Points beyond it keep their places, and the eye is mirrored to the place behind it.
struct MirrorView {
  const Curve* edge;
  Vec2d normal;                     // unit, to the eye's side
  std::vector<Curve> beyond;        // curves that end light, clipped to the eye's side
  std::vector<BodyDisk> disks;      // around each of these curves
  std::vector<BodyDisk> lights;     // around each body that it may show
  std::vector<const Curve*> clear;  // curves that light passes
  Vec2d reflected(Vec2d p) const { return p - normal * (2 * dot(normal, p - edge->a)); }
  Vec2d reflected_direction(Vec2d u) const { return u - normal * (2 * dot(normal, u)); }
};

struct View {
  std::vector<SunView> suns;           // plain suns with nothing clear in front of them; every other sun is handled elsewhere
  std::vector<const Curve*> blocking;  // curves that end light: lights, occluders, mirrors, absorbing bodies
  std::vector<BodyDisk> disks;         // around each of these curves
  std::vector<const Curve*> clear;     // curves that light passes
  std::vector<MirrorView> mirrors;
  std::vector<const Curve*> all;  // all curves of the world, if mirrors may show suns without width
};

inline bool is_open(const View& view, const PlaneSun& sun) {
  return std::any_of(view.suns.begin(), view.suns.end(), [&](const SunView& s) { return s.sun == &sun; });
}

// lights: does the view include lights, or only suns and mirrors?
View view_of(const World& world, BodyDisk eye, bool lights);

// Can one of these bodies matter to what the eye sees? If not, its view is that of a world without them.
bool may_matter(const World& world, BodyDisk eye, bool lights, const std::vector<std::size_t>& bodies);

// Appends the parts of a curve in front of a line.
void cut_at_line(const Curve& curve, Vec2d at, Vec2d normal, std::vector<Curve>& out);

}  // namespace steradian::plane
