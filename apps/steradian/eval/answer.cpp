#include "eval/answer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "eval/derivatives.h"
#include "eval/exchange.h"
#include "eval/shadowed.h"
#include "integrals/curved_light.h"
#include "integrals/point_light.h"
#include "steradian/error.h"

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
  const PreparedPolygon prepared = is_polygon ? prepare(flat_polygon(*light)) : PreparedPolygon{};
  for (const Material& material : query.materials) {
    const methods::Row& entry = methods::resolve(query.method, material, query.precision, query.quality);
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

}  // namespace

Answer evaluate(const Query& query) {
  const ShadingPoint at = {query.position, query.normal, query.view.value_or(query.normal)};
  RadianceOptions options = {query.method, query.quality, query.precision, query.spp,
                             query.seed,   query.table,   query.peak_form, query.early_stop};
  Sum sum;
  for (const Light& light : query.lights) {
    add_light(sum, query, light, at, options);
    options.seed += 0xd1342543de82ef95u;  // no two lobes of different lights share a seed
  }
  if (query.derivatives) sum.answer().derivatives = derivatives_of(query);
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
