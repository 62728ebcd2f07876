// The pose of a node in a glTF file, and functions to move, turn and scale it. They keep the form that the file uses: a matrix, or
// translation, rotation and scale.
#pragma once

#include <array>
#include <vector>

#include "document/document.h"
#include "scene/gltf/gltf_nodes.h"

namespace steradian::view {

using scene::Affine;

// The transforms of all nodes of a document in its present state.
class NodeTree {
 public:
  NodeTree() = default;  // without nodes
  explicit NodeTree(const EditedDocument& document) : NodeTree(document.json(), document.file().path) {}
  NodeTree(const Json& json, const std::string& path);  // throws Error as load_scene does
  const Affine& world(int node) const { return nodes_.world[static_cast<std::size_t>(node)]; }
  Affine parent_world(int node) const;  // the identity for a root
  const std::vector<scene::GltfNode>& visible() const { return nodes_.visible; }
  bool contains(int node) const { return node >= 0 && static_cast<std::size_t>(node) < nodes_.world.size(); }

 private:
  scene::GltfNodes nodes_;
  std::vector<int> parents_;
};

struct NodePose {
  bool is_matrix = false;
  Affine matrix;  // for a node with a matrix
  Vec3d translation, scale{1, 1, 1};
  std::array<double, 4> rotation{0, 0, 0, 1};  // x y z w
};
NodePose pose_of(const EditedDocument& document, int node);
void set_pose(EditedDocument& document, int node, const NodePose& pose);  // writes changed values only

// `parent`: the world transform of the node's parent. Directions, axes and distances are in world space. A parent with unequal scales turns
// an axis to the direction of its image in the parent.
NodePose moved(NodePose pose, const Affine& parent, Vec3d by);
NodePose turned(NodePose pose, const Affine& parent, Vec3d axis, double angle);  // about the node's own origin
NodePose scaled(NodePose pose, Vec3d factors);                                   // along the node's own axes

Affine inverse(const Affine& a);  // the map must be invertible

}  // namespace steradian::view
