// glTF meshes to triangle meshes in world space.
#pragma once

#include <vector>

#include "scene/gltf_nodes.h"
#include "scene/kept_meshes.h"
#include "scene/warnings.h"
#include "steradian/scene.h"

namespace steradian::scene {

struct PlacedMeshes {
  std::vector<Mesh> meshes;
  std::vector<int> nodes;  // of each: whose node it is
};

// Every mesh of every visible node, one Mesh per primitive that makes triangles. Appends a default material
// to `materials` where a primitive has none. kept: of the last reading, which become those of this one; null: none.
PlacedMeshes read_meshes(const GltfDocument& document, const GltfNodes& nodes, std::vector<SurfaceMaterial>& materials, Warnings& warnings,
                         KeptMeshes* kept = nullptr);

}  // namespace steradian::scene
