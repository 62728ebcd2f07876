// glTF skins in rest pose: joint matrices blended per vertex.
#pragma once

#include <vector>

#include "scene/gltf/gltf_nodes.h"

namespace steradian::scene {

struct Skin {
  std::vector<Affine> joints;  // world transform of the joint times its inverse bind matrix
};

Skin read_skin(const GltfDocument& document, const GltfNodes& nodes, int skin);

// The matrix of each vertex from JOINTS_0 and WEIGHTS_0. Weights are normalised; if all are zero, the first joint's matrix is used.
std::vector<Affine> blend_joints(const GltfDocument& document, const Skin& skin, const JsonCursor& attributes, std::size_t vertices);

}  // namespace steradian::scene
