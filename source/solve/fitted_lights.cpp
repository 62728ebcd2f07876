#include "solve/fitted_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "shapes/triangulate.h"
#include "solve/moved_shape.h"
#include "steradian/error.h"
#include "steradian/polygon_light.h"

namespace steradian {

double light_flux(const AreaLight& light) { return std::numbers::pi * light.power * (light.two_sided ? 2 : 1); }

double light_flux(const PunctualLight& light) {
  return (light.kind == PunctualKind::directional ? 1 : 4 * std::numbers::pi) * luminance(light.intensity);
}

}  // namespace steradian

namespace steradian::solving {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

// Directions in the plane of a polygon, along which its vertices move.
struct PlaneAxes {
  Vec3d u, v;
};
PlaneAxes plane_of(const AreaLight& light) {
  const Frame frame = Frame::from_normal(prepare_polygon(flat_polygon(light)).normal);
  return {frame.x, frame.y};
}

std::vector<Vec3d*> vertices_of(Polygon& p) {
  std::vector<Vec3d*> all;
  for (Vec3d& v : p.vertices) all.push_back(&v);
  for (auto& hole : p.holes)
    for (Vec3d& v : hole) all.push_back(&v);
  return all;
}

// True if an outline crosses itself, or runs the other way round as seen along the axes.
bool crosses(const Polygon& p, const PlaneAxes& axes) {
  Contours contours;
  const auto add = [&](const std::vector<Vec3d>& contour) {
    auto& flat = contours.emplace_back();
    for (const Vec3d& v : contour) flat.push_back({dot(v, axes.u), dot(v, axes.v)});
  };
  add(p.vertices);
  for (const auto& hole : p.holes) {
    add(hole);
    double area = 0;
    const auto& flat = contours.back();
    for (std::size_t i = 0; i < flat.size(); ++i) area += cross(flat[i], flat[(i + 1) % flat.size()]);
    if (area > 0) std::reverse(contours.back().begin(), contours.back().end());
  }
  return !triangles_of(contours);
}

// A direction as a mirror with this unit normal shows it.
Vec3d mirrored(Vec3d way, Vec3d normal) { return way - normal * (2 * dot(normal, way)); }

// The vertex of a copy of a polygon for each of its own. placed(way): the way from the middle to a vertex, as the copy has it. Empty if the
// other light is no copy.
template <class Placed>
std::vector<std::size_t> corners_of_copy(const AreaLight& light, const AreaLight& other, Placed placed) {
  constexpr double kSame = 1e-4;  // of the size: distance between equal vertices
  if (!std::holds_alternative<Polygon>(light.shape) || !std::holds_alternative<Polygon>(other.shape)) return {};
  auto polygon = std::get<Polygon>(light.shape), copy = std::get<Polygon>(other.shape);
  const std::vector<Vec3d*> own = vertices_of(polygon), its = vertices_of(copy);
  const Vec3d middle = center_of(polygon), its_middle = center_of(copy);
  std::vector<std::size_t> corners;
  for (const Vec3d* v : own) {
    const Vec3d place = its_middle + placed(*v - middle);
    for (std::size_t k = 0; k < its.size(); ++k)
      if (length(*its[k] - place) <= kSame * length(*v - middle)) corners.push_back(k);
  }
  return own.size() == its.size() && corners.size() == own.size() ? corners : std::vector<std::size_t>{};
}

// Emitting area of one side.
double area_of(const PolygonLight& light) {
  Vec3d sum{};
  const auto add = [&](const std::vector<Vec3d>& contour) {
    for (std::size_t i = 0; i < contour.size(); ++i) sum += cross(contour[i], contour[(i + 1) % contour.size()]) * 0.5;
  };
  add(light.vertices);
  double area = length(sum);
  for (const auto& hole : light.holes) {
    sum = {};
    add(hole);
    area -= length(sum);
  }
  return area;
}

Vec3d place_of(const FittedLight& light) { return light.is_punctual ? light.punctual.position : center_of(light.area.shape); }

Vec3d& radiance_of(FittedLight& light) { return light.is_punctual ? light.punctual.intensity : light.area.radiance; }

double flux_of(const FittedLight& light) { return light.is_punctual ? light_flux(light.punctual) : light_flux(light.area); }

// The reason why a light lacks a parameter; empty if it has it.
std::string lack_of_position(const FittedLight& light) {
  if (light.is_punctual) return light.punctual.kind == PunctualKind::directional ? "a directional light has no position" : "";
  return light.area.texture || light.area.emission ? "the position of a textured or profiled light is not fitted" : "";
}
std::string lack_of_rotation(const FittedLight& light) {
  if (light.is_punctual) {
    if (light.punctual.kind == PunctualKind::point) return "a point light has no rotation";
    return light.punctual.profile ? "the rotation of a measured lamp is not fitted" : "";
  }
  if (light.area.texture || light.area.emission) return "the rotation of a textured or profiled light is not fitted";
  if (const auto* e = std::get_if<Ellipsoid>(&light.area.shape)) {
    const double x = length(e->x), y = length(e->y), z = length(e->z);
    if (std::max({x, y, z}) <= 1.00001 * std::min({x, y, z})) return "a sphere has no rotation";
  }
  return "";
}
std::string lack_of_size(const FittedLight& light) {
  if (light.is_punctual) return "a point, spot or directional light has no size";
  if (light.area.texture || light.area.emission) return "the size of a textured or profiled light is not fitted";
  return sizes_of(light.area.shape).empty() ? "this shape has no size to fit" : "";
}

std::string lack_of_vertices(const LightFit& fit, const FittedLight& light) {
  if (light.is_punctual || !std::holds_alternative<Polygon>(light.area.shape)) return "only polygons have vertices";
  if (light.area.texture || light.area.emission) return "the vertices of a textured or profiled light are not fitted";
  if (light.area.node >= 0) return "the file has a rectangle, whose corners stay one (fit position, rotation and size)";
  if (fit.position || fit.rotation || fit.size) return "vertices include position, rotation and size (name vertices alone)";
  return crosses(std::get<Polygon>(light.area.shape), plane_of(light.area)) ? "its outline crosses itself, or has no area" : "";
}

std::string default_name(std::size_t number) { return "light " + std::to_string(number); }

}  // namespace

