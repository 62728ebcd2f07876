// radiance() of lights of every shape.
#include "steradian/radiance.h"

#include "integrals/curved_light.h"

namespace steradian {
RadianceResult radiance(const AreaLight& light, const ShadingPoint& at, const Material& lobe, const RadianceOptions& options) {
  if (std::holds_alternative<Polygon>(light.shape) && !light.emission) return radiance(flat_polygon(light), at, lobe, options);
  const methods::Row& row = methods::resolve(options.method, lobe, options.precision, options.quality);
  if (!(dot(at.normal, at.view) > 0)) return methods::nothing(row.method);
  RadianceResult result = methods::curved_light_answer(light, at, lobe, row, options);
  result.method = row.method;
  return result;
}

}  // namespace steradian
