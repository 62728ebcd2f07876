#include "eval/answer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "eval/exchange.h"
#include "eval/shadowed.h"
#include "integrals/curved_light.h"
#include "integrals/point_light.h"
#include "steradian/error.h"
#include "steradian/polygon_derivatives.h"

namespace steradian::eval {
namespace {

// Prepares a light of any type. Errors name the query's key.
PreparedPolygon prepare(const PolygonLight& light) {
  try {
    return prepare_polygon(light);
  } catch (const Error& e) {
    throw Error("light." + e.place(), e.problem(), e.hint());
  }
}

// A light without extent is a single direction: a method gives its lobe there, without error if that is the material's.
RadianceResult point_answer(const Light& light, const ShadingPoint& at, const Material& m, const methods::Row& entry,
                            const RadianceOptions& options) {
  RadianceResult answer = methods::nothing(entry.method);
  const auto* point = std::get_if<PointLight>(&light);
  answer.radiance = point != nullptr ? methods::point_light_radiance(*point, at, m, entry, options)
                                     : methods::directional_light_radiance(std::get<DirectionalLight>(light), at, m, entry, options);
  return answer;
}

using ByChannel = std::array<Vec3d, 3>;

void add(ByChannel& to, const ByChannel& v) {
  for (std::size_t channel = 0; channel < 3; ++channel) to[channel] += v[channel];
}

ShadowedDerivatives unoccluded_derivatives(const Query& query, const PolygonLight& light, const ShadingPoint& at, const Material& m,
                                           const methods::Row& entry) {
  const RadianceDerivatives d = entry.derivatives(light, at, m, query.quality);
  return {d, by_position(d), {}};
}

// Adds one material's contribution to the derivatives. Throws Error for unsupported lobes and methods.
void add_derivatives(Answer& answer, const Query& query, const PolygonLight& light, const ShadingPoint& at, const Material& m,
                     const methods::Row& entry) {
  if (entry.derivatives == nullptr)
    throw Error("derivatives", std::string("brdf ") + name_of(m.brdf) + " has none by " + entry.name, "use auto");
  const auto [d, position, occluders] =
      query.occluders != nullptr ? shadowed_derivatives(query, light, m, entry) : unoccluded_derivatives(query, light, at, m, entry);
  if (!answer.derivatives) answer.derivatives.emplace(d.vertices.size());
  add(answer.by_position, position);
  if (query.occluders_are_listed) {
    answer.by_occluders.resize(occluders.size());
    for (std::size_t i = 0; i < occluders.size(); ++i) add(answer.by_occluders[i], occluders[i]);
  }
  for (std::size_t channel = 0; channel < 3; ++channel) {
    answer.derivatives->normal[channel] += d.normal[channel];
    for (std::size_t i = 0; i < d.vertices.size(); ++i) answer.derivatives->vertices[i][channel] += d.vertices[i][channel];
  }
}

class Sum {
 public:
  void add(const methods::Row& entry, const RadianceResult& part) {
    if (answer_.method.find(entry.name) == std::string::npos) {
      if (!answer_.method.empty()) answer_.method += '+';
      answer_.method += entry.name;
    }
    answer_.radiance += part.radiance;
    if (part.bound) answer_.bound = answer_.bound.value_or(0.0) + *part.bound;
    // The lobes are sampled with different seeds, so variances add.
    if (part.standard_error) answer_.standard_error = std::hypot(answer_.standard_error.value_or(0.0), *part.standard_error);
  }
  Answer& answer() { return answer_; }
  Answer finish(Precision precision) && {
    answer_.precision = precision;
    const bool error_is_finite = std::isfinite(answer_.bound.value_or(0.0)) && std::isfinite(answer_.standard_error.value_or(0.0));
    // Values that are printed as floats must fit into a float.
    const Vec3d r = answer_.radiance;
    const double largest = std::max({std::fabs(r.x), std::fabs(r.y), std::fabs(r.z)});
    const bool fits = precision == Precision::double_ || largest <= static_cast<double>(std::numeric_limits<float>::max());
    if (!is_finite(r) || !fits || !error_is_finite)
      throw Error("radiance", "the result is out of the range of numbers", "scale radiance, intensity, albedo or distances down");
    return std::move(answer_);
  }

