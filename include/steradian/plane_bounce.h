// Interreflection between the walls of the plane, that is everything that blocks, by radiosity on elements of the outlines.
//
//   PlaneBounces bounces(world);                        // all of them
//   Vec3d light = world.query(p).radiance + bounces.query(p).radiance;
//   options.bounces = &bounces;                         // of PlaneFrameOptions: pictures with them
//
// A wall of albedo rho sends L = rho H / 2 to all sides alike, where H is the integral of the arriving light times the cosine. Radiance is
// linear along each element. The light between elements, and to a point, is integrated in closed form over the visible part. Elements are
// halved until the part of the light that is linear on none of them is small. So the result is not exact; it includes an error estimate.
#pragma once

#include <memory>

#include "steradian/bounces.h"
#include "steradian/plane.h"

namespace steradian {

struct PlaneBounceOptions {
  int bounces = kAllBounces;  // maximum number of bounces
  double tolerance = 1e-3;    // elements are halved if their error exceeds this fraction of the brightest wall; for short ones the bound
                              // rises as much as they are shorter than a 32nd of the picture
  Limits limits;
};

struct PlaneBounceStats {
  std::size_t elements = 0;
  int rounds = 0;    // number of rounds of halving
  int sweeps = 0;    // sweeps of the solution, in all rounds
  double error = 0;  // estimated, root mean square over the walls, as a fraction of their mean radiance
  double ms = 0;
};

// Bodies reflect by PlaneBody::albedo; occluders without one by their colour. Above 0.98 counts as 0.98 if all bounces are requested.
// Ellipses more than sixty times longer than wide reflect nothing. A point within a light sees only that light.
class PlaneBounces {
 public:
  // The world must outlive this at its place. Throws Error if the scene exceeds the limits.
  explicit PlaneBounces(const PlaneWorld& world, const PlaneBounceOptions& options = {});
  ~PlaneBounces();
  PlaneBounces(PlaneBounces&&) noexcept;
  PlaneBounces& operator=(PlaneBounces&&) noexcept;

  // Light that arrives at a point after one bounce or more, to be added to PlaneWorld::query.
  PlaneLight query(Vec2d position) const;
  // Estimated error of its radiance.
  Vec3d error(Vec2d position) const;

  const PlaneBounceStats& stats() const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace steradian