FittedLights::FittedLights(const Scene& scene, const std::vector<LightFit>& fits, const std::vector<LightTie>& ties,
                           const std::vector<MaterialFit>& materials) {
  std::vector<std::string> problems;
  const std::size_t all = scene.area_lights.size() + scene.punctual_lights.size();
  const double room = std::max(length(scene.bounds_max - scene.bounds_min), 1e-6);
  if (fits.empty() && materials.empty()) problems.push_back("nothing to fit (name a light or a material)");
  const auto add_light = [&](std::size_t number) {
    Driven d;
    d.start.number = number;
    d.start.is_punctual = number >= scene.area_lights.size();
    if (d.start.is_punctual)
      d.start.punctual = scene.punctual_lights[number - scene.area_lights.size()];
    else
      d.start.area = scene.area_lights[number];
    d.name = d.start.is_punctual ? d.start.punctual.name : d.start.area.name;
    if (d.name.empty()) d.name = default_name(number);
    d.leader = lights_.size();
    lights_.push_back(std::move(d));
  };
  for (const LightFit& fit : fits) {
    if (fit.light >= all) {
      problems.push_back(default_name(fit.light) + " is not in the scene, which has " + std::to_string(all));
      continue;
    }
    if (is_fitted(fit.light)) {
      problems.push_back(default_name(fit.light) + " is fitted twice (name it once)");
      continue;
    }
    add_light(fit.light);
    if (!fit.name.empty()) lights_.back().name = fit.name;
    add_unknowns(fit, lights_.size() - 1, room, problems);
  }
  for (const LightTie& tie : ties) {
    const auto leader = std::find_if(lights_.begin(), lights_.end(), [&](const Driven& d) {
      return !tie.lights.empty() && d.start.number == tie.lights.front() && !d.unknowns.empty();
    });
    if (tie.lights.size() < 2 || leader == lights_.end()) {
      problems.push_back("a tie needs a fitted light and at least one that follows it");
      continue;
    }
    const auto number = static_cast<std::size_t>(leader - lights_.begin());
    for (std::size_t i = 1; i < tie.lights.size(); ++i) {
      if (tie.lights[i] >= all || is_fitted(tie.lights[i])) {
        problems.push_back(default_name(tie.lights[i]) + " follows another light, and is fitted itself or not in the scene");
        continue;
      }
      add_light(tie.lights[i]);
      lights_.back().leader = number;
      lights_.back().mirrored = tie.has_mirror;
      lights_.back().mirror_point = tie.mirror_point;
      lights_.back().mirror_normal = normalized(tie.mirror_normal);
      if (std::any_of(lights_[number].unknowns.begin(), lights_[number].unknowns.end(),
                      [&](std::size_t u) { return unknowns_[u].kind == UnknownKind::vertex_u; })) {
        const Driven &first = lights_[number], &copy = lights_.back();
        std::vector<std::size_t> corners = corners_of_copy(
            first.start.area, copy.start.area, [&](Vec3d way) { return copy.mirrored ? mirrored(way, copy.mirror_normal) : way; });
        if (corners.empty())
          problems.push_back("'" + copy.name + "' cannot follow the vertices of '" + first.name + "', since it has another outline" +
                             (copy.mirrored ? " than its mirror image" : "") + " (leave the tie out)");
        lights_.back().corners = std::move(corners);
      }
      const bool colored = std::any_of(lights_[number].unknowns.begin(), lights_[number].unknowns.end(),
                                       [&](std::size_t u) { return unknowns_[u].kind == UnknownKind::red; });
      if (colored) {
        Vec3d& radiance = radiance_of(lights_.back().start);
        const double white = luminance(radiance);
        radiance = {white, white, white};
      }
    }
  }
  materials_ = FittedMaterials(scene, materials, unknowns_, problems);
  if (problems.empty() && unknowns_.empty())
    problems.push_back("nothing to fit (name a parameter: power, color, position, rotation, size, vertices, albedo, roughness)");
  if (!problems.empty()) {
    std::string text;
    for (const std::string& p : problems) text += (text.empty() ? "" : "\n") + p;
    throw Error("fit", text);
  }
  linear_ = std::all_of(unknowns_.begin(), unknowns_.end(), [](const Unknown& u) { return is_scale(u.kind); });
  // Factors instead of their logarithms, so that a light may go out.
  for (Unknown& u : unknowns_)
    if (linear_) {
      u.start = std::exp(u.start);
      u.low = std::exp(u.low);
      u.high = std::exp(u.high);
    }
}

