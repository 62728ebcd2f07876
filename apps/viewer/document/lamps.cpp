#include "document/lamps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lobes/lobe.h"

namespace steradian::view {
namespace {

constexpr const char* kArea = "EXT_lights_area";
constexpr const char* kPunctual = "KHR_lights_punctual";
constexpr const char* kProfile = "EXT_lights_ies";
constexpr const char* kStrength = "/extensions/KHR_materials_emissive_strength";
constexpr const char* kLobe = "/extras/steradian";

const char* extension_of(LampKind kind) {
  switch (kind) {
    case LampKind::area: return kArea;
    case LampKind::punctual: return kPunctual;
    case LampKind::profile: return kProfile;
    case LampKind::mesh: break;
  }
  return "";
}

std::string node_pointer(int node) { return "/nodes/" + std::to_string(node); }
std::string material_pointer(int material) { return "/materials/" + std::to_string(material); }

// The JSON pointer of a lamp's values.
std::string values_pointer(const Lamp& lamp) {
  if (lamp.kind == LampKind::mesh) return material_pointer(lamp.light);
  if (lamp.kind == LampKind::profile) return node_pointer(lamp.node) + "/extensions/" + kProfile;  // colour and factor belong to the node
  return std::string("/extensions/") + extension_of(lamp.kind) + "/lights/" + std::to_string(lamp.light);
}

Vec3d color(const EditedDocument& document, const std::string& pointer, Vec3d otherwise) {
  for (const std::size_t count : {std::size_t{3}, std::size_t{4}})
    if (const auto c = document.numbers(pointer, count); !c.empty()) return {c[0], c[1], c[2]};
  return otherwise;
}

// Writes a value if it differs from the present value, or from the default if there is none.
template <class T>
void put(EditedDocument& document, const std::string& pointer, const T& value, const T& now, const Json& json) {
  if (value != now) document.set(pointer, json);
}
void put(EditedDocument& document, const std::string& pointer, double value, double now) {
  put(document, pointer, value, now, Json(value));
}
void put(EditedDocument& document, const std::string& pointer, Vec3d value, Vec3d now) {
  if (!(value == now)) document.set(pointer, Json::array({value.x, value.y, value.z}));
}

bool shines(const EditedDocument& document, int material) {
  const Vec3d e = color(document, material_pointer(material) + "/emissiveFactor", {});
  return e.x > 0 || e.y > 0 || e.z > 0;
}

void add_mesh_lamps(const EditedDocument& document, int node, std::vector<Lamp>& lamps) {
  const int mesh = document.index(node_pointer(node) + "/mesh");
  const Json* primitives = mesh < 0 ? nullptr : document.find("/meshes/" + std::to_string(mesh) + "/primitives");
  if (primitives == nullptr) return;
  std::vector<int> seen;
  for (const Json& primitive : *primitives) {
    if (!primitive.is_object() || !primitive.contains("material") || !primitive["material"].is_number_integer()) continue;
    const int material = primitive["material"].get<int>();
    if (std::find(seen.begin(), seen.end(), material) != seen.end() || !shines(document, material)) continue;
    seen.push_back(material);
    const std::string name = document.text(node_pointer(node) + "/name", document.text(material_pointer(material) + "/name", "mesh"));
    lamps.push_back({LampKind::mesh, node, material, name, "mesh"});
  }
}

}  // namespace

void use_extension(EditedDocument& document, const std::string& name) {
  const Json* used = document.find("/extensionsUsed");
  if (used != nullptr && std::find(used->begin(), used->end(), Json(name)) != used->end()) return;
  document.set("/extensionsUsed/" + std::to_string(document.count("/extensionsUsed")), name);
}

std::vector<Lamp> lamps_of(const EditedDocument& document, const NodeTree& tree) {
  std::vector<Lamp> lamps;
  for (const scene::GltfNode& visible : tree.visible()) {
    const std::string node = node_pointer(visible.index);
    for (const LampKind kind : {LampKind::area, LampKind::punctual, LampKind::profile}) {
      const int light = document.index(node + "/extensions/" + extension_of(kind) + "/light");
      if (light < 0) continue;
      Lamp lamp{kind, visible.index, light, "", "profile"};
      const std::string definition = std::string("/extensions/") + extension_of(kind) + "/lights/" + std::to_string(lamp.light);
      lamp.name = document.text(definition + "/name", document.text(node + "/name", "light " + std::to_string(lamp.light)));
      if (kind != LampKind::profile) lamp.type = document.text(definition + "/type", "");
      lamps.push_back(std::move(lamp));
    }
    add_mesh_lamps(document, visible.index, lamps);
  }
  return lamps;
}

LampValues values_of(const EditedDocument& document, const Lamp& lamp) {
  const std::string at = values_pointer(lamp);
  LampValues v;
  if (lamp.kind == LampKind::mesh) {
    v.color = color(document, at + "/emissiveFactor", {});
    v.intensity = document.number(at + kStrength + "/emissiveStrength", 1);
    v.two_sided = document.flag(at + "/doubleSided");
    return v;
  }
  v.color = color(document, at + "/color", {1, 1, 1});
  v.intensity = document.number(at + (lamp.kind == LampKind::profile ? "/multiplier" : "/intensity"),
                                lamp.kind == LampKind::area ? 1000 : 1);  // the default of the draft
  if (lamp.kind == LampKind::punctual && lamp.type == "spot") {
    v.inner_angle = document.number(at + "/spot/innerConeAngle", 0);
    v.outer_angle = document.number(at + "/spot/outerConeAngle", std::numbers::pi / 4);
  }
  if (lamp.kind == LampKind::punctual) v.type = lamp.type;
  if (lamp.kind != LampKind::area) return v;
  v.type = lamp.type;
  v.size = document.number(at + "/size", 1);
  if (lamp.type == "rect") v.aspect = document.number(at + "/rect/aspect", 1);
  if (lamp.type == "capsule") v.length = document.number(at + "/capsule/length", 1);
  if (lamp.type == "rect" || lamp.type == "disk") v.two_sided = document.flag(at + "/extras/steradian/two_sided");
  return v;
}

void set_values(EditedDocument& document, const Lamp& lamp, const LampValues& values) {
  const std::string at = values_pointer(lamp);
  const LampValues now = values_of(document, lamp);
  if (lamp.kind == LampKind::mesh) {
    put(document, at + "/emissiveFactor", values.color, now.color);
    if (values.intensity != now.intensity) {
      use_extension(document, "KHR_materials_emissive_strength");
      document.set(at + kStrength + "/emissiveStrength", values.intensity);
    }
    if (values.two_sided) put(document, at + "/doubleSided", *values.two_sided, *now.two_sided, Json(*values.two_sided));
    return;
  }
  put(document, at + "/color", values.color, now.color);
  put(document, at + (lamp.kind == LampKind::profile ? "/multiplier" : "/intensity"), values.intensity, now.intensity);
  if (values.type && now.type) put(document, at + "/type", *values.type, *now.type, Json(*values.type));
  if (values.size && now.size) put(document, at + "/size", *values.size, *now.size);
  if (values.aspect && now.aspect) put(document, at + "/rect/aspect", *values.aspect, *now.aspect);
  if (values.length && now.length) put(document, at + "/capsule/length", *values.length, *now.length);
  if (values.two_sided && now.two_sided)
    put(document, at + "/extras/steradian/two_sided", *values.two_sided, *now.two_sided, Json(*values.two_sided));
  if (values.inner_angle && now.inner_angle) put(document, at + "/spot/innerConeAngle", *values.inner_angle, *now.inner_angle);
  if (values.outer_angle && now.outer_angle) put(document, at + "/spot/outerConeAngle", *values.outer_angle, *now.outer_angle);
}

int add_light(EditedDocument& document, const std::string& type, Vec3d position, Vec3d direction, double size) {
  const bool punctual = type == "point" || type == "spot" || type == "directional";
  const std::string extension = punctual ? kPunctual : kArea;
  const std::size_t light = document.count("/extensions/" + extension + "/lights");
  const std::string name = (punctual ? type : "light") + " " + std::to_string(light + 1);
  Json json = {{"type", type}, {"name", name}, {"color", {1, 1, 1}}, {"intensity", 5}};
  if (!punctual) {
    json["size"] = size;
    json["extras"] = {{"steradian", {{"scale", "axes"}}}};  // lets each handle of the gizmo scale one side
  }
  if (type == "spot") json["spot"] = Json::object();
  use_extension(document, extension);
  document.set("/extensions/" + extension + "/lights/" + std::to_string(light), std::move(json));
  return add_node(document, {{"name", name}, {"extensions", {{extension, {{"light", light}}}}}}, position, direction);
}

int add_node(EditedDocument& document, Json json, Vec3d position, Vec3d direction) {
  const std::size_t node = document.count("/nodes");
  const Frame frame = Frame::from_normal(-normalized(direction));
  document.set("/nodes/" + std::to_string(node), std::move(json));
  // The rotation of the frame, as a quaternion: a turn from z to the frame's z about the axis perpendicular to both.
  NodePose pose;
  pose.translation = position;
  const Vec3d axis = cross(Vec3d{0, 0, 1}, frame.z);
  const double angle = std::atan2(length(axis), frame.z.z);
  if (angle > 1e-9) pose = turned(pose, {}, length(axis) > 1e-9 ? normalized(axis) : Vec3d{1, 0, 0}, angle);
  set_pose(document, static_cast<int>(node), pose);
  // A file with scenes lists its nodes; a file without scenes shows all.
  if (document.count("/scenes") > 0) {
    const std::string list = "/scenes/" + std::to_string(static_cast<int>(document.number("/scene", 0))) + "/nodes";
    document.set(list + "/" + std::to_string(document.count(list)), node);
  }
  return static_cast<int>(node);
}

void remove_lamp(EditedDocument& document, const Lamp& lamp) {
  const std::string node = node_pointer(lamp.node);
  if (lamp.kind == LampKind::mesh) {
    for (const char* key : {"/mesh", "/skin", "/weights"}) document.erase(node + key);
    return;
  }
  const Json* extensions = document.find(node + "/extensions");
  document.erase(extensions != nullptr && extensions->size() == 1 ? node + "/extensions" : node + "/extensions/" + extension_of(lamp.kind));
}

// Excludes the lobes of cloth and paint, which accompany a specular lobe, and lobe products, which need an axis.
std::vector<std::string> lobe_names() {
  std::vector<std::string> names;
  for (const lobes::LobeRow& row : lobes::lobe_rows())
    if (row.brdf != Brdf::lambert && row.brdf != Brdf::charlie && row.brdf != Brdf::lobe_product) names.emplace_back(row.name);
  return names;
}

Json lobe_named(const std::string& name) {
  Json lobe = {{"brdf", name}};
  for (const lobes::LobeRow& row : lobes::lobe_rows()) {
    if (name != row.name) continue;
    if (lobes::has_key(row.keys, "exponent")) lobe["exponent"] = 50;
    if (lobes::has_key(row.keys, "roughness")) lobe["roughness"] = 0.3;
  }
  return lobe;
}

MaterialValues material_values(const EditedDocument& document, int material) {
  const std::string at = material_pointer(material), pbr = at + "/pbrMetallicRoughness";
  return {document.text(at + "/name", "material " + std::to_string(material)), color(document, pbr + "/baseColorFactor", {1, 1, 1}),
          document.number(pbr + "/metallicFactor", 1), document.number(pbr + "/roughnessFactor", 1), [&] {
            const Json* lobe = document.find(at + kLobe);
            return lobe != nullptr ? *lobe : Json();
          }()};
}

void set_material_values(EditedDocument& document, int material, const MaterialValues& values) {
  const std::string pbr = material_pointer(material) + "/pbrMetallicRoughness";
  const MaterialValues now = material_values(document, material);
  if (!(values.base_color == now.base_color)) {
    const Json* old = document.find(pbr + "/baseColorFactor");
    const Vec3d c = values.base_color;
    document.set(pbr + "/baseColorFactor", Json::array({c.x, c.y, c.z, old != nullptr && old->size() == 4 ? old->at(3) : Json(1)}));
  }
  put(document, pbr + "/metallicFactor", values.metallic, now.metallic);
  put(document, pbr + "/roughnessFactor", values.roughness, now.roughness);
  if (values.lobe == now.lobe) return;
  if (values.lobe.is_null())
    document.erase(material_pointer(material) + kLobe);
  else
    document.set(material_pointer(material) + kLobe, values.lobe);
}

}  // namespace steradian::view
