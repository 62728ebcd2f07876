// The node tree of a glTF file: checked, flattened, transforms multiplied out.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "scene/affine.h"
#include "scene/gltf_document.h"
#include "steradian/scene.h"

namespace steradian::scene {

struct GltfNode {
  int index = 0;
  Affine world;
};

struct GltfNodes {
  std::vector<Affine> world;      // of every node of the file, in or out of the scene
  std::vector<GltfNode> visible;  // those of the scene, parents before children, without those of scale zero
  std::size_t zero_scaled = 0;    // nodes left out because a scale of theirs is zero
};

// Ray casting and the lights' arithmetic are in single precision, and square what they work with twice: beyond this
// distance from the origin nothing can be rendered.
inline constexpr double kFarthest = 1e15;

inline bool within_reach(Vec3d p) { return std::fabs(p.x) <= kFarthest && std::fabs(p.y) <= kFarthest && std::fabs(p.z) <= kFarthest; }

// Throws Error with the node's name for a point that is not within reach. what: "vertex 3".
void check_reach(const JsonCursor& node, Vec3d point, const std::string& what);

// The camera of a node: whatever its scales and shears, the view is not turned about its axis, and orthonormal.
Camera camera_at(const Affine& world, double yfov, std::string name);

// Throws Error for cycles, nodes with two parents, children that do not exist, broken transforms.
GltfNodes read_nodes(const GltfDocument& document);

}  // namespace steradian::scene
