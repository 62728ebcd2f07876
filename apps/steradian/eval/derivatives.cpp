#include "eval/derivatives.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "eval/answer.h"
#include "eval/shadowed.h"
#include "integrals/differences.h"
#include "integrals/light_derivatives.h"
#include "steradian/error.h"

namespace steradian::eval {
namespace {

using ByChannel = std::array<Vec3d, 3>;
using Form = Derivative::Form;

void add(ByChannel& to, const ByChannel& v) {
  for (std::size_t channel = 0; channel < 3; ++channel) to[channel] += v[channel];
}
void add(std::vector<ByChannel>& to, const std::vector<ByChannel>& v) {
  to.resize(std::max(to.size(), v.size()));
  for (std::size_t i = 0; i < v.size(); ++i) add(to[i], v[i]);
}

ByChannel numbers(Vec3d by_channel) { return {Vec3d{by_channel.x, 0, 0}, Vec3d{by_channel.y, 0, 0}, Vec3d{by_channel.z, 0, 0}}; }

// The radiance of the query with one value changed, in double and without noise.
Vec3d radiance_with(Query query) {
  query.derivatives = false;
  query.precision = Precision::double_;
  if (query.method == Method::sampled) query.method = Method::automatic;
  return evaluate(query).radiance;
}
template <class Change>
Vec3d radiance_after(const Query& query, const Change& change) {
  Query changed = query;
  change(changed);
  return radiance_with(std::move(changed));
}

double narrowest_width(const Query& query) {
  const ShadingPoint at = {query.position, query.normal, query.view.value_or(query.normal)};
  double width = 1;
  for (const Material& m : query.materials) width = std::min(width, methods::narrowest_width(m, at));
  return width;
}

// ---- Derivatives by differences of the answer ------------------------------------------------------------------

// The derivatives by a vector of the query: Vec3d& member(Query&).
template <class Member>
ByChannel by_vector(const Query& query, double step, const Member& member) {
  ByChannel result{};
  for (double Vec3d::*axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
    const Vec3d slope =
        methods::by_number(step, [&](double by) { return radiance_after(query, [&](Query& q) { member(q).*axis += by; }); });
    result[0].*axis = slope.x;
    result[1].*axis = slope.y;
    result[2].*axis = slope.z;
  }
  return result;
}

template <class Member>
ByChannel by_direction(const Query& query, double step, const Member& member) {
  return methods::by_direction(query.*member, step, [&](Vec3d v) { return radiance_after(query, [&](Query& q) { q.*member = v; }); });
}

// Past occluders, the horizon moves by whole cells (docs/shadows.md). So the turn is 1e-3, and where the horizon cuts the light, the
// derivative is off by 2e-4 of the light. Without a geometric normal, the normal also is that of the query's triangle.
constexpr double kTurnPastOccluders = 1e-3;

double turn_of(const Query& query) { return query.occluders != nullptr ? kTurnPastOccluders : methods::kStep * narrowest_width(query); }

// Lights without an outline: points and parallel light.
void add_differences(std::vector<Derivative>& result, const Query& query) {
  const Light& light = query.lights.front();
  const double relative = methods::kStep * narrowest_width(query);
  const auto distance = [&](Vec3d p) { return std::max(length(p - query.position), 1e-300); };
  if (const auto* point = std::get_if<PointLight>(&light)) {
    const double step = relative * distance(point->position);
    const ByChannel by_place = by_vector(query, step, [](Query& q) -> Vec3d& { return std::get<PointLight>(q.lights.front()).position; });
    result.push_back({"d_light_position", Form::vector, {by_place}});
    result.push_back({"d_position", Form::vector, {{-by_place[0], -by_place[1], -by_place[2]}}});
  } else if (const auto* sun = std::get_if<DirectionalLight>(&light)) {
    const ByChannel by_direction = methods::by_direction(sun->direction, relative, [&](Vec3d v) {
      return radiance_after(query, [&](Query& q) { std::get<DirectionalLight>(q.lights.front()).direction = v; });
    });
    result.push_back({"d_direction", Form::vector, {by_direction}});
    result.push_back({"d_position", Form::vector, {ByChannel{}}});
  }
  result.push_back({"d_normal", Form::vector, {by_direction(query, turn_of(query), &Query::normal)}});
  if (query.view) {
    const ByChannel by_view =
        methods::by_direction(*query.view, turn_of(query), [&](Vec3d v) { return radiance_after(query, [&](Query& q) { q.view = v; }); });
    result.push_back({"d_view", Form::vector, {by_view}});
  }
}

// ---- Derivatives by the light's outline ------------------------------------------------------------------------

// By the keys of the query's light.
void add_shape(std::vector<Derivative>& result, const std::string_view type, const OutlineDerivatives& d) {
  const std::vector<ByChannel>& v = d.by_vector;
  const auto sum_of = [&](std::initializer_list<double> factors) {
    ByChannel sum{};
    std::size_t i = 0;
    for (const double factor : factors) {
      for (std::size_t c = 0; c < 3; ++c) sum[c] += v[i][c] * factor;
      ++i;
    }
    return sum;
  };
  if (type == "polygon" || type == "rect") result.push_back({"d_vertices", Form::vectors, v});
  if (type == "rect") {
    result.push_back({"d_center", Form::vector, {sum_of({1, 1, 1, 1})}});
    result.push_back({"d_x", Form::vector, {sum_of({-1, 1, 1, -1})}});
    result.push_back({"d_y", Form::vector, {sum_of({-1, -1, 1, 1})}});
  }
  if (type == "disk" || type == "ellipsoid" || type == "sphere") result.push_back({"d_center", Form::vector, {v[0]}});
  if (type == "disk" || type == "ellipsoid") {
    result.push_back({"d_x", Form::vector, {v[1]}});
    result.push_back({"d_y", Form::vector, {v[2]}});
  }
  if (type == "ellipsoid") result.push_back({"d_z", Form::vector, {v[3]}});
  if (type == "sphere") {
    const auto by_radius = [&](std::size_t c) { return v[1][c].x + v[2][c].y + v[3][c].z; };
    result.push_back({"d_radius", Form::number, {numbers({by_radius(0), by_radius(1), by_radius(2)})}});
  }
  if (type == "capsule" || type == "line") result.push_back({"d_ends", Form::vectors, v});
  if (type == "capsule") {
    result.push_back({"d_radius", Form::number, {numbers(d.by_radius)}});
  }
}

void add_outline(std::vector<Derivative>& result, const Query& query, const AreaLight& light) {
  const ShadingPoint at = {query.position, query.normal, query.view.value_or(query.normal)};
  const RadianceOptions options = {query.method, query.quality, query.precision, query.spp,
                                   query.seed,   query.table,   query.peak_form, query.early_stop};
  methods::LightDerivativesOfLobe sum;
  std::vector<ByChannel> by_occluders;
  for (const Material& m : query.materials) {
    const methods::Row& row = methods::resolve(query.method, m, query.precision, query.quality);
    methods::LightDerivativesOfLobe d;
    if (query.occluders == nullptr) {
      d = methods::light_derivatives(light, at, m, row, options);
    } else {
      ShadowedDerivatives past = shadowed_derivatives(query, light, m, row);
      d.light = std::move(past.light);
      add(by_occluders, past.occluders);
    }
    add(sum.light.by_vector, d.light.by_vector);
    sum.light.by_radius += d.light.by_radius;
    add(sum.light.position, d.light.position);
    add(sum.normal, d.normal);
    add(sum.view, d.view);
  }
  if (query.occluders != nullptr) {
    sum.normal = by_direction(query, kTurnPastOccluders, &Query::normal);
    if (query.view)
      sum.view = methods::by_direction(*query.view, kTurnPastOccluders,
                                       [&](Vec3d v) { return radiance_after(query, [&](Query& q) { q.view = v; }); });
  }
  add_shape(result, std::holds_alternative<Line>(light.shape) ? "line" : query.light_type, sum.light);
  result.push_back({"d_position", Form::vector, {sum.light.position}});
  result.push_back({"d_normal", Form::vector, {sum.normal}});
  if (query.view) result.push_back({"d_view", Form::vector, {sum.view}});
  if (query.occluders_are_listed && !by_occluders.empty()) result.push_back({"d_occluders", Form::vectors, std::move(by_occluders)});
}

// ---- Derivatives by the numbers of light and lobe ---------------------------------------------------------------

// The result is linear in what a light sends: so these are exact.
Derivative by_emission(const Query& query) {
  struct SetToOne {
    const char* operator()(AreaLight& l) const { return l.radiance = {1, 1, 1}, "d_radiance"; }
    const char* operator()(PointLight& l) const { return l.intensity = {1, 1, 1}, "d_intensity"; }
    const char* operator()(DirectionalLight& l) const { return l.illuminance = {1, 1, 1}, "d_illuminance"; }
  };
  Query changed = query;
  const char* key = std::visit(SetToOne(), changed.lights.front());
  return {key, Form::number, {numbers(radiance_with(std::move(changed)))}};
}

// Central differences by a number of the lobe; at the ends of its range, of one side.
template <class Set>
std::optional<Vec3d> by_number_of_lobe(const Query& query, double value, double least, double scale, const Set& set) {
  const double step = methods::kStep * scale;
  const Material& m = query.materials.front();
  const methods::Row& row = methods::resolve(query.method, m, query.precision, query.quality);
  Material moved = m;
  set(moved, value + step);
  // Some methods serve only some values, such as whole exponents.
  if (!row.serves(moved)) return {};
  const auto at = [&](double x) {
    return radiance_after(query, [&](Query& q) {
      const methods::FineMethod fine = methods::fine_method(row.method, query.quality);
      q.method = fine.method;
      q.quality = fine.quality;
      set(q.materials.front(), x);
    });
  };
  if (value - 2 * step >= least) return methods::by_number(step, [&](double by) { return at(value + by); });
  const double low = std::max(value, least);
  return (at(low + step) * 4.0 - at(low + 2 * step) - at(low) * 3.0) / (2 * step);
}

// By the parameters of a single lobe.
void add_lobe(std::vector<Derivative>& result, const Query& query) {
  if (query.materials.size() != 1) return;
  const Material& m = query.materials.front();
  const auto linear = [&](const char* key, const auto& set) {
    Query changed = query;
    set(changed.materials.front());
    // `exact` serves GGX with equal reflectances alone.
    if (methods::find(query.method, changed.materials.front(), query.quality) == nullptr) changed.method = Method::automatic;
    result.push_back({key, Form::number, {numbers(radiance_with(std::move(changed)))}});
  };
  const auto smooth = [&](const char* key, double value, double least, double scale, const auto& set) {
    if (const auto d = by_number_of_lobe(query, value, least, scale, set)) result.push_back({key, Form::number, {numbers(*d)}});
  };
  if (m.brdf == Brdf::lambert || m.brdf == Brdf::phong || m.brdf == Brdf::charlie || m.brdf == Brdf::lobe_product)
    linear("d_albedo", [](Material& lobe) { lobe.albedo = {1, 1, 1}; });
  if (m.brdf == Brdf::ggx && !m.multiple_scattering) {
    linear("d_f0", [](Material& lobe) { lobe.f0 = {1, 1, 1}, lobe.f90 = {0, 0, 0}; });
    linear("d_f90", [](Material& lobe) { lobe.f0 = {0, 0, 0}, lobe.f90 = {1, 1, 1}; });
  }
  if (m.brdf == Brdf::ggx || m.brdf == Brdf::beckmann || m.brdf == Brdf::charlie) {
    if (m.alpha_x == m.alpha_y || m.brdf == Brdf::charlie) {
      smooth("d_roughness", std::sqrt(m.alpha_x), std::sqrt(kSmallestAlpha), std::sqrt(m.alpha_x),
             [](Material& lobe, double r) { lobe.alpha_x = lobe.alpha_y = alpha_from_roughness(r); });
    } else {
      smooth("d_alpha_x", m.alpha_x, kSmallestAlpha, m.alpha_x, [](Material& lobe, double a) { lobe.alpha_x = a; });
      smooth("d_alpha_y", m.alpha_y, kSmallestAlpha, m.alpha_y, [](Material& lobe, double a) { lobe.alpha_y = a; });
    }
  }
  if (m.brdf == Brdf::phong || m.brdf == Brdf::blinn_phong || m.brdf == Brdf::lobe_product)
    smooth("d_exponent", m.exponent, 0, m.exponent + 1, [](Material& lobe, double n) { lobe.exponent = n; });
  if (m.brdf == Brdf::lobe_product)
    smooth("d_axis_exponent", m.axis_exponent, 0, m.axis_exponent + 1, [](Material& lobe, double n) { lobe.axis_exponent = n; });
}

}  // namespace

std::vector<Derivative> derivatives_of(const Query& query) {
  if (query.lights.size() > 1) throw Error("derivatives", "there are none of a list of lights", "ask for each light in a line of its own");
  const Light& light = query.lights.front();
  const auto* area = std::get_if<AreaLight>(&light);
  for (const Material& m : query.materials) {
    const methods::Row& row = methods::resolve(query.method, m, query.precision, query.quality);
    if (row.density == nullptr) throw Error("derivatives", std::string("brdf ") + name_of(m.brdf) + " has none by " + row.name, "use auto");
  }
  std::vector<Derivative> result;
  if (area != nullptr)
    add_outline(result, query, *area);
  else
    add_differences(result, query);
  result.push_back(by_emission(query));
  add_lobe(result, query);
  return result;
}

}  // namespace steradian::eval
