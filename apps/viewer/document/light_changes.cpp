#include "document/light_changes.h"

#include <algorithm>
#include <cmath>

#include "document/lamps.h"
#include "document/node_pose.h"
#include "document/outline.h"
#include "steradian/area_light.h"  // luminance
#include "scene/emitters/light_materials.h"
#include "steradian/error.h"

namespace steradian::view {
namespace {

Vec3d radiance_in(const Scene& scene, std::size_t light) {
  const std::size_t area = scene.area_lights.size();
  return light < area ? scene.area_lights[light].radiance : scene.punctual_lights[light - area].intensity;
}

std::string name_in(const Scene& scene, std::size_t light) {
  const std::size_t area = scene.area_lights.size();
  return light < area ? scene.area_lights[light].name : scene.punctual_lights[light - area].name;
}

// A lamp of the file: by its node, or by its material for an emissive mesh.
Lamp lamp_of(const EditedDocument& document, const std::vector<Lamp>& lamps, const Scene& scene, std::size_t light) {
  const std::size_t area = scene.area_lights.size();
  const bool punctual = light >= area;
  const int node = punctual ? scene.punctual_lights[light - area].node : scene.area_lights[light].node;
  const int material = node < 0 ? scene::material_of_light(scene, light) : -1;
  const auto found = std::find_if(lamps.begin(), lamps.end(), [&](const Lamp& lamp) {
    if (node < 0) return lamp.kind == LampKind::mesh && lamp.light == material;
    return lamp.node == node && lamp.kind != LampKind::mesh && (lamp.kind != LampKind::area) == punctual;
  });
  if (found != lamps.end()) return *found;
  throw Error(document.file().path, "light '" + name_in(scene, light) + "' is not in the file in a form that can be changed",
              "leave it out of --fit");
}

// Gives a lamp whose definition other nodes use a copy of its own.
void separate(EditedDocument& document, Lamp& lamp, const std::vector<Lamp>& lamps) {
  if (lamp.kind != LampKind::area && lamp.kind != LampKind::punctual) return;
  const bool shared =
      std::count_if(lamps.begin(), lamps.end(), [&](const Lamp& l) { return l.kind == lamp.kind && l.light == lamp.light; }) > 1;
  if (!shared) return;
  const std::string extension = lamp.kind == LampKind::area ? "EXT_lights_area" : "KHR_lights_punctual";
  const std::string list = "/extensions/" + extension + "/lights";
  const auto copy = static_cast<int>(document.count(list));
  document.set(list + "/" + std::to_string(copy), *document.find(list + "/" + std::to_string(lamp.light)));
  document.set("/nodes/" + std::to_string(lamp.node) + "/extensions/" + extension + "/light", copy);
  lamp.light = copy;
}

// Moves a lamp to a child of its node, where the node shows or carries other things.
void take_out(EditedDocument& document, Lamp& lamp) {
  const std::string node = "/nodes/" + std::to_string(lamp.node);
  const bool alone =
      document.count(node + "/children") == 0 && document.find(node + "/mesh") == nullptr && document.find(node + "/camera") == nullptr;
  if (alone) return;
  const std::string extension = lamp.kind == LampKind::area       ? "EXT_lights_area"
                                : lamp.kind == LampKind::punctual ? "KHR_lights_punctual"
                                                                  : "EXT_lights_ies";
  const Json light = *document.find(node + "/extensions/" + extension);
  const auto child = static_cast<int>(document.count("/nodes"));
  document.set("/nodes/" + std::to_string(child), {{"name", document.text(node + "/name", "light")}, {"extensions", {{extension, light}}}});
  document.set(node + "/children/" + std::to_string(document.count(node + "/children")), child);
  remove_lamp(document, lamp);
  lamp.node = child;
}

void set_place(EditedDocument& document, Lamp& lamp, const LightChange& change) {
  if (change.move == Vec3d{} && change.rotation == Vec3d{}) return;
  take_out(document, lamp);
  const Affine parent = NodeTree(document).parent_world(lamp.node);
  NodePose pose = moved(pose_of(document, lamp.node), parent, change.move);
  const double angle = length(change.rotation);
  if (angle > 0) pose = turned(pose, parent, change.rotation / angle, angle);
  set_pose(document, lamp.node, pose);
}

void set_light(EditedDocument& document, const Lamp& lamp, const LightChange& change, Vec3d before, bool profiled) {
  const double factor = luminance(change.radiance) / luminance(before);
  if (profiled) {
    const std::string at = "/extensions/EXT_lights_area/lights/" + std::to_string(lamp.light) + "/extras/steradian/profile/multiplier";
    document.set(at, document.number(at, 1) * factor);
    return;
  }
  LampValues values = values_of(document, lamp);
  if (change.color) {
    const Vec3d unit = values.color * values.intensity;
    const Vec3d wanted = change.radiance * (luminance(unit) / luminance(before));
    values.intensity = std::max({wanted.x, wanted.y, wanted.z, 1e-30});
    values.color = wanted / values.intensity;
  } else {
    values.intensity *= factor;
  }
  if (values.size) *values.size *= change.size_2;
  if (values.aspect) *values.aspect *= change.size_1 / change.size_2;
  if (values.length) *values.length *= change.size_1;
  set_values(document, lamp, values);
}

// The outline's corners are found among the vertices of the start by their places. A vertex on a straight line is no corner of the outline.
void set_vertices(EditedDocument& document, const Lamp& lamp, const AreaLight& start, const std::vector<Vec3d>& moved) {
  const auto fail = [&](const char* problem) {
    throw Error(document.file().path, "light '" + lamp.name + "' " + problem, "leave its vertices out of the fit");
  };
  std::optional<Outline> outline = lamp.kind == LampKind::mesh ? outline_of(document, lamp) : std::nullopt;
  if (!outline) return fail("is not one flat polygon of a mesh");
  const PolygonLight before = flat_polygon(start);
  std::vector<Vec3d> vertices = before.vertices;
  for (const auto& hole : before.holes) vertices.insert(vertices.end(), hole.begin(), hole.end());
  if (vertices.size() != moved.size()) return fail("has other vertices than the scene");
  const Affine world = NodeTree(document).world(lamp.node);
  std::size_t found = 0;
  for (auto& contour : outline->contours)
    for (Vec3d& corner : contour) {
      const Vec3d place = world.point(corner);
      const auto nearest = std::min_element(vertices.begin(), vertices.end(),
                                            [&](const Vec3d& a, const Vec3d& b) { return length(a - place) < length(b - place); });
      if (length(*nearest - place) > 1e-4 * length(vertices[0] - vertices[1])) return fail("has other vertices than the scene");
      corner = inverse(world).point(moved[static_cast<std::size_t>(nearest - vertices.begin())]);
      ++found;
    }
  if (found != vertices.size()) return fail("has other vertices than the scene");
  if (!set_outline(document, lamp, *outline)) return fail("would cross itself");
}

}  // namespace

void apply_changes(EditedDocument& document, const Scene& start, const std::vector<LightChange>& changes) {
  std::vector<int> materials;  // that were changed: all lights of one shine alike
  for (const LightChange& change : changes) {
    const std::vector<Lamp> lamps = lamps_of(document, NodeTree(document));
    Lamp lamp = lamp_of(document, lamps, start, change.light);
    if (lamp.kind == LampKind::mesh) {
      if (std::find(materials.begin(), materials.end(), lamp.light) != materials.end()) continue;
      materials.push_back(lamp.light);
    }
    separate(document, lamp, lamps);
    set_light(document, lamp, change, radiance_in(start, change.light),
              change.light < start.area_lights.size() && start.area_lights[change.light].emission.has_value());
    if (lamp.kind != LampKind::mesh) set_place(document, lamp, change);
    if (!change.vertices.empty()) set_vertices(document, lamp, start.area_lights[change.light], change.vertices);
  }
}

void apply_changes(EditedDocument& document, const std::vector<MaterialChange>& changes) {
  for (const MaterialChange& change : changes) {
    const std::string material = "/materials/" + std::to_string(change.material), at = material + "/pbrMetallicRoughness/";
    if (change.material >= document.count("/materials"))
      throw Error(document.file().path, "a fitted material is not in the file", "leave it out of --fit");
    if (change.has_albedo) {
      std::vector<double> color = document.numbers(at + "baseColorFactor", 4);
      if (color.empty()) color.assign(4, 1.0);
      document.set(at + "baseColorFactor", {change.albedo.x, change.albedo.y, change.albedo.z, color[3]});
    }
    if (change.has_roughness) document.set(at + "roughnessFactor", change.roughness);
  }
}

}  // namespace steradian::view
