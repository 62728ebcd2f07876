// OBJ, STL and PLY files as meshes of polygons, by Assimp. Without that part (STERADIAN_ASSIMP), reading says how to get it.
#pragma once

#include <string>
#include <vector>

#include "core/budget.h"
#include "steradian/vector.h"

namespace steradian::exchange {

struct PolygonMesh {
  std::string name, material, node;  // any may be empty; node: a key that tells apart nodes of one name
  std::vector<std::vector<Vec3d>> polygons;
};

// True if the name ends in .obj, .stl or .ply.
bool is_mesh_file(const std::string& path);

// Polygons keep their corners. Points and lines are left out. Throws Error for a file that is no such mesh.
std::vector<PolygonMesh> read_mesh_file(const std::string& path, Budget& budget);

}  // namespace steradian::exchange
