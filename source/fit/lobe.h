// The lobes that the fitter knows. steradian/fit.h defines lobes.
#pragma once

#include <string>
#include <vector>

#include "integrals/ggx/ltc_radiance.h"  // view_from_cosine
#include "steradian/fit.h"
#include "steradian/material.h"  // alpha_from_roughness
#include "steradian/vector.h"

namespace steradian::fit {

using Lobe = LobeFunction;

Lobe ggx_lobe(double alpha, Vec3d view);
Lobe ggx_lobe_anisotropic(double alpha_x, double alpha_y, Vec3d view);
Lobe beckmann_lobe(double alpha, Vec3d view);
Lobe charlie_lobe(double alpha, Vec3d view);             // sheen of glTF: Estevez, Kulla 2017, its own shadowing
Lobe disney_diffuse_lobe(double roughness, Vec3d view);  // Burley 2012, albedo 1
Lobe oren_nayar_lobe(double sigma, Vec3d view);          // full model of 1994 with one bounce, albedo 1; sigma [rad]

// The same lobe times (1 - v.h)^5: the factor of F90 - F0 in Schlick's Fresnel.
Lobe with_grazing_fresnel(const Lobe& lobe);

// ggx, beckmann, charlie, disney-diffuse, oren-nayar. Oren-Nayar's sigma is roughness times pi/2.
const std::vector<LobeFamily>& lobe_families();
// Finds a family by name. Throws Error with the known names.
const LobeFamily& lobe_family(const std::string& name);

// Returns the lobe, with default samples if it has none.
Lobe with_samples(Lobe lobe);

}  // namespace steradian::fit
