// The surface at a hit on a mesh: position, normal and lobes. Scalar code; one call a pixel.
#pragma once

#include "core/mip_maps.h"
#include "render/surface/camera_rays.h"
#include "steradian/scene.h"

namespace steradian {

inline constexpr float kCoatF0 = 0.04f;  // KHR_materials_clearcoat: a coat of index 1.5

// The metallic-roughness surface at one point, with its textures looked up.
//
// kernels/surface/surface.glsl computes its frame and its lobes. All terms are already weighted by the surface's coverage of its place
// (alpha mode blend). A surface with custom lobes (extras) is opaque.
struct Surface {
  Vec3f position;
  Vec3f normal;            // shading normal, unit; the view is above its horizon, as it is above the triangle
  Vec3f geometric_normal;  // triangle's normal, unit, turned to the viewer; the shading normal if the triangle has no area
  Vec3f tangent;           // unit, perpendicular to the normal: direction of alpha_x
  Vec3f coat_normal;       // normal of the clear coat, which lies smooth over the bumps of the base
  Vec3f emission;          // radiance towards the viewer
  Vec3f albedo;            // diffuse albedo in the direction in which the boundary above reflects F0
  float fresnel_loss = 0;  // decrease of the albedo in other directions: this fraction of (1 - v.h)^5
  Vec3f f0, f90;           // specular; both are 0 without such a lobe
  float alpha_x = 1, alpha_y = 1;
  Vec3f sheen;  // colour of Charlie's lobe; black: no sheen
  float sheen_alpha = 1;
  float coat = 0, coat_alpha = 1;  // clear coat: weight and width; its F0 is 0.04
  Vec3f passes;                    // fraction of the light from behind that comes through a blended or thin surface, as seen from here
  const SurfaceMaterial* material = nullptr;
};

// Base colour with alpha at barycentric coordinates u, v (weights of the second and third vertex) of a mesh's triangle.
Vec4f base_color_at(const Scene& scene, const Mesh& mesh, unsigned triangle, float u, float v);

// Moves a hit away from the edges of its triangle, to `distance` from each or, in a smaller triangle, towards the middle. Within roundings
// of a wall that stands on the edge, it would be inside the wall and see nothing.
void keep_within(const Mesh& mesh, unsigned triangle, float distance, float& u, float& v);

// Moves a hit to the curved surface that the normals of the triangle's vertices describe, if that lies outside the triangle (surface_lift).
//
//   outside  the triangle's normal, turned to the viewer
Vec3f smooth_position(const Mesh& mesh, unsigned triangle, float u, float v, Vec3f outside);

// Footprint of a pixel on a triangle: the changes of the barycentric coordinates u, v to the next pixels. Textures are means over it.
struct SurfaceFootprint {
  const MipMaps* maps = nullptr;  // null: textures at a point
  Vec2f right, down;
};

// Footprint of the pixel whose unit ray meets the triangle at that distance; empty if ray and triangle are parallel.
SurfaceFootprint footprint_on(const MipMaps& maps, const Mesh& mesh, unsigned triangle, Vec3f direction, float distance,
                              const PixelSteps& steps);

// Emission of the light whose shape is this mesh; null if there is none, or if the light has one radiance.
const LightEmission* emission_of(const Scene& scene, const Mesh& mesh);

// `view` points to the viewer and is a unit vector.
Surface surface_at(const Scene& scene, const Mesh& mesh, unsigned triangle, float u, float v, Vec3f view,
                   const SurfaceFootprint& footprint = {});

Material sheen_of(const Surface& surface);

// Fraction that a solid leaves of light after a distance.
Vec3f left_after(const SurfaceMaterial& m, float distance);

// True if light between surfaces goes straight through a mesh: most of it passes, and none is sent.
inline bool light_passes(const Scene& scene, const Mesh& mesh) {
  return !mesh.casts_shadow && !scene.materials[static_cast<std::size_t>(mesh.material)].emits();
}

// The lobes of a surface in the form that scalar integrators take: diffuse, specular or its override, coat. Skips lobes of zero weight.
// fitted: a table in the place of GGX; null: GGX.
struct SurfaceLobe {
  Material material;
  Vec3f normal;
  bool diffuse = false;
};
std::vector<SurfaceLobe> lobes_of(const Surface& surface, const ClassicTable* fitted = nullptr);

}  // namespace steradian
