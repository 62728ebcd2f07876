#include "integrals/methods.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "integrals/curved_light.h"
#include "integrals/ggx/charlie.h"
#include "integrals/ggx/ltc_radiance.h"
#include "integrals/phong/matched_lobe.h"
#include "integrals/tables/table.h"
#include "shapes/polygon.h"
#include "steradian/closed_form.h"
#include "steradian/error.h"
#include "steradian/half_vector.h"
#include "steradian/kernels.h"
#include "steradian/ltc.h"
#include "steradian/phong.h"
#include "steradian/radiance.h"
#include "steradian/reference.h"

namespace steradian::methods {
namespace {

bool every_lobe(const Material&) { return true; }
bool phong_lobes(const Material& m) { return m.brdf == Brdf::phong; }
bool plain_phong(const Material& m) { return m.brdf == Brdf::phong && !m.foreshortening; }
bool ggx_lobes(const Material& m) { return m.brdf == Brdf::ggx; }
bool sheen(const Material& m) { return m.brdf == Brdf::charlie; }
bool products(const Material& m) { return m.brdf == Brdf::lobe_product; }
bool half_vector_lobes(const Material& m) { return m.brdf == Brdf::blinn_phong || m.brdf == Brdf::beckmann || m.brdf == Brdf::ggx; }
bool exact_lobes(const Material& m) {
  return m.brdf == Brdf::lambert || m.brdf == Brdf::phong || (m.brdf == Brdf::ggx && !m.shadowing && m.f0 == m.f90);
}
bool phong_of_integer_exponent(const Material& m) {
  return m.brdf == Brdf::phong && m.exponent == std::floor(m.exponent) && m.exponent < 1e9;
}
template <Method method>
bool ltc_lobes(const Material& m) {
  return steradian::serves(*ltc_method(method, Quality::normal), m);
}

RadianceResult answer(Method method, Vec3d radiance) { return {radiance, std::nullopt, std::nullopt, method}; }

template <class S>
Vec3d lambert(S irradiance, Vec3d radiance, Vec3d albedo) {
  const S factor = Kernels<S>().lambert_radiance(Real<S>::of(irradiance)).v;
  return Vec3d(Vector3<S>(radiance) * Vector3<S>(albedo) * factor);
}

template <Method method>
RadianceResult phong(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, const RadianceOptions& options) {
  const PhongOptions o{method, options.quality, options.early_stop, options.peak_form};
  return answer(method,
                options.precision == Precision::float_ ? Vec3d(phong_radiance_float(light, at, m, o)) : phong_radiance(light, at, m, o));
}

RadianceResult exact(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, const RadianceOptions& options) {
  const bool in_float = options.precision == Precision::float_;
  if (m.brdf == Brdf::phong) return phong<Method::exact>(light, at, m, options);
  if (m.brdf == Brdf::ggx)
    return answer(Method::exact, in_float ? exact_ggx_radiance_float(light, at, m) : exact_ggx_radiance(light, at, m));
  return answer(Method::exact, in_float ? lambert(polygon_irradiance_float(light, at.position, at.normal), light.radiance, m.albedo)
                                        : lambert(polygon_irradiance(light, at.position, at.normal), light.radiance, m.albedo));
}

RadianceResult closed_form(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, const RadianceOptions& options) {
  const auto evaluate = options.precision == Precision::float_ ? closed_form_radiance_float : closed_form_radiance;
  return answer(Method::closed_form, evaluate(light, at, m, options.quality));
}

RadianceResult half_vector(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, const RadianceOptions& options) {
  const auto evaluate = options.precision == Precision::float_ ? half_vector_radiance_float : half_vector_radiance;
  return answer(Method::half_vector, evaluate(light, at, m, half_vector_options(options.quality)));
}

template <Method method>
RadianceResult ltc(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, const RadianceOptions& options) {
  if (method == Method::ltc && options.table != nullptr) {
    const auto by = options.precision == Precision::float_ ? ltc_radiance_by_float : ltc_radiance_by;
    return answer(method, by(*options.table, light, at, m));
  }
  const auto evaluate = options.precision == Precision::float_ ? ltc_radiance_float : ltc_radiance;
  return answer(method, evaluate(*ltc_method(method, options.quality), light, at, m));
}

template <Method method>
Vec3d ltc_lobe(Vec3d direction, const ShadingPoint& at, const Material& m, const RadianceOptions& options) {
  const auto evaluate = options.precision == Precision::float_ ? ltc_towards_float : ltc_towards;
  return evaluate(*ltc_method(method, options.quality), direction, at, m, method == Method::ltc ? options.table.get() : nullptr);
}

template <class S>
double sheen_radiance(const PreparedPolygon& light, const ShadingPoint& at, double alpha) {
  const Frame frame = Frame::from_normal(at.normal);
  integrals::CharlieIntegral<S> integral;
  integral.alpha = alpha;
  using integrals::to_kernel;
  const auto shading = integrals::shading_from<S>(shapes::lit_side(light, at.position), to_kernel<S>(frame.to_local(at.view)));
  return static_cast<double>(integrate(integrals::contours_in<S>(light, frame, at.position), shading, integral).x.v);
}

RadianceResult cubature(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, const RadianceOptions& options) {
  const auto evaluate = options.precision == Precision::float_ ? sheen_radiance<float> : sheen_radiance<double>;
  return answer(Method::cubature, light.radiance * m.albedo * evaluate(light, at, m.alpha_x));
}

template <class S>
double matched_lobe_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, Quality quality) {
  const Frame frame = Frame::from_normal(at.normal);
  using integrals::to_kernel;
  const auto in_frame = [&](Vec3d axis) { return to_kernel<S>(axis == Vec3d{} ? Vec3d{0, 0, 1} : normalized(frame.to_local(axis))); };
  std::vector<lobes::ProductFactor<S>> axes = {{in_frame(m.axis), m.axis_exponent}};
  for (const AxisPower& f : m.factors) axes.push_back({in_frame(f.axis), f.exponent});
  integrals::MatchedLobe<S> integral(m.exponent, std::move(axes), quality);
  const auto shading = integrals::shading_from<S>(shapes::lit_side(light, at.position), to_kernel<S>(frame.to_local(at.view)));
  return static_cast<double>(integrate(integrals::contours_in<S>(light, frame, at.position), shading, integral).x.v);
}

RadianceResult matched_lobe(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, const RadianceOptions& options) {
  const double r = options.precision == Precision::float_ ? matched_lobe_radiance<float>(light, at, m, options.quality)
                                                          : matched_lobe_radiance<double>(light, at, m, options.quality);
  return answer(Method::matched_lobe, light.radiance * m.albedo * r);
}

RadianceResult reference(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, const RadianceOptions&) {
  const ReferenceResult r = reference_radiance(light, at, m);
  return {r.radiance, r.bound, std::nullopt, Method::reference};
}

RadianceResult sampled(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, const RadianceOptions& options) {
  const SampledResult r = sampled_radiance(light, at, m, {options.spp, options.seed});
  return {r.radiance, std::nullopt, r.standard_error, Method::sampled};
}

LobeDensity any_density(const ShadingPoint& at, const Material& m, Quality) { return lobe_density(at, m); }

template <Method method>
RadianceDerivatives ltc_derivatives(const PolygonLight& light, const ShadingPoint& at, const Material& m, Quality quality) {
  return ltc_radiance_derivatives(*ltc_method(method, quality), light, at, m);
}

template <Method method>
LobeDensity ltc_density(const ShadingPoint& at, const Material& m, Quality quality) {
  return ltc_lobe_density(*ltc_method(method, quality), at, m);
}

constexpr const char* kNoQualities = "";

// A new method is a row here and a name in include/steradian/method.h.
constexpr Row kMethods[] = {
    {Method::series, "series", "phong", phong_lobes, true, "normal, high", "1.3e-3; high: 4.5e-4", "constant an edge",
     Procedure::phong_lobe, phong<Method::series>, radiance_derivatives, any_density},
    {Method::exact, "exact", "lambert; phong; ggx without shadowing and with f0 = f90", exact_lobes, true, kNoQualities,
     "rounding; phong: 1e-10", "phong: quadrature", Procedure::diffuse, exact, radiance_derivatives, any_density},
    {Method::arvo, "arvo", "phong with an integer exponent", phong_of_integer_exponent, true, kNoQualities, "rounding",
     "grows with exponent", Procedure::phong_lobe, phong<Method::arvo>, radiance_derivatives, any_density},
    {Method::lorentzian, "lorentzian", "phong without foreshortening", plain_phong, true, kNoQualities, "1e-2", "constant an edge",
     Procedure::phong_lobe, phong<Method::lorentzian>},
    {Method::pearson, "pearson", "phong without foreshortening", plain_phong, true, kNoQualities, "1e-2", "constant an edge",
     Procedure::phong_lobe, phong<Method::pearson>},
    {Method::ellipsoid, "ellipsoid", "phong without foreshortening", plain_phong, true, kNoQualities, "1e-2", "constant an edge",
     Procedure::phong_lobe, phong<Method::ellipsoid>},
    {Method::closed_form, "closed-form", "ggx", ggx_lobes, true, "draft, normal, high", "0.1 to 0.2 % rms", "constant an edge",
     Procedure::closed_form, closed_form, radiance_derivatives, any_density},
    {Method::ltc, "ltc", "ggx, isotropic, with shadowing", ltc_lobes<Method::ltc>, true, "normal, high", "3 % rms; high: 2 %; points: 16 %",
     "constant an edge", Procedure::ltc, ltc<Method::ltc>, ltc_derivatives<Method::ltc>, ltc_density<Method::ltc>, ltc_lobe<Method::ltc>},
    {Method::ltc_compact, "ltc-compact", "ggx, isotropic, with shadowing", ltc_lobes<Method::ltc_compact>, true, kNoQualities,
     "3 % rms; points: 16 %", "constant an edge", Procedure::ltc, ltc<Method::ltc_compact>, ltc_derivatives<Method::ltc_compact>,
     ltc_density<Method::ltc_compact>, ltc_lobe<Method::ltc_compact>},
    {Method::ltc_clipless, "ltc-clipless", "ggx, isotropic, with shadowing", ltc_lobes<Method::ltc_clipless>, true, kNoQualities,
     "above ltc's at the horizon; points: 16 %", "constant an edge", Procedure::ltc_clipless, ltc<Method::ltc_clipless>, nullptr, nullptr,
     ltc_lobe<Method::ltc_clipless>},
    {Method::representative_point, "representative-point", "ggx, isotropic, with shadowing", ltc_lobes<Method::representative_point>, true,
     kNoQualities, "no bound; for comparison", "constant", Procedure::representative_point, ltc<Method::representative_point>},
    {Method::half_vector, "half-vector", "blinn-phong; beckmann; ggx", half_vector_lobes, true, "draft, normal, high",
     "0.02 %; ggx: closed-form's", "3, 4 or 8 arcs", Procedure::half_vector, half_vector, nullptr, any_density},
    {Method::matched_lobe, "matched-lobe", "lobe-product", products, true, "normal, high", "1 % of most lights", "constant an edge",
     Procedure::none, matched_lobe, nullptr, any_density},
    {Method::cubature, "cubature", "charlie", sheen, true, kNoQualities, "0.1 %; large lights 0.4 %", "a few nodes", Procedure::sheen,
     cubature, nullptr, any_density},
    {Method::reference, "reference", "all", every_lobe, false, kNoQualities, "printed bound", "adaptive quadrature", Procedure::none,
     reference, nullptr, any_density},
    {Method::sampled, "sampled", "all", every_lobe, false, kNoQualities, "printed standard error", "grows with --spp", Procedure::none,
     sampled, nullptr, any_density},
};

}  // namespace

