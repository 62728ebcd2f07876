#include "document/node_pose.h"

#include <algorithm>
#include <cmath>

#include "core/budget.h"

namespace steradian::view {
namespace {

std::string node_pointer(int node, const char* key) { return "/nodes/" + std::to_string(node) + "/" + key; }

Json list(Vec3d v) { return Json::array({v.x, v.y, v.z}); }

std::array<double, 4> product(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

// Writes a value if it differs from the file's. A value that is absent and equals glTF's default stays absent.
void put(EditedDocument& document, int node, const char* key, const Json& value, const Json& otherwise) {
  const std::string pointer = node_pointer(node, key);
  const Json* now = document.find(pointer);
  if (now != nullptr ? *now == value : value == otherwise) return;
  document.set(pointer, value);
}

}  // namespace

NodeTree::NodeTree(const Json& json, const std::string& path) {
  // Only the nodes are read; the file reader checks them and multiplies their transforms.
  Budget budget;
  scene::GltfDocument nodes;
  nodes.path = path;
  nodes.sources = std::make_unique<scene::GltfSources>(scene::GltfSources{budget});
  nodes.json = nlohmann::json::object();
  for (const char* key : {"nodes", "scenes", "scene"})
    if (json.contains(key)) nodes.json[key] = json[key];
  nodes_ = scene::read_nodes(nodes);
  parents_.assign(nodes_.world.size(), -1);
  int index = 0;
  for (const scene::JsonCursor& node : nodes.root().elements("nodes")) {
    for (const scene::JsonCursor& child : node.elements("children"))
      parents_[static_cast<std::size_t>(child.as_index(parents_.size(), "node"))] = index;
    ++index;
  }
}

Affine NodeTree::parent_world(int node) const {
  const int parent = parents_[static_cast<std::size_t>(node)];
  return parent < 0 ? Affine{} : world(parent);
}

Affine inverse(const Affine& a) {
  const double d = a.determinant();
  const Vec3d r0 = cross(a.y, a.z) / d, r1 = cross(a.z, a.x) / d, r2 = cross(a.x, a.y) / d;  // rows
  Affine i{{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, {}};
  i.t = -i.vector(a.t);
  return i;
}

NodePose pose_of(const EditedDocument& document, int node) {
  NodePose pose;
  if (const auto m = document.numbers(node_pointer(node, "matrix"), 16); !m.empty()) {
    const auto column = [&](std::size_t c) { return Vec3d{m[4 * c], m[4 * c + 1], m[4 * c + 2]}; };
    pose.is_matrix = true;
    pose.matrix = {column(0), column(1), column(2), column(3)};
    return pose;
  }
  if (const auto t = document.numbers(node_pointer(node, "translation"), 3); !t.empty()) pose.translation = {t[0], t[1], t[2]};
  if (const auto s = document.numbers(node_pointer(node, "scale"), 3); !s.empty()) pose.scale = {s[0], s[1], s[2]};
  if (const auto r = document.numbers(node_pointer(node, "rotation"), 4); !r.empty()) std::copy(r.begin(), r.end(), pose.rotation.begin());
  return pose;
}

void set_pose(EditedDocument& document, int node, const NodePose& pose) {
  if (pose.is_matrix) {
    const Affine& m = pose.matrix;
    document.set(node_pointer(node, "matrix"),
                 Json::array({m.x.x, m.x.y, m.x.z, 0, m.y.x, m.y.y, m.y.z, 0, m.z.x, m.z.y, m.z.z, 0, m.t.x, m.t.y, m.t.z, 1}));
    return;
  }
  const auto& r = pose.rotation;
  put(document, node, "translation", list(pose.translation), list({}));
  put(document, node, "rotation", Json::array({r[0], r[1], r[2], r[3]}), Json::array({0, 0, 0, 1}));
  put(document, node, "scale", list(pose.scale), list({1, 1, 1}));
}

NodePose moved(NodePose pose, const Affine& parent, Vec3d by) {
  const Vec3d local = inverse(parent).vector(by);
  (pose.is_matrix ? pose.matrix.t : pose.translation) += local;
  return pose;
}

NodePose turned(NodePose pose, const Affine& parent, Vec3d axis, double angle) {
  Vec3d local = normalized(inverse(parent).vector(axis));
  if (parent.determinant() < 0) angle = -angle;  // a mirror reverses the rotation
  if (pose.is_matrix) {
    for (Vec3d* column : {&pose.matrix.x, &pose.matrix.y, &pose.matrix.z}) *column = rotated(*column, local, angle);
    return pose;
  }
  const double s = std::sin(angle / 2);
  pose.rotation = product({local.x * s, local.y * s, local.z * s, std::cos(angle / 2)}, pose.rotation);
  double norm = 0;
  for (const double q : pose.rotation) norm += q * q;
  for (double& q : pose.rotation) q /= std::sqrt(norm);
  return pose;
}

NodePose scaled(NodePose pose, Vec3d factors) {
  if (pose.is_matrix) {
    pose.matrix.x *= factors.x;
    pose.matrix.y *= factors.y;
    pose.matrix.z *= factors.z;
  } else {
    pose.scale = pose.scale * factors;
  }
  return pose;
}

}  // namespace steradian::view
