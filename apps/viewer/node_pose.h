// Where a node of a glTF file stands, and how it is moved, turned and scaled: in the words that the file uses for it, a matrix or
// translation, rotation and scale.
#pragma once

#include <array>
#include <vector>

#include "document.h"
#include "scene/gltf_nodes.h"

namespace steradian::view {

using scene::Affine;

// The transforms of all nodes of a document as it stands.
class NodeTree {
 public:
  NodeTree() = default;  // of no nodes
  explicit NodeTree(const Document& document) : NodeTree(document.json(), document.file().path) {}
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
  Affine matrix;  // of a node with one
  Vec3d translation, scale{1, 1, 1};
  std::array<double, 4> rotation{0, 0, 0, 1};  // x y z w
};
NodePose pose_of(const Document& document, int node);
void set_pose(Document& document, int node, const NodePose& pose);  // writes what differs alone

// `parent`: the world transform of the node's parent. Directions, axes and distances are the world's; a parent of unequal scales turns
// an axis to the direction that its image has in the parent.
NodePose moved(NodePose pose, const Affine& parent, Vec3d by);
NodePose turned(NodePose pose, const Affine& parent, Vec3d axis, double angle);  // about the node's own origin
NodePose scaled(NodePose pose, Vec3d factors);                                   // along the node's own axes

Affine inverse(const Affine& a);  // of one that can be inverted

}  // namespace steradian::view
