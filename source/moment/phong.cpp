#include "steradian/phong.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "moment/clipped_edges.h"
#include "moment/exact_moment.h"
#include "moment/phong_lobe.h"
#include "steradian/error.h"

namespace steradian {
namespace {

struct Named {
  PhongMethod method;
  const char* name;
};
constexpr Named kNames[] = {{PhongMethod::exact, "exact"},           {PhongMethod::arvo, "arvo"},
                            {PhongMethod::lorentzian, "lorentzian"}, {PhongMethod::pearson, "pearson"},
                            {PhongMethod::ellipsoid, "ellipsoid"},   {PhongMethod::series, "series"}};

void check(const Material& material, const PhongOptions& options) {
  if (!(material.exponent >= 0) || !std::isfinite(material.exponent))
    throw Error("exponent", "must be 0 or more, here is " + std::to_string(material.exponent));
  if (options.method == PhongMethod::arvo &&
      (material.exponent != std::floor(material.exponent) || material.exponent > 1e9))
    throw Error("exponent", "arvo needs an integer, here is " + std::to_string(material.exponent),
                "use exact or series for others");
}

// A light seen from one point: the frame, and which side faces it.
struct View {
  Vec3d position;
  Frame frame;
  int side;  // 0: nothing arrives

  View(const PreparedPolygon& light, Vec3d position_, Vec3d normal)
      : position(position_), frame(Frame::from_normal(normal)), side(light.side_of(position_)) {
    if (side < 0 && !light.two_sided) side = 0;
  }

  template <class S>
  auto directions() const {
    return [this](const Vec3d& vertex) {
      const Vec3d l = frame.to_local(vertex - position);
      return Kernels<S>().polygon_direction({l.x, l.y, l.z});
    };
  }
};

template <class S>
typename Kernels<S>::vec3 to_kernel(Vec3d v) {
  return {v.x, v.y, v.z};
}

template <class S, PhongMethod method, PhongQuality quality = PhongQuality::normal>
Real<S> sum_of_shares(const PreparedPolygon& light, const View& view, typename Kernels<S>::vec3 r, double n,
                      double precision) {
  const PhongLobe<S> lobe(n, precision);
  return sum_over_clipped_edges<S>(light, view.directions<S>(), [&](const auto& a, const auto& b) {
    return lobe.template share<method, quality>(a, b, r);
  });
}

double exact_sum(const PreparedPolygon& light, const View& view, Kernels<double>::vec3 r, double n) {
  Kernels<double> k;
  return sum_over_clipped_edges<double>(light, view.directions<double>(), [&](const auto& a, const auto& b) {
           const auto edge = k.moment_edge(a, b, r);
           return k.moment_edge_share(edge, integrate_front(edge, n).moment);
         }).v;
}

// Radiance of albedo 1 under radiance 1.
template <class S>
S radiance(const PreparedPolygon& light, const ShadingPoint& at, double n, const PhongOptions& options) {
  const View view(light, at.position, at.normal);
  const Vec3d v = view.frame.to_local(at.view);
  if (view.side == 0 || !(v.z > 0)) return S(0);
  Kernels<S> k;
  const auto r = k.phong_mirror(to_kernel<S>(v));
  const double precision = options.relative_precision;
  Real<S> sum(0.0);
  switch (options.method) {
    case PhongMethod::exact:
      if constexpr (std::is_same_v<S, double>)
        sum = exact_sum(light, view, r, n);
      else
        sum = sum_of_shares<S, PhongMethod::exact>(light, view, r, n, precision);
      break;
    case PhongMethod::arvo: sum = sum_of_shares<S, PhongMethod::arvo>(light, view, r, n, precision); break;
    case PhongMethod::lorentzian: sum = sum_of_shares<S, PhongMethod::lorentzian>(light, view, r, n, precision); break;
    case PhongMethod::pearson: sum = sum_of_shares<S, PhongMethod::pearson>(light, view, r, n, precision); break;
    case PhongMethod::ellipsoid: sum = sum_of_shares<S, PhongMethod::ellipsoid>(light, view, r, n, precision); break;
    case PhongMethod::series:
      if (options.quality == PhongQuality::high)
        sum = sum_of_shares<S, PhongMethod::series, PhongQuality::high>(light, view, r, n, precision);
      else
        sum = sum_of_shares<S, PhongMethod::series>(light, view, r, n, precision);
      break;
  }
  return k.moment_phong_radiance(sum, Mask<S>(view.side < 0)).v;
}

}  // namespace

std::optional<PhongMethod> phong_method_of(std::string_view name) {
  if (name == "auto") return PhongMethod::series;
  for (const Named& named : kNames)
    if (name == named.name) return named.method;
  return std::nullopt;
}

const char* name_of(PhongMethod method) {
  for (const Named& named : kNames)
    if (method == named.method) return named.name;
  return "?";
}

Vec3d phong_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                     const PhongOptions& options) {
  check(material, options);
  return light.radiance * material.albedo * radiance<double>(light, at, material.exponent, options);
}

Vec3f phong_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                           const PhongOptions& options) {
  check(material, options);
  return static_cast<Vec3f>(light.radiance * material.albedo) * radiance<float>(light, at, material.exponent, options);
}

double axial_moment(const PreparedPolygon& light, Vec3d position, Vec3d normal, Vec3d axis, double n) {
  const View view(light, position, normal);
  if (view.side == 0) return 0;
  const double sum = exact_sum(light, view, to_kernel<double>(view.frame.to_local(axis)), n);
  return std::clamp(view.side * sum, 0.0, 2 * std::numbers::pi) / (n + 1);
}

double double_axis_moment(const PreparedPolygon& light, Vec3d position, Vec3d normal, Vec3d axis, Vec3d other,
                          double n) {
  const View view(light, position, normal);
  if (view.side == 0) return 0;
  Kernels<double> k;
  const auto r = to_kernel<double>(view.frame.to_local(axis));
  const auto v = to_kernel<double>(view.frame.to_local(other));
  const double sum =
      sum_over_clipped_edges<double>(light, view.directions<double>(), [&](const auto& a, const auto& b) {
        const auto edge = k.moment_edge(a, b, r);
        const auto front = integrate_front(edge, n - 1);
        return k.moment_double_axis_share(a, b, r, v, k.moment_edge_share(edge, front.moment), front.power);
      }).v;
  return view.side * sum / (n + 2);
}

}  // namespace steradian
