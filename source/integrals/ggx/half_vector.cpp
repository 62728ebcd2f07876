#include "steradian/half_vector.h"

#include <string>
#include <type_traits>

#include "integrals/ggx/half_vector.h"
#include "shapes/polygon.h"
#include "steradian/albedo.h"
#include "steradian/error.h"

namespace steradian {
namespace {

template <class S>
Vec3d radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, const HalfVectorOptions& options) {
  if (options.arcs < 1) throw Error("arcs", "must be 1 or more, here is " + std::to_string(options.arcs));
  const int side = dot(at.view, at.normal) > 0 ? shapes::lit_side(light, at.position) : 0;
  const auto by = [&](const auto& lobe, Vec3d tangent, Vec3d f0, Vec3d f90) {
    const Frame frame = Frame::from_normal_and_tangent(at.normal, tangent);
    integrals::HalfVector<S, std::decay_t<decltype(lobe)>> integral(lobe, options);
    const auto part = integrate(integrals::contours_in<S>(light, frame, at.position),
                                integrals::shading_from<S>(side, integrals::to_kernel<S>(frame.to_local(at.view))), integral);
    return integrals::radiance_of<S>(part, f0, f90, light.radiance);
  };
  constexpr Vec3d kOne{1, 1, 1};
  switch (m.brdf) {
    case Brdf::ggx: return by(integrals::GgxHalfVectorArcs<S>{m.alpha_x, m.alpha_y, m.shadowing ? 1.0 : 0.0}, m.tangent, m.f0, m.f90);
    case Brdf::blinn_phong: return by(integrals::BlinnPhongArcs<S>(m.exponent), {}, kOne, kOne);
    case Brdf::beckmann: return by(integrals::BeckmannArcs<S>{m.alpha_x, m.alpha_y}, m.tangent, kOne, kOne);
    default: throw Error("material.brdf", std::string("half vectors have no ") + name_of(m.brdf), "use blinn-phong, beckmann or ggx");
  }
}

}  // namespace

Vec3d half_vector_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                           const HalfVectorOptions& options) {
  return radiance<double>(light, at, with_multiple_scattering(material, at), options);
}
Vec3d half_vector_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                                 const HalfVectorOptions& options) {
  return radiance<float>(light, at, with_multiple_scattering(material, at), options);
}

}  // namespace steradian
