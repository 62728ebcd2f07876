// radiance() of lights of every shape.
#include "steradian/radiance.h"

#include "integrals/curved_light.h"

namespace steradian {
namespace {

CurvedLight curved(const AreaLight& light) {
  const Vec3d radiance = light.polygon.radiance;
  switch (light.shape) {
    case LightShape::disk: return {Ellipse{light.center, light.x, light.y}, radiance, light.polygon.two_sided};
    case LightShape::capsule: return {capsule_or_line(light.center - light.x, light.center + light.x, light.radius), radiance, false};
    default: return {Ellipsoid{light.center, light.x, light.y, light.z}, radiance, false};
  }
}

}  // namespace

RadianceResult radiance(const AreaLight& light, const ShadingPoint& at, const Material& lobe, const RadianceOptions& options) {
  if (light.shape == LightShape::polygon) return radiance(light.polygon, at, lobe, options);
  const methods::Row& row = methods::resolve(options.method, lobe, options.precision, options.quality);
  if (!(dot(at.normal, at.view) > 0)) return methods::nothing(row.method);
  RadianceResult result = methods::curved_light_answer(curved(light), at, lobe, row, options);
  result.method = row.method;
  return result;
}

}  // namespace steradian