std::span<const Row> all() { return kMethods; }

const Row& row_of(Method method) {
  for (const Row& row : kMethods)
    if (row.method == method) return row;
  throw Error("method", "auto stands for no method of its own");
}

Procedure procedure_of(Method method, Brdf brdf) {
  if (method != Method::exact) return row_of(method).procedure;
  return brdf == Brdf::phong ? Procedure::phong_lobe : brdf == Brdf::ggx ? Procedure::closed_form : row_of(method).procedure;
}

const Row* find(Method method, const Material& lobe, Quality quality) {
  for (const Row& row : kMethods) {
    if (method != Method::automatic && method != row.method) continue;
    if (!row.serves(lobe)) continue;
    if (method == Method::automatic && row.method == Method::closed_form && quality == Quality::draft &&
        ltc_lobes<Method::ltc_compact>(lobe))
      return &row_of(Method::ltc_compact);
    return &row;
  }
  return nullptr;
}

const Row& resolve(Method method, const Material& lobe, Precision precision, Quality quality) {
  const Row* row = find(method, lobe, quality);
  const std::string brdf = name_of(lobe.brdf);
  if (row == nullptr) {
    std::string serving;
    for (const Row& r : kMethods)
      if (r.serves(lobe)) serving += (serving.empty() ? "" : ", ") + std::string(r.name);
    throw Error("method", std::string(name_of(method)) + " does not serve brdf " + brdf, "use auto or one of: " + serving);
  }
  if (precision == Precision::float_ && !row->in_float)
    throw Error("precision", std::string("method ") + row->name + " works in double only for brdf " + brdf, "leave precision out");
  return *row;
}

