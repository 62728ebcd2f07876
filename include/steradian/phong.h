// Phong lobes under polygon lights: the axial moment by every method, in double and in float.
//
//   const PreparedPolygon light = prepare_polygon({vertices});
//   Material material{.brdf = Brdf::phong, .exponent = 100};
//   Vec3d radiance = phong_radiance(light, at, material, {.method = Method::series});
//
// Radiance = albedo (n + 1)/(2 pi) integral over the light of max(u.r, 0)^n, where r is the mirrored view. There is no foreshortening
// unless the material asks for it. Then the integrand is max(u.r, 0)^n max(u.normal, 0), by exact, arvo and series.
// Derivation, errors and speed of the methods: docs/theory/moments.md.
#pragma once

#include "steradian/material.h"
#include "steradian/method.h"
#include "steradian/polygon_light.h"
#include "steradian/shading_point.h"

namespace steradian {

// method: exact (boundary integral by quadrature: 1e-10 of the full lobe in double, any n >= 0), arvo (Arvo's recurrence,
// O(n): exact, integer n), lorentzian, pearson, ellipsoid (the published peak fits, errors of 1e-2, for comparison), series
// (the matched ellipsoid's cosine series, O(1): 1e-3 of the full lobe at worst, 2e-4 on the average).
// quality: of series.
struct PhongOptions {
  Method method = Method::series;
  Quality quality = Quality::normal;
  double relative_precision = 0;   // for arvo: an edge's sum stops when the rest is below this; 0 sums everything
  PeakForm form = PeakForm::best;  // for lorentzian, pearson and ellipsoid
};

// Radiance towards the view; 0 for a view below the surface, from behind a one-sided light, and in its plane. Throws Error for a negative
// exponent, for a method of other lobes, and for arvo with an exponent that is not an integer.
Vec3d phong_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material, const PhongOptions& options = {});

// The same in single precision. exact is the fixed quadrature of kernels/integral/moment_quadrature.glsl, with 14 nodes.
Vec3f phong_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                           const PhongOptions& options = {});

// Integral of max(u.axis, 0)^n over the part of a light above the horizon of `normal`, to 1e-10 of 2 pi/(n + 1).
//
//   axis     unit, not below the horizon
//   n        real, at least 0
double axial_moment(const PreparedPolygon& light, Vec3d position, Vec3d normal, Vec3d axis, double n);

// Integral of max(u.axis, 0)^n (u.other) over the same part, exact as above: foreshortening (other = normal) without
// approximation. `other` may have any length; n >= 0.
double double_axis_moment(const PreparedPolygon& light, Vec3d position, Vec3d normal, Vec3d axis, Vec3d other, double n);

}  // namespace steradian
