// Polygon lights on microfacet lobes by edge splitting in half vector space: Blinn-Phong, Beckmann, and GGX for
// comparison with closed_form.h. docs/theory/ggx.md derives it.
#pragma once

#include "steradian/material.h"
#include "steradian/polygon_light.h"
#include "steradian/shading_point.h"

namespace steradian {

enum class ArcSplit {
  uniform,      // equal angles on the light
  pole_mapped,  // dense where the edge passes the lobe
};

struct HalfVectorOptions {
  int arcs = 4;  // per edge, at least 1
  ArcSplit split = ArcSplit::pole_mapped;
};

// Radiance towards the view of a blinn_phong, beckmann (isotropic or anisotropic) or ggx surface. GGX takes shadowing and
// Fresnel as the closed form does, the others have none. 0 for a view below the surface, a light seen from behind (unless
// two-sided) and a light without area. Error: docs/measured/accuracy.md, "half vector". Throws Error for other lobes and for arcs < 1.
Vec3d half_vector_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                           const HalfVectorOptions& options = {});
// In float, Blinn-Phong uses the cosine series instead of quadrature.
Vec3d half_vector_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                                 const HalfVectorOptions& options = {});

}  // namespace steradian