void FittedLights::add_unknowns(const LightFit& fit, std::size_t light, double room, std::vector<std::string>& problems) {
  Driven& d = lights_[light];
  const double infinite = std::numeric_limits<double>::infinity();
  const auto complain = [&](const std::string& problem) {
    if (!problem.empty()) problems.push_back("'" + d.name + "': " + problem);
    return !problem.empty();
  };
  const auto add = [&](const std::string& word, UnknownKind kind, double start, double low, double high, double typical) {
    Unknown u{d.name + ": " + word, light, kind, start, low, high, typical, fit.keep};
    if (!(low <= high))
      complain(word + ": the least value is above the largest");
    else if (!(start >= low && start <= high))
      complain(word + ": the start is outside of its range (widen the range)");
    d.unknowns.push_back(unknowns_.size());
    unknowns_.push_back(u);
  };
  const double flux = flux_of(d.start);
  if (!(flux > 0) && (fit.power || fit.color)) complain("it does not shine, so its power has no start (give it an intensity)");
  if (fit.power && fit.color) complain("a color includes the power (name one of them)");
  const FitRange factor{std::max(fit.power_range.low, 0.0) / flux, fit.power_range.high / flux};
  if (flux > 0 && fit.power) add("power", UnknownKind::power, 0, std::log(factor.low), std::log(factor.high), 1);
  if (flux > 0 && fit.color) {
    // Each channel starts from the luminance, so that a channel that the file leaves dark can become bright.
    Vec3d& radiance = radiance_of(d.start);
    const double all = luminance(radiance);
    const auto add_channel = [&](const char* word, UnknownKind kind, double value) {
      add(word, kind, std::log(std::max(value / all, 1e-3)), std::log(factor.low * 1e-3), std::log(factor.high * 10), 1);
    };
    if (d.start.is_punctual || (!d.start.area.texture && !d.start.area.emission)) {
      add_channel("red", UnknownKind::red, radiance.x);
      add_channel("green", UnknownKind::green, radiance.y);
      add_channel("blue", UnknownKind::blue, radiance.z);
      radiance = {all, all, all};
    } else {
      complain("the color of a textured or profiled light is not fitted (fit its power)");
    }
  }
  if (fit.position && !complain(lack_of_position(d.start))) {
    const Vec3d c = place_of(d.start);
    add("position x", UnknownKind::position_x, c.x, fit.position_x.low, fit.position_x.high, room);
    add("position y", UnknownKind::position_y, c.y, fit.position_y.low, fit.position_y.high, room);
    add("position z", UnknownKind::position_z, c.z, fit.position_z.low, fit.position_z.high, room);
  }
  if (fit.rotation && !complain(lack_of_rotation(d.start))) {
    const double most = fit.most_degrees / kDegrees;
    add("rotation x", UnknownKind::rotation_x, 0, -most, most, 1);
    add("rotation y", UnknownKind::rotation_y, 0, -most, most, 1);
    add("rotation z", UnknownKind::rotation_z, 0, -most, most, 1);
  }
  if (fit.size && !complain(lack_of_size(d.start))) {
    UnknownKind kind = UnknownKind::size_1;
    for (const ShapeSize& size : sizes_of(d.start.area.shape)) {
      if (size.value > 0)
        add(size.word, kind, 0, std::log(std::max(fit.size_range.low, 0.0) / size.value), std::log(fit.size_range.high / size.value), 1);
      kind = UnknownKind::size_2;
    }
  }
  if (fit.vertices && !complain(lack_of_vertices(fit, d.start))) {
    auto polygon = std::get<Polygon>(d.start.area.shape);
    const double most = std::max(fit.most_move, 0.0), size = std::sqrt(area_of(flat_polygon(d.start.area)));
    for (std::size_t i = 0; i < vertices_of(polygon).size(); ++i)
      for (const UnknownKind kind : {UnknownKind::vertex_u, UnknownKind::vertex_v}) {
        add("vertex " + std::to_string(i + 1) + (kind == UnknownKind::vertex_u ? " u" : " v"), kind, 0, -most, most, size);
        unknowns_.back().vertex = i;
      }
  }
  if (!(fit.keep >= 0 && fit.keep < infinite)) complain("keep must be 0 or more");
}