 private:
  Answer answer_;
};

}  // namespace

namespace {

// Adds the answers of every lobe for one of the query's lights.
void add_light(Sum& sum, const Query& query, const Light& source, const ShadingPoint& at, RadianceOptions options) {
  const bool seen = dot(at.normal, at.view) > 0.0;
  const auto* light = std::get_if<AreaLight>(&source);
  const bool is_polygon = light != nullptr && std::holds_alternative<Polygon>(light->shape) && !light->emission;
  const PolygonLight polygon = is_polygon ? flat_polygon(*light) : PolygonLight{};
  const PreparedPolygon prepared = is_polygon ? prepare(polygon) : PreparedPolygon{};
  for (const Material& material : query.materials) {
    const methods::Row& entry = methods::resolve(query.method, material, query.precision, query.quality);
    if (query.derivatives) add_derivatives(sum.answer(), query, polygon, at, material, entry);
    const auto unoccluded = [&] {
      if (is_polygon) return entry.polygon(prepared, at, material, options);
      if (light != nullptr) return methods::curved_light_answer(*light, at, material, entry, options);
      return point_answer(source, at, material, entry, options);
    };
    if (!seen)
      sum.add(entry, methods::nothing(entry.method));
    else if (query.occluders != nullptr)
      sum.add(entry, shadowed_answer(query, source, at, material, entry, options, unoccluded));
    else
      sum.add(entry, unoccluded());
    options.seed += 0x9e3779b97f4a7c15u;  // far from the seeds that people choose
  }
}

void check_derivatives(const Query& query) {
  if (!query.derivatives) return;
  const auto* light = std::get_if<AreaLight>(&query.lights.front());
  if (query.lights.size() > 1) throw Error("derivatives", "there are none of a list of lights", "ask for each light in a line of its own");
  if (light != nullptr && light->emission) throw Error("derivatives", "there are none of a light with a profile", "leave the key out");
  if (light == nullptr || !std::holds_alternative<Polygon>(light->shape))
    throw Error("derivatives", "only polygons and rects have vertices", "leave the key out");
}

// The radiance of the query with one value changed, in double.
Vec3d radiance_with(Query query) {
  query.derivatives = false;
  query.precision = Precision::double_;
  return evaluate(query).radiance;
}

// The result is linear in the light's radiance and in F0, so these derivatives are exact. The derivative by the roughness r is the central
// difference of step 1e-4 r. It is off by 1e-8 of the third derivative and by a rounding over the step.
ParameterDerivatives parameter_derivatives(const Query& query) {
  ParameterDerivatives result;
  Query changed = query;
  std::get<AreaLight>(changed.lights.front()).radiance = {1, 1, 1};
  result.radiance = radiance_with(changed);
  if (query.materials.size() != 1) return result;
  const Material& m = query.materials.front();
  if (m.brdf == Brdf::ggx && !m.multiple_scattering) {
    changed = query;
    changed.materials.front().f0 = {1, 1, 1};
    changed.materials.front().f90 = {0, 0, 0};
    result.f0 = radiance_with(changed);
  }
  if ((m.brdf == Brdf::ggx || m.brdf == Brdf::beckmann || m.brdf == Brdf::charlie) && m.alpha_x == m.alpha_y) {
    const double r = std::sqrt(m.alpha_x), high = r * (1 + 1e-4), low = std::max(r * (1 - 1e-4), std::sqrt(kSmallestAlpha));
    const auto at = [&](double roughness) {
      changed = query;
      changed.materials.front().alpha_x = changed.materials.front().alpha_y = alpha_from_roughness(roughness);
      return radiance_with(changed);
    };
    result.roughness = (at(high) - at(low)) / (high - low);
  }
  return result;
}

// The derivative by the normal past occluders, as a direction: the central difference of a rotation by 1e-3. It is off by 1e-6 of the third
// derivative. Where the horizon cuts the light, it is off by 2e-4 of the light, since the horizon moves by whole cells (docs/shadows.md).
// If no geometric normal is given, the normal also is that of the query's triangle.
ByChannel by_normal_past_occluders(const Query& query) {
  constexpr double kTurn = 1e-3;
  const Frame frame = Frame::from_normal(query.normal);
  ByChannel result{};
  for (const Vec3d& axis : {frame.x, frame.y}) {
    const auto turned = [&](double angle) {
      Query changed = query;
      changed.normal = query.normal * std::cos(angle) + axis * std::sin(angle);
      return radiance_with(changed);
    };
    const Vec3d slope = (turned(kTurn) - turned(-kTurn)) / (2 * kTurn);
    add(result, {axis * slope.x, axis * slope.y, axis * slope.z});
  }
  return result;
}

}  // namespace

Answer evaluate(const Query& query) {
  const ShadingPoint at = {query.position, query.normal, query.view.value_or(query.normal)};
  check_derivatives(query);
  RadianceOptions options = {query.method, query.quality, query.precision, query.spp,
                             query.seed,   query.table,   query.peak_form, query.early_stop};
  Sum sum;
  for (const Light& light : query.lights) {
    add_light(sum, query, light, at, options);
    options.seed += 0xd1342543de82ef95u;  // no two lobes of different lights share a seed
  }
  if (query.derivatives) sum.answer().parameters = parameter_derivatives(query);
  if (query.derivatives && query.occluders != nullptr) sum.answer().derivatives->normal = by_normal_past_occluders(query);
  return std::move(sum).finish(query.precision);
}

bool answer_line(QueryReader& reader, std::string_view line, std::string& out) {
  if (const std::optional<bool> exchange = answer_exchange(line, out)) return *exchange;
  try {
    const Query query = reader.read(line);  // before id() is read
    write_answer(out, evaluate(query), reader.id());
    return true;
  } catch (const Error& e) {
    write_error(out, e.what(), reader.id());
    return false;
  }
}

}  // namespace steradian::eval
