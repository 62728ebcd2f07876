#include "scene/gltf/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scene/gltf/gltf_accessor.h"

namespace steradian::scene {
namespace {

Affine matrix_of(const JsonCursor& matrix) {
  const auto m = matrix.as_numbers<16>();
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) matrix.fail("the last row must be 0 0 0 1 (the matrix is given by columns)");
  const Affine a{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  if (a.determinant() == 0) matrix.fail("the matrix cannot be inverted", "use \"scale\" to flatten or hide a node");
  return a;
}

Affine rotation_of(const JsonCursor& rotation) {
  const auto q = rotation.as_numbers<4>();
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(norm > 0.5 && norm < 2)) rotation.fail("must be a unit quaternion, its length is " + std::to_string(norm));
  const double x = q[0] / norm, y = q[1] / norm, z = q[2] / norm, w = q[3] / norm;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
          {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
          {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
          {}};
}

Affine local_transform(const JsonCursor& node) {
  if (const auto matrix = node.find("matrix")) {
    for (const char* other : {"translation", "rotation", "scale"})
      if (node.has(other)) node.fail(std::string("has both \"matrix\" and \"") + other + "\"", "use one of them");
    return matrix_of(*matrix);
  }
  const auto rotation = node.find("rotation");
  Affine a = rotation ? rotation_of(*rotation) : Affine{};
  const Vec3d s = node.vector("scale", {1, 1, 1});
  a.x *= s.x;
  a.y *= s.y;
  a.z *= s.z;
  a.t = node.vector("translation", {});
  return a;
}

std::vector<int> read_parents(const JsonElements& nodes, std::vector<std::vector<int>>& children) {
  std::vector<int> parent(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const JsonCursor& child : nodes[i].elements("children")) {
      const int c = child.as_index(nodes.size(), "node");
      int& of_child = parent[static_cast<std::size_t>(c)];
      if (of_child >= 0)
        child.fail("node " + std::to_string(c) + " is already a child of node " + std::to_string(of_child), "a node has one parent");
      of_child = static_cast<int>(i);
      children[i].push_back(c);
    }
  return parent;
}

std::vector<int> scene_roots(const GltfDocument& document, const std::vector<int>& parent) {
  const JsonCursor root = document.root();
  const std::size_t scenes = document.count("scenes");
  int scene = root.index("scene", scenes, "scene");
  std::vector<int> roots;
  if (scenes == 0) {
    for (std::size_t i = 0; i < parent.size(); ++i)
      if (parent[i] < 0) roots.push_back(static_cast<int>(i));
    return roots;
  }
  std::vector<bool> listed(parent.size(), false);
  for (const JsonCursor& node : document.object("scenes", scene < 0 ? 0 : scene).elements("nodes")) {
    const int n = node.as_index(parent.size(), "node");
    if (parent[static_cast<std::size_t>(n)] >= 0)
      node.fail("node " + std::to_string(n) + " is a child of node " + std::to_string(parent[static_cast<std::size_t>(n)]),
                "a scene lists root nodes");
    if (listed[static_cast<std::size_t>(n)]) node.fail("node " + std::to_string(n) + " is listed twice");
    listed[static_cast<std::size_t>(n)] = true;
    roots.push_back(n);
  }
  return roots;
}

}  // namespace

void check_reach(const JsonCursor& node, Vec3d p, const std::string& what) {
  if (within_reach(p)) return;
  const double farthest = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  const std::string name = node.text("name", "");
  char text[80];
  std::snprintf(text, sizeof text, " lies %.3g from the origin; %.0e is the farthest that can be rendered", farthest, kFarthest);
  throw Error(node.place() + (name.empty() ? "" : " \"" + name + "\""), what + text, "scale the scene down");
}

Camera camera_at(const Affine& world, double yfov, std::string name) {
  const Vec3d z = normalized(world.z);
  const Frame frame = Frame::from_normal_and_tangent(z, world.x);
  return {std::move(name), world.t, frame.x, frame.y, z, yfov};
}

void GltfNodes::move(Vec3d by) {
  for (Affine& node : world) node.t += by;
  for (GltfNode& node : visible) node.world.t += by;
}

GltfNodes read_nodes(const GltfDocument& document) {
  const JsonElements nodes = document.root().elements("nodes");
  std::vector<std::vector<int>> children(nodes.size());
  const std::vector<int> parent = read_parents(nodes, children);

  // Parents come before children. Each node has one parent, so nodes not reached from a root lie on a cycle or below one.
  std::vector<int> order;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (parent[i] < 0) order.push_back(static_cast<int>(i));
  for (std::size_t i = 0; i < order.size(); ++i)
    for (const int c : children[static_cast<std::size_t>(order[i])]) order.push_back(c);
  std::vector<bool> reached(nodes.size(), false);
  for (const int n : order) reached[static_cast<std::size_t>(n)] = true;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!reached[i]) nodes[i].fail("the node is its own ancestor", "break the cycle of \"children\"");

