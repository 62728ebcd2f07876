// The faces of a scene that exchange radiation: coplanar neighbours of a mesh joined to polygons, divided and turned over on demand.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/budget.h"
#include "exchange/files/masks.h"
#include "exchange/files/mesh_files.h"
#include "steradian/load_scene.h"
#include "steradian/view_factors.h"

namespace steradian::exchange {

enum class FacesBy { face, node, material };

struct SceneFaces {
  std::vector<ViewFactorFace> faces;
  std::vector<std::size_t> groups;                   // by face: its place in group_names; empty by face
  std::vector<std::string> group_names;              // nodes or materials that have faces
  std::vector<std::array<Vec3d, 3>> obstacles = {};  // triangles that obstruct and exchange nothing
  std::vector<FaceMask> masks = {};                  // rows of group_names without faces
  std::vector<std::string> warnings = {};            // whole sentences about what was split or dropped
};

struct FaceOptions {
  FacesBy by = FacesBy::face;
  double divide = 0;  // faces are cut into elements that are no longer than this [m]; 0: not at all
  bool two_sided = false;
};

// The shapes of lights are no surfaces and are left out. Face k of a mesh is called NAME#k, element j of it NAME#k.j, its back NAME#k back.
SceneFaces faces_of_scene(const LoadedScene& loaded, const FaceOptions& options, Budget& budget);
// The same for other meshes. Polygons of more than three corners stay faces; triangles are joined with their neighbours.
SceneFaces faces_of_meshes(const std::vector<PolygonMesh>& meshes, const FaceOptions& options, Budget& budget);

// Appends faces, divided and turned over as the options say.
void add_faces(SceneFaces& to, const std::vector<ViewFactorFace>& faces, const FaceOptions& options, Budget& budget);

// Cuts a face into elements whose sides are at most `size` long: a parallelogram along its sides, any other face by a grid in its plane.
std::vector<ViewFactorFace> divided_face(const ViewFactorFace& face, double size, Budget& budget);

}  // namespace steradian::exchange
