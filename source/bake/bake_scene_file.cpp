#include <filesystem>

#include "bake/bake.h"
#include "bake/baked_file.h"
#include "bake/light_groups.h"
#include "bake/scene_to_bake.h"
#include "steradian/bake.h"
#include "steradian/error.h"
#include "steradian/picture.h"

namespace steradian::bake {

LoadedScene load_to_bake(const std::string& path, LoadOptions options) {
  options.near_origin = true;
  options.lights = {AddedLight::none};
  LoadedScene loaded = load_scene(path, options);
  const Scene& scene = loaded.scene;
  if (scene.area_lights.empty() && scene.punctual_lights.empty() && !scene.environment)
    throw Error(path, "has no light", "add lamps or emissive meshes, or an environment");
  return loaded;
}

std::string map_beside(const std::string& baked_scene) { return std::filesystem::path(baked_scene).replace_extension(".exr").string(); }

}  // namespace steradian::bake

namespace steradian {

LightMapFacts bake_light_map(const std::string& scene, const std::string& output, const LightMapOptions& options) {
  LoadOptions load;
  load.limits = options.limits;
  const LoadedScene loaded = bake::load_to_bake(scene, load);
  bake::BakeOptions own;
  own.texels = options.texels;
  own.light.shadows = Shadows::on;
  own.light.bounces = options.bounces;
  own.light.quality = options.quality;
  own.light.threads = options.threads;
  bake::BakeStats stats;
  Budget budget(options.limits);
  const bake::LightMap map =
      options.groups.empty()
          ? bake::bake_map(loaded.scene, own, scene, budget, &stats)
          : bake::bake_light_groups(loaded.scene, bake::light_groups(loaded.scene, options.groups, scene), own, scene, budget, stats);
  const std::string exr = bake::map_beside(output);
  scene::GltfFile file = scene::read_gltf_file(scene, options.limits);
  bake::add_light_map(file, loaded, map, std::filesystem::path(exr).filename().string(), options.limits);
  write_picture(bake::picture_of(map), exr);
  scene::write_gltf_file(file, output);
  LightMapFacts facts{map.width, map.height, stats.charts, stats.samples, stats.mean, stats.rms_residual, loaded.warnings};
  facts.warnings.insert(facts.warnings.end(), map.warnings.begin(), map.warnings.end());
  return facts;
}

}  // namespace steradian
