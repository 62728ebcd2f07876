// GGX under polygon lights by linearly transformed cosines: a table look-up and a closed form. Approximate and fast.
#pragma once

#include "steradian/material.h"
#include "steradian/polygon_light.h"
#include "steradian/shading_point.h"

namespace steradian {

// classic      two 64 x 64 tables, as engines sample them                                          "ltc"
// fresnel      classic, and two tables more for the lobe times (1 - v.h)^5: a second walk, for dielectrics   "ltc", quality high
// compact      3984 bytes of plain arrays, the matrix about the mirror direction                   "ltc-compact"
// clipless     for comparison: classic, a sphere's form factor in place of clipping                "ltc-clipless"
// representative_point   for comparison: Karis 2013, no table at all                               "representative-point"
enum class LtcMethod { classic, fresnel, compact, clipless, representative_point };

// True if a method serves a material: isotropic GGX with shadowing.
bool serves(LtcMethod method, const Material& material);

// Radiance towards the view from a light of its radiance, with Fresnel by the split into n_A and f_A (except fresnel). 0 for a view below
// the surface, exactly 0 for a light entirely below the horizon (except clipless), 0 from behind. Precondition: serves(method, material).
// Error against GGX: docs/theory/ltc.md.
Vec3d ltc_radiance(LtcMethod method, const PreparedPolygon& light, const ShadingPoint& at, const Material& material);
// The same with arithmetic in float.
Vec3d ltc_radiance_float(LtcMethod method, const PreparedPolygon& light, const ShadingPoint& at, const Material& material);

// The GGX tables that the library ships: raw values, for textures and for shaders.
struct LtcTableView {
  int classic_size;
  const float* matrix;     // classic_size^2 RGBA: M^-1 over its middle element, as in docs/theory/ltc.md
  const float* magnitude;  // classic_size^2 RGBA: n_A, f_A, 0, form factor of a clipped sphere
  int shape_size;
  const float* shapes;  // shape_size^2 times 4: the arguments of ltc_from_compact
  int magnitude_size;
  const float* magnitudes;  // magnitude_size^2 times 2: n_A, f_A
  // Textures of the lobe times (1 - v.h)^5, like the classic ones: their n_A is the factor of F90 - F0.
  const float* fresnel_matrix;
  const float* fresnel_magnitude;
};
LtcTableView ltc_ggx_tables();

}  // namespace steradian
