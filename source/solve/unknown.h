// Unknown: a number that a fit is free to change.
#pragma once

#include <cstddef>
#include <string>

namespace steradian::solving {

// Scale: the logarithm of a factor on power, or the factor itself where all unknowns are powers and colours.
enum class UnknownKind {
  power,
  red,
  green,
  blue,
  position_x,
  position_y,
  position_z,
  rotation_x,
  rotation_y,
  rotation_z,
  size_1,
  size_2,
  vertex_u,
  vertex_v,
  albedo_red,
  albedo_green,
  albedo_blue,
  roughness
};

inline bool is_scale(UnknownKind kind) { return kind <= UnknownKind::blue; }
inline bool is_of_material(UnknownKind kind) { return kind >= UnknownKind::albedo_red; }

struct Unknown {
  std::string name;
  std::size_t fit = 0;  // number of its light in FittedLights, or of its material in FittedMaterials
  UnknownKind kind = UnknownKind::power;
  double start = 0, low = 0, high = 0;
  double typical =
      1;  // change that is felt: 1 in logarithms and of a material, the room's size in metres, 1 radian; a vertex: the light's size
  double keep = 0;
  std::size_t vertex = 0;  // of vertex_u and vertex_v: number among the outline's and the holes'
};

}  // namespace steradian::solving
