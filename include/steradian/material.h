// Material: one lobe of a surface, as `eval` and scenes describe it. A surface may carry several; results add.
#pragma once

#include <algorithm>
#include <vector>

#include "steradian/shading_point.h"
#include "steradian/vector.h"

namespace steradian {

struct ClassicTable;

// charlie: the sheen of glTF. lobe_product: two Phong lobes, one about the mirrored view, the other about `axis`, and any number more.
enum class Brdf { lambert, phong, ggx, blinn_phong, beckmann, charlie, lobe_product };

// Smallest width of a distribution of half vectors: below, float cannot distinguish it from a mirror.
inline constexpr double kSmallestAlpha = 1e-4;

// Width of a perceptual roughness: its square.
constexpr double alpha_from_roughness(double roughness) { return std::max(roughness * roughness, kSmallestAlpha); }

// A factor of a product: a power of the cosine to an axis.
struct AxisPower {
  Vec3d axis;  // unit
  double exponent = 1;

  bool operator==(const AxisPower&) const = default;
};

struct Material {
  Brdf brdf = Brdf::lambert;
  Vec3d albedo{1, 1, 1};    // lambert, phong, charlie, lobe_product
  double fresnel_loss = 0;  // lambert: under a dielectric, albedo times 1 - fresnel_loss (1 - v.h)^5
  double exponent = 1;      // phong, blinn_phong, lobe_product: n >= 0
  double alpha_x = 0.25;    // ggx, beckmann: widths along the tangent and across it, at least kSmallestAlpha; charlie: alpha_x
  double alpha_y = 0.25;
  Vec3d tangent{0, 0, 0};  // ggx, beckmann: direction of alpha_x, projected on the surface; zero: any
  Vec3d f0{1, 1, 1};       // ggx: Schlick's Fresnel; f0 = f90 = 1 is no Fresnel
  Vec3d f90{1, 1, 1};
  bool shadowing = true;             // ggx: height-correlated Smith
  bool foreshortening = false;       // phong: times the cosine of the light
  Vec3d axis{0, 0, 0};               // lobe_product: axis of its second lobe; zero: the normal
  double axis_exponent = 1;          // lobe_product: exponent of its second lobe, n >= 0
  std::vector<AxisPower> factors{};  // lobe_product: its third lobe and all further ones
  bool multiple_scattering = false;  // ggx: restores the light that is lost between the facets, see albedo.h
  // ggx, isotropic: a fitted table (fit.h) in the place of the lobe, for `reference`, `sampled` and `ltc`. Must outlive the material.
  const ClassicTable* fitted = nullptr;

  bool operator==(const Material&) const = default;
};

// The name in the command line, in JSON and in messages: "lambert", "blinn-phong", ...
const char* name_of(Brdf brdf);

// Properties of a lobe for the polygon that replaces a round light.
struct LobeAxis {
  Vec3d axis;        // unit, from the shading point: the mirrored view
  double width = 1;  // [rad]: 1/sqrt(n + 1) for Phong
};
LobeAxis lobe_axis(const Material& material, const ShadingPoint& at);

}  // namespace steradian
