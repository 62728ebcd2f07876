#include "scene/gltf/gltf_meshes.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "scene/gltf/gltf_accessor.h"
#include "scene/gltf/gltf_nodes.h"
#include "scene/tangents.h"

namespace steradian::scene {
namespace {

enum Mode { kTriangles = 4, kStrip = 5, kFan = 6 };

constexpr std::uint64_t kStepsPerMorphedVertex = 50;

struct Context {
  const GltfDocument& document;
  Warnings& warnings;
  std::size_t accessors;

  int attribute(const JsonCursor& attributes, const char* name) const { return attributes.index(name, accessors, "accessor"); }
};

// Triangles of a list, strip or fan of `count` corners. Every second triangle of a strip is reversed so that all face the same way.
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

std::vector<std::uint32_t> read_indices(const Context& c, const JsonCursor& primitive, std::size_t vertices, int mode) {
  std::vector<std::uint32_t> corners;
  const int accessor = primitive.index("indices", c.accessors, "accessor");
  if (accessor >= 0) {
    corners = read_unsigned(c.document, accessor, "SCALAR");
    for (std::size_t i = 0; i < corners.size(); ++i)
      if (corners[i] >= vertices)
        primitive.at("indices").fail("accessor " + std::to_string(accessor) + ", element " + std::to_string(i) + " is " +
                                         std::to_string(corners[i]) + ", the primitive has " + std::to_string(vertices) + " vertices",
                                     "the file is broken; export it again");
  } else {
    corners.resize(vertices);
    for (std::size_t i = 0; i < vertices; ++i) corners[i] = static_cast<std::uint32_t>(i);
  }
  if (mode == kTriangles ? corners.size() % 3 != 0 : corners.size() < 3)
    primitive.fail(std::to_string(corners.size()) + " corners do not make whole triangles");
  return triangulated(corners, mode);
}

FloatArray read_attribute(const Context& c, const JsonCursor& attributes, const char* name, const char* types, std::size_t vertices,
                          NotFinite not_finite = NotFinite::refuse) {
  const int accessor = c.attribute(attributes, name);
  if (accessor < 0) return {};
  FloatArray result = read_floats(c.document, accessor, types, not_finite);
  if (result.count != vertices)
    attributes.at(name).fail("accessor " + std::to_string(accessor) + " has " + std::to_string(result.count) + " elements, POSITION has " +
                             std::to_string(vertices));
  return result;
}

Vec3f vec3_at(const FloatArray& a, std::size_t i) { return {a.values[3 * i], a.values[3 * i + 1], a.values[3 * i + 2]}; }

std::vector<Vec3f> vec3_array(const FloatArray& a) {
  std::vector<Vec3f> result(a.count);
  for (std::size_t i = 0; i < a.count; ++i) result[i] = vec3_at(a, i);
  return result;
}

void add_morph_targets(const Context& c, Mesh& mesh, const JsonCursor& primitive, const std::vector<double>& weights) {
  const auto targets = primitive.elements("targets");
  for (std::size_t t = 0; t < targets.size() && t < weights.size(); ++t) {
    if (weights[t] == 0) continue;
    c.document.budget().take_work(targets[t].place(), "its morph targets", kStepsPerMorphedVertex * mesh.positions.size());
    const auto add = [&](const char* name, std::vector<Vec3f>& to) {
      const FloatArray delta = read_attribute(c, targets[t], name, "VEC3", mesh.positions.size());
      for (std::size_t i = 0; i < delta.count && i < to.size(); ++i) to[i] += vec3_at(delta, i) * static_cast<float>(weights[t]);
    };
    add("POSITION", mesh.positions);
    add("NORMAL", mesh.normals);
  }
}

std::vector<double> morph_weights(const JsonCursor& node, const JsonCursor& mesh) {
  std::vector<double> weights;
  for (const JsonCursor& w : (node.has("weights") ? node : mesh).elements("weights")) weights.push_back(w.as_number());
  return weights;
}

// Reads a primitive in the space of its mesh, with morph targets at the given weights.
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
      mesh.tangents.push_back(
          {tangents.values[4 * i], tangents.values[4 * i + 1], tangents.values[4 * i + 2], tangents.values[4 * i + 3] < 0 ? -1.0f : 1.0f});
  }
  for (int set = 0; set < 2; ++set) {
    const FloatArray uv = read_attribute(c, attributes, set == 0 ? "TEXCOORD_0" : "TEXCOORD_1", "VEC2", n);
    for (std::size_t i = 0; i < uv.count; ++i) mesh.texcoords[set].push_back({uv.values[2 * i], uv.values[2 * i + 1]});
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

// Transforms each vertex by one matrix: the node's, or a blend of its skin's joints.
template <class TransformOf>
void to_world(Mesh& mesh, const JsonCursor& node, TransformOf transform_of) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Affine m = transform_of(i);
    const Vec3d p = m.point(static_cast<Vec3d>(mesh.positions[i]));
    if (!within_reach(p)) check_reach(node, p, "vertex " + std::to_string(i));
    mesh.positions[i] = static_cast<Vec3f>(p);
    if (!mesh.normals.empty()) mesh.normals[i] = static_cast<Vec3f>(m.normal(normalized(static_cast<Vec3d>(mesh.normals[i]))));
    if (!mesh.tangents.empty()) {
      Vec4f& t = mesh.tangents[i];
      const Vec3d v = normalized(m.vector(static_cast<Vec3d>(Vec3f{t.x, t.y, t.z})));
      t = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), m.determinant() < 0 ? -t.w : t.w};
    }
  }
}

