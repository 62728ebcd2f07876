// Lights other than area lights, for code that takes light names.
#pragma once

#include <memory>

#include "steradian/light_profile.h"
#include "steradian/shape.h"

namespace steradian {

// A capsule, or a line if the radius is 0.
inline Shape capsule_or_line(Vec3d end_a, Vec3d end_b, double radius) {
  if (radius == 0) return Line{end_a, end_b};
  return Capsule{end_a, end_b, radius};
}

// A light without size.
struct PointLight {
  Vec3d position;
  Vec3d intensity{1, 1, 1};                       // W/sr or candela, linear RGB
  std::shared_ptr<const LightProfile> profile{};  // candela by direction, which intensity multiplies; null: 1 everywhere
  ProfileAxes axes{};
};

// Parallel light from one direction.
struct DirectionalLight {
  Vec3d direction;             // unit, along which it shines
  Vec3d illuminance{1, 1, 1};  // W/m2 or lux across it, linear RGB
};

}  // namespace steradian