std::vector<double> FittedLights::start() const {
  std::vector<double> x;
  for (const Unknown& u : unknowns_) x.push_back(u.start);
  return x;
}

bool FittedLights::is_fitted(std::size_t number) const {
  return std::any_of(lights_.begin(), lights_.end(), [&](const Driven& d) { return d.start.number == number; });
}

bool FittedLights::drives(std::size_t unknown, std::size_t light) const {
  return !is_of_material(unknowns_[unknown].kind) && lights_[light].leader == unknowns_[unknown].fit;
}

std::vector<FittedLight> FittedLights::at(const std::vector<double>& x) const {
  std::vector<FittedLight> result;
  for (const Driven& driven : lights_) {
    FittedLight light = driven.start;
    move(lights_[driven.leader], x, light, driven);
    result.push_back(std::move(light));
  }
  return result;
}

bool FittedLights::crosses_itself(const std::vector<double>& x) const {
  const std::vector<FittedLight> lights = at(x);
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (!lights[i].change.vertices.empty() && crosses(std::get<Polygon>(lights[i].area.shape), plane_of(lights_[i].start.area)))
      return true;
  return false;
}

// The flux stays.
void FittedLights::move_vertices(const std::vector<std::pair<std::size_t, double>>& by, const Driven& leader, const Driven& driven,
                                 FittedLight& light) const {
  constexpr double kLeastArea = 1e-3;  // of the start's: a light that collapses in a step keeps a finite radiance
  const PlaneAxes axes = plane_of(leader.start.area);
  const double area = area_of(flat_polygon(light.area));
  auto& polygon = std::get<Polygon>(light.area.shape);
  const std::vector<Vec3d*> all = vertices_of(polygon);
  for (const auto& [unknown, value] : by) {
    const Vec3d way = (unknowns_[unknown].kind == UnknownKind::vertex_u ? axes.u : axes.v) * value;
    const std::size_t vertex = unknowns_[unknown].vertex;
    *all[driven.corners.empty() ? vertex : driven.corners[vertex]] += driven.mirrored ? mirrored(way, driven.mirror_normal) : way;
  }
  for (const Vec3d* v : all) light.change.vertices.push_back(*v);
  light.scale = light.scale * (area / std::max(area_of(flat_polygon(light.area)), kLeastArea * area));
}

