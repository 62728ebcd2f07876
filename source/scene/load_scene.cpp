#include "steradian/load_scene.h"

#include <cmath>
#include <cstdio>

#include "scene/emitters/emitters.h"
#include "scene/emitters/keep_strongest.h"
#include "scene/emitters/solid_meshes.h"
#include "scene/framing.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/gltf_environment.h"
#include "scene/gltf/gltf_file.h"
#include "scene/gltf/gltf_lights.h"
#include "scene/gltf/gltf_materials.h"
#include "scene/gltf/gltf_meshes.h"
#include "scene/gltf/gltf_nodes.h"
#include "scene/turned_environment.h"

namespace steradian::scene {
namespace {

std::vector<Camera> read_cameras(const GltfDocument& document, const GltfNodes& nodes, Warnings& warnings) {
  std::vector<Camera> result;
  for (const GltfNode& visible : nodes.visible) {
    const JsonCursor node = document.object("nodes", visible.index);
    const int index = node.index("camera", document.count("cameras"), "camera");
    if (index < 0) continue;
    const JsonCursor json = document.object("cameras", index);
    const std::string type = json.at("type").as_text();
    if (type == "orthographic") {
      warnings.not_supported("orthographic cameras");
      continue;
    }
    if (type != "perspective") json.at("type").fail("\"" + type + "\" is not a camera", "known are perspective and orthographic");
    const JsonCursor perspective = json.at("perspective");
    perspective.at("yfov");
    check_reach(node, visible.world.t, "the camera");
    result.push_back(camera_at(visible.world, perspective.number("yfov", 0, 1e-6, 3.14159),
                               json.text("name", node.text("name", "camera" + std::to_string(index)))));
  }
  return result;
}

// True if more than half of the light passes. Such a surface casts a tinted shadow instead of a black one.
bool lets_light_through(const SurfaceMaterial& m) {
  if (!m.specular_override.empty()) return false;
  return (m.alpha_mode == AlphaMode::blend && m.base_color.w < 0.5f) || m.transmission > 0.5f;
}

std::string counted(std::size_t n, const std::string& what, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? what : many);
}
std::string counted(std::size_t n, const std::string& what) { return counted(n, what, what + "s"); }

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f %%", 100 * share);
  return text;
}

void say_what_was_dropped(const Scene& scene, const KeptLights& kept, std::size_t without_area, Warnings& warnings) {
  const std::string most = std::to_string(kept.most) + " are kept (max-lights)";
  if (without_area > 0) warnings.say(counted(without_area, "emissive triangle") + " without area dropped");
  if (kept.without_power > 0) warnings.say(counted(kept.without_power, "area light") + " without area or radiance dropped");
  MergedLights of_solids;
  std::size_t solids = 0;
  if (kept.merged.count > 0)
    for (const SolidMesh& solid : solid_meshes(scene)) {
      of_solids.count += kept.of[solid.mesh].count;
      of_solids.share += kept.of[solid.mesh].share;
      solids += kept.of[solid.mesh].count > 0 ? 1 : 0;
    }
  if (of_solids.count > 0)
    warnings.say(counted(solids, "closed mesh", "closed meshes") +
                 " of one radiance: one exact light each. Where their faces count one by one (shadows off or exact, points among them), " +
                 counted(of_solids.count, "weak face") + " merged into the nearest, " + percent(of_solids.share) + " of all power; " +
                 most);
  if (kept.merged.count > of_solids.count)
    warnings.say(counted(kept.merged.count - of_solids.count, "weak area light") +
                 " of emissive meshes merged into the nearest that are kept of the same mesh, " +
                 percent(kept.merged.share - of_solids.share) + " of all power; " + most);
  if (kept.dropped > 0)
    warnings.say("the " + counted(kept.dropped, "weakest area light") + " dropped, " + percent(kept.dropped_share) + " of all power; " +
                 most);
}

// The factor by which Blender's exporter multiplies punctual lights, but not emission: lumens per watt.
constexpr double kExportersFactor = 683;

void scale_to_emission(Scene& scene, const std::string& generator, LightUnits units, Warnings& warnings) {
  if (scene.punctual_lights.empty() || units == LightUnits::candela) return;
  if (units == LightUnits::from_generator) {
    // The generator reads "Khronos glTF Blender I/O v3.4.50". The factor applies from 3.4 on.
    const std::size_t at = generator.find("Blender I/O v");
    int major = 0, minor = 0;
    if (at == std::string::npos || std::sscanf(generator.c_str() + at, "Blender I/O v%d.%d", &major, &minor) != 2) return;
    if (major < 3 || (major == 3 && minor < 4)) return;
    warnings.say(
        "the file's point, spot and directional lights are divided by 683: Blender's exporter multiplies them by 683 lm/W and "
        "leaves emission in watts (light-units candela keeps them)");
  }
  for (PunctualLight& light : scene.punctual_lights) light.intensity = light.intensity / kExportersFactor;
}

// Neither lamps, nor surfaces that shine, nor an environment, from a program that leaves lamps out unless asked.
bool lacks_blenders_lamps(const Scene& scene, const std::string& generator) {
  return generator.find("Blender") != std::string::npos && scene.punctual_lights.empty() && scene.area_lights.empty() && !scene.environment;
}

// Below this extent the products of three lengths vanish in single precision. For a scene of one point the camera chooses the extent.
constexpr double kSmallest = 1e-12;

