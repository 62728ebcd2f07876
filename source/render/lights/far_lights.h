// Lights that elements stand for from afar, as packs read them (kernels/outline/far_light.glsl).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/cpu/light_list.h"

namespace steradian::lights {

// A plane of numbers, one a light.
using Plane = std::vector<float>;

struct Planes {
  Plane x, y, z;
};

// One element and the light's radiance.
struct Element {
  Vec3f center, area;  // area: unit normal to the side that shines on who looks, times area; (area, 0, 0) of a ball
  Vec3f radiance;
};
struct FourElements {
  Vec3f center, reach_a, reach_b, area, radiance;
};

// Area lights without a texture: polygons and disks by elements, balls by their centre, and points that send the same everywhere. Of other
// shapes only the ball that holds them is known: that tells whom they cannot reach. Behind the last stand lights without area, up to a
// multiple of 16.
struct FarLights {
  std::size_t count = 0;                 // of lights
  std::vector<const PackLight*> lights;  // by number
  Planes center, normal;                 // unit, to the lit side; zero where no plane bounds what is lit
  Planes reach_a, reach_b;               // of the four elements
  Planes radiance;
  std::vector<Element> elements;  // as their lit sides shine
  std::vector<FourElements> fours;
  Plane area;                           // of balls, of their great circle; 0: no element stands for it
  Plane radius;                         // of a ball about the centre that holds the light; 0 of points
  Plane spread;                         // how far from the centre it, or an element, sends light from: 0 of balls
  Plane deviation2, third, fourth;      // moments: see far_error_of_one and far_error_of_four
  Plane symmetric, two_sided, is_flat;  // 1 or 0
  std::vector<std::int32_t> number_of;  // by PackLight::index; -1: it is none of these
};

FarLights prepare_far_lights(const std::vector<PackLight>& lights);

}  // namespace steradian::lights
