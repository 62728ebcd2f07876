#include "steradian/ellipse_light.h"

#include <algorithm>
#include <cmath>

#include "shapes/small_light.h"
#include "steradian/error.h"
#include "steradian/kernels.h"

namespace steradian {
namespace {

template <class S>
typename Kernels<S>::Ellipse seen_from(const Ellipse& ellipse, Vec3d position, const Frame& frame) {
  const auto local = [&](Vec3d v) {
    const Vec3d l = frame.to_local(v);
    return typename Kernels<S>::vec3(l.x, l.y, l.z);
  };
  return Kernels<S>().ellipse_prepare(local(ellipse.center - position), local(ellipse.x), local(ellipse.y));
}

template <class S>
S irradiance(const Ellipse& ellipse, Vec3d position, Vec3d normal) {
  const Vec3d lit = cross(ellipse.x, ellipse.y);
  if (!(dot(position - ellipse.center, lit) > 0)) return S(0);
  // The unit is the distance: squares of squares of tiny and huge lights would leave the range of float.
  const Vec3d to_center = ellipse.center - position;
  const double unit = 1 / (length(to_center) + length(ellipse.x) + length(ellipse.y));
  const Ellipse scaled{position + to_center * unit, ellipse.x * unit, ellipse.y * unit};
  Kernels<S> k;
  const auto seen = seen_from<S>(scaled, position, Frame::from_normal(normal));
  const auto elements = k.ellipse_elements(seen);
  const integrals::SmallLight<S> small = {k.light_elements_diffuse_sharpness(), k.light_elements_along_arcs()};
  if (any_lane(integrals::elements_serve<S>(elements, small))) return k.light_elements_irradiance_vector(elements).z.v;
  return k.ellipse_irradiance_vector(seen).z.v;
}

PolygonLight polygon_of(const Kernels<double>::EllipseFan& fan, Vec3d position, int vertices) {
  if (vertices < 6 || vertices > 64 || vertices % 2 != 0)
    throw Error("vertices", "must be even, from 6 to 64, here is " + std::to_string(vertices));
  Kernels<double> k;
  PolygonLight light;
  for (int i = vertices; i-- > 0;) {  // stored order is the reverse of walk order
    const auto v = k.ellipse_fan_corner(fan, i, vertices);
    light.vertices.push_back(position + Vec3d{v.x.v, v.y.v, v.z.v});
  }
  return light;
}

// Twice the number of kernels/outline/ellipse.glsl: a quarter of the error, where time does not matter.
constexpr int kVerticesNearRim = 64;

}  // namespace

double ellipse_irradiance(const Ellipse& ellipse, Vec3d position, Vec3d normal) { return irradiance<double>(ellipse, position, normal); }
float ellipse_irradiance_float(const Ellipse& ellipse, Vec3d position, Vec3d normal) {
  return irradiance<float>(ellipse, position, normal);
}

double ellipsoid_irradiance(const Ellipsoid& ellipsoid, Vec3d position, Vec3d normal) {
  const auto outline = silhouette(ellipsoid, position);
  return outline ? ellipse_irradiance(*outline, position, normal) : 0.0;
}

PolygonLight polygon_for_lobe(const Ellipse& ellipse, Vec3d position, const LobeAxis& lobe, int vertices) {
  Kernels<double> k;
  const auto local = seen_from<double>(ellipse, position, Frame::world());
  const auto fan = k.ellipse_fan_concentrated(local, {lobe.axis.x, lobe.axis.y, lobe.axis.z}, lobe.width);
  return polygon_of(fan, position, any_lane(fan.near) ? std::max(vertices, kVerticesNearRim) : vertices);
}

PolygonLight polygon_of_equal_steps(const Ellipse& ellipse, Vec3d position, int vertices) {
  return polygon_of(Kernels<double>().ellipse_fan(seen_from<double>(ellipse, position, Frame::world())), position, vertices);
}

}  // namespace steradian
