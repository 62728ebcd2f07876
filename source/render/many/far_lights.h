// Lights that elements represent from afar, in the layout of packs (kernels/outline/far_light.glsl).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/lights/light_list.h"

namespace steradian::lights {

// An array with one number per light.
using Plane = std::vector<float>;

struct Planes {
  Plane x, y, z;
};

// One element and the light's radiance.
struct FarElement {
  Vec3f center, area;  // area: unit normal of the side that faces the viewer, times area; (area, 0, 0) for a ball
  Vec3f radiance;
};
struct FourElements {
  Vec3f center, reach_a, reach_b, area, radiance;
};

// Area lights without a texture: polygons and disks by elements, balls by their centre, and points that emit the same everywhere. Other
// shapes have only a bounding ball, which tells which receivers they cannot reach. After the last light come lights without area, up to a
// multiple of 16.
struct FarLights {
  std::size_t count = 0;                 // number of lights
  std::vector<const PackLight*> lights;  // by number
  Planes center, normal;                 // unit, to the lit side; zero if no plane bounds the lit region
  Planes reach_a, reach_b;               // offsets of the four elements
  Planes radiance;
  std::vector<FarElement> elements;  // for the lit sides
  std::vector<FourElements> fours;
  Plane area;                           // area of the great circle for balls; 0: no element represents it
  Plane radius;                         // radius of a ball about the centre that contains the light; 0 for points
  Plane spread;                         // largest distance from the centre of a point of the light or an element; 0 for balls
  Plane deviation2, third, fourth;      // moments: see far_error_of_one and far_error_of_four
  Plane symmetric, two_sided, is_flat;  // 1 or 0
  Plane outline;                        // bound of the length of the light's outline from any point
  std::vector<std::int32_t> number_of;  // by PackLight::index; -1: not in this list
};

FarLights prepare_far_lights(const std::vector<PackLight>& lights);

}  // namespace steradian::lights
