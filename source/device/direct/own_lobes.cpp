#include "device/direct/own_lobes.h"

#include <algorithm>

#include "integrals/ggx/half_vector.h"
#include "integrals/phong/phong.h"
#include "steradian/error.h"

namespace steradian::vulkan {
namespace {

#include "shaders/layout.glsl"
#include "shaders/lobes/phong_methods.glsl"

Vec4Floats with(Vec3d v, double w) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

OwnLobes::Lobe lobe_by(const Material& m, Method method, Quality quality, std::size_t first) {
  OwnLobes::Lobe lobe{methods::procedure_of(method, m.brdf), static_cast<std::uint32_t>(first), 0, 0, 0, true, 0};
  if (m.brdf == Brdf::phong) {
    lobe.phong = phong_method({method, quality});
    lobe.form = m.foreshortening ? 1 : 0;
    lobe.low = m.foreshortening ? integrals::cosine_series_range(m.exponent) : m.exponent < 1 ? 2 : 0;
    lobe.by_points = m.foreshortening;
    lobe.least_distance2 =
        Kernels<double>().light_elements_along_power(m.exponent, integrals::bias_of(m.exponent, {method, quality})).least_distance2.v;
  }
  if (m.brdf == Brdf::ggx) lobe.form = method == Method::exact ? 2 : m.shadowing ? 0 : 1;
  return lobe;
}

}  // namespace

int phong_method(const PhongOptions& options) {
  switch (options.method) {
    case Method::exact: return kPhongExact;
    case Method::arvo: return kPhongArvo;
    case Method::lorentzian: return kPhongLorentzian;
    case Method::pearson: return kPhongPearson;
    case Method::ellipsoid: return kPhongEllipsoid;
    case Method::series: return options.quality == Quality::high ? kPhongSeriesHigh : kPhongSeries;
    default: throw Error("method", std::string("no shader has Phong lobes by ") + name_of(options.method));
  }
}

std::size_t OwnLobes::most_vectors(const Scene& scene) {
  std::size_t count = 0;
  for (const SurfaceMaterial& m : scene.materials) count += m.specular_override.size() * static_cast<std::size_t>(kOwnLobe);
  return count;
}

OwnLobes::OwnLobes(const Scene& scene, const DirectMethod& method, std::size_t first) : scene_(scene), method_(method) {
  for (const SurfaceMaterial& surface : scene.materials) {
    std::vector<Lobe>& lobes = lobes_.emplace_back();
    for (const Material& m : surface.specular_override) {
      if (m.brdf == Brdf::lambert || !has(m)) continue;
      const Method by = method_.row_for(m).method;
      Lobe lobe = lobe_by(m, by, method_.quality, first + values_.size());
      // Like SpecularPass::add_ggx_override.
      if (m.brdf == Brdf::ggx) lobe.by_points = !m.shadowing || m.tangent != Vec3d{} || by != method_.ggx;
      const auto number = static_cast<double>(lobes_.size());
      values_.insert(values_.end(), {with(m.brdf == Brdf::ggx ? m.f0 : m.albedo, number), with(m.f90, m.exponent), with(m.tangent, 0),
                                     with({m.alpha_x, m.alpha_y, 0}, 0)});
      lobes.push_back(lobe);
    }
  }
}

bool OwnLobes::has(const Material& m) const {
  if (m.brdf == Brdf::lambert) return true;
  const Method by = method_.row_for(m).method;
  if (m.brdf == Brdf::phong) return by == Method::series || by == Method::exact;
  if (m.brdf != Brdf::ggx) return m.brdf == Brdf::charlie;
  const methods::Procedure procedure = methods::procedure_of(by, m.brdf);
  const bool has_table = by == method_.ggx,
             needs_one = procedure == methods::Procedure::ltc || procedure == methods::Procedure::ltc_clipless;
  return !m.multiple_scattering && (has_table || !needs_one);
}

std::size_t OwnLobes::number_of(const SurfaceMaterial* material) const {
  if (material == nullptr || material->unlit || material->specular_override.empty()) return 0;
  return static_cast<std::size_t>(material - scene_.materials.data()) + 1;
}

}  // namespace steradian::vulkan
