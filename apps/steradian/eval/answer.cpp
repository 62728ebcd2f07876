#include "eval/answer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrals/curved_light.h"
#include "integrals/point_light.h"
#include "eval/shadowed.h"
#include "steradian/error.h"
#include "steradian/polygon_derivatives.h"

namespace steradian::eval {
namespace {

// The light made ready, whatever its type; the errors are placed at the query's key.
PreparedPolygon prepare(const PolygonLight& light) {
  try {
    return prepare_polygon(light);
  } catch (const Error& e) {
    throw Error("light." + e.place(), e.problem(), e.hint());
  }
}

// A point light is one direction: every method has the same answer, without error.
RadianceResult point_answer(const PointLight& light, const ShadingPoint& at, const Material& m, Method method) {
  RadianceResult answer = methods::nothing(method);
  answer.radiance = methods::point_light_radiance(light, at, m);
  return answer;
}

// Adds what one material contributes to the derivatives. Throws Error for lobes and methods that have none.
void add_derivatives(Answer& answer, const PolygonLight& light, const ShadingPoint& at, const Material& m, const methods::Row& entry,
                     Quality quality) {
  if (entry.derivatives == nullptr)
    throw Error("derivatives", std::string("brdf ") + name_of(m.brdf) + " has none by " + entry.name, "use auto");
  const RadianceDerivatives d = entry.derivatives(light, at, m, quality);
  if (!answer.derivatives) answer.derivatives.emplace(d.vertices.size());
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
    // The lobes are sampled with seeds of their own: variances add.
    if (part.standard_error) answer_.standard_error = std::hypot(answer_.standard_error.value_or(0.0), *part.standard_error);
  }
  Answer& answer() { return answer_; }
  Answer finish(Precision precision) && {
    answer_.precision = precision;
    const bool error_is_finite = std::isfinite(answer_.bound.value_or(0.0)) && std::isfinite(answer_.standard_error.value_or(0.0));
    // What is printed as a float must be one.
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

Answer evaluate(const Query& query) {
  const ShadingPoint at = {query.position, query.normal, query.view.value_or(query.normal)};
  const bool seen = dot(at.normal, at.view) > 0.0;
  RadianceOptions options = {query.method, query.quality, query.precision, query.spp, query.seed};

  const auto* light = std::get_if<AreaLight>(&query.light);
  const bool is_polygon = light != nullptr && std::holds_alternative<Polygon>(light->shape);
  const PolygonLight polygon = is_polygon ? flat_polygon(*light) : PolygonLight{};
  const PreparedPolygon prepared = is_polygon ? prepare(polygon) : PreparedPolygon{};
  if (query.derivatives && !is_polygon) throw Error("derivatives", "only polygons and rects have vertices", "leave the key out");
  if (query.derivatives && query.occluders != nullptr)
    throw Error("derivatives", "there are none past occluders yet", "leave one of the keys out");
  Sum sum;
  for (const Material& material : query.materials) {
    const methods::Row& entry = methods::resolve(query.method, material, query.precision, query.quality);
    if (query.derivatives) add_derivatives(sum.answer(), polygon, at, material, entry, query.quality);
    const auto unoccluded = [&] {
      if (is_polygon) return entry.polygon(prepared, at, material, options);
      if (light != nullptr) return methods::curved_light_answer(*light, at, material, entry, options);
      return point_answer(std::get<PointLight>(query.light), at, material, entry.method);
    };
    if (!seen)
      sum.add(entry, methods::nothing(entry.method));
    else if (query.occluders != nullptr)
      sum.add(entry, shadowed_answer(query, at, material, entry, options, unoccluded));
    else
      sum.add(entry, unoccluded());
    options.seed += 0x9e3779b97f4a7c15u;  // far from the seeds that people choose
  }
  return std::move(sum).finish(query.precision);
}

bool answer_line(QueryReader& reader, std::string_view line, std::string& out) {
  try {
    write_answer(out, evaluate(reader.read(line)));
    return true;
  } catch (const Error& e) {
    write_error(out, e.what());
    return false;
  }
}

}  // namespace steradian::eval
