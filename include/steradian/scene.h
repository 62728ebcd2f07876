// Scene: everything that a renderer needs of a 3D scene, flat and in world space. Read from glTF by load_scene.h.
//
// Right-handed, y up, metres. Indices are valid, coordinates finite, normals unit: the code that fills a Scene checks this.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "steradian/area_light.h"
#include "steradian/environment.h"
#include "steradian/light_profile.h"
#include "steradian/material.h"
#include "steradian/texture.h"
#include "steradian/vector.h"

namespace steradian {

enum class AlphaMode { opaque, mask, blend };

// A glTF metallic-roughness material. A factor times its texture (if it has one) is the value; colours are linear.
struct SurfaceMaterial {
  std::string name;

  Vec4f base_color{1, 1, 1, 1};
  TextureUse base_color_texture;  // sRGB, alpha linear
  float metallic = 1;
  float roughness = 1;                    // perceptual: alpha is its square
  TextureUse metallic_roughness_texture;  // roughness in g, metallic in b
  TextureUse normal_texture;              // tangent space; its `scale` multiplies x and y
  TextureUse occlusion_texture;           // r; read, but not part of direct light
  Vec3f emissive{0, 0, 0};                // radiance, emissive strength included
  TextureUse emissive_texture;            // sRGB

  float clearcoat = 0;
  TextureUse clearcoat_texture;  // r
  float clearcoat_roughness = 0;
  TextureUse clearcoat_roughness_texture;  // g
  TextureUse clearcoat_normal_texture;

  Vec3f sheen_color{0, 0, 0};      // for Charlie's lobe over all but the coat; black: none
  TextureUse sheen_color_texture;  // sRGB
  float sheen_roughness = 0;
  TextureUse sheen_roughness_texture;  // a

  float ior = 1.5f;                   // F0 of a dielectric is ((ior - 1) / (ior + 1))^2
  float specular = 1;                 // scales a dielectric's F0 and F90
  TextureUse specular_texture;        // a
  Vec3f specular_color{1, 1, 1};      // colours a dielectric's F0, which is then clamped to 1
  TextureUse specular_color_texture;  // sRGB

  float anisotropy = 0;           // strength
  float anisotropy_rotation = 0;  // radians, counter-clockwise from the tangent
  TextureUse anisotropy_texture;  // direction in rg (2x - 1), strength in b

  float transmission = 0;            // fraction of the diffuse lobe that passes a thin wall instead, in the base colour
  TextureUse transmission_texture;   // r
  bool solid = false;                // of what transmits: its mesh bounds a solid that bends light; false: a thin wall
  Vec3f attenuation_color{1, 1, 1};  // of a solid: fraction of light that is left after attenuation_distance
  float attenuation_distance = std::numeric_limits<float>::infinity();

  AlphaMode alpha_mode = AlphaMode::opaque;  // blend: covers the background by base_color's alpha
  float alpha_cutoff = 0.5f;                 // for AlphaMode::mask
  bool double_sided = false;
  bool unlit = false;  // shows base_color, takes no light

  // extras.steradian: these lobes replace the specular lobe; empty if the file has none. The diffuse lobe stays.
  std::vector<Material> specular_override;

  bool emits() const { return emissive.x > 0 || emissive.y > 0 || emissive.z > 0; }

  bool operator==(const SurfaceMaterial&) const = default;
};

// Triangles of one material, in world space, counter-clockwise as seen from their front.
//
// A mesh whose material emits is visible to the camera with `emissive` as its radiance. Its light is already in Scene::area_lights:
// `triangle_lights` gives the light of each triangle, so that none is counted twice. The rect, disk and sphere lights of a file become such
// meshes too (`is_light_shape`, black apart from the emission).
struct Mesh {
  std::string name;
  int material = 0;  // into Scene::materials; always valid
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;                 // as many as positions
  std::vector<Vec4f> tangents;                // as many, or none; w = +-1: bitangent = w cross(normal, tangent)
  std::vector<Vec2f> texcoords[2];            // set 0 and 1: as many, or none
  std::vector<Vec4f> colors;                  // linear, multiply base_color: as many, or none
  std::vector<std::uint32_t> indices;         // three a triangle
  std::vector<std::int32_t> triangle_lights;  // emitters: into Scene::area_lights, -1 dropped; others: none
  bool is_light_shape = false;
  bool casts_shadow = true;  // false: light comes straight through it to other surfaces; a clear material tints it

  std::size_t triangle_count() const { return indices.size() / 3; }
  bool is_emitter() const { return !triangle_lights.empty(); }

  bool operator==(const Mesh&) const = default;
};

enum class PunctualKind { point, spot, directional };

struct PunctualLight {
  std::string name;
  PunctualKind kind = PunctualKind::point;
  Vec3d position;
  Vec3d direction{0, 0, -1};  // unit, along which spot and directional lights shine
  Vec3d intensity{1, 1, 1};   // colour times candela (point, spot) or lux (directional)
  double range = std::numeric_limits<double>::infinity();
  double cos_inner = 1;  // spot: full inside, none outside, glTF's square falloff between
  double cos_outer = 0.70710678118654752;
  std::shared_ptr<const LightProfile> profile{};  // for a point: candela by direction, which `intensity` multiplies; null: 1 everywhere
  ProfileAxes profile_axes{};
  int node = -1;  // of the file that places the light; -1: none

  bool operator==(const PunctualLight&) const = default;
};

// A perspective camera. x points right, y up, z against the view; they are orthonormal.
struct Camera {
  std::string name;
  Vec3d position;
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  double yfov = 0.785398163397448;  // vertical field of view in radians; the aspect is the picture's
};

struct Scene {
  std::vector<Mesh> meshes;
  std::vector<SurfaceMaterial> materials;
  std::vector<Image> images;  // targets of TextureUse::image
  std::vector<AreaLight> area_lights;
  std::vector<PunctualLight> punctual_lights;
  std::vector<Camera> cameras;                     // at least one after load_scene; the first is the default
  Vec3d bounds_min, bounds_max;                    // of all meshes; both zero without meshes
  std::shared_ptr<const Environment> environment;  // null: no environment
  bool multiple_scattering = false;                // for the GGX lobes of metallic-roughness surfaces, see albedo.h

  std::size_t triangle_count() const {
    std::size_t n = 0;
    for (const Mesh& m : meshes) n += m.triangle_count();
    return n;
  }
  // True if all but the cameras is the same, so that surfaces are lit the same.
  bool is_lit_like(const Scene& other) const {
    return meshes == other.meshes && materials == other.materials && images == other.images && area_lights == other.area_lights &&
           punctual_lights == other.punctual_lights && environment == other.environment && multiple_scattering == other.multiple_scattering;
  }
};

}  // namespace steradian
