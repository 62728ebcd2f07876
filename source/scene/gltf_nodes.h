// The node tree of a glTF file: checked, flattened, transforms multiplied out.
#pragma once

#include <vector>

#include "scene/affine.h"
#include "scene/gltf_document.h"

namespace steradian {

struct GltfNode {
  int index = 0;
  Affine world;
};

struct GltfNodes {
  std::vector<Affine> world;      // of every node of the file, in or out of the scene
  std::vector<GltfNode> visible;  // those of the scene, parents before children, without those of scale zero
  std::size_t zero_scaled = 0;    // nodes left out because a scale of theirs is zero
};

// Throws Error for cycles, nodes with two parents, children that do not exist, broken transforms.
GltfNodes read_nodes(const GltfDocument& document);

}  // namespace steradian
