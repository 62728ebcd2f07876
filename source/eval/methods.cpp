#include "eval/methods.h"

#include <cmath>

#include "steradian/closed_form.h"
#include "steradian/error.h"
#include "steradian/half_vector.h"
#include "steradian/kernels.h"
#include "steradian/phong.h"
#include "steradian/ltc.h"

namespace steradian::eval {
namespace {

bool every_lobe(const Material&) { return true; }
bool phong_only(const Material& m) { return m.brdf == Brdf::phong; }
bool ggx_only(const Material& m) { return m.brdf == Brdf::ggx; }
bool half_vector_lobes(const Material& m) {
  return m.brdf == Brdf::blinn_phong || m.brdf == Brdf::beckmann || m.brdf == Brdf::ggx;
}
bool exact_lobes(const Material& m) {
  return m.brdf == Brdf::lambert || m.brdf == Brdf::phong || (m.brdf == Brdf::ggx && !m.shadowing && m.f0 == m.f90);
}
bool phong_of_integer_exponent(const Material& m) {
  return m.brdf == Brdf::phong && m.exponent == std::floor(m.exponent) && m.exponent < 1e9;
}

template <class S>
Vec3d lambert(S irradiance, Vec3d radiance, Vec3d albedo) {
  const S factor = Kernels<S>().lambert_radiance(Real<S>::of(irradiance)).v;
  return Vec3d(Vector3<S>(radiance) * Vector3<S>(albedo) * factor);
}

template <PhongMethod method>
LobeAnswer phong(const PreparedPolygon& light, const ShadingPoint& at, const Material& m,
                 const MethodOptions& options) {
  const PhongOptions o{method, options.quality == Quality::high ? PhongQuality::high : PhongQuality::normal};
  LobeAnswer answer;
  answer.radiance = options.precision == Precision::float_ ? Vec3d(phong_radiance_float(light, at, m, o))
                                                           : phong_radiance(light, at, m, o);
  return answer;
}

LobeAnswer closed_form(const PreparedPolygon& light, const ShadingPoint& at, const Material& m,
                       const MethodOptions& options) {
  LobeAnswer answer;
  answer.radiance = options.precision == Precision::float_ ? closed_form_radiance_float(light, at, m, options.quality)
                                                           : closed_form_radiance(light, at, m, options.quality);
  return answer;
}

LobeAnswer half_vector(const PreparedPolygon& light, const ShadingPoint& at, const Material& m,
                       const MethodOptions& options) {
  const int arcs = options.quality == Quality::draft ? 3 : options.quality == Quality::normal ? 4 : 8;
  LobeAnswer answer;
  answer.radiance = options.precision == Precision::float_ ? half_vector_radiance_float(light, at, m, {.arcs = arcs})
                                                           : half_vector_radiance(light, at, m, {.arcs = arcs});
  return answer;
}

LobeAnswer exact(const PreparedPolygon& light, const ShadingPoint& at, const Material& m,
                 const MethodOptions& options) {
  if (m.brdf == Brdf::phong) return phong<PhongMethod::exact>(light, at, m, options);
  LobeAnswer answer;
  if (m.brdf == Brdf::ggx) {
    answer.radiance = options.precision == Precision::float_ ? exact_ggx_radiance_float(light, at, m)
                                                             : exact_ggx_radiance(light, at, m);
    return answer;
  }
  if (options.precision == Precision::float_)
    answer.radiance =
        lambert(polygon_irradiance_float(light, at.position, at.normal), light.radiance, m.albedo);
  else
    answer.radiance = lambert(polygon_irradiance(light, at.position, at.normal), light.radiance, m.albedo);
  return answer;
}

LobeAnswer reference(const PreparedPolygon& light, const ShadingPoint& at, const Material& m,
                     const MethodOptions&) {
  const ReferenceResult r = reference_radiance(light, at, m);
  return {r.radiance, r.bound, std::nullopt};
}

LobeAnswer sampled(const PreparedPolygon& light, const ShadingPoint& at, const Material& m,
                   const MethodOptions& options) {
  SampledOptions o;
  o.spp = options.spp;
  o.seed = options.seed;
  const SampledResult r = sampled_radiance(light, at, m, o);
  return {r.radiance, std::nullopt, r.standard_error};
}

template <LtcMethod method>
bool ltc_serves(const Material& m) {
  return serves(method, m);
}

template <LtcMethod method>
LobeAnswer ltc(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, const MethodOptions& options) {
  const auto evaluate = options.precision == Precision::float_ ? ltc_radiance_float : ltc_radiance;
  LobeAnswer answer;
  answer.radiance = evaluate(method, light, at, m);
  return answer;
}

// A new method is an entry here and a name in Method.
constexpr MethodEntry kMethods[] = {
    {Method::series, "series", phong_only, true, phong<PhongMethod::series>},
    {Method::exact, "exact", exact_lobes, true, exact},
    {Method::arvo, "arvo", phong_of_integer_exponent, true, phong<PhongMethod::arvo>},
    {Method::lorentzian, "lorentzian", phong_only, true, phong<PhongMethod::lorentzian>},
    {Method::pearson, "pearson", phong_only, true, phong<PhongMethod::pearson>},
    {Method::ellipsoid, "ellipsoid", phong_only, true, phong<PhongMethod::ellipsoid>},
    {Method::closed_form, "closed-form", ggx_only, true, closed_form},
    {Method::ltc, "ltc", ltc_serves<LtcMethod::classic>, true, ltc<LtcMethod::classic>},
    {Method::ltc_compact, "ltc-compact", ltc_serves<LtcMethod::compact>, true, ltc<LtcMethod::compact>},
    {Method::ltc_clipless, "ltc-clipless", ltc_serves<LtcMethod::clipless>, true, ltc<LtcMethod::clipless>},
    {Method::representative_point, "representative-point", ltc_serves<LtcMethod::representative_point>, true, ltc<LtcMethod::representative_point>},
    {Method::half_vector, "half-vector", half_vector_lobes, true, half_vector},
    {Method::reference, "reference", every_lobe, false, reference},
    {Method::sampled, "sampled", every_lobe, false, sampled},
};

}  // namespace

std::span<const MethodEntry> methods() { return kMethods; }

std::optional<Method> method_of(std::string_view name) {
  if (name == "auto") return Method::automatic;
  for (const MethodEntry& entry : kMethods)
    if (name == entry.name) return entry.method;
  return std::nullopt;
}

std::string method_names() {
  std::string names = "auto";
  for (const MethodEntry& entry : kMethods) names += std::string(", ") + entry.name;
  return names;
}

const MethodEntry& resolve(Method asked_for, const Material& material, Precision precision, Quality quality) {
  // The rule of source/render/cpu/methods.cpp.
  const bool table = asked_for == Method::automatic && quality == Quality::draft && material.brdf == Brdf::ggx &&
                     !exact_lobes(material) && ltc_serves<LtcMethod::compact>(material);
  const Method method = table ? Method::ltc_compact : asked_for;
  const std::string brdf = name_of(material.brdf);
  std::string serving;
  for (const MethodEntry& entry : kMethods) {
    if (!entry.serves(material)) continue;
    serving += (serving.empty() ? "" : ", ") + std::string(entry.name);
    if (method != Method::automatic && method != entry.method) continue;
    if (precision == Precision::float_ && !entry.in_float)
      throw Error("precision", std::string("method ") + entry.name + " works in double only for brdf " + brdf,
                  "leave precision out");
    return entry;
  }
  std::string asked = "auto";
  for (const MethodEntry& entry : kMethods)
    if (entry.method == method) asked = entry.name;
  throw Error("method", asked + " does not serve brdf " + brdf, "use auto or one of: " + serving);
}

}  // namespace steradian::eval
