#include "steradian/phong.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "integrals/integrate.h"
#include "integrals/phong/exact_moment.h"
#include "integrals/phong/foreshortened_phong.h"
#include "shapes/polygon.h"
#include "steradian/error.h"

namespace steradian {
namespace {

void check(const Material& material, const PhongOptions& options) {
  if (!(material.exponent >= 0) || !std::isfinite(material.exponent))
    throw Error("exponent", "must be 0 or more, here is " + std::to_string(material.exponent));
  const Method m = options.method;
  if (m != Method::exact && m != Method::arvo && m != Method::lorentzian && m != Method::pearson && m != Method::ellipsoid &&
      m != Method::series)
    throw Error("method", std::string(name_of(m)) + " does not serve brdf phong");
  if (material.foreshortening && m != Method::exact && m != Method::arvo && m != Method::series)
    throw Error("method", std::string(name_of(m)) + " does not serve phong with foreshortening");
  if (options.method == Method::arvo && (material.exponent != std::floor(material.exponent) || material.exponent > 1e9))
    throw Error("exponent", "arvo needs an integer, here is " + std::to_string(material.exponent), "use exact or series for others");
}

using integrals::to_kernel;

// The quadrature of x^n has a limit at n = 0, but not that exponent; from here the error equals this bound.
constexpr double kNearlyFlat = 1e-11;

// Contribution of the edge by quadrature in double that subdivides until it has converged.
double exact_share(const auto& a, const auto& b, const auto& axis, double n) {
  Kernels<double> k;
  const auto edge = k.moment_edge(a, b, axis);
  return k.moment_edge_share(edge, integrate_front(edge, n).moment).v;
}

// The same for the lobe times the light's cosine.
double exact_foreshortened_share(const auto& a, const auto& b, const auto& axis, double n) {
  Kernels<double> k;
  const auto edge = k.moment_edge(a, b, axis);
  const auto front = integrate_front(edge, std::max(n, kNearlyFlat) - 1);
  return (n + 1) / (n + 2) * k.moment_foreshortened_share(edge, a, b, axis, front.moment, front.power).v;
}

// Radiance of albedo 1 under radiance 1.
template <class S>
S radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material, const PhongOptions& options) {
  const double n = material.exponent;
  const Frame frame = Frame::from_normal(at.normal);
  const auto shading = integrals::shading_from<S>(shapes::lit_side(light, at.position), to_kernel<S>(frame.to_local(at.view)));
  const auto by = [&](auto share) {
    integrals::PhongIntegral<S, decltype(share)> integral(share, n, options);
    integral.foreshortened = material.foreshortening;
    return integrate(integrals::contours_in<S>(light, frame, at.position), shading, integral).x.v;
  };
  if (material.foreshortening) {
    if constexpr (std::is_same_v<S, double>)
      if (options.method == Method::exact)
        return by([n](const auto& a, const auto& b, const auto& axis) { return exact_foreshortened_share(a, b, axis, n); });
    const integrals::ForeshortenedLobe<S> lobe(n, options.relative_precision);
    return integrals::with_foreshortened_share<S>(lobe, options, by);
  }
  if constexpr (std::is_same_v<S, double>)
    if (options.method == Method::exact)
      return by([n](const auto& a, const auto& b, const auto& axis) { return exact_share(a, b, axis, n); });
  const integrals::PhongLobe<S> lobe(n, options);
  return integrals::with_phong_share<S>(lobe, options, by);
}

}  // namespace

Vec3d phong_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material, const PhongOptions& options) {
  check(material, options);
  return light.radiance * material.albedo * radiance<double>(light, at, material, options);
}

Vec3f phong_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& material, const PhongOptions& options) {
  check(material, options);
  return static_cast<Vec3f>(light.radiance * material.albedo) * radiance<float>(light, at, material, options);
}

double axial_moment(const PreparedPolygon& light, Vec3d position, Vec3d normal, Vec3d axis, double n) {
  const int side = shapes::lit_side(light, position);
  if (side == 0) return 0;
  const Frame frame = Frame::from_normal(normal);
  const auto r = to_kernel<double>(frame.to_local(axis));
  const double sum =
      integrals::sum_over_edges<double>(integrals::contours_in<double>(light, frame, position), [&](const auto& a, const auto& b) {
        return exact_share(a, b, r, n);
      }).v;
  return std::clamp(side * sum, 0.0, 2 * std::numbers::pi) / (n + 1);
}

double double_axis_moment(const PreparedPolygon& light, Vec3d position, Vec3d normal, Vec3d axis, Vec3d other, double n) {
  const int side = shapes::lit_side(light, position);
  if (side == 0) return 0;
  const Frame frame = Frame::from_normal(normal);
  const auto r = to_kernel<double>(frame.to_local(axis)), v = to_kernel<double>(frame.to_local(other));
  Kernels<double> k;
  const auto share = [&](const auto& a, const auto& b) {
    const auto edge = k.moment_edge(a, b, r);
    const auto front = integrate_front(edge, std::max(n, kNearlyFlat) - 1);
    return k.moment_double_axis_share(a, b, r, v, k.moment_edge_share(edge, front.moment), front.power);
  };
  return side * integrals::sum_over_edges<double>(integrals::contours_in<double>(light, frame, position), share).v / (n + 2);
}

}  // namespace steradian
