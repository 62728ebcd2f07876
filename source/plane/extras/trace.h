// Rays through scenes with extras: the method `sampled`, and the reference for the exact one. It uses no envelope and no closed form.
#pragma once

#include "plane/extras/passage.h"

namespace steradian::plane {

class Tracer {
 public:
  // Among the curves, those of one body that transmits light must be contiguous.
  Tracer(const World& world, std::span<const Curve* const> curves, Vec2d from)
      : world_(world), curves_(curves), from_(from), start_(start_at(world, from)) {}

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
  Vec2d from_;
  Start start_;
};

PlaneLight traced_light(const World& world, Vec2d from, const PlaneSampling& sampling);

}  // namespace steradian::plane
