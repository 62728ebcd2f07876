#include "scene/gltf/gltf_skin.h"

#include "scene/gltf/gltf_accessor.h"

namespace steradian::scene {

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
