#include "info/info_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>
#include <variant>

#include "lobes/lobe.h"
#include "render/direct_only.h"
#include "render/frame/methods.h"
#include "steradian/load_scene.h"

namespace steradian::app {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(Vec3d v) { return {v.x, v.y, v.z}; }
Json numbers(Vec3f v) { return numbers(static_cast<Vec3d>(v)); }

double rounded(double x) { return x == 0 || !std::isfinite(x) ? x : std::stod(fmt::format("{:.6g}", x)); }

Json camera_facts(const Camera& camera) {
  return {{"name", camera.name},
          {"position", numbers(camera.position)},
          {"vertical_field_of_view", rounded(camera.yfov * 180 / std::numbers::pi)}};
}

// The shape's name, and its sizes.
struct ShapeFacts {
  Json operator()(const Polygon& p) const { return {{"type", "polygon"}, {"corners", p.vertices.size()}}; }
  Json operator()(const Ellipse& e) const {
    return {{"type", "disk"}, {"center", numbers(e.center)}, {"size", {rounded(2 * length(e.x)), rounded(2 * length(e.y))}}};
  }
  Json operator()(const Ellipsoid& e) const {
    return {{"type", "sphere"},
            {"center", numbers(e.center)},
            {"size", {rounded(2 * length(e.x)), rounded(2 * length(e.y)), rounded(2 * length(e.z))}}};
  }
  Json operator()(const Capsule& c) const {
    return {{"type", "tube"},
            {"center", numbers((c.end_a + c.end_b) * 0.5)},
            {"size", {rounded(length(c.end_b - c.end_a) + 2 * c.radius), rounded(2 * c.radius)}}};
  }
  Json operator()(const Line& l) const { return {{"type", "line"}, {"size", {rounded(length(l.end_b - l.end_a))}}}; }
};

Json area_light_facts(const AreaLight& light) {
  Json facts = {{"name", light.name}};
  facts.update(std::visit(ShapeFacts{}, light.shape));
  const double y = luminance(light.radiance), sides = light.two_sided ? 2 : 1;
  facts["area"] = rounded(y > 0 ? light.power / y : 0);
  facts["radiance"] = numbers(light.radiance);
  facts["power"] = rounded(std::numbers::pi * light.power * sides);
  facts["two_sided"] = light.two_sided;
  facts["textured"] = light.texture.has_value();
  return facts;
}

Json punctual_light_facts(const PunctualLight& light) {
  const bool directional = light.kind == PunctualKind::directional;
  Json facts = {{"name", light.name}, {"type", directional ? "directional" : light.kind == PunctualKind::spot ? "spot" : "point"}};
  facts[directional ? "illuminance" : "intensity"] = numbers(light.intensity);
  if (!directional) facts["position"] = numbers(light.position);
  if (light.kind != PunctualKind::point) facts["direction"] = numbers(light.direction);
  if (light.kind == PunctualKind::spot) {
    const auto degrees = [](double cosine) { return rounded(std::acos(cosine) * 180 / std::numbers::pi); };
    facts["angles"] = {degrees(light.cos_inner), degrees(light.cos_outer)};
  }
  if (light.profile != nullptr) {
    facts["flux"] = rounded(luminance(light.intensity) * luminous_flux(*light.profile));
    facts["direction"] = numbers(light.direction);
  }
  if (std::isfinite(light.range)) facts["range"] = light.range;
  return facts;
}

// The lobes by the material's factors; textures may still reduce a lobe to zero.
Json lobes_of(const SurfaceMaterial& m) {
  Json lobes = Json::array();
  if (m.unlit) return lobes;
  const auto weighs = [](Vec3f c) { return c.x > 0 || c.y > 0 || c.z > 0; };
  if (m.metallic < 1 && m.transmission < 1 && weighs({m.base_color.x, m.base_color.y, m.base_color.z})) lobes.push_back("lambert");
  for (const Material& lobe : m.specular_override) lobes.push_back(name_of(lobe.brdf));
  if (m.specular_override.empty() && (m.metallic > 0 || m.specular > 0)) lobes.push_back(m.anisotropy > 0 ? "ggx, anisotropic" : "ggx");
  if (weighs(m.sheen_color)) lobes.push_back("charlie (sheen)");
  if (m.clearcoat > 0) lobes.push_back("ggx (coat)");
  if (m.transmission > 0) lobes.push_back(m.solid ? "transmission, solid" : "transmission, thin");
  return lobes;
}

Json material_facts(const SurfaceMaterial& m) {
  Json facts = {{"name", m.name}, {"lobes", lobes_of(m)}};
  facts["base_color"] = {m.base_color.x, m.base_color.y, m.base_color.z, m.base_color.w};
  facts["metallic"] = m.metallic;
  facts["roughness"] = m.roughness;
  if (m.emits()) facts["emission"] = numbers(m.emissive);
  if (m.alpha_mode != AlphaMode::opaque) facts["alpha"] = m.alpha_mode == AlphaMode::mask ? "mask" : "blend";
  if (m.unlit) facts["unlit"] = true;
  return facts;
}

}  // namespace

