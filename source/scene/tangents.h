// Normals and tangents for meshes that come without.
#pragma once

#include "steradian/scene.h"

namespace steradian::scene {

// Gives every triangle vertices of its own with the face's normal, as glTF wants where normals are missing.
void make_flat_normals(Mesh& mesh);

// Replaces normals that are zero by the area-weighted mean of the faces around; how many there were.
std::size_t repair_normals(Mesh& mesh);

// Tangents along growing u of texture set `set`, which the mesh must have; w is the sign of the bitangent.
// Where the texture coordinates span no area: any direction in the surface.
void make_tangents(Mesh& mesh, int set);

}  // namespace steradian::scene