// Moves a light as its leader's unknowns say.
void FittedLights::move(const Driven& leader, const std::vector<double>& x, FittedLight& light, const Driven& driven) const {
  Motion motion;
  motion.center = place_of(driven.start);
  const Vec3d from = place_of(leader.start);
  Vec3d by{}, rotation{};
  bool moves = false, has_second = false;
  std::vector<std::pair<std::size_t, double>> vertices;  // numbers of unknowns, and their values
  for (const std::size_t i : leader.unknowns) {
    const double value = x[i], factor = linear_ ? value : std::exp(value);
    switch (unknowns_[i].kind) {
      case UnknownKind::power: light.scale = light.scale * factor; continue;
      case UnknownKind::red: light.scale.x *= factor, light.change.color = true; continue;
      case UnknownKind::green: light.scale.y *= factor; continue;
      case UnknownKind::blue: light.scale.z *= factor; continue;
      case UnknownKind::position_x: by.x = value - from.x; break;
      case UnknownKind::position_y: by.y = value - from.y; break;
      case UnknownKind::position_z: by.z = value - from.z; break;
      case UnknownKind::rotation_x: rotation.x = value; break;
      case UnknownKind::rotation_y: rotation.y = value; break;
      case UnknownKind::rotation_z: rotation.z = value; break;
      case UnknownKind::size_1: motion.f1 = factor; break;
      case UnknownKind::size_2: motion.f2 = factor, has_second = true; break;
      case UnknownKind::vertex_u:
      case UnknownKind::vertex_v: vertices.emplace_back(i, value); continue;
      default: continue;
    }
    moves = true;
  }
  if (!vertices.empty()) move_vertices(vertices, leader, driven, light);
  if (!moves) return;
  if (!has_second && !(light.is_punctual) && !std::holds_alternative<Capsule>(light.area.shape)) motion.f2 = motion.f1;
  if (driven.mirrored) {
    const Vec3d n = driven.mirror_normal;
    const bool placed = std::any_of(leader.unknowns.begin(), leader.unknowns.end(),
                                    [&](std::size_t i) { return unknowns_[i].kind == UnknownKind::position_x; });
    const Vec3d there = from + by;
    by = placed ? driven.mirror_point + mirrored(there - driven.mirror_point, n) - motion.center : Vec3d{};
    rotation = -mirrored(rotation, n);  // an axial vector
  }
  motion.by = by;
  motion.rotation = rotation;
  light.change.move = by;
  light.change.rotation = rotation;
  light.change.size_1 = motion.f1;
  light.change.size_2 = motion.f2;
  if (light.is_punctual) {
    light.punctual.position = motion.moved(light.punctual.position);
    light.punctual.direction = normalized(motion.turned(light.punctual.direction));
    return;
  }
  light.scale = light.scale * area_ratio(light.area.shape, motion.f1, motion.f2);
  light.area.shape = moved(driven.start.area.shape, motion);
}

double FittedLights::shown(std::size_t unknown, double x, double* slope) const {
  const Unknown& u = unknowns_[unknown];
  if (is_of_material(u.kind)) {
    if (slope != nullptr) *slope = 1;
    return x;
  }
  const FittedLight& light = lights_[u.fit].start;
  const auto scaled = [&](double unit, bool logarithm) {
    const double value = unit * (logarithm ? std::exp(x) : x);
    if (slope != nullptr) *slope = logarithm ? value : unit;
    return value;
  };
  switch (u.kind) {
    case UnknownKind::power: return scaled(flux_of(light), !linear_);
    case UnknownKind::red:
    case UnknownKind::green:
    case UnknownKind::blue: return scaled(light.is_punctual ? light.punctual.intensity.x : light.area.radiance.x, !linear_);
    case UnknownKind::rotation_x:
    case UnknownKind::rotation_y:
    case UnknownKind::rotation_z: return scaled(kDegrees, false);
    case UnknownKind::size_1: return scaled(sizes_of(light.area.shape).front().value, true);
    case UnknownKind::size_2: return scaled(sizes_of(light.area.shape).back().value, true);
    default: return scaled(1, false);
  }
}

}  // namespace steradian::solving
