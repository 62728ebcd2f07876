// Lobe: BRDF times the cosine of the light, for one view, as callables in double. What the fitter fits.
//
// Frame: z the surface normal, the view v = (sin, 0, cos) in the plane of x and z.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "integrals/ltc/ltc_shape.h"  // LobeFrame
#include "steradian/material.h"       // alpha_from_roughness
#include "steradian/vector.h"

namespace steradian::fit {

struct Lobe {
  Vec3d view;
  // BRDF without Fresnel times l_z for a unit l; 0 below the horizon.
  std::function<double(Vec3d l)> evaluate;
  // A direction for a point of the unit square [0, 1)^2. The map is smooth, its azimuth grows with b, and
  // sample(a, 1 - b) is sample(a, b) mirrored in y where the lobe is symmetric. May point below the horizon.
  std::function<Vec3d(double a, double b)> sample;
  // Density of sample per solid angle, wherever sample may point, below the horizon included.
  std::function<double(Vec3d l)> pdf;
};

// The lobes of one reflection model over perceptual roughness in [0, 1] and the view's cosine.
struct LobeFamily {
  std::string name;
  LobeFrame frame = LobeFrame::mirror;
  std::function<Lobe(double roughness, double cos_theta)> at;
};

Lobe ggx_lobe(double alpha, Vec3d view);
Lobe ggx_lobe_anisotropic(double alpha_x, double alpha_y, Vec3d view);
Lobe beckmann_lobe(double alpha, Vec3d view);
Lobe charlie_lobe(double alpha, Vec3d view);             // sheen of glTF: Estevez, Kulla 2017, its own shadowing
Lobe disney_diffuse_lobe(double roughness, Vec3d view);  // Burley 2012, albedo 1
Lobe oren_nayar_lobe(double sigma, Vec3d view);          // full model of 1994 with one bounce, albedo 1; sigma [rad]

// The same lobe times (1 - v.h)^5: what F90 - F0 multiplies in Schlick's Fresnel.
Lobe with_grazing_fresnel(const Lobe& lobe);

// ggx, beckmann, charlie, disney-diffuse, oren-nayar. Oren-Nayar's sigma is roughness times pi/2.
const std::vector<LobeFamily>& lobe_families();
// Throws Error with the known names.
const LobeFamily& lobe_family(const std::string& name);

}  // namespace steradian::fit
