// Polygon lights on microfacet surfaces without sampling: GGX in closed form. docs/theory/ggx.md derives it.
#pragma once

#include "steradian/material.h"
#include "steradian/method.h"  // Quality
#include "steradian/polygon_light.h"
#include "steradian/shading_point.h"

namespace steradian {

// Radiance towards the view of a GGX surface (Brdf::ggx, isotropic or anisotropic, with or without shadowing).
// 0 for a view below the surface, a light seen from behind (unless two-sided) and a light without area.
// Error: docs/measured/accuracy.md, "GGX with shadowing and Fresnel". Throws Error for another lobe.
Vec3d closed_form_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                           Quality quality = Quality::normal);
Vec3d closed_form_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                                 Quality quality = Quality::normal);

// The same without any approximation, for GGX without shadowing and with constant Fresnel (f0 = f90).
// Error: 1e-12 of the full lobe. Throws Error for another material.
Vec3d exact_ggx_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material);
Vec3d exact_ggx_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& material);

}  // namespace steradian
