// Radiance that one lobe sends to the view under a light with a curved outline: one procedure for ellipses and capsules.
#pragma once

#include <algorithm>
#include <cmath>

#include "integrals/methods.h"
#include "steradian/ellipse_light.h"

namespace steradian::methods {

inline constexpr int kFineVertices = 1024;

inline RadianceResult lambert_answer(double irradiance, Vec3d radiance, const Material& m) {
  RadianceResult answer;
  answer.radiance = radiance * m.albedo * (irradiance / 3.14159265358979324);
  return answer;
}

// Polygons replace the outline. They have 32 vertices (48 in high quality) that gather about the lobe, or 1024 for `exact` and `sampled`.
// `reference` uses 1024 and 512, and its bound includes the difference: the error falls with the square of the number at least.
//
//   about(lobe, vertices)  a polygon that gathers about a lobe
//   fine(vertices)         one of equal steps
template <class About, class Fine>
RadianceResult outline_answer(const About& about, const Fine& fine, Vec3d radiance, const ShadingPoint& at, const Material& m,
                              const Row& entry, const RadianceOptions& options) {
  const auto by = [&](PolygonLight polygon) {
    if (polygon.vertices.empty()) return nothing(entry.method);
    polygon.radiance = radiance;
    return entry.polygon(prepare_polygon(polygon), at, m, options);
  };
  if (entry.method == Method::reference) {
    RadianceResult answer = by(fine(kFineVertices));
    const Vec3d change = answer.radiance - by(fine(kFineVertices / 2)).radiance;
    answer.bound = answer.bound.value_or(0.0) + std::max({std::fabs(change.x), std::fabs(change.y), std::fabs(change.z)});
    return answer;
  }
  if (entry.method == Method::exact || entry.method == Method::sampled) return by(fine(kFineVertices));
  return by(about(lobe_axis(m, at), options.quality == Quality::high ? 48 : 32));
}

}  // namespace steradian::methods
