// Disks, ellipses, spheres and ellipsoids in `steradian eval`: form factors for the diffuse lobe, polygons for the others.
#pragma once

#include <optional>

#include "eval/methods.h"
#include "steradian/area_light.h"

namespace steradian::eval {

struct RoundLight {
  LightShape shape = LightShape::disk;  // disk or sphere
  Vec3d center, x, y, z;                // half axes, conjugate; a disk has no z and its lit side is that of x cross y
  Vec3d radiance{1, 1, 1};
  bool two_sided = false;               // disk
};

// The ellipse that a point at the origin sees, x cross y towards it. center, x, y of the light are from that point.
// None from behind, from inside, from its plane, and of a light without area or volume.
std::optional<Ellipse> outline_of(const RoundLight& light);

// What one lobe sends to the view, by a method of the table.
//
// lambert by `exact` is the form factor of the ellipse. Other methods walk a polygon of 12 vertices (quality high: 16)
// that gather about the lobe; `exact` and `sampled` one of 1024; `reference` compares 512 with 1024, and its bound holds
// that difference.
LobeAnswer round_light_answer(const RoundLight& light, const ShadingPoint& at, const Material& material,
                              const MethodEntry& entry, const MethodOptions& options);

}  // namespace steradian::eval
