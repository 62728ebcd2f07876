#include "device/surface/scene_buffers.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <vector>

#include "integrals/tables/ggx_tables.h"
#include "render/surface/surface_pack.h"
#include "scene/emitters/emitters.h"

namespace steradian::vulkan {
namespace {

#include "shaders/surface/surface_layout.glsl"

using Vec4Floats = std::array<float, 4>;

constexpr std::size_t kMostNumbers = std::size_t{1} << 24;  // largest count that a float holds
constexpr int kLongestSide = 1 << 20;                       // texture side: positions along longer ones are no whole numbers in float

static_assert(kMaterial == kMaterialTextures + kUses * kUse);

std::array<const TextureUse*, kUses> uses_of(const SurfaceMaterial& m) {
  return {&m.base_color_texture, &m.metallic_roughness_texture,  &m.normal_texture,           &m.emissive_texture,
          &m.specular_texture,   &m.specular_color_texture,      &m.sheen_color_texture,      &m.sheen_roughness_texture,
          &m.clearcoat_texture,  &m.clearcoat_roughness_texture, &m.clearcoat_normal_texture, &m.anisotropy_texture};
}

const SurfaceMaterial& material_of(const Scene& scene, const Mesh& mesh) {
  return scene.materials[static_cast<std::size_t>(mesh.material)];
}

// Upper bound of the number of texels of a picture and its pyramid.
std::size_t texels_of_pyramid(const Image& image) {
  const auto texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  return texels + texels / 2 + 64;
}

// Levels of the pictures that are used.
class Levels {
 public:
  explicit Levels(const MipMaps& maps) : maps_(maps) {}

  // Number of the first level of a use.
  std::size_t first(const TextureUse& use) {
    const auto [at, is_new] = firsts_.try_emplace({use.image, use.color_space}, all_.size());
    if (is_new) {
      pyramids_.push_back(maps_.pyramid(use));
      all_.insert(all_.end(), maps_.levels(use).begin(), maps_.levels(use).end());
    }
    return at->second;
  }

  // One vector per level: position of its first texel among all texels, and its size.
  std::vector<Vec4Floats> records() const {
    std::vector<Vec4Floats> to;
    std::size_t texel = 0;
    for (const Image* level : all_) {
      to.push_back({static_cast<float>(texel / kTexelRow), static_cast<float>(texel % kTexelRow), static_cast<float>(level->width),
                    static_cast<float>(level->height)});
      texel += level->rgba.size() / 4;
    }
    return to;
  }
  std::vector<std::uint8_t> texels() const {
    std::vector<std::uint8_t> to;
    for (const Image* level : all_) to.insert(to.end(), level->rgba.begin(), level->rgba.end());
    return to;
  }
  const std::vector<std::shared_ptr<MipMaps::Pyramid>>& pyramids() const { return pyramids_; }

