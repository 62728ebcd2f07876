#include "steradian/load_scene.h"

#include <cmath>
#include <cstdio>

#include "scene/emitters.h"
#include "scene/framing.h"
#include "scene/gltf_document.h"
#include "scene/gltf_lights.h"
#include "scene/gltf_materials.h"
#include "scene/gltf_meshes.h"
#include "scene/gltf_nodes.h"

namespace steradian::scene {
namespace {

bool is_supported(const std::string& extension) {
  for (const char* known : {"EXT_lights_area", "KHR_lights_punctual", "KHR_materials_anisotropy", "KHR_materials_clearcoat",
                            "KHR_materials_sheen", "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_specular",
                            "KHR_materials_unlit", "KHR_mesh_quantization", "KHR_texture_transform"})
    if (extension == known) return true;
  return false;
}

void check_extensions(const JsonCursor& root, Warnings& warnings) {
  for (const JsonCursor& name : root.elements("extensionsRequired"))
    if (!is_supported(name.as_text()))
      name.fail("the file requires " + name.as_text() + ", which is not supported", "export it without this extension");
  for (const JsonCursor& name : root.elements("extensionsUsed"))
    if (!is_supported(name.as_text())) warnings.not_supported(name.as_text());
}

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
    Camera camera;
    camera.name = json.text("name", node.text("name", "camera" + std::to_string(index)));
    camera.yfov = perspective.number("yfov", 0, 1e-6, 3.14159);
    camera.position = visible.world.t;
    check_reach(node, camera.position, "the camera");
    camera.z = normalized(visible.world.z);
    const Frame frame = Frame::from_normal_and_tangent(camera.z, visible.world.x);
    camera.x = frame.x;
    camera.y = frame.y;
    result.push_back(camera);
  }
  return result;
}

std::string counted(std::size_t n, const std::string& what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

void say_what_was_dropped(const KeptLights& kept, std::size_t without_area, const LoadOptions& options, Warnings& warnings) {
  if (without_area > 0) warnings.say(counted(without_area, "emissive triangle") + " without area dropped");
  if (kept.without_power > 0) warnings.say(counted(kept.without_power, "area light") + " without area or radiance dropped");
  if (kept.too_many > 0) {
    char share[32];
    std::snprintf(share, sizeof share, "%.2f", 100 * (1 - kept.share));
    warnings.say("the " + counted(kept.too_many, "weakest area light") + " dropped, " + share + " % of all their power; " +
                 std::to_string(options.max_lights) + " are kept (max-lights)");
  }
}

// Below this extent the products of three lengths, in single precision, vanish. A scene of one point is no smaller than
// its camera chooses.
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
  check_extensions(document.root(), warnings);
  const GltfNodes nodes = read_nodes(document);

  Scene scene;
  GltfTextures textures(document, scene.images, warnings);
  scene.materials = read_materials(document, textures, warnings);
  scene.meshes = read_meshes(document, nodes, scene.materials, warnings);
  scene.cameras = read_cameras(document, nodes, warnings);
  scene.punctual_lights = read_punctual_lights(document, nodes);
  add_area_lights(document, nodes, scene);
  const std::size_t without_area = add_emitters(scene, document.budget(), document.path);
  say_what_was_dropped(keep_strongest(scene, static_cast<std::size_t>(options.max_lights)), without_area, options, warnings);

  measure_bounds(scene);
  check_extent(scene, document.path);
  if (nodes.zero_scaled > 0) warnings.say(counted(nodes.zero_scaled, "node") + " of scale zero left out");
  if (scene.meshes.empty()) warnings.say("the scene has no triangles");
  if (!options.lights.empty()) {
    add_lights(scene, options.lights);
  } else if (wants_light(scene)) {
    warnings.say(scene.area_lights.empty()
                     ? "the scene has no lights: a default area light shines from above"
                     : "the scene's emissive textures are too weak to light it: a default area light shines from above");
    scene.area_lights.push_back(default_light(scene));
  }
  if (scene.cameras.empty()) {
    scene.cameras.push_back(framing_camera(scene));
    warnings.say("the scene has no camera: a default one frames it from the front");
  }
  return {std::move(scene), warnings.sentences()};
}

LoadedScene read_within(Budget& budget, std::span<const std::uint8_t> file, const std::string& path, const LoadOptions& options) {
  if (options.max_lights < 1) throw Error("max_lights", "is " + std::to_string(options.max_lights) + ", must be at least 1");
  try {
    return read_scene(read_gltf(file, path, budget), options);
  } catch (const std::bad_alloc&) {
    throw budget.out_of_memory();
  }
}

}  // namespace

}  // namespace steradian::scene

namespace steradian {

LoadedScene load_scene_from_memory(std::string_view bytes, const std::string& path, const LoadOptions& options) {
  Budget budget(options.limits);
  return scene::read_within(budget, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, path, options);
}

LoadedScene load_scene(const std::string& path, const LoadOptions& options) {
  Budget budget(options.limits);
  const Bytes file = read_file(path, path, budget);
  return scene::read_within(budget, file, path, options);
}

}  // namespace steradian