RadianceResult nothing(Method method) {
  RadianceResult result;
  result.method = method;
  if (method == Method::reference) result.bound = 0.0;
  if (method == Method::sampled) result.standard_error = 0.0;
  return result;
}

std::string names() {
  std::string names = "auto";
  for (const Row& row : kMethods) names += std::string(", ") + row.name;
  return names;
}

}  // namespace steradian::methods

namespace steradian {

namespace {

// A unit vector. One that is already unit, within its rounding, stays as it is to the last bit.
Vec3d unit(Vec3d v) { return std::fabs(dot(v, v) - 1) <= 8 * std::numeric_limits<double>::epsilon() ? v : normalized(v); }
ShadingPoint with_unit_vectors(const ShadingPoint& at) { return {at.position, unit(at.normal), unit(at.view)}; }

}  // namespace

RadianceResult radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& lobe, const RadianceOptions& options) {
  const methods::Row& row = methods::resolve(options.method, lobe, options.precision, options.quality);
  if (!(dot(at.normal, at.view) > 0)) return methods::nothing(row.method);
  return row.polygon(light, with_unit_vectors(at), lobe, options);
}

RadianceResult radiance(const PolygonLight& light, const ShadingPoint& at, const Material& lobe, const RadianceOptions& options) {
  return radiance(prepare_polygon(light), at, lobe, options);
}

const char* name_of(Method method) { return method == Method::automatic ? "auto" : methods::row_of(method).name; }

std::optional<Method> method_of(std::string_view name) {
  if (name == "auto") return Method::automatic;
  for (const methods::Row& row : methods::all())
    if (name == row.name) return row.method;
  return std::nullopt;
}

// radiance() of lights of every shape.

RadianceResult radiance(const AreaLight& light, const ShadingPoint& at, const Material& lobe, const RadianceOptions& options) {
  if (std::holds_alternative<Polygon>(light.shape) && !light.emission) return radiance(flat_polygon(light), at, lobe, options);
  const methods::Row& row = methods::resolve(options.method, lobe, options.precision, options.quality);
  if (!(dot(at.normal, at.view) > 0)) return methods::nothing(row.method);
  RadianceResult result = methods::curved_light_answer(light, with_unit_vectors(at), lobe, row, options);
  result.method = row.method;
  return result;
}

}  // namespace steradian
