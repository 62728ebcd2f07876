#include "steradian/closed_form.h"

#include "integrals/ggx/ggx.h"
#include "shapes/polygon.h"
#include "steradian/albedo.h"
#include "steradian/error.h"

namespace steradian {
namespace {

void check_ggx(const Material& material) {
  if (material.brdf != Brdf::ggx) throw Error("material.brdf", std::string("the closed form has no ") + name_of(material.brdf), "use ggx");
}

template <class S, class Integral>
integrals::Part<S> integrate_ggx(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, Integral& integral) {
  const int side = dot(at.view, at.normal) > 0 ? shapes::lit_side(light, at.position) : 0;
  const Frame frame = Frame::from_normal_and_tangent(at.normal, m.tangent);
  integral.alpha_x = m.alpha_x;
  integral.alpha_y = m.alpha_y;
  return integrate(integrals::contours_in<S>(light, frame, at.position),
                   integrals::shading_from<S>(side, integrals::to_kernel<S>(frame.to_local(at.view))), integral);
}

template <class S>
Vec3d closed_form(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, Quality quality) {
  check_ggx(m);
  integrals::GgxIntegral<S> integral;
  integral.smith = m.shadowing ? 1.0 : 0.0;
  integral.quality = quality;
  return integrals::radiance_of<S>(integrate_ggx<S>(light, at, m, integral), m.f0, m.f90, light.radiance);
}

template <class S>
Vec3d exact(const PreparedPolygon& light, const ShadingPoint& at, const Material& m) {
  check_ggx(m);
  if (m.shadowing || !(m.f0 == m.f90))
    throw Error("material", "GGX is exact only without shadowing and with f0 = f90",
                "set shadowing to none, or use the method closed-form");
  integrals::UnshadowedGgx<S> integral;
  return light.radiance * m.f0 * static_cast<double>(integrate_ggx<S>(light, at, m, integral).x.v);
}

}  // namespace

Vec3d closed_form_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material, Quality quality) {
  return closed_form<double>(light, at, with_multiple_scattering(material, at), quality);
}
Vec3d closed_form_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& material, Quality quality) {
  return closed_form<float>(light, at, with_multiple_scattering(material, at), quality);
}

Vec3d exact_ggx_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material) {
  return exact<double>(light, at, with_multiple_scattering(material, at));
}
Vec3d exact_ggx_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& material) {
  return exact<float>(light, at, with_multiple_scattering(material, at));
}

}  // namespace steradian