 private:
  const MipMaps& maps_;
  std::vector<const Image*> all_;
  std::vector<std::shared_ptr<MipMaps::Pyramid>> pyramids_;  // pyramids of these levels
  std::map<std::pair<int, ColorSpace>, std::size_t> firsts_;
};

void add_use(const TextureUse& use, const MipMaps& maps, std::size_t first, std::vector<Vec4Floats>& to) {
  if (!use.present()) {
    to.insert(to.end(), {Vec4Floats{-1, 0, 0, 0}, Vec4Floats{}, Vec4Floats{}});
    return;
  }
  const int flags = static_cast<int>(use.wrap_u) + 4 * static_cast<int>(use.wrap_v) + (use.filter == Filter::nearest ? kNearest : 0) +
                    (use.color_space == ColorSpace::srgb ? kSrgb : 0);
  to.push_back({static_cast<float>(first), static_cast<float>(maps.levels(use).size()), static_cast<float>(flags),
                static_cast<float>(use.texcoord)});
  to.push_back({use.uv[0], use.uv[1], use.uv[2], use.uv[3]});
  to.push_back({use.uv[4], use.uv[5], use.scale, 0});
}

// Adds the factors that surface_at uses.
void add_factors(const Scene& scene, const SurfaceMaterial& m, std::vector<Vec4Floats>& to) {
  const float r = (m.ior - 1) / (m.ior + 1);
  to.push_back({m.base_color.x, m.base_color.y, m.base_color.z, m.base_color.w});
  to.push_back({m.emissive.x, m.emissive.y, m.emissive.z, m.double_sided ? 1.0f : 0.0f});
  to.push_back({m.specular_color.x, m.specular_color.y, m.specular_color.z, m.specular});
  to.push_back({m.metallic, m.roughness, r * r, static_cast<float>((m.unlit ? kUnlit : 0) + (scene.multiple_scattering ? kScatters : 0))});
  to.push_back({m.sheen_color.x, m.sheen_color.y, m.sheen_color.z, m.sheen_roughness});
  to.push_back({m.clearcoat, m.clearcoat_roughness, m.anisotropy, m.anisotropy_rotation});
}

// For each vertex, the distance by which its triangles are lifted off the lights whose faces they are.
std::vector<float> lifts_of(const Scene& scene, const Mesh& mesh) {
  std::vector<float> lifts(mesh.positions.size(), 0.0f);
  for (std::size_t t = 0; t < mesh.triangle_lights.size(); ++t) {
    if (mesh.triangle_lights[t] < 0) continue;
    const float lift = scene::roundings_of_plane(scene.area_lights[static_cast<std::size_t>(mesh.triangle_lights[t])]);
    for (std::size_t c = 3 * t; c < 3 * t + 3; ++c) lifts[mesh.indices[c]] = std::max(lifts[mesh.indices[c]], lift);
  }
  return lifts;
}

void add_vertices(const Scene& scene, const Mesh& mesh, std::vector<Vec4Floats>& to) {
  const std::vector<float> lifts = lifts_of(scene, mesh);
  const auto two = [](const std::vector<Vec2f>& set, std::size_t i) { return set.empty() ? Vec2f{} : set[i]; };
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3f &p = mesh.positions[i], &n = mesh.normals[i];
    const Vec4f t = mesh.tangents.empty() ? Vec4f{} : mesh.tangents[i], c = mesh.colors.empty() ? Vec4f{} : mesh.colors[i];
    const Vec2f a = two(mesh.texcoords[0], i), b = two(mesh.texcoords[1], i);
    to.insert(to.end(), {Vec4Floats{p.x, p.y, p.z, lifts[i]}, Vec4Floats{n.x, n.y, n.z, 0}, Vec4Floats{t.x, t.y, t.z, t.w},
                         Vec4Floats{a.x, a.y, b.x, b.y}, Vec4Floats{c.x, c.y, c.z, c.w}});
  }
}

int longer_side(const Image& image) { return std::max(image.width, image.height); }

// Reason why the shaders do not find a mesh's surfaces; empty: they do.
std::string why_for_host(const Scene& scene, const Mesh& mesh) {
  const SurfaceMaterial& m = material_of(scene, mesh);
  if (emission_of(scene, mesh) != nullptr) return "which does not shine alike in all directions";
  if (m.anisotropy > 0 && scene.multiple_scattering) return "whose lobe is brushed and scatters between its facets";
  if (m.alpha_mode != AlphaMode::opaque || m.transmission > 0) return "through which something shows";
  if (!m.specular_override.empty()) return "which has lobes of its own";
  for (const TextureUse* use : uses_of(m))
    if (use->present() && longer_side(scene.images[static_cast<std::size_t>(use->image)]) > kLongestSide)
      return "whose texture has more texels in a row than floats tell places between";
  return {};
}

bool shows_layers(const Scene& scene, const Mesh& mesh) {
  return kind_of(scene, mesh) == SurfaceKind::layered && why_for_host(scene, mesh).empty();
}

// Tables of the fractions of light that lobes reflect.
std::vector<Vec4Floats> tables_of_albedo() {
  const CompactTable &ggx = ggx_compact_table(), &charlie = charlie_compact_table();
  std::vector<Vec4Floats> to = {{static_cast<float>(ggx.shape_size), static_cast<float>(ggx.magnitude_size),
                                 static_cast<float>(charlie.shape_size), static_cast<float>(charlie.magnitude_size)}};
  for (const CompactTable* table : {&ggx, &charlie}) {
    to.insert(to.end(), table->shapes.begin(), table->shapes.end());
    for (const auto& [n_a, f_a] : table->magnitudes) to.push_back({n_a, f_a, 0, 0});
  }
  return to;
}

// Contents of the buffers.
struct Contents {
  std::vector<Vec4Floats> vertices, triangles, materials;
  Levels pictures;

