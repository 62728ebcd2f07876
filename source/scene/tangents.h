// Computes normals and tangents for meshes without them.
#pragma once

#include "steradian/scene.h"

namespace steradian::scene {

// Gives every triangle separate vertices with the face's normal, as glTF demands if normals are missing.
void make_flat_normals(Mesh& mesh);

// Replaces zero normals by the area-weighted mean of the adjacent faces. Returns the number of replacements.
std::size_t repair_normals(Mesh& mesh);

// Tangents along growing u of texture set `set`, which the mesh must have; w is the sign of the bitangent. If the texture coordinates span
// no area, the tangent is any direction in the surface.
void make_tangents(Mesh& mesh, int set);

}  // namespace steradian::scene
