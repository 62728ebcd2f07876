// Irradiance and solid angle of a polygon: the closed forms, walked edge by edge.
#include "integrals/irradiance.h"
#include "shapes/polygon.h"
#include "steradian/polygon_light.h"

namespace steradian {
namespace {

template <class S>
S irradiance(const PreparedPolygon& light, Vec3d position, Vec3d normal) {
  const auto shading = integrals::shading_from<S>(shapes::lit_side(light, position), {0.0, 0.0, 1.0});
  integrals::Irradiance<S> integral;
  return integrate(integrals::contours_in<S>(light, Frame::from_normal(normal), position), shading, integral).z.v;
}

}  // namespace

double polygon_irradiance(const PreparedPolygon& light, Vec3d position, Vec3d normal) {
  return irradiance<double>(light, position, normal);
}

float polygon_irradiance_float(const PreparedPolygon& light, Vec3d position, Vec3d normal) {
  return irradiance<float>(light, position, normal);
}

double polygon_solid_angle(const PreparedPolygon& light, Vec3d position) {
  const int side = shapes::lit_side(light, position);
  if (side == 0) return 0.0;
  const auto outline = integrals::contours_in<double>(light, Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, position);
  integrals::SolidAngle<double> integral(outline.direction(light.vertices.front()));
  return integrate(outline, integrals::shading_from<double>(side, {0.0, 0.0, 1.0}), integral).x.v;
}

}  // namespace steradian