void check_extent(const Scene& scene, const std::string& path) {
  const double extent = length(scene.bounds_max - scene.bounds_min);
  if (extent == 0 || extent >= kSmallest) return;
  char text[120];
  std::snprintf(text, sizeof text, "the whole scene is %.3g across; %.0e is the smallest that can be rendered", extent, kSmallest);
  throw Error(path, text, "scale the scene up");
}

LoadedScene read_scene(const GltfDocument& document, const LoadOptions& options) {
  Warnings warnings;
  FileFacts facts = read_file_facts(document.root(), warnings);
  GltfNodes nodes = read_nodes(document);

  Scene scene;
  GltfTextures textures(document, scene.images, warnings, options.pictures);
  scene.materials = read_materials(document, textures);
  const std::size_t materials = scene.materials.size();
  PlacedMeshes placed = read_meshes(document, nodes, scene.materials, warnings, options.meshes.get());
  const Vec3d origin = options.near_origin ? far_middle(box_around(placed.meshes)) : Vec3d{};
  if (!(origin == Vec3d{})) {
    nodes.move(-origin);
    scene.materials.resize(materials);
    Warnings said;
    placed = read_meshes(document, nodes, scene.materials, said, options.meshes.get());
  }
  scene.meshes = std::move(placed.meshes);
  for (Mesh& mesh : scene.meshes) mesh.casts_shadow = !lets_light_through(scene.materials[static_cast<std::size_t>(mesh.material)]);
  scene.cameras = read_cameras(document, nodes, warnings);
  scene.punctual_lights = read_punctual_lights(document, nodes);
  scale_to_emission(scene, facts.generator, options.light_units, warnings);
  scene.environment = read_image_based_light(document, textures);
  for (const int node : add_area_lights(document, nodes, scene)) placed.nodes.push_back(node);
  const std::size_t without_area = add_emitters(scene, document.budget(), document.path);
  std::optional<std::size_t> most;
  if (options.max_lights) most = static_cast<std::size_t>(*options.max_lights);
  const KeptLights kept = keep_strongest(scene, most, document.budget(), document.path);
  say_what_was_dropped(scene, kept, without_area, warnings);

  measure_bounds(scene);
  check_extent(scene, document.path);
  if (nodes.zero_scaled > 0) warnings.say(counted(nodes.zero_scaled, "node") + " of scale zero left out");
  if (scene.meshes.empty()) warnings.say("the scene has no triangles");
  if (!options.environment.empty()) {
    Environment environment = load_environment(options.environment, options.limits);
    if (environment.repaired > 0)
      warnings.say(counted(environment.repaired, "value") + " of the environment " + environment.name +
                   " that no radiance has (negative, infinite, none) made 0 or the largest of the others");
    scene.environment = std::make_shared<const Environment>(std::move(environment));
  }
  if (scene.environment && options.environment_rotation != 0) {
    Environment turned = *scene.environment;
    turn(turned, options.environment_rotation);
    scene.environment = std::make_shared<const Environment>(std::move(turned));
  }
  if (scene.cameras.empty()) {
    scene.cameras.push_back(framing_camera(scene, options.aspect));
    warnings.say("the scene has no camera: a default one frames it from the front and the right");
  }
  if (lacks_blenders_lamps(scene, facts.generator))
    warnings.say(
        "the file has no light, and Blender's exporter writes lamps only with \"Punctual Lights\" in its export options: perhaps they were "
        "left out");
  if (!options.lights.empty()) {
    add_lights(scene, options.lights);
  } else if (!scene.environment && wants_light(scene, scene.cameras.front())) {
    warnings.say(
        scene.area_lights.empty()
            ? "the scene has no lights: a default area light shines from above, and a weak one from the front"
            : "the scene's emissive textures do not light it: a default area light shines from above, and a weak one from the front");
    add_lights(scene, {AddedLight::standard});
  }
  facts.not_supported = warnings.features();
  return {std::move(scene),
          std::move(facts),
          textures.decoding_ms(),
          warnings.sentences(),
          std::move(placed.nodes),
          options.meshes != nullptr ? options.meshes->found : 0,
          origin};
}

template <class Document>  // a function that returns the document
LoadedScene read_within(Budget& budget, const LoadOptions& options, Document document) {
  if (options.max_lights && *options.max_lights < 1)
    throw Error("max_lights", "is " + std::to_string(*options.max_lights) + ", must be at least 1");
  try {
    return read_scene(document(), options);
  } catch (const std::bad_alloc&) {
    throw budget.out_of_memory();
  }
}

}  // namespace

LoadedScene load_scene(const GltfFile& file, const LoadOptions& options) {
  Budget budget(options.limits);
  return read_within(budget, options, [&] { return document_of(file, budget); });
}

}  // namespace steradian::scene

namespace steradian {

LoadedScene load_scene_from_memory(std::string_view bytes, const std::string& path, const LoadOptions& options) {
  Budget budget(options.limits);
  const std::span<const std::uint8_t> file(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  return scene::read_within(budget, options, [&] { return scene::read_gltf(file, path, budget); });
}

LoadedScene load_scene(const std::string& path, const LoadOptions& options) {
  Budget budget(options.limits);
  const Bytes file = read_file(path, path, budget);
  return scene::read_within(budget, options, [&] { return scene::read_gltf(file, path, budget); });
}

}  // namespace steradian
