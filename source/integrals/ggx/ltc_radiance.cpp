#include "integrals/ggx/ltc_radiance.h"

#include <algorithm>
#include <cmath>

#include "integrals/ggx/representative_point.h"
#include "integrals/tables/ggx_tables.h"
#include "shapes/polygon.h"
#include "steradian/albedo.h"
#include "steradian/error.h"
#include "steradian/kernels.h"
#include "steradian/ltc.h"

namespace steradian {

Vec3d view_from_cosine(double cos_theta) { return {std::sqrt(std::max(1 - cos_theta * cos_theta, 0.0)), 0, cos_theta}; }

LtcInverse ltc_inverse(const LtcShape& s, LobeFrame frame, double alpha, Vec3d view) {
  const bool mirror = frame == LobeFrame::mirror;
  Kernels<double>::vec4 e;
  e.x = s.e00, e.y = s.e11, e.z = s.e02, e.w = s.e20;
  const Vec3d v = mirror ? view : Vec3d{0, 0, 1};
  const auto m = Kernels<double>{}.ltc_from_compact(e, mirror ? alpha : 1.0, {v.x, v.y, v.z});
  return {m.xx.v, m.xz.v, m.yy.v, m.zx.v, m.zz.v};
}

double ltc_evaluate(const LtcInverse& m, Vec3d l) {
  Kernels<double>::LtcMatrix k;
  k.xx = m.xx, k.xz = m.xz, k.yy = m.yy, k.zx = m.zx, k.zz = m.zz;
  return Kernels<double>{}.ltc_lobe(k, {l.x, l.y, l.z}).v;
}

double ltc_above_horizon(const LtcInverse& m) { return 0.5 + 0.5 * m.xx / std::hypot(m.xx, m.zx); }

namespace {

// A surface point in the frame of the tables: z the normal, x along the view's projection.
template <class S>
struct TablePoint {
  typename Kernels<S>::mat3 frame;
  typename Kernels<S>::vec3 view;
  double cosine;  // of the view

  explicit TablePoint(const ShadingPoint& at) : cosine(dot(normalized(at.normal), normalized(at.view))) {
    const auto n = integrals::to_kernel<S>(normalized(at.normal)), v = integrals::to_kernel<S>(normalized(at.view));
    frame = Kernels<S>().frame_from_normal_and_view(n, v);
    view = transform_transposed(frame, v);
    view.y = 0.0;
  }
};

// part_by(integral): the part of a light by the integral of a lobe. light: the light's radiance, or illuminance.
template <class S, class PartBy>
Vec3d reflected(LtcMethod method, const ClassicTable& table, const TablePoint<S>& point, const Material& m, Vec3d light,
                const PartBy& part_by) {
  const double alpha = std::max(m.alpha_x, kSmallestAlpha), cosine = point.cosine;
  const auto by = [&](auto integral) { return integrals::radiance_of<S>(part_by(integral), m.f0, m.f90, light); };
  switch (method) {
    case LtcMethod::representative_point: return by(integrals::RepresentativePoint<S>(m.alpha_x));
    case LtcMethod::classic: return by(integrals::Ltc<S>(classic_lobe<S>(table, alpha, cosine)));
    case LtcMethod::fresnel: {
      const auto lobe = part_by(integrals::Ltc<S>(classic_lobe<S>(table, alpha, cosine)));
      const auto grazing = part_by(integrals::Ltc<S>(classic_lobe<S>(ggx_fresnel_table(), alpha, cosine)));
      return integrals::radiance_of<S>({lobe.x, grazing.x}, m.f0, m.f90, light);
    }
    case LtcMethod::clipless: return by(integrals::CliplessLtc<S>(classic_lobe<S>(table, alpha, cosine)));
    case LtcMethod::compact: break;
  }
  return by(integrals::Ltc<S>(compact_lobe<S>(ggx_compact_table(), alpha, cosine, point.view)));
}

template <class S>
Vec3d radiance(LtcMethod method, const ClassicTable& table, const PreparedPolygon& light, const ShadingPoint& at,
               const Material& material) {
  const TablePoint<S> point(at);
  const auto shading = integrals::shading_from<S>(point.cosine > 0 ? shapes::lit_side(light, at.position) : 0, point.view);
  return reflected(method, table, point, material, light.radiance,
                   [&](auto integral) { return integrate(integrals::contours_in<S>(light, point.frame, at.position), shading, integral); });
}

template <class S>
Vec3d towards(LtcMethod method, const ClassicTable& table, Vec3d direction, const ShadingPoint& at, const Material& material) {
  const TablePoint<S> point(at);
  const auto l = transform_transposed(point.frame, integrals::to_kernel<S>(direction));
  const auto shading = integrals::shading_from<S>(point.cosine > 0 && dot(at.normal, direction) > 0 ? 1 : 0, point.view);
  return reflected(method, table, point, material, {1, 1, 1}, [&](auto integral) {
    integrals::Part<S> nothing;
    integrals::set_to_zero(nothing);
    const auto lit = integral.begin(shading);
    return select(lit, integral.at(l), nothing);
  });
}

void require_service(LtcMethod method, const Material& material) {
  if (!serves(method, material))
    throw Error("material", "linearly transformed cosines serve isotropic ggx with shadowing", "use the method closed-form or reference");
}

}  // namespace

bool serves(LtcMethod, const Material& material) {
  return material.brdf == Brdf::ggx && material.shadowing && material.alpha_x == material.alpha_y;
}

Vec3d ltc_radiance(LtcMethod method, const PreparedPolygon& light, const ShadingPoint& at, const Material& material) {
  require_service(method, material);
  return radiance<double>(method, ggx_classic_table(), light, at, with_multiple_scattering(material, at));
}

Vec3d ltc_radiance_float(LtcMethod method, const PreparedPolygon& light, const ShadingPoint& at, const Material& material) {
  require_service(method, material);
  return radiance<float>(method, ggx_classic_table(), light, at, with_multiple_scattering(material, at));
}

Vec3d ltc_radiance_by(const ClassicTable& table, const PreparedPolygon& light, const ShadingPoint& at, const Material& material) {
  require_service(LtcMethod::classic, material);
  return radiance<double>(LtcMethod::classic, table, light, at, material);
}

Vec3d ltc_radiance_by_float(const ClassicTable& table, const PreparedPolygon& light, const ShadingPoint& at, const Material& material) {
  require_service(LtcMethod::classic, material);
  return radiance<float>(LtcMethod::classic, table, light, at, material);
}

Vec3d ltc_towards(LtcMethod method, Vec3d direction, const ShadingPoint& at, const Material& material, const ClassicTable* fitted) {
  require_service(method, material);
  if (fitted != nullptr) return towards<double>(LtcMethod::classic, *fitted, direction, at, material);
  return towards<double>(method, ggx_classic_table(), direction, at, with_multiple_scattering(material, at));
}

Vec3d ltc_towards_float(LtcMethod method, Vec3d direction, const ShadingPoint& at, const Material& material, const ClassicTable* fitted) {
  require_service(method, material);
  if (fitted != nullptr) return towards<float>(LtcMethod::classic, *fitted, direction, at, material);
  return towards<float>(method, ggx_classic_table(), direction, at, with_multiple_scattering(material, at));
}

}  // namespace steradian
