// What a hit on a mesh looks like to a light: position, normal, lobes. Scalar; one call a pixel.
#pragma once

#include "core/mip_maps.h"
#include "render/cpu/camera_rays.h"
#include "steradian/scene.h"

namespace steradian {

inline constexpr float kCoatF0 = 0.04f;  // KHR_materials_clearcoat: a coat of index 1.5

// The metallic-roughness surface at one point, textures looked up.
//
// A back face shows the front's frame with its normal reversed: bumps and directions of brushing stay where they are.
//
// Radiance = emission + diffuse + specular (+ sheen) (+ coat). The diffuse lobe has albedo base (1 - metallic) (1 - F), F the
// largest channel of the dielectric's Fresnel: what its specular lobe reflects does not reach it. All of it already weighs what the
// surface covers of its place (alpha mode blend); with lobes of its own (extras) a surface is opaque.
struct Surface {
  Vec3f position;
  Vec3f normal;            // shading normal, unit; the view is above its horizon, as it is above the triangle
  Vec3f geometric_normal;  // of the triangle, unit, turned to the viewer; the normal where it has no area
  Vec3f tangent;           // unit, perpendicular to the normal: direction of alpha_x
  Vec3f coat_normal;       // of the clear coat, which lies smooth over what bends the base
  Vec3f emission;          // radiance towards the viewer
  Vec3f albedo;            // diffuse, in the direction in which the boundary above reflects F0
  float fresnel_loss = 0;  // ... and less by this share of (1 - v.h)^5 in all others
  Vec3f f0, f90;           // specular; both 0: no such lobe
  float alpha_x = 1, alpha_y = 1;
  Vec3f sheen;  // colour of Charlie's lobe; black: none
  float sheen_alpha = 1;
  float coat = 0, coat_alpha = 1;  // clear coat: weight, width; F0 0.04
  Vec3f passes;                    // share of the light from behind that comes through: a blended or thin surface, seen from here
  const SurfaceMaterial* material = nullptr;
};

// Base colour with alpha, of a mesh's triangle at barycentric coordinates u, v (of the second and third vertex).
Vec4f base_color_at(const Scene& scene, const Mesh& mesh, unsigned triangle, float u, float v);

// The hit moved to the curved surface that the normals of the triangle's vertices describe, where that lies outside of the
// triangle: the mean of its feet on the planes through the vertices, by their weights. At a vertex, on a flat triangle and in a hollow it
// is the hit.
//
//   outside  the triangle's normal, turned to the viewer
//
// Source: Hanika, "Hacking the shadow terminator", Ray Tracing Gems II, 2021.
Vec3f smooth_position(const Mesh& mesh, unsigned triangle, float u, float v, Vec3f outside);

// What a pixel covers of a triangle: how the barycentric coordinates u, v change to the next pixels. Textures are means over it.
struct SurfaceFootprint {
  const MipMaps* maps = nullptr;  // null: textures at a point
  Vec2f right, down;
};

// Of the pixel whose ray of unit direction meets the triangle at that distance; nothing where the two are parallel.
SurfaceFootprint footprint_on(const MipMaps& maps, const Mesh& mesh, unsigned triangle, Vec3f direction, float distance,
                              const PixelSteps& steps);

// Of the light that a mesh is the shape of; null: it is none, or one of even radiance.
const LightEmission* emission_of(const Scene& scene, const Mesh& mesh);

// `view` points to the viewer, unit.
Surface surface_at(const Scene& scene, const Mesh& mesh, unsigned triangle, float u, float v, Vec3f view,
                   const SurfaceFootprint& footprint = {});

Material sheen_of(const Surface& surface);

// The lobes of a surface as the scalar integrators take them: diffuse, specular or its override, coat. Lobes of
// zero weight are left out.
struct SurfaceLobe {
  Material material;
  Vec3f normal;
  bool diffuse = false;
};
std::vector<SurfaceLobe> lobes_of(const Surface& surface);

}  // namespace steradian
