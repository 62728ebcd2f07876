// Chart: a part of a mesh that a light map shows as one piece, without a seam.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/box.h"
#include "steradian/scene.h"
#include "steradian/vector2.h"

namespace steradian::bake {

struct ChartTriangle {
  std::uint32_t triangle = 0;  // of the chart's mesh
  std::array<Vec2d, 3> at;     // its corners in the chart
};

// A convex part of a triangle, where light arrives.
struct ChartPiece {
  std::uint32_t number = 0;  // of its triangle in the chart
  std::vector<Vec2d> outline;
};

// The plane of a flat chart: a corner's place in the chart is its place along x and y.
struct ChartPlane {
  Vec3d origin, x, y, normal;
  Vec2d at(Vec3d p) const { return {dot(p - origin, x), dot(p - origin, y)}; }
};

// A part of an edge where two charts of one plane meet without a contact between them. Both have a door of this number.
struct ChartDoor {
  std::uint32_t number = 0;
  std::array<Vec2d, 2> ends;
  double length = 0;  // [m]
};

// Its coordinates are metres until place_charts makes them texels of the map, with texel centres at half numbers.
struct Chart {
  static constexpr std::uint32_t kWhole = UINT32_MAX;

  std::uint32_t mesh = 0;
  std::vector<ChartTriangle> triangles;
  std::vector<ChartPiece> pieces;  // the lit parts where contacts cover others; empty: all triangles
  std::vector<ChartDoor> doors;
  bool is_flat = false, is_covered = false;  // covered: no light arrives anywhere
  ChartPlane plane;                          // where it is flat
  std::uint32_t cut_from = kWhole;           // charts of one number were cut apart at contacts, so nothing joins them

  int x = 0, y = 0, width = 0, height = 0;  // its texels in the map, which no other chart touches

  Box2d box() const {
    Box2d all;
    for (const ChartTriangle& t : triangles)
      for (const Vec2d p : t.at) all.add(p);
    return all;
  }
};

inline Vec3d corner_of(const Mesh& mesh, std::size_t triangle, std::size_t k) {
  return static_cast<Vec3d>(mesh.positions[mesh.indices[3 * triangle + k]]);
}
// Twice the area times the normal.
inline Vec3d across(const Mesh& mesh, std::size_t triangle) {
  const Vec3d a = corner_of(mesh, triangle, 0);
  return cross(corner_of(mesh, triangle, 1) - a, corner_of(mesh, triangle, 2) - a);
}
inline double doubled_area(const std::array<Vec2d, 3>& at) { return cross(at[1] - at[0], at[2] - at[0]); }

// The mesh in words, for messages.
inline std::string name_of(const Mesh& mesh, std::size_t number) {
  return mesh.name.empty() ? "mesh number " + std::to_string(number) : "mesh \"" + mesh.name + "\"";
}

}  // namespace steradian::bake
