#include "integrals/point_light.h"

#include "lobes/lobe.h"

namespace steradian::methods {

Vec3d lobe_towards(Vec3d direction, const ShadingPoint& at, const Material& material, const Row& row, const RadianceOptions& options) {
  if (row.towards != nullptr) return row.towards(direction, at, material, options);
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  const lobes::Lobe lobe(lobes::in_frame(material, frame), frame.to_local(at.view));
  return lobe.radiance(lobe.evaluate(frame.to_local(direction)));
}

Vec3d point_light_radiance(const PointLight& light, const ShadingPoint& at, const Material& material, const Row& row,
                           const RadianceOptions& options) {
  const Vec3d to_light = light.position - at.position;
  const double distance = length(to_light);
  if (!(distance > 0)) return {};
  const Vec3d l = normalized(to_light), from = -l;
  const double candela = light.profile == nullptr
                             ? 1
                             : intensity(*light.profile, {dot(from, light.axes.x), dot(from, light.axes.y), dot(from, light.axes.aim)});
  return lobe_towards(l, at, material, row, options) * light.intensity * candela / distance / distance;
}

Vec3d directional_light_radiance(const DirectionalLight& light, const ShadingPoint& at, const Material& material, const Row& row,
                                 const RadianceOptions& options) {
  return lobe_towards(-light.direction, at, material, row, options) * light.illuminance;
}

}  // namespace steradian::methods