Json scene_facts(const std::string& path, const Limits& limits) {
  LoadOptions options;
  options.limits = limits;
  options.max_lights = 1 << 20;
  const LoadedScene loaded = load_scene(path, options);
  const Scene& scene = loaded.scene;

  Json facts = {{"scene", path}, {"generator", loaded.file.generator}};
  facts["meshes"] = scene.meshes.size();
  facts["triangles"] = scene.triangle_count();
  facts["bounds"] = {numbers(scene.bounds_min), numbers(scene.bounds_max)};
  facts["pictures"] = scene.images.size();
  for (const char* list : {"cameras", "lights", "materials"}) facts[list] = Json::array();
  for (const Camera& camera : scene.cameras) facts["cameras"].push_back(camera_facts(camera));
  for (const AreaLight& light : scene.area_lights) facts["lights"].push_back(area_light_facts(light));
  for (const PunctualLight& light : scene.punctual_lights) facts["lights"].push_back(punctual_light_facts(light));
  std::set<int> worn;
  for (const Mesh& mesh : scene.meshes)
    if (!mesh.is_light_shape) worn.insert(mesh.material);
  for (const int material : worn) facts["materials"].push_back(material_facts(scene.materials[static_cast<std::size_t>(material)]));
  facts["environment"] = scene.environment ? Json(scene.environment->name) : Json(nullptr);
  facts["extensions_used"] = loaded.file.extensions_used;
  facts["extensions_required"] = loaded.file.extensions_required;
  facts["not_supported"] = loaded.file.not_supported;
  facts["not_computed"] = may_focus_light(scene) ? Json{"caustics of glass"} : Json::array();
  facts["method"] = choose_method(scene, {}).name;
  facts["warnings"] = loaded.warnings;
  return facts;
}

namespace {

constexpr std::size_t kMostLines = 32;  // per list; --json has all

std::string short_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>().empty() ? "''" : value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
  if (!value.is_array()) return value.is_null() ? "none" : value.dump();
  if (value.empty()) return "none";
  const bool numeric = value[0].is_number();
  std::string text;
  for (const Json& item : value) text += (text.empty() ? "" : numeric ? " " : ", ") + short_text(item);
  return text;
}

}  // namespace

std::string scene_text(const Json& facts) {
  std::string text;
  for (const auto& [key, value] : facts.items()) {
    std::string label = key;
    std::replace(label.begin(), label.end(), '_', ' ');
    const bool lines = value.is_array() && !value.empty() && (value[0].is_object() || key == "warnings");
    if (!lines) {
      text += fmt::format("{:<21} {}\n", label, short_text(value));
      continue;
    }
    text += fmt::format("{:<21} {}\n", label, value.size());
    for (std::size_t i = 0; i < std::min(value.size(), kMostLines); ++i) {
      if (value[i].is_string()) {
        text += "  " + value[i].get<std::string>() + "\n";
        continue;
      }
      text += "  " + short_text(value[i]["name"]);
      for (const auto& [part, item] : value[i].items())
        if (part != "name" && item != Json(false)) text += fmt::format("; {} {}", part, short_text(item));
      text += "\n";
    }
    if (value.size() > kMostLines) text += fmt::format("  and {} more (--json lists them)\n", value.size() - kMostLines);
  }
  return text;
}

}  // namespace steradian::app
