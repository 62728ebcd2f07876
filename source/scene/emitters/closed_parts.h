// Finds the triangles of a mesh that belong to closed surfaces. Closed surfaces tell a lamp's inside from its outside.
#pragma once

#include <cstddef>
#include <vector>

#include "core/box.h"
#include "scene/emitters/merge_polygons.h"

namespace steradian::scene {

// Triangles connected by corners that are equal to a millionth of the list's extent. Programs that compute the corners at a pole or a seam
// twice get them equal up to rounding.
struct MeshPart {
  std::vector<std::size_t> triangles;
  bool closed = false;  // every edge is used once in each direction
  double volume = 0;    // volume of a closed part [m^3]: negative where its triangles face inwards
  Box3d box;
};

// The parts of a list of triangles, in the order of their first triangles. Triangles with two equal corners belong to no part.
std::vector<MeshPart> mesh_parts(const std::vector<Triangle>& triangles);

}  // namespace steradian::scene
