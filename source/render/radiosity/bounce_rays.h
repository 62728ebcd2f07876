// BounceRays: the places on patches that rays of fixed directions meet.
#pragma once

#include <array>
#include <cstdint>

#include "render/radiosity/patches.h"
#include "render/surface/ray_scene.h"
#include "render/surface/surface.h"

namespace steradian::radiosity {

class BounceRays {
 public:
  static constexpr std::size_t kLanes = 16;

  // Both must outlive this object.
  BounceRays(const RayScene& rays, const Patches& patches) : rays_(rays), patches_(patches) {}

  // Sets ray `lane` from a surface, and asks for it. Rays that begin below the surface's triangle meet nothing.
  void set(std::size_t lane, const Surface& from, Vec3f direction);
  // Traces the rays that were set since the last call. Returns the place that each meets; its side may be kNoSide.
  std::array<PatchPlace, kLanes> trace();
  // Length of a ray to what it met in the last call.
  float distance(std::size_t lane) const { return packet_.ray.tfar[lane]; }

 private:
  const RayScene& rays_;
  const Patches& patches_;
  RTCRayHit16 packet_{};
  std::uint32_t asked_ = 0;
};

}  // namespace steradian::radiosity
