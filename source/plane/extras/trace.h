// Rays through extras: the fraction that a path leaves, and whole rays.
#pragma once

#include <span>
#include <vector>

#include "plane/exact/world.h"

namespace steradian::plane {

// Fraction of light that remains after a straight path through bodies that transmit or absorb it.

// Bodies that hold a point.
struct Start {
  bool dark = false;      // within an occluder that lets no light in
  int light = -1;         // index of the last light
  std::vector<int> deep;  // bodies that absorb light
  Vec2d at;               // off outlines
};
Start start_at(const World& world, Vec2d p);

// Does light from or to that point go on through the body? Other bodies end it.
bool passes(const World& world, const Start& start, int body);

// The fraction that remains after a path of length `way` (may be infinite) in direction u. filters: curves, grouped by body, of which those
// that light passes count.
Vec3d passage(const World& world, const Start& start, std::span<const Curve* const> filters, Vec2d from, Vec2d u, double way);

// Rays through scenes with extras: the method `sampled`, and the reference for the exact one. It uses no envelope and no closed form.

class Tracer {
 public:
  // Among the curves, those of one body that transmits light must be contiguous.
  Tracer(const World& world, std::span<const Curve* const> curves, Vec2d from)
      : world_(world), curves_(curves), start_(start_at(world, from)), from_(start_.at) {}

  // Radiance from direction u (of length 1), except suns without width.
  Vec3d radiance(Vec2d u) const { return start_.dark ? Vec3d{} : look(u, nullptr); }
  // Light of suns without width, direct and by mirrors: sums over directions.
  PlaneLight hard_suns() const;

 private:
  Vec3d look(Vec2d u, const PlaneSun* hard) const;
  const PlaneBody& body_of(const RayHit& hit) const { return world_.scene.bodies[static_cast<std::size_t>(hit.curve->body)]; }
  RayHit first_hit(Vec2d from, Vec2d u, const Curve* but) const;
  Vec3d arriving(const RayHit& hit, Vec2d at, Vec2d u, double way) const;
  Vec3d sky(Vec2d u, const PlaneSun* hard) const;

  const World& world_;
  std::span<const Curve* const> curves_;
  Start start_;
  Vec2d from_;
};

PlaneLight traced_light(const World& world, Vec2d from, const PlaneSampling& sampling);

}  // namespace steradian::plane
