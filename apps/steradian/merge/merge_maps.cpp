#include "merge/merge_maps.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "bake/bake.h"
#include "bake/baked_file.h"
#include "bake/encoding.h"
#include "bake/scene_to_bake.h"
#include "merge/joined_parts.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "wrong_use.h"
#include "verb.h"

namespace steradian::app {

void check_baked_name(const std::string& path) {
  if (!path.ends_with(".glb") && !path.ends_with(".gltf")) throw WrongOption("-o", "the baked scene is a .glb or .gltf file");
}

void merge_maps(const std::vector<std::string>& parts, const std::string& output, const Limits& limits) {
  check_baked_name(output);
  const auto add = [](Picture& to, const Picture& part, Part) {
    for (std::size_t i = 0; i < to.pixels.size(); ++i) to.pixels[i] += part.pixels[i];
    std::vector<Vec3f>& error = to.layers["error"];
    const std::vector<Vec3f>& more = part.layers.at("error");
    for (std::size_t i = 0; i < error.size(); ++i) error[i] += more[i];
  };
  const Picture all = join_parts(parts, "bake", limits, add);
  for (const char* key : {"steradian.scene", "steradian.texels"})
    if (all.metadata.count(key) == 0 || all.layers.count("error") == 0)
      throw Error(parts[0], "is no part of a light map", "merge the files of bake --part");
  const std::string scene_path = all.metadata.at("steradian.scene");

  LoadOptions load;
  load.limits = limits;
  load.environment = "white";  // the parts hold the light, and any light will do
  const LoadedScene loaded = bake::load_to_bake(scene_path, load);
  bake::BakeOptions options;
  if (std::sscanf(all.metadata.at("steradian.texels").c_str(), "%lf", &options.texels) != 1 ||
      !(options.texels >= 1e-3 && options.texels <= 1e4))
    throw Error(parts[0], "has no number of texels a metre", "bake the parts again");
  Budget budget(limits);
  bake::LightMap map = bake::empty_map(loaded.scene, options, scene_path, budget);
  if (map.width != all.width || map.height != all.height)
    throw Error(scene_path, "is another scene than that of " + parts[0], "bake the parts again");
  map.irradiance = all.pixels;
  map.error = all.layers.at("error");
  const std::string exr = bake::map_beside(output);
  const auto encoding = all.metadata.find("steradian.encoding");
  scene::GltfFile file = scene::read_gltf_file(scene_path, limits);
  bake::add_light_map(file, loaded, map, std::filesystem::path(exr).filename().string(), limits,
                      bake::encoding_of(encoding == all.metadata.end() ? "" : encoding->second));
  write_picture(all, exr);
  scene::write_gltf_file(file, output);
  fmt::print("map         {} x {} texels of {} parts\n", map.width, map.height, parts.size());
}

}  // namespace steradian::app
