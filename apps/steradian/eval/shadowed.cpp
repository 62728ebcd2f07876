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
constexpr double kSameFace = 1 - 1e-12;     // cosine of two faces in one plane
constexpr std::size_t kMostViewpoints = 8;  // both sides of three faces
constexpr int kProfileCells = 1024, kProfileCorners = 96;
constexpr double kBeforeTheLight = 1e-9;  // fraction of the way that is left out, so that nothing at the surface itself blocks
constexpr double kRounding = 0x1p-50;     // of coordinates in double, after sums of some products

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

double reach_of(const std::vector<Vec3d>& points) {
  double reach = 0;
  for (const Vec3d& p : points) reach = std::max(reach, shadow::largest_coordinate(p));
  return reach;
}

double reach_of(const Light& source) {
  const auto* light = std::get_if<AreaLight>(&source);
  if (light == nullptr) return 0;
  struct Reach {
    double operator()(const Polygon& p) const { return reach_of(p.vertices); }
    double operator()(const Ellipse& e) const { return reach_of({e.center, e.x, e.y}); }
    double operator()(const Ellipsoid& e) const { return reach_of({e.center, e.x, e.y, e.z}); }
    double operator()(const Capsule& c) const { return std::max(reach_of({c.end_a, c.end_b}), c.radius); }
    double operator()(const Line& l) const { return reach_of({l.end_a, l.end_b}); }
  };
  return std::visit(Reach(), light->shape);
}

// The unit normals of the triangles in which a point lies, one of each direction. Distances below `error` are none.
std::vector<Vec3d> faces_at(const shadow::EdgeMesh& mesh, Vec3d p, double error) {
  std::vector<Vec3d> normals;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d n = normalized(mesh.planes[t].normal);
    const auto corner = [&](std::size_t c) { return mesh.vertices[mesh.triangles[t][c % 3]]; };
    if (n == Vec3d{} || !(std::fabs(dot(n, p - corner(0))) <= error)) continue;
    const auto is_left = [&](std::size_t c) { return dot(n, cross(normalized(corner(c + 1) - corner(c)), p - corner(c))) >= -error; };
    const auto is_known = [&](Vec3d m) { return std::fabs(dot(m, n)) > kSameFace; };
    if (is_left(0) && is_left(1) && is_left(2) && std::none_of(normals.begin(), normals.end(), is_known)) normals.push_back(n);
  }
  return normals;
}

// The query's point, moved off its surface. A point that still lies in a face is seen from both sides of it.
std::vector<shadow::Viewpoint> viewpoints_of(const Query& query, double reach) {
  const Vec3d geometric = query.geometric_normal.value_or(query.normal);
  const double offset = shadow::offset_from_surface(query.position, std::max(reach, query.occluders->reach), kRounding);
  shadow::Viewpoint from;
  from.position = query.position + geometric * offset;
  from.normal = query.normal;
  if (query.geometric_normal && !(geometric == query.normal)) from.geometric_normal = geometric;
  std::vector<shadow::Viewpoint> result = {from};
  for (const Vec3d& normal : faces_at(query.occluders->mesh, from.position, offset / 4)) {
    if (result.size() == kMostViewpoints) break;
    const std::size_t count = result.size();
    for (std::size_t i = 0; i < count; ++i) {
      result.push_back(result[i]);
      result[i].position += normal * (2 * offset);
      result.back().position -= normal * (2 * offset);
    }
  }
  return result;
}

RadianceResult answer_from(const shadow::Viewpoint& from, const Query& query, const Light& source, const ShadingPoint& surface,
                           const Material& m, const methods::Row& entry, const RadianceOptions& options,
                           const std::function<RadianceResult()>& unoccluded);