void turn_triangles(Mesh& mesh) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

bool has_broken_tangents(const Mesh& mesh) {
  for (const Vec4f& t : mesh.tangents)
    if (!(t.x * t.x + t.y * t.y + t.z * t.z > 0.25f)) return true;
  return false;
}

// The set of texture coordinates that the material's tangents follow; -1: it needs none.
int tangent_set(const SurfaceMaterial& m) {
  if (m.normal_texture.present()) return m.normal_texture.texcoord;
  if (m.clearcoat_normal_texture.present()) return m.clearcoat_normal_texture.texcoord;
  if (m.anisotropy_texture.present()) return m.anisotropy_texture.texcoord;
  return m.anisotropy > 0 ? 0 : -1;
}

void complete(Mesh& mesh, const SurfaceMaterial& material, Warnings& warnings) {
  if (mesh.normals.empty()) make_flat_normals(mesh);
  if (repair_normals(mesh) > 0)
    warnings.count("normals of length zero were replaced by those of the faces around them", "mesh \"" + mesh.name + "\"");
  const int set = tangent_set(material);
  if (has_broken_tangents(mesh)) mesh.tangents.clear();
  if (mesh.tangents.empty() && set >= 0 && !mesh.texcoords[set].empty()) make_tangents(mesh, set);
}

void check_texture_sets(const SurfaceMaterial& m, const Mesh& mesh, Warnings& warnings) {
  for (const TextureUse* use :
       {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture, &m.emissive_texture,
        &m.clearcoat_texture, &m.clearcoat_roughness_texture, &m.sheen_color_texture, &m.sheen_roughness_texture,
        &m.clearcoat_normal_texture, &m.specular_texture, &m.specular_color_texture, &m.anisotropy_texture})
    if (use->present() && mesh.texcoords[use->texcoord].empty())
      return warnings.count("meshes with textures lack their coordinates; (0, 0) is used", "mesh \"" + mesh.name + "\"");
}

// A primitive that yields triangles. It is checked once, however many nodes place its mesh.
struct UsablePrimitive {
  JsonCursor json;
  int number = 0;  // within its mesh
  int mode = kTriangles;
  int material = -1;
};

struct UsableMesh {
  std::vector<UsablePrimitive> primitives;
  std::uint64_t bytes = 0;  // memory of one placement
};

// Memory of a primitive. Positions, normals and tangents exist even if the file has none. Other vertex attributes exist only if the
// primitive names them.
std::uint64_t bytes_of(const Context& c, const JsonCursor& primitive, int mode) {
  const JsonCursor attributes = primitive.at("attributes");
  const std::uint64_t vertices = checked_count(c.document, c.attribute(attributes, "POSITION"));
  const int indices = primitive.index("indices", c.accessors, "accessor");
  std::uint64_t corners = indices >= 0 ? checked_count(c.document, indices) : vertices;
  if (mode != kTriangles) corners *= 3;
  std::uint64_t vertex = 2 * sizeof(Vec3f) + sizeof(Vec4f);
  for (const char* set : {"TEXCOORD_0", "TEXCOORD_1"}) vertex += attributes.has(set) ? sizeof(Vec2f) : 0;
  if (attributes.has("COLOR_0")) vertex += sizeof(Vec4f);
  if (attributes.has("JOINTS_0")) vertex += sizeof(Affine);
  // With flat normals every corner becomes a separate vertex.
  const std::uint64_t made = attributes.has("NORMAL") ? vertices : std::max(vertices, corners);
  return sizeof(Mesh) + made * vertex + corners * sizeof(std::uint32_t);
}

UsableMesh usable_mesh(const Context& c, const JsonCursor& mesh, std::size_t materials) {
  UsableMesh result;
  mesh.at("primitives");
  int number = -1;
  for (const JsonCursor& primitive : mesh.elements("primitives")) {
    ++number;
    const int mode = static_cast<int>(primitive.integer("mode", kTriangles, 0, 6));
    if (mode < kTriangles) {
      c.warnings.not_supported("points and lines");
      continue;
    }
    const int material = primitive.index("material", materials, "material");
    if (c.attribute(primitive.at("attributes"), "POSITION") < 0) {
      c.warnings.count("primitives without POSITION were left out", primitive.place());
      continue;
    }
    result.bytes += bytes_of(c, primitive, mode);
    result.primitives.push_back({primitive, number, mode, material});
  }
  return result;
}

