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

  // Both must outlive this object. order: of the rays that are traced together.
  BounceRays(const RayScene& rays, const Patches& patches, RayScene::Order order);

  // Lets the rays of a lane begin on a surface.
  void start(std::size_t lane, const Surface& from);
  // Lets the rays of a lane begin at a place off its surface. above: they go to the side of this direction.
  void start_off(std::size_t lane, Vec3f origin, Vec3f above) {
    origin_[lane] = origin;
    normal_[lane] = above;
  }
  Vec3d origin(std::size_t lane) const { return static_cast<Vec3d>(origin_[lane]); }
  // Sets the direction of a lane's ray, and asks for it. Rays into the surface's triangle meet nothing.
  void set(std::size_t lane, Vec3f direction) {
    if (!(dot(direction, normal_[lane]) > 0)) return;
    packet_.ray.dir_x[lane] = direction.x;
    packet_.ray.dir_y[lane] = direction.y;
    packet_.ray.dir_z[lane] = direction.z;
    asked_ |= 1u << lane;
  }
  // Traces the rays that were set since the last call. Returns the place that each meets; its side may be kNoSide.
  std::array<PatchPlace, kLanes> trace();
  // Fraction of the light that comes to a lane through the glass that its ray has passed in the last call.
  Vec3f tint(std::size_t lane) const { return tint_[lane]; }
  bool any_tint() const { return any_tint_; }
  // Length of a ray to what it met in the last call.
  float distance(std::size_t lane) const { return packet_.ray.tfar[lane]; }

 private:
  const RayScene& rays_;
  const Patches& patches_;
  const RayScene::Order order_;
  std::array<Vec3f, kLanes> origin_{}, normal_{}, tint_{};
  bool any_tint_ = false;
  RTCRayHit16 packet_{};
  std::uint32_t asked_ = 0;
};

}  // namespace steradian::radiosity
