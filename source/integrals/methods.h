// The table of methods with one row each. `eval`, `render`, their help and the tables of the manual come from it, or are tested against it.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "integrals/procedures.h"
#include "steradian/ellipse_light.h"
#include "steradian/half_vector.h"
#include "steradian/ltc.h"
#include "steradian/material.h"
#include "steradian/polygon_derivatives.h"
#include "steradian/polygon_light.h"
#include "steradian/radiance.h"
#include "steradian/shading_point.h"

namespace steradian::methods {

struct Row {
  Method method;
  const char* name;
  const char* lobes;  // names of the lobes that `serves` accepts, for the table of `steradian methods`
  bool (*serves)(const Material& lobe);
  bool in_float;          // has Precision::float_
  const char* qualities;  // the supported ones, in words; empty: none
  const char* error;      // the largest or the rms, for the table
  const char* time;       // its growth with light and lobe, for the table
  Procedure procedure;    // computes it on packs and on a device
  // Radiance that the lobe sends to the view under a light. Precondition: serves(lobe).
  RadianceResult (*polygon)(const PreparedPolygon&, const ShadingPoint&, const Material&, const RadianceOptions&);
  // Derivatives of a polygon by its vertices, the normal and the view; null: only those of the density.
  RadianceDerivatives (*derivatives)(const PolygonLight&, const ShadingPoint&, const Material&, Quality) = nullptr;
  // Density of the derivatives by any light, or by the visible part of one; null: the method has no derivatives.
  LobeDensity (*density)(const ShadingPoint&, const Material&, Quality) = nullptr;
  // The method's own lobe towards a unit direction, with its colours, for lights without extent; null: the material's lobe.
  Vec3d (*towards)(Vec3d direction, const ShadingPoint&, const Material&, const RadianceOptions&) = nullptr;
};

// The rows in the order of preference of `auto`, which itself has no row.
std::span<const Row> all();

const Row& row_of(Method method);  // not of Method::automatic

// The row that a method selects for a lobe; null if it does not serve the lobe. The rule of `auto`: the first row that serves the lobe; a
// draft prefers ltc-compact to the closed form.
const Row* find(Method method, const Material& lobe, Quality quality);

// The same. Throws Error, which names the methods that serve the lobe, also if the row does not have the precision.
const Row& resolve(Method method, const Material& lobe, Precision precision, Quality quality);

// The procedure by which packs and a device compute a lobe by a method; none: they compute it point by point, or not at all.
Procedure procedure_of(Method method, Brdf brdf);

// True if packs can have such a lobe by a procedure of its own.
constexpr bool has_packs(const Material& m) {
  return m.brdf == Brdf::ggx ? m.shadowing && !m.multiple_scattering : m.brdf != Brdf::phong || !m.foreshortening;
}

// The form of linearly transformed cosines that a method uses; null: none. In high quality, the classic tables have Fresnel's beside them.
constexpr std::optional<LtcMethod> ltc_method(Method method, Quality quality) {
  switch (method) {
    case Method::ltc: return quality == Quality::high ? LtcMethod::fresnel : LtcMethod::classic;
    case Method::ltc_compact: return LtcMethod::compact;
    case Method::ltc_clipless: return LtcMethod::clipless;
    case Method::representative_point: return LtcMethod::representative_point;
    default: return std::nullopt;
  }
}

// The arcs of half vectors at a quality.
constexpr HalfVectorOptions half_vector_options(Quality quality) {
  return {quality == Quality::draft ? 3 : quality == Quality::normal ? 4 : 8, ArcSplit::pole_mapped};
}

// The method and the quality whose differences are a method's derivatives. The error of a value changes with the lobe, so that of its
// derivative is larger: `exact` for Phong, and `high`, keep the derivative as true as the value is. The tables of `ltc` are lobes of their
// own. Samples have noise.
struct FineMethod {
  Method method;
  Quality quality;
};
constexpr FineMethod fine_method(Method method, Quality quality) {
  if (method == Method::series) return {Method::exact, quality};
  if (method == Method::sampled) return {Method::automatic, Quality::high};
  const bool converges = method == Method::closed_form || method == Method::half_vector || method == Method::matched_lobe;
  return {method, converges && quality == Quality::normal ? Quality::high : quality};
}

// The answer 0 of a method: nothing of the light is visible.
RadianceResult nothing(Method method);

std::string names();  // "auto, series, exact, ..."

// Radiance that one lobe sends to the view under a light with a curved outline: one procedure for ellipses and capsules.

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