// A visible node that shows a mesh.
struct Placement {
  JsonCursor node;
  int index;
  const Affine* world;
  int mesh, skin;
};

// The whole memory is checked before anything is allocated, because a small file can place a large mesh many times.
std::vector<Placement> take_placements(const Context& c, const GltfNodes& nodes, std::size_t materials,
                                       std::unordered_map<int, UsableMesh>& meshes) {
  std::vector<Placement> result;
  for (const GltfNode& visible : nodes.visible) {
    const JsonCursor node = c.document.object("nodes", visible.index);
    const int mesh = node.index("mesh", c.document.count("meshes"), "mesh");
    const int skin = node.index("skin", c.document.count("skins"), "skin");
    if (mesh < 0) continue;
    auto known = meshes.find(mesh);
    if (known == meshes.end()) known = meshes.emplace(mesh, usable_mesh(c, c.document.object("meshes", mesh), materials)).first;
    if (known->second.primitives.empty()) continue;
    c.document.budget().take_memory(node.place(), "the vertices and triangles of its mesh", known->second.bytes);
    result.push_back({node, visible.index, &visible.world, mesh, skin});
  }
  return result;
}

}  // namespace

PlacedMeshes read_meshes(const GltfDocument& document, const GltfNodes& nodes, std::vector<SurfaceMaterial>& materials, Warnings& warnings,
                         KeptMeshes* kept) {
  if (kept != nullptr) kept->begin(document);
  const Context c{document, warnings, document.count("accessors")};
  const std::size_t given_materials = materials.size();
  std::unordered_map<int, UsableMesh> meshes;
  std::unordered_map<int, Skin> skins;
  PlacedMeshes result;
  for (const Placement& placement : take_placements(c, nodes, given_materials, meshes)) {
    const JsonCursor mesh_json = document.object("meshes", placement.mesh);
    const std::vector<double> weights = morph_weights(placement.node, mesh_json);
    for (const UsablePrimitive& primitive : meshes.at(placement.mesh).primitives) {
      const JsonCursor attributes = primitive.json.at("attributes");
      int material = primitive.material;
      if (material < 0) {
        if (materials.size() == given_materials) materials.push_back({});
        material = static_cast<int>(given_materials);
      }
      const SurfaceMaterial& m = materials[static_cast<std::size_t>(material)];
      const bool skinned = placement.skin >= 0 && attributes.has("JOINTS_0");
      const std::string name = mesh_json.text("name", placement.node.text("name", ""));
      KeptMeshes::Source source{*placement.world, weights, placement.mesh, material, tangent_set(m), name};
      result.nodes.push_back(placement.index);
      if (const Mesh* as_it_was = kept != nullptr && !skinned ? kept->find(placement.index, primitive.number, source) : nullptr) {
        result.meshes.push_back(*as_it_was);
        check_texture_sets(m, result.meshes.back(), warnings);
        ++kept->found;
        continue;
      }
      Mesh mesh = read_local(c, primitive.json, weights, primitive.mode);
      mesh.name = name;
      mesh.material = material;
      if (skinned) {
        auto skin = skins.find(placement.skin);
        if (skin == skins.end()) skin = skins.emplace(placement.skin, read_skin(document, nodes, placement.skin)).first;
        const std::vector<Affine> blended = blend_joints(document, skin->second, attributes, mesh.positions.size());
        to_world(mesh, placement.node, [&](std::size_t i) { return blended[i]; });
      } else {
        to_world(mesh, placement.node, [&](std::size_t) { return *placement.world; });
        if (placement.world->determinant() < 0) turn_triangles(mesh);
      }
      check_texture_sets(m, mesh, warnings);
      complete(mesh, m, warnings);
      if (kept != nullptr && !skinned) kept->keep(placement.index, primitive.number, std::move(source), mesh);
      result.meshes.push_back(std::move(mesh));
    }
  }
  return result;
}

std::vector<int> triangle_primitives(const GltfDocument& document, int mesh) {
  Warnings said;
  const Context c{document, said, document.count("accessors")};
  std::vector<int> numbers;
  for (const UsablePrimitive& primitive : usable_mesh(c, document.object("meshes", mesh), document.count("materials")).primitives)
    numbers.push_back(primitive.number);
  return numbers;
}

std::vector<std::uint32_t> read_corners(const GltfDocument& document, int mesh, int primitive) {
  Warnings said;
  const Context c{document, said, document.count("accessors")};
  const JsonCursor json = document.object("meshes", mesh).elements("primitives")[static_cast<std::size_t>(primitive)];
  const std::size_t vertices = checked_count(document, c.attribute(json.at("attributes"), "POSITION"));
  return read_indices(c, json, vertices, static_cast<int>(json.integer("mode", kTriangles, 0, 6)));
}

}  // namespace steradian::scene
