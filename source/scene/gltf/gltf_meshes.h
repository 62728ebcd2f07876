// Converts glTF meshes to triangle meshes in world space.
#pragma once

#include <vector>

#include "scene/emitters/kept_meshes.h"
#include "scene/gltf/gltf_nodes.h"
#include "scene/warnings.h"
#include "steradian/scene.h"

namespace steradian::scene {

struct PlacedMeshes {
  std::vector<Mesh> meshes;
  std::vector<int> nodes;  // the node of each mesh
};

// Reads every mesh of every visible node, one Mesh per primitive that yields triangles. Appends a default material to `materials` if a
// primitive has none. kept: cached meshes of the last reading, replaced by those of this one; null: no cache.
PlacedMeshes read_meshes(const GltfDocument& document, const GltfNodes& nodes, std::vector<SurfaceMaterial>& materials, Warnings& warnings,
                         KeptMeshes* kept = nullptr);

// The numbers of a mesh's primitives that yield triangles. A node that shows the mesh has one Mesh for each, in this order.
std::vector<int> triangle_primitives(const GltfDocument& document, int mesh);

// The vertices of a primitive's triangles, three each, in the order in which read_meshes reads them.
std::vector<std::uint32_t> read_corners(const GltfDocument& document, int mesh, int primitive);

}  // namespace steradian::scene
