// What may matter to the points of a disk: curves between it and lights, at once or by a mirror, and towards suns.
#pragma once

#include <vector>

#include "plane/exact/world.h"

namespace steradian::plane {

struct Disk {
  Vec2d center;
  double radius = 0;
};

// One edge of a mirror, seen from one side. Seen by it, things are where they are, and the eye is behind it.
struct MirrorView {
  const Curve* edge;
  Vec2d normal;                     // unit, to the eye's side
  std::vector<Curve> beyond;        // what ends light, of it the parts on the eye's side
  std::vector<const Curve*> clear;  // what light passes
  Vec2d reflected(Vec2d p) const { return p - normal * (2 * dot(normal, p - edge->a)); }
  Vec2d reflected_direction(Vec2d u) const { return u - normal * (2 * dot(normal, u)); }
};

struct View {
  std::vector<const Curve*> blocking;  // what ends light: lights, occluders, mirrors, bodies that take light in
  std::vector<const Curve*> clear;     // what light passes
  std::vector<MirrorView> mirrors;
  std::vector<const Curve*> all;  // of the world, where mirrors may show suns without width
};

// lights: are they looked at, too, or only suns and mirrors?
View view_of(const World& world, Disk eye, bool lights);

// The parts of a curve in front of a line, appended.
void cut_at_line(const Curve& curve, Vec2d at, Vec2d normal, std::vector<Curve>& out);

}  // namespace steradian::plane
