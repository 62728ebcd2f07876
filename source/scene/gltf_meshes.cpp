#include "scene/gltf_meshes.h"

#include <cmath>

#include "scene/gltf_accessor.h"
#include "scene/gltf_skin.h"
#include "scene/tangents.h"

namespace steradian {
namespace {

// A small file can place a large mesh many times: bound the whole before anything is allocated.
constexpr std::size_t kMaxVertices = 200'000'000;

enum Mode { kTriangles = 4, kStrip = 5, kFan = 6 };

struct Context {
  const GltfDocument& document;
  Warnings& warnings;
  std::size_t accessors;

  int attribute(const JsonCursor& attributes, const char* name) const {
    return attributes.index(name, accessors, "accessor");
  }
};

// Triangles of a list, strip or fan of `count` corners; every second one of a strip is turned so that all
// face alike.
std::vector<std::uint32_t> triangulated(const std::vector<std::uint32_t>& corners, int mode) {
  if (mode == kTriangles) return corners;
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    if (mode == kFan)
      result.insert(result.end(), {corners[i + 1], corners[i + 2], corners[0]});
    else if (i % 2 == 0)
      result.insert(result.end(), {corners[i], corners[i + 1], corners[i + 2]});
    else
      result.insert(result.end(), {corners[i], corners[i + 2], corners[i + 1]});
  }
  return result;
}

std::vector<std::uint32_t> read_indices(const Context& c, const JsonCursor& primitive, std::size_t vertices,
                                        int mode) {
  std::vector<std::uint32_t> corners;
  const int accessor = primitive.index("indices", c.accessors, "accessor");
  if (accessor >= 0) {
    corners = read_unsigned(c.document, accessor, "SCALAR");
    for (std::size_t i = 0; i < corners.size(); ++i)
      if (corners[i] >= vertices)
        primitive.at("indices").fail("accessor " + std::to_string(accessor) + ", element " +
                                         std::to_string(i) + " is " + std::to_string(corners[i]) +
                                         ", the primitive has " + std::to_string(vertices) + " vertices",
                                     "the file is broken; export it again");
  } else {
    corners.resize(vertices);
    for (std::size_t i = 0; i < vertices; ++i) corners[i] = static_cast<std::uint32_t>(i);
  }
  if (mode == kTriangles ? corners.size() % 3 != 0 : corners.size() < 3)
    primitive.fail(std::to_string(corners.size()) + " corners do not make whole triangles");
  return triangulated(corners, mode);
}

FloatArray read_attribute(const Context& c, const JsonCursor& attributes, const char* name, const char* types,
                          std::size_t vertices, NotFinite not_finite = NotFinite::refuse) {
  const int accessor = c.attribute(attributes, name);
  if (accessor < 0) return {};
  FloatArray result = read_floats(c.document, accessor, types, not_finite);
  if (result.count != vertices)
    attributes.at(name).fail("accessor " + std::to_string(accessor) + " has " + std::to_string(result.count) +
                             " elements, POSITION has " + std::to_string(vertices));
  return result;
}

Vec3f vec3_at(const FloatArray& a, std::size_t i) {
  return {a.values[3 * i], a.values[3 * i + 1], a.values[3 * i + 2]};
}

std::vector<Vec3f> vec3_array(const FloatArray& a) {
  std::vector<Vec3f> result(a.count);
  for (std::size_t i = 0; i < a.count; ++i) result[i] = vec3_at(a, i);
  return result;
}

void add_morph_targets(const Context& c, Mesh& mesh, const JsonCursor& primitive,
                       const std::vector<double>& weights) {
  const auto targets = primitive.elements("targets");
  for (std::size_t t = 0; t < targets.size() && t < weights.size(); ++t) {
    if (weights[t] == 0) continue;
    const auto add = [&](const char* name, std::vector<Vec3f>& to) {
      const FloatArray delta = read_attribute(c, targets[t], name, "VEC3", mesh.positions.size());
      for (std::size_t i = 0; i < delta.count && i < to.size(); ++i)
        to[i] += vec3_at(delta, i) * static_cast<float>(weights[t]);
    };
    add("POSITION", mesh.positions);
    add("NORMAL", mesh.normals);
  }
}

std::vector<double> morph_weights(const JsonCursor& node, const JsonCursor& mesh) {
  std::vector<double> weights;
  for (const JsonCursor& w : (node.has("weights") ? node : mesh).elements("weights"))
    weights.push_back(w.as_number());
  return weights;
}

// Everything of a primitive in the space of its mesh, morphs at their given weights.
Mesh read_local(const Context& c, const JsonCursor& primitive, const std::vector<double>& weights, int mode) {
  const JsonCursor attributes = primitive.at("attributes");
  const int position = c.attribute(attributes, "POSITION");
  Mesh mesh;
  const FloatArray positions = read_floats(c.document, position, "VEC3");
  const std::size_t n = positions.count;
  mesh.positions = vec3_array(positions);
  mesh.normals = vec3_array(read_attribute(c, attributes, "NORMAL", "VEC3", n, NotFinite::zero));
  if (!mesh.normals.empty()) {
    const FloatArray tangents = read_attribute(c, attributes, "TANGENT", "VEC4", n, NotFinite::zero);
    for (std::size_t i = 0; i < tangents.count; ++i)
      mesh.tangents.push_back({tangents.values[4 * i], tangents.values[4 * i + 1], tangents.values[4 * i + 2],
                               tangents.values[4 * i + 3] < 0 ? -1.0f : 1.0f});
  }
  for (int set = 0; set < 2; ++set) {
    const FloatArray uv = read_attribute(c, attributes, set == 0 ? "TEXCOORD_0" : "TEXCOORD_1", "VEC2", n);
    for (std::size_t i = 0; i < uv.count; ++i)
      mesh.texcoords[set].push_back({uv.values[2 * i], uv.values[2 * i + 1]});
  }
  const FloatArray colors = read_attribute(c, attributes, "COLOR_0", "VEC3 VEC4", n);
  for (std::size_t i = 0; i < colors.count; ++i) {
    const float* v = colors.values.data() + i * static_cast<std::size_t>(colors.components);
    mesh.colors.push_back({v[0], v[1], v[2], colors.components == 4 ? v[3] : 1.0f});
  }
  mesh.indices = read_indices(c, primitive, n, mode);
  add_morph_targets(c, mesh, primitive, weights);
  return mesh;
}

// One matrix per vertex: of its node, or blended from the joints of its skin.
template <class TransformOf>
void to_world(Mesh& mesh, const JsonCursor& primitive, TransformOf transform_of) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Affine m = transform_of(i);
    mesh.positions[i] = static_cast<Vec3f>(m.point(static_cast<Vec3d>(mesh.positions[i])));
    if (!is_finite(mesh.positions[i]))
      primitive.fail("vertex " + std::to_string(i) + " leaves the range of numbers in world space");
    if (!mesh.normals.empty())
      mesh.normals[i] = static_cast<Vec3f>(m.normal(normalized(static_cast<Vec3d>(mesh.normals[i]))));
    if (!mesh.tangents.empty()) {
      Vec4f& t = mesh.tangents[i];
      const Vec3d v = normalized(m.vector(static_cast<Vec3d>(Vec3f{t.x, t.y, t.z})));
      t = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
           m.determinant() < 0 ? -t.w : t.w};
    }
  }
}

