// Finds the triangles of a mesh that belong to closed surfaces. Closed surfaces tell a lamp's inside from its outside.
#pragma once

#include <cstddef>
#include <vector>

#include "core/box.h"
#include "scene/emitters/merge_polygons.h"
#include "steradian/scene.h"

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

// For each mesh, the bounds of all other meshes, computed in one pass from either end.
std::vector<Box3d> bounds_of_the_others(const Scene& scene);

// The side on which a mesh emits. Files set `doubleSided` on nearly everything. On a closed surface the far half would then shine through
// the near one, so closed surfaces emit outwards. A dome around the scene is an exception: from inside, both sides are right.
enum class Shines { as_the_file_says, outwards, outwards_and_faces_inwards };

// others: bounds of the other meshes
Shines where_it_shines(const SurfaceMaterial& m, const MeshPart& part, const Box3d& others);

// Turns a polygon's front to the other side.
void turn_over(MergedPolygon& polygon);

}  // namespace steradian::scene
