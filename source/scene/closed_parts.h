// Which triangles of a mesh belong to closed surfaces: what tells a lamp's inside from its outside.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/merge_polygons.h"

namespace steradian::scene {

// Triangles that are connected by corners equal to a millionth of the list's extent: programs that compute the corners at a
// pole or a seam twice get them equal but for rounding.
struct MeshPart {
  std::vector<std::size_t> triangles;
  bool closed = false;  // every edge is walked once each way
  double volume = 0;    // of a closed part [m^3]: negative where its triangles face inwards
  Vec3d low, high;      // bounds
};

// The parts of a list of triangles, in the order of their first triangles. Triangles with two equal corners belong to none.
std::vector<MeshPart> mesh_parts(const std::vector<Triangle>& triangles);

}  // namespace steradian::scene