// A light with a profile: the result for the light with uniform emission, times the profile's mean over the visible part, weighted by the
// lobe.
RadianceResult profiled_answer(const Query& query, const AreaLight& light, const shadow::Viewpoint& from, const ShadingPoint& surface,
                               const Material& m, const methods::Row& entry, const RadianceOptions& options) {
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
  if (entry.method == Method::reference)
    return reference_past(query, light, {from.position, surface.normal, surface.view}, m, methods::emission_factor(*light.emission));
  RadianceResult answer = answer_from(from, query, even, surface, m, entry, options,
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

RadianceResult answer_from(const shadow::Viewpoint& from, const Query& query, const Light& source, const ShadingPoint& surface,
                           const Material& m, const methods::Row& entry, const RadianceOptions& options,
                           const std::function<RadianceResult()>& unoccluded) {
  const Vec3d geometric = query.geometric_normal.value_or(surface.normal);
  const ShadingPoint at = {from.position, surface.normal, surface.view};

  if (const auto* light = std::get_if<DirectionalLight>(&source)) {
    // Twice as far as any triangle.
    const double far_away = 4 * (query.occluders->reach + shadow::largest_coordinate(from.position));
    const Vec3d far = from.position - light->direction * far_away;
    const bool blocked = !(dot(light->direction, geometric) < 0) || query.occluders->rays.between(from.position, far);
    return blocked ? methods::nothing(entry.method) : unoccluded();
  }
  if (const auto* light = std::get_if<PointLight>(&source)) {
    const Vec3d to = light->position - from.position;
    const bool blocked = !(dot(to, geometric) > 0) || query.occluders->rays.between(from.position, light->position);
    return blocked ? methods::nothing(entry.method) : unoccluded();
  }
  const auto& light = std::get<AreaLight>(source);
  if (light.emission) return profiled_answer(query, light, from, surface, m, entry, options);
  if (std::holds_alternative<Line>(light.shape)) throw Error("occluders", "a line casts no shadow here", "give the capsule a radius");
  if (entry.method == Method::sampled) return answer_of(sampled_past(query, light, from, at, m, {options.spp, options.seed}), entry.method);
  if (entry.method == Method::reference) return reference_past(query, light, at, m);
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

}  // namespace

RadianceResult shadowed_answer(const Query& query, const Light& source, const ShadingPoint& surface, const Material& m,
                               const methods::Row& entry, RadianceOptions options, const std::function<RadianceResult()>& unoccluded) {
  std::vector<shadow::Viewpoint> sides = viewpoints_of(query, reach_of(source));
  if (entry.method == Method::reference && sides.size() == 1) sides[0].position = query.position;  // it knows the face on which it lies
  RadianceResult mean = methods::nothing(entry.method);
  const double share = 1 / static_cast<double>(sides.size());
  for (const shadow::Viewpoint& from : sides) {
    const RadianceResult side = answer_from(from, query, source, surface, m, entry, options, unoccluded);
    mean.radiance += side.radiance * share;
    if (side.bound) mean.bound = mean.bound.value_or(0) + *side.bound * share;
    if (side.standard_error) mean.standard_error = std::hypot(mean.standard_error.value_or(0), *side.standard_error * share);
    options.seed += 0xa0761d6478bd642fu;  // the variances of the sides add
  }
  return mean;
}

namespace {

// The share of a light's vectors in the motion of a corner of its polygon, in the order of OutlineDerivatives, and the corner's motion with
// the radius.
struct CornerMotion {
  std::vector<double> by_vector;
  Vec3d by_radius{};
};

struct MotionOfCorner {
  Vec3d corner;

  CornerMotion operator()(const Polygon&) const { return {}; }
  CornerMotion operator()(const Line&) const { return {}; }
  CornerMotion operator()(const Ellipse& e) const {
    const Vec3d d = corner - e.center, n = cross(e.x, e.y) / dot(cross(e.x, e.y), cross(e.x, e.y));
    return {{1, dot(cross(d, e.y), n), dot(cross(e.x, d), n)}};
  }
  CornerMotion operator()(const Ellipsoid& e) const {
    const Vec3d d = (corner - e.center) / dot(cross(e.x, e.y), e.z);
    return {{1, dot(cross(e.y, e.z), d), dot(cross(e.z, e.x), d), dot(cross(e.x, e.y), d)}};
  }
  // A corner is a point of the ball about the nearer end.
  CornerMotion operator()(const Capsule& c) const {
    const bool is_a = length(corner - c.end_a) <= length(corner - c.end_b);
    return {{is_a ? 1.0 : 0.0, is_a ? 0.0 : 1.0}, (corner - (is_a ? c.end_a : c.end_b)) / c.radius};
  }
};

std::size_t vector_count(const AreaLight& light) {
  if (const auto* p = std::get_if<Polygon>(&light.shape)) {
    std::size_t count = p->vertices.size();
    for (const auto& hole : p->holes) count += hole.size();
    return count;
  }
  return std::holds_alternative<Ellipse>(light.shape) ? 3 : std::holds_alternative<Ellipsoid>(light.shape) ? 4 : 2;
}

}  // namespace

ShadowedDerivatives shadowed_derivatives(const Query& query, const AreaLight& light, const Material& m, const methods::Row& entry) {
  if (std::holds_alternative<Line>(light.shape) || light.emission)
    throw Error("derivatives", "past occluders, lines and lights with a profile have none", "leave one of the keys out");
  const bool is_polygon = std::holds_alternative<Polygon>(light.shape);
  PreparedPolygon flat;
  std::vector<std::size_t> stored_index;
  if (is_polygon) {
    const PolygonLight stored = flat_polygon(light);
    flat = prepare_polygon(stored);
    stored_index = stored_vertices(stored, flat);
  }
  const int corners = query.quality == Quality::high ? 192 : 96;
  ShadowedDerivatives result;
  result.light.by_vector.resize(vector_count(light));
  result.occluders.resize(query.occluders->mesh.vertices.size());
  const std::vector<shadow::Viewpoint> sides = viewpoints_of(query, reach_of(light));
  const double share = 1 / static_cast<double>(sides.size());
  const auto add = [&](shadow::ByChannel& to, const shadow::ByChannel& from, double factor) {
    for (std::size_t channel = 0; channel < 3; ++channel) to[channel] += from[channel] * (factor * share);
  };
  const auto add_corner = [&](Vec3d corner, const shadow::ByChannel& by_corner) {
    const CornerMotion motion = std::visit(MotionOfCorner{corner}, light.shape);
    for (std::size_t i = 0; i < motion.by_vector.size(); ++i) add(result.light.by_vector[i], by_corner, motion.by_vector[i]);
    const auto along = [&](std::size_t channel) { return dot(by_corner[channel], motion.by_radius); };
    result.light.by_radius += Vec3d{along(0), along(1), along(2)} * share;
  };
  for (const shadow::Viewpoint& from : sides) {
    const ShadingPoint at = {from.position, query.normal, query.view.value_or(query.normal)};
    const LobeDensity density = entry.density(at, m, query.quality);
    for (const PreparedPolygon& part : is_polygon ? std::vector<PreparedPolygon>{flat} : polygons_of(light, from.position, corners)) {
      const shadow::BoundaryDerivatives d =
          shadow::boundary_derivatives(part, *query.occluders, from, [&](Vec3d direction) { return light.radiance * density(direction); });
      add(result.light.position, d.position, 1);
      for (std::size_t i = 0; i < d.occluders.size(); ++i) add(result.occluders[i], d.occluders[i], 1);
      for (std::size_t i = 0; i < d.light.size(); ++i)
        if (is_polygon)
          add(result.light.by_vector[stored_index[i]], d.light[i], 1);
        else
          add_corner(part.vertices[i], d.light[i]);
    }
  }
  return result;
}

}  // namespace steradian::eval