void turn_triangles(Mesh& mesh) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

bool has_broken_tangents(const Mesh& mesh) {
  for (const Vec4f& t : mesh.tangents)
    if (!(t.x * t.x + t.y * t.y + t.z * t.z > 0.25f)) return true;
  return false;
}

// Which set of texture coordinates the material's tangents follow; -1: it needs none.
int tangent_set(const SurfaceMaterial& m) {
  if (m.normal_texture.present()) return m.normal_texture.texcoord;
  if (m.clearcoat_normal_texture.present()) return m.clearcoat_normal_texture.texcoord;
  if (m.anisotropy_texture.present()) return m.anisotropy_texture.texcoord;
  return m.anisotropy > 0 ? 0 : -1;
}

void complete(Mesh& mesh, const SurfaceMaterial& material, Warnings& warnings) {
  if (mesh.normals.empty()) make_flat_normals(mesh);
  if (repair_normals(mesh) > 0)
    warnings.say("normals of length zero were replaced by those of the faces around them (first in mesh \"" +
                 mesh.name + "\")");
  const int set = tangent_set(material);
  if (has_broken_tangents(mesh)) mesh.tangents.clear();
  if (mesh.tangents.empty() && set >= 0 && !mesh.texcoords[set].empty()) make_tangents(mesh, set);
}