  GltfNodes result;
  result.world.resize(nodes.size());
  for (const int n : order) {
    const auto i = static_cast<std::size_t>(n);
    result.world[i] = local_transform(nodes[i]);
    if (parent[i] >= 0) result.world[i] = result.world[static_cast<std::size_t>(parent[i])] * result.world[i];
    const Affine& w = result.world[i];
    if (!is_finite(w.x) || !is_finite(w.y) || !is_finite(w.z) || !is_finite(w.t) || !std::isfinite(w.determinant()))
      nodes[i].fail("the transform leaves the range of numbers");
  }

  std::vector<int> stack = scene_roots(document, parent);
  for (std::size_t i = 0; i < stack.size(); ++i) {
    const auto n = static_cast<std::size_t>(stack[i]);
    for (const int c : children[n]) stack.push_back(c);
    if (result.world[n].determinant() == 0)
      ++result.zero_scaled;
    else
      result.visible.push_back({stack[i], result.world[n]});
  }
  return result;
}

Skin read_skin(const GltfDocument& document, const GltfNodes& nodes, int index) {
  const JsonCursor json = document.object("skins", index);
  Skin skin;
  const JsonElements joints = json.at("joints").elements();
  document.budget().take_memory(json.place(), "its joints", joints.size() * sizeof(Affine));
  skin.joints.reserve(joints.size());
  for (const JsonCursor& joint : joints)
    skin.joints.push_back(nodes.world[static_cast<std::size_t>(joint.as_index(nodes.world.size(), "node"))]);
  if (skin.joints.empty()) json.at("joints").fail("the list is empty");

  const int accessor = json.index("inverseBindMatrices", document.count("accessors"), "accessor");
  if (accessor < 0) return skin;
  const FloatArray matrices = read_first_floats(document, accessor, "MAT4", skin.joints.size());
  if (matrices.count < skin.joints.size())
    json.at("inverseBindMatrices")
        .fail("has " + std::to_string(matrices.count) + " matrices for " + std::to_string(skin.joints.size()) + " joints");
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    const float* m = matrices.values.data() + 16 * j;
    const auto column = [&](int c) { return static_cast<Vec3d>(Vec3f{m[4 * c], m[4 * c + 1], m[4 * c + 2]}); };
    skin.joints[j] = skin.joints[j] * Affine{column(0), column(1), column(2), column(3)};
  }
  return skin;
}

std::vector<Affine> blend_joints(const GltfDocument& document, const Skin& skin, const JsonCursor& attributes, std::size_t vertices) {
  const std::size_t accessors = document.count("accessors");
  attributes.at("JOINTS_0");
  attributes.at("WEIGHTS_0");
  const auto joints = read_unsigned(document, attributes.index("JOINTS_0", accessors, "accessor"), "VEC4");
  const FloatArray weights = read_floats(document, attributes.index("WEIGHTS_0", accessors, "accessor"), "VEC4");
  if (joints.size() != 4 * vertices || weights.count != vertices)
    attributes.fail("JOINTS_0 and WEIGHTS_0 must have as many elements as POSITION");
  std::vector<Affine> result(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += static_cast<double>(weights.values[4 * i + k]);
    Affine blended{{}, {}, {}, {}};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t joint = joints[4 * i + k];
      if (joint >= skin.joints.size())
        attributes.at("JOINTS_0")
            .fail("vertex " + std::to_string(i) + " names joint " + std::to_string(joint) + ", the skin has " +
                  std::to_string(skin.joints.size()));
      const double w = sum > 0 ? static_cast<double>(weights.values[4 * i + k]) / sum : (k == 0 ? 1 : 0);
      const Affine& m = skin.joints[joint];
      blended.x += m.x * w;
      blended.y += m.y * w;
      blended.z += m.z * w;
      blended.t += m.t * w;
    }
    result[i] = blended;
  }
  return result;
}

}  // namespace steradian::scene