  Contents(const Scene& scene, const MipMaps& maps) : pictures(maps) {
    // The order is: codes, the meshes' own vectors, materials, levels of their textures.
    const std::size_t first_material = kCodes + scene.meshes.size(), first_level = first_material + scene.materials.size() * kMaterial;
    for (std::size_t i = 0; i < 4 * kCodes; i += 4) {
      const auto code = [&](std::size_t k) { return linear_from_srgb8(static_cast<std::uint8_t>(i + k)); };
      materials.push_back({code(0), code(1), code(2), code(3)});
    }
    std::vector<Vec4Floats> records;
    for (const SurfaceMaterial& m : scene.materials) {
      add_factors(scene, m, records);
      for (const TextureUse* use : uses_of(m)) add_use(*use, maps, use->present() ? first_level + pictures.first(*use) : 0, records);
    }
    for (const Mesh& mesh : scene.meshes) {
      const auto number = static_cast<float>(materials.size()), first = static_cast<float>(vertices.size() / kVertex);
      materials.push_back({static_cast<float>(first_material + static_cast<std::size_t>(mesh.material) * kMaterial),
                           mesh.tangents.empty() ? 0.0f : 1.0f, mesh.colors.empty() ? 0.0f : 1.0f,
                           (mesh.texcoords[0].empty() ? 0.0f : 1.0f) + (mesh.texcoords[1].empty() ? 0.0f : 2.0f) +
                               (why_for_host(scene, mesh).empty() ? 0.0f : static_cast<float>(kForHost))});
      add_vertices(scene, mesh, vertices);
      for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        triangles.push_back({first + static_cast<float>(mesh.indices[i]), first + static_cast<float>(mesh.indices[i + 1]),
                             first + static_cast<float>(mesh.indices[i + 2]), number});
    }
    materials.insert(materials.end(), records.begin(), records.end());
    const std::vector<Vec4Floats> levels = pictures.records();
    materials.insert(materials.end(), levels.begin(), levels.end());
  }
};

}  // namespace

std::string what_keeps_on_host(const Scene& scene, const DeviceInfo& device) {
  if (!device.graphics) return "the device draws no triangles";
  std::size_t vertices = 0, triangles = 0, texels = 0;
  for (const Mesh& mesh : scene.meshes) {
    vertices += mesh.positions.size();
    triangles += mesh.triangle_count();
  }
  for (const Image& image : scene.images) texels += 2 * texels_of_pyramid(image);
  const std::size_t most = std::min(device.texel_buffer, kGuaranteedBuffer / sizeof(Vec4Floats));
  if (vertices * kVertex > most || std::max(vertices, triangles) >= kMostNumbers || triangles > most)
    return "more triangles than a buffer has room for";
  if (texels > std::min(device.texel_buffer, kGuaranteedBuffer / 4)) return "more texels than a buffer has room for";
  return {};
}

std::vector<std::string> materials_for_host(const Scene& scene) {
  std::vector<std::string> said;
  for (const Mesh& mesh : scene.meshes) {
    const std::string why = why_for_host(scene, mesh);
    if (mesh.indices.empty() || why.empty()) continue;
    std::string sentence = "the CPU finds the surfaces of tiles with the material '" + material_of(scene, mesh).name + "', " + why;
    if (std::find(said.begin(), said.end(), sentence) == said.end()) said.push_back(std::move(sentence));
  }
  return said;
}

SceneBuffers::SceneBuffers(const Device& d)
    : vertices_(d, BufferUse::host_writes, BufferForm::texels),
      triangles_(d, BufferUse::host_writes, BufferForm::texels),
      materials_(d, BufferUse::host_writes, BufferForm::texels),
      texels_(d, BufferUse::host_writes, BufferForm::colors),
      tables_(d, BufferUse::host_writes, BufferForm::texels) {
  tables_.hold(tables_of_albedo());
}

void SceneBuffers::follow(const Scene& scene, const MipMaps& maps) {
  const Contents c(scene, maps);
  triangle_count_ = c.triangles.size();
  has_layers_ = std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) { return shows_layers(scene, mesh); });
  vertices_.hold(c.vertices);
  triangles_.hold(c.triangles);
  materials_.hold(c.materials);
  if (texels_.is_made() && pyramids_ == c.pictures.pyramids()) return;
  pyramids_.clear();
  texels_.hold(c.pictures.texels());
  pyramids_ = c.pictures.pyramids();
}

}  // namespace steradian::vulkan