void check_texture_sets(const SurfaceMaterial& m, const Mesh& mesh, Warnings& warnings) {
  for (const TextureUse* use :
       {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture,
        &m.emissive_texture, &m.clearcoat_texture, &m.clearcoat_roughness_texture, &m.sheen_color_texture, &m.sheen_roughness_texture,
        &m.clearcoat_normal_texture, &m.specular_texture, &m.specular_color_texture, &m.anisotropy_texture})
    if (use->present() && mesh.texcoords[use->texcoord].empty())
      warnings.say("mesh \"" + mesh.name + "\" has textures but not their coordinates; (0, 0) is used");
}

}  // namespace

std::vector<Mesh> read_meshes(const GltfDocument& document, const GltfNodes& nodes,
                              std::vector<SurfaceMaterial>& materials, Warnings& warnings) {
  const Context c{document, warnings, document.count("accessors")};
  const std::size_t given_materials = materials.size();
  std::vector<Mesh> result;
  std::size_t vertices = 0;
  for (const GltfNode& visible : nodes.visible) {
    const JsonCursor node = document.object("nodes", visible.index);
    const int mesh_index = node.index("mesh", document.count("meshes"), "mesh");
    const int skin_index = node.index("skin", document.count("skins"), "skin");
    if (mesh_index < 0) continue;
    const JsonCursor mesh_json = document.object("meshes", mesh_index);
    const std::vector<double> weights = morph_weights(node, mesh_json);
    mesh_json.at("primitives");
    for (const JsonCursor& primitive : mesh_json.elements("primitives")) {
      const int mode = static_cast<int>(primitive.integer("mode", kTriangles, 0, 6));
      if (mode < kTriangles) {
        warnings.not_supported("points and lines");
        continue;
      }
      int material = primitive.index("material", given_materials, "material");
      const int position = c.attribute(primitive.at("attributes"), "POSITION");
      if (position < 0) {
        warnings.say("a primitive without POSITION was left out: " + primitive.place());
        continue;
      }
      vertices += checked_count(document, position);
      const int indices = primitive.index("indices", c.accessors, "accessor");
      if (indices >= 0) vertices += checked_count(document, indices);
      if (vertices > kMaxVertices)
        primitive.fail("the scene has more than " + std::to_string(kMaxVertices) + " vertices and indices",
                       "use a smaller scene");

      Mesh mesh = read_local(c, primitive, weights, mode);
      mesh.name = mesh_json.text("name", node.text("name", ""));
      if (skin_index >= 0 && primitive.at("attributes").has("JOINTS_0")) {
        const Skin skin = read_skin(document, nodes, skin_index);
        const std::vector<Affine> blended =
            blend_joints(document, skin, primitive.at("attributes"), mesh.positions.size());
        to_world(mesh, primitive, [&](std::size_t i) { return blended[i]; });
      } else {
        to_world(mesh, primitive, [&](std::size_t) { return visible.world; });
        if (visible.world.determinant() < 0) turn_triangles(mesh);
      }
      if (material < 0) {
        if (materials.size() == given_materials) materials.push_back({});
        material = static_cast<int>(given_materials);
      }
      mesh.material = material;
      const SurfaceMaterial& m = materials[static_cast<std::size_t>(material)];
      check_texture_sets(m, mesh, warnings);
      complete(mesh, m, warnings);
      result.push_back(std::move(mesh));
    }
  }
  return result;
}

}  // namespace steradian
