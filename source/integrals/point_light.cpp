#include "integrals/point_light.h"

#include "lobes/lobe.h"

namespace steradian::methods {

Vec3d point_light_radiance(const PointLight& light, const ShadingPoint& at, const Material& material) {
  const Vec3d to_light = light.position - at.position;
  const double distance = length(to_light);
  if (!(distance > 0)) return {};
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  const lobes::Lobe lobe(lobes::in_frame(material, frame), frame.to_local(at.view));
  const Vec3d f = lobe.radiance(lobe.evaluate(frame.to_local(normalized(to_light))));
  return f * light.intensity / distance / distance;
}

}  // namespace steradian::methods
