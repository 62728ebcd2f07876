// The nodes of a glTF file, and the skins that they move.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "scene/affine.h"
#include "scene/gltf/gltf_document.h"
#include "steradian/scene.h"

namespace steradian::scene {

// The node tree of a glTF file: checked, flattened, with transforms multiplied out.

struct GltfNode {
  int index = 0;
  Affine world;
};

struct GltfNodes {
  std::vector<Affine> world;      // for every node of the file, in the scene or not
  std::vector<GltfNode> visible;  // nodes of the scene, parents before children, without those of scale zero
  std::size_t zero_scaled = 0;    // nodes skipped because one of their scales is zero

  void move(Vec3d by);  // moves all of them in the world
};

// Ray casting and the arithmetic of lights use single precision and square their operands twice. Beyond this distance from the origin
// nothing can be rendered.
inline constexpr double kFarthest = 1e15;

inline bool within_reach(Vec3d p) { return std::fabs(p.x) <= kFarthest && std::fabs(p.y) <= kFarthest && std::fabs(p.z) <= kFarthest; }

// Throws Error with the node's name for a point that is out of this range. what: "vertex 3".
void check_reach(const JsonCursor& node, Vec3d point, const std::string& what);

// The camera of a node. Scales and shears of the node do not turn the view about its axis; the camera's axes are orthonormal.
Camera camera_at(const Affine& world, double yfov, std::string name);

// Throws Error for cycles, nodes with two parents, children that do not exist, broken transforms.
GltfNodes read_nodes(const GltfDocument& document);

// glTF skins in rest pose: joint matrices blended per vertex.

struct Skin {
  std::vector<Affine> joints;  // world transform of the joint times its inverse bind matrix
};

Skin read_skin(const GltfDocument& document, const GltfNodes& nodes, int skin);

// The matrix of each vertex from JOINTS_0 and WEIGHTS_0. Weights are normalised; if all are zero, the first joint's matrix is used.
std::vector<Affine> blend_joints(const GltfDocument& document, const Skin& skin, const JsonCursor& attributes, std::size_t vertices);

}  // namespace steradian::scene
