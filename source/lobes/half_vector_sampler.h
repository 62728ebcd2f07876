// Sampling of half vectors with the density of a microfacet distribution, in the shading frame, and of their reflections.
#pragma once

#include "steradian/vector.h"

namespace steradian::lobes {

// Density D(h) h_z over the hemisphere, u, v in [0, 1).
Vec3d sample_blinn_phong_half_vector(double n, double u, double v);
double pdf_blinn_phong_half_vector(double n, Vec3d h);
Vec3d sample_beckmann_half_vector(double ax, double ay, double u, double v);
double pdf_beckmann_half_vector(double ax, double ay, Vec3d h);

// Normals of a GGX surface that are visible from the view: density G1(v) D(h) max(v.h, 0) / v_z. The view is above the surface.
// Source: Dupuy, Benyoub, "Sampling visible GGX normals with spherical caps", 2023, listing 3.
Vec3d sample_ggx_visible_normal(Vec3d view, double ax, double ay, double u, double v);
double pdf_ggx_visible_normal(Vec3d view, double ax, double ay, Vec3d h);

// The view mirrored at h; the zero vector if h looks away from the view.
Vec3d sample_reflection(Vec3d view, Vec3d h);
// Density of the reflection per solid angle: that of h over 4 v.h.
double pdf_reflection(Vec3d view, Vec3d h, double half_vector_pdf);

}  // namespace steradian::lobes
