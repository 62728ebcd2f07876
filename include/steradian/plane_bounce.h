// Light that walls of the plane send on: interreflection between everything that blocks, by radiosity on elements of the outlines.
//
//   PlaneBounces bounces(world);                        // all of them
//   Vec3d light = world.query(p).radiance + bounces.query(p).radiance;
//   options.bounces = &bounces;                         // of PlaneFrameOptions: pictures with them
//
// A wall of albedo rho sends L = rho H / 2 to every side alike, H the integral of what arrives times the cosine. Radiance is linear along
// each element; what the elements send to each other, and to a point, is integrated in closed form over what is visible, and elements
// are halved until the part of the light that is linear on none of them is small. So the result is not exact: it says how far off it is.
#pragma once

#include <memory>

#include "steradian/plane.h"

namespace steradian {

inline constexpr int kAllBounces = -1;

struct PlaneBounceOptions {
  int bounces = kAllBounces;  // how often light is sent on, at most
  double tolerance = 1e-3;    // elements are halved where they are further off than this share of the brightest wall, short ones where
                              // they are further off by as much as they are shorter than a 32nd of the picture
  Limits limits;
};

struct PlaneBounceStats {
  std::size_t elements = 0;
  int rounds = 0;    // of halving
  int sweeps = 0;    // of the solution, in all rounds
  double error = 0;  // estimated, root mean square over the walls, in shares of their mean radiance
  double ms = 0;
};

// Bodies reflect by PlaneBody::albedo; occluders without one by their colour. Above 0.98 counts as 0.98 where all bounces are asked for.
// Ellipses more than sixty times longer than wide reflect nothing. A point within a light sees that light alone.
class PlaneBounces {
 public:
  // The world stays where it is. Throws Error where the scene asks for more than the limits.
  explicit PlaneBounces(const PlaneWorld& world, const PlaneBounceOptions& options = {});
  ~PlaneBounces();
  PlaneBounces(PlaneBounces&&) noexcept;
  PlaneBounces& operator=(PlaneBounces&&) noexcept;

  // What arrives at a point after one bounce or more, to be added to PlaneWorld::query.
  PlaneLight query(Vec2d position) const;
  // The estimated error of its radiance.
  Vec3d error(Vec2d position) const;

  const PlaneBounceStats& stats() const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace steradian
