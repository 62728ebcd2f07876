#include "eval/shadowed.h"

#include <algorithm>
#include <cmath>

#include "integrals/curved_light.h"
#include "integrals/point_light.h"
#include "integrals/textured/profiled_light.h"
#include "reference/past_occluders.h"
#include "reference/sampled.h"
#include "shadow/edges/bodies.h"
#include "shadow/region/round_light.h"
#include "shadow/region/visible_part.h"
#include "steradian/capsule_light.h"
#include "steradian/error.h"

namespace steradian::eval {
namespace {

constexpr double kLift = 1e-9, kLiftInFloat = 1e-6;
constexpr int kProfileCells = 1024, kProfileCorners = 96;
constexpr double kBeforeTheLight = 1e-9;  // fraction of the way that is left out, so that nothing at the surface itself blocks
constexpr double kFar = 1e9;              // distance to parallel light

// The polygons that replace a disk, an ellipsoid or a tube for a point.
std::vector<PreparedPolygon> polygons_of(const AreaLight& light, Vec3d from, int corners) {
  if (const auto* tube = std::get_if<Capsule>(&light.shape)) return shadow::parts_of_tube(*tube, light.radiance, from, corners);
  PreparedPolygon polygon = shadow::polygon_of_round(light, from, corners);
  if (polygon.vertices.empty()) return {};
  return {std::move(polygon)};
}

RadianceResult answer_of(const SampledResult& sampled, Method method) {
  RadianceResult answer = methods::nothing(method);
  answer.radiance = sampled.radiance;
  answer.standard_error = sampled.standard_error;
  return answer;
}

// By rays to the light's true surface.
SampledResult sampled_past(const Query& query, const AreaLight& light, const shadow::Viewpoint& from, const ShadingPoint& at,
                           const Material& m, const SampledOptions& options) {
  const auto above = [&](Vec3d to) { return !from.geometric_normal || dot(to, *from.geometric_normal) > 0; };
  const auto open = [&](Vec3d to) { return above(to) && !query.occluders->rays.between(from.position, from.position + to); };
  if (!std::holds_alternative<Polygon>(light.shape))
    return reference::sampled_on_surface([&](Vec3d to) { return open(to * (1 - kBeforeTheLight)); }, light, at, m, options);
  const PreparedPolygon polygon = prepare_polygon(flat_polygon(light));
  if (polygon.vertices.empty()) return {};
  const double eta = shadow::margin_of_plane(polygon), height = std::fabs(dot(polygon.centroid - from.position, polygon.normal));
  const auto sees = [&](Vec3d direction) {
    return open(direction * std::max((height - eta) / std::fabs(dot(direction, polygon.normal)), 0.0));
  };
  return reference::sampled_radiance_past(sees, polygon, at, m, options);
}

RadianceResult over_visible(const PreparedPolygon& light, const shadow::Viewpoint& from, const shadow::Occluders& occluders,
                            const Body* body, const ShadingPoint& at, const Material& m, const methods::Row& entry,
                            const RadianceOptions& options) {
  const double lift = options.precision == Precision::float_ ? kLiftInFloat : kLift;
  return entry.polygon(shadow::visible_part(light, occluders, from, lift, body), at, m, options);
}

// By quadrature over the light's true surface.
RadianceResult reference_past(const Query& query, const AreaLight& light, const ShadingPoint& at, const Material& m,
                              const EmissionFactor& emission = {}) {
  const shadow::EdgeMesh& mesh = query.occluders->mesh;
  std::vector<reference::Blocker> blockers;
  for (const auto& [a, b, c] : mesh.triangles) blockers.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  // A profile's table has kinks all over the light, and every triangle makes some.
  const ReferenceOptions options = emission ? ReferenceOptions{1e-7, 0, 4'000'000} : ReferenceOptions{1e-9, 1e-13, 20'000'000};
  const ReferenceResult r = reference::radiance_past(blockers, light, at, query.geometric_normal.value_or(at.normal), m, options, emission);
  return {r.radiance, r.bound, std::nullopt, Method::reference};
}

// The viewpoint of the query's point.
shadow::Viewpoint viewpoint_of(const Query& query) {
  const Vec3d geometric = query.geometric_normal.value_or(query.normal);
  shadow::Viewpoint from;
  from.position = query.position + geometric * shadow::offset_from_surface(query.position);
  from.normal = query.normal;
  if (query.geometric_normal && !(geometric == query.normal)) from.geometric_normal = geometric;
  return from;
}

// A light with a profile: the result for the light with uniform emission, times the profile's mean over the visible part, weighted by the
// lobe.
RadianceResult profiled_answer(const Query& query, const AreaLight& light, const ShadingPoint& surface, const Material& m,
                               const methods::Row& entry, const RadianceOptions& options) {
  const shadow::Viewpoint from = viewpoint_of(query);
  AreaLight even = light;
  even.emission.reset();
  even.radiance = {1, 1, 1};
  if (entry.method == Method::sampled) {
    AreaLight bright = even;
    bright.radiance = light.emission->intensity;
    const ShadingPoint at = {from.position, surface.normal, surface.view};
    return answer_of(sampled_past(query, bright, from, at, m, {options.spp, options.seed, methods::emission_factor(*light.emission)}),
                     entry.method);
  }
  if (entry.method == Method::reference) return reference_past(query, light, surface, m, methods::emission_factor(*light.emission));
  RadianceResult answer = shadowed_answer(query, even, surface, m, entry, options,
                                          [&] { return methods::curved_light_answer(even, surface, m, entry, options); });
  const double integral = std::max({answer.radiance.x, answer.radiance.y, answer.radiance.z});
  if (!(integral > 0)) return answer;
  const ProfiledLight profiled(light);
  const PreparedPolygon part = shadow::visible_part(prepare_polygon(flat_polygon(light, kProfileCorners)), *query.occluders, from, kLift);
  PlaneRegion visible;
  for (std::size_t i = 0; i + 1 < part.vertices.size(); i += 2)
    visible.add(profiled.coordinates_of(part.vertices[i]), profiled.coordinates_of(part.vertices[i + 1]));
  answer.radiance = answer.radiance * profiled.seen_by(m, surface, integral, kProfileCells, &visible);
  return answer;
}

}  // namespace

RadianceResult shadowed_answer(const Query& query, const Light& source, const ShadingPoint& surface, const Material& m,
                               const methods::Row& entry, const RadianceOptions& options,
                               const std::function<RadianceResult()>& unoccluded) {
  const Vec3d geometric = query.geometric_normal.value_or(surface.normal);
  const shadow::Viewpoint from = viewpoint_of(query);
  const ShadingPoint at = {from.position, surface.normal, surface.view};

  if (const auto* light = std::get_if<DirectionalLight>(&source)) {
    const Vec3d far = from.position - light->direction * (kFar * (1 + length(from.position)));
    const bool blocked = !(dot(light->direction, geometric) < 0) || query.occluders->rays.between(from.position, far);
    return blocked ? methods::nothing(entry.method) : unoccluded();
  }
  if (const auto* light = std::get_if<PointLight>(&source)) {
    const Vec3d to = light->position - from.position;
    const bool blocked = !(dot(to, geometric) > 0) || query.occluders->rays.between(from.position, light->position);
    return blocked ? methods::nothing(entry.method) : unoccluded();
  }
  const auto& light = std::get<AreaLight>(source);
  if (light.emission) return profiled_answer(query, light, surface, m, entry, options);
  if (std::holds_alternative<Line>(light.shape)) throw Error("occluders", "a line casts no shadow here", "give the capsule a radius");
  if (entry.method == Method::sampled) return answer_of(sampled_past(query, light, from, at, m, {options.spp, options.seed}), entry.method);
  if (entry.method == Method::reference) return reference_past(query, light, surface, m);
  if (std::holds_alternative<Polygon>(light.shape)) {
    const PreparedPolygon polygon = prepare_polygon(flat_polygon(light));
    if (polygon.vertices.empty()) return methods::nothing(entry.method);
    return over_visible(polygon, from, *query.occluders, nullptr, at, m, entry, options);
  }
  const int corners = options.quality == Quality::high ? 48 : 24;
  const std::optional<Body> body = Body::of(light.shape);
  std::optional<shadow::Occluders> cut;
  if (body && shadow::may_enter(query.occluders->mesh, {&*body, 1})) cut.emplace(query.occluders->cut_by(*body));
  const shadow::Occluders& occluders = cut ? *cut : *query.occluders;
  RadianceResult part = methods::nothing(entry.method);
  Vec3d all{};
  for (const PreparedPolygon& polygon : polygons_of(light, from.position, corners)) {
    const RadianceResult r = over_visible(polygon, from, occluders, body ? &*body : nullptr, at, m, entry, options);
    part.radiance += r.radiance;
    all += entry.polygon(polygon, at, m, options).radiance;
  }
  const auto share = [](double a, double b) { return b > 0 ? a / b : 0.0; };
  RadianceResult answer = unoccluded();
  answer.radiance = answer.radiance * Vec3d{share(part.radiance.x, all.x), share(part.radiance.y, all.y), share(part.radiance.z, all.z)};
  return answer;
}

ShadowedDerivatives shadowed_derivatives(const Query& query, const PolygonLight& stored, const Material& m, const methods::Row& entry) {
  const shadow::Viewpoint from = viewpoint_of(query);
  const ShadingPoint at = {from.position, query.normal, query.view.value_or(query.normal)};
  const PreparedPolygon light = prepare_polygon(stored);
  const LobeDensity density = entry.density(at, m, query.quality);
  shadow::BoundaryDerivatives d =
      shadow::boundary_derivatives(light, *query.occluders, from, [&](Vec3d direction) { return light.radiance * density(direction); });
  std::size_t count = stored.vertices.size();
  for (const auto& hole : stored.holes) count += hole.size();
  ShadowedDerivatives result{RadianceDerivatives(count), d.position, std::move(d.occluders)};
  const std::vector<std::size_t> stored_index = stored_vertices(stored, light);
  for (std::size_t i = 0; i < d.light.size(); ++i) result.light.vertices[stored_index[i]] = d.light[i];
  return result;
}

}  // namespace steradian::eval
