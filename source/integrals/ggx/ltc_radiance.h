// The fitted lobe: its four degrees of freedom, its matrix, its density.
#pragma once

#include "steradian/fit.h"  // LobeFrame
#include "steradian/ltc.h"
#include "steradian/vector.h"

namespace steradian {

// The view (sin, 0, cos) with that cosine.
Vec3d view_from_cosine(double cos_theta);

// Four degrees of freedom: entries (0,0), (1,1), (0,2), (2,0) of R^T M over alpha, entry (2,2) being 1.
// About the mirror direction: R turns z into it. About the normal: R and alpha are 1. See ltc_from_compact.
struct LtcShape {
  double e00 = 1, e11 = 1, e02 = 0, e20 = 0;
  bool operator==(const LtcShape&) const = default;
};

// M^-1 up to a factor: rows (xx, 0, xz), (0, yy, 0), (zx, 0, zz).
struct LtcInverse {
  double xx = 1, xz = 0, yy = 1, zx = 0, zz = 1;
};

LtcInverse ltc_inverse(const LtcShape& shape, LobeFrame frame, double alpha, Vec3d view);

// Density per solid angle at a unit direction.
double ltc_evaluate(const LtcInverse& inverse, Vec3d l);

// The fraction of the lobe above the real horizon.
double ltc_above_horizon(const LtcInverse& inverse);

struct ClassicTable;

// The method's lobe towards a unit direction, with Fresnel: what it puts in the place of BRDF times cosine, per unit of illuminance across
// that direction. A light without extent sends this; a small one sends it times its solid angle. 0 below the surface and for a view below
// it.
//
//   fitted   for classic: the table of another lobe in the place of GGX's; null: GGX's
Vec3d ltc_towards(LtcMethod method, Vec3d direction, const ShadingPoint& at, const Material& material,
                  const ClassicTable* fitted = nullptr);
// The same with arithmetic in float.
Vec3d ltc_towards_float(LtcMethod method, Vec3d direction, const ShadingPoint& at, const Material& material,
                        const ClassicTable* fitted = nullptr);

}  // namespace steradian
