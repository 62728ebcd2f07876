// The radiance that a light sends to the eye from a point with a lobe, by any method.
//
//   PolygonLight panel;
//   panel.vertices = {{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}};     // counter-clockwise from the lit side
//   Material lobe;
//   lobe.brdf = Brdf::ggx;
//   lobe.alpha_x = lobe.alpha_y = 0.1;
//   const RadianceResult r = radiance(panel, {{0, 0, 0}, {0, 1, 0}, {0.6, 0.8, 0}}, lobe);
//   // r.radiance; name_of(r.method) is "closed-form"
//
// The methods and their selection are those of `steradian eval` (docs/methods.md). For many evaluations, prepare the light once.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "steradian/area_light.h"
#include "steradian/material.h"
#include "steradian/method.h"
#include "steradian/polygon_light.h"
#include "steradian/shading_point.h"
#include "steradian/vector.h"

namespace steradian {

struct ClassicTable;

struct RadianceOptions {
  Method method = Method::automatic;
  Quality quality = Quality::normal;
  Precision precision = Precision::double_;     // of the arithmetic; reference and sampled have double only
  int spp = 256;                                // for sampled: pairs of a light sample and a lobe sample
  std::uint64_t seed = 1;                       // for sampled
  std::shared_ptr<const ClassicTable> table{};  // for ltc: a fitted table instead of GGX's; null: GGX's
  PeakForm peak_form = PeakForm::best;          // for lorentzian, pearson and ellipsoid
  double early_stop = 0;                        // for arvo: an edge's sum stops when the rest is below this fraction; 0: never
};

struct RadianceResult {
  Vec3d radiance;                        // towards the view [the light's radiance]
  std::optional<double> bound;           // for reference: bound on the absolute error of the largest channel
  std::optional<double> standard_error;  // for sampled: that of the largest channel
  Method method = Method::automatic;     // the one that answered
};

// The normal and the view need not be unit. 0 for a view below the surface, from behind (unless two-sided), for a light without area, and
// for a normal or view that is zero. Throws Error if the method does not serve the lobe or the precision; the message names the methods
// that do.
RadianceResult radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& lobe, const RadianceOptions& options = {});
RadianceResult radiance(const PolygonLight& light, const ShadingPoint& at, const Material& lobe, const RadianceOptions& options = {});
// Radiance of polygons, disks, spheres and capsules; a textured light counts with its mean radiance. Round lights are exact for Lambert by
// `exact`. For other methods they are polygons, and the bound of reference includes the difference (docs/theory/round-lights.md).
RadianceResult radiance(const AreaLight& light, const ShadingPoint& at, const Material& lobe, const RadianceOptions& options = {});

}  // namespace steradian
