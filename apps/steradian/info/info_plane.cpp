#include "info/info_plane.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "render/left_out.h"
#include "plane/exact/outline.h"
#include "steradian/plane_animation.h"

namespace steradian::app {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double x) { return x == 0 || !std::isfinite(x) ? x : std::stod(fmt::format("{:.6g}", x)); }
double degrees(double radians) { return rounded(radians * 180 / std::numbers::pi); }
Json numbers(Vec2d v) { return {rounded(v.x), rounded(v.y)}; }
Json numbers(Vec3d v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

const char* shape_of(const PlaneBody& body) {
  switch (body.shape) {
    case PlaneBody::Shape::polygon: return "outline";
    case PlaneBody::Shape::polyline: return "line without thickness";
    case PlaneBody::Shape::ellipse: return "ellipse";
    case PlaneBody::Shape::capsule: return "round line";
  }
  return "";
}

Json body_facts(const PlaneBody& body) {
  const Box2d box = plane::bounds_of(body);
  return {{"name", body.name}, {"shape", shape_of(body)}, {"center", numbers(box.center())}, {"size", numbers(box.size())}};
}

Json light_facts(const PlaneBody& body) {
  Json facts = body_facts(body);
  const PlaneEmission& light = *body.light;
  if (light.gradient)
    facts["gradient"] = light.gradient->stops.size();
  else
    facts["radiance"] = numbers(light.radiance);
  if (light.profile != PlaneProfile::uniform) facts["profile"] = light.profile == PlaneProfile::lambert ? "lambert" : "inverse";
  if (std::isfinite(light.range)) facts["range"] = rounded(light.range);
  if (light.is_spot()) facts["spot"] = {degrees(angle_of(light.spot_axis)), degrees(light.spot_half_angle)};
  return facts;
}

Json occluder_facts(const PlaneBody& body) {
  Json facts = body_facts(body);
  if (body.transmittance) facts["transmittance"] = numbers(*body.transmittance);
  if (body.mirror) facts["mirror"] = numbers(*body.mirror);
  if (body.light_depth > 0) facts["light_depth"] = rounded(body.light_depth);
  return facts;
}

}  // namespace

Json plane_facts(const std::string& path, const Limits& limits) {
  const PlaneSvg drawing = load_plane_scene(path, limits);
  const PlaneScene& scene = drawing.scene;
  Json facts = {{"drawing", path}, {"origin", numbers(scene.origin)}, {"size", numbers(Vec2d{scene.width, scene.height})}};
  if (scene.fog_density > 0) facts["fog_density"] = rounded(scene.fog_density);
  for (const char* list : {"lights", "suns", "occluders", "left_out"}) facts[list] = Json::array();
  for (const PlaneBody& body : scene.bodies)
    facts[body.light ? "lights" : "occluders"].push_back(body.light ? light_facts(body) : occluder_facts(body));
  for (const PlaneSun& sun : scene.suns)
    facts["suns"].push_back({{"name", sun.name},
                             {"radiance", numbers(sun.radiance)},
                             {"direction", degrees(sun.direction)},
                             {"half_width", degrees(sun.half_width)}});
  for (const PlaneLeftOut& shapes : drawing.left_out)
    facts["left_out"].push_back({{"name", names_of(shapes)}, {"count", shapes.count}, {"reason", words_of(shapes.why)}});
  facts["not_supported"] = drawing.ignored;
  facts["warnings"] = drawing.warnings;
  const PlaneAnimation animation(path, limits);
  if (animation.moves()) facts["animation_seconds"] = rounded(animation.duration());
  return facts;
}

}  // namespace steradian::app
