#include "merge_maps.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <set>

#include "bake/bake.h"
#include "bake/baked_file.h"
#include "image/codecs.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "wrong_use.h"
#include "verb.h"

namespace steradian::app {
namespace {

std::string read_text(const Picture& picture, const std::string& path, const char* key) {
  const auto found = picture.metadata.find(key);
  if (found == picture.metadata.end()) throw Error(path, "is no part of a light map", "merge the files of bake --part");
  return found->second;
}

}  // namespace

void merge_maps(const std::vector<std::string>& parts, const std::string& output, const Limits& limits) {
  if (!output.ends_with(".glb") && !output.ends_with(".gltf")) throw WrongOption("-o", "the baked scene is a .glb or .gltf file");
  Picture all;
  std::string settings, scene_path;
  std::size_t count = 0;
  std::set<std::size_t> numbers;
  for (const std::string& path : parts) {
    Picture part = read_picture(path, limits);
    std::size_t number = 0, of = 0;
    if (std::sscanf(read_text(part, path, "steradian.part").c_str(), "%zu/%zu", &number, &of) != 2)
      throw Error(path, "has a part that is not k/n", "merge the files of bake --part");
    scene_path = read_text(part, path, "steradian.scene");
    const std::string own = read_text(part, path, "steradian.settings") + " | " + read_text(part, path, "steradian.version") + " | " +
                            read_text(part, path, "steradian.texels") + " | " + read_text(part, path, "steradian.direct") + " | " +
                            scene_path + fmt::format(" | {} x {} | of {}", part.width, part.height, of);
    if (!numbers.insert(number).second) throw Error(path, fmt::format("is part {} once more", number), "name each part once");
    if (all.pixels.empty()) {
      all = std::move(part);
      settings = own;
      count = of;
      continue;
    }
    if (own != settings) throw Error(path, "has other settings than " + parts[0], "merge the parts of one map");
    std::vector<Vec3f>&to = all.layers["error"], &from = part.layers["error"];
    for (std::size_t i = 0; i < all.pixels.size(); ++i) {
      all.pixels[i] += part.pixels[i];
      if (i < to.size() && i < from.size()) to[i] += from[i];
    }
  }
  if (numbers.size() != count)
    throw Error(parts[0], fmt::format("is one of {} parts, and {} are here", count, numbers.size()), "merge all parts of the map");

  LoadOptions load;
  load.limits = limits;
  load.near_origin = true;
  load.lights = {AddedLight::none};
  const LoadedScene loaded = load_scene(scene_path, load);
  bake::BakeOptions options;
  if (std::sscanf(all.metadata.at("steradian.texels").c_str(), "%lf", &options.texels) != 1 ||
      !(options.texels >= 1e-3 && options.texels <= 1e4))
    throw Error(parts[0], "has no number of texels a metre", "bake the parts again");
  Budget budget(limits);
  bake::LightMap map = bake::empty_map(loaded.scene, options, scene_path, budget);
  if (map.width != all.width || map.height != all.height)
    throw Error(scene_path, "is another scene than that of " + parts[0], "bake the parts again");
  map.irradiance = all.pixels;
  map.error = all.layers["error"];
  all.metadata.erase("steradian.part");
  const std::string exr = std::filesystem::path(output).replace_extension(".exr").string();
  scene::GltfFile file = scene::read_gltf_file(scene_path, limits);
  bake::add_light_map(file, loaded, map, std::filesystem::path(exr).filename().string(), limits);
  write_picture(all, exr);
  scene::write_gltf_file(file, output);
  fmt::print("map         {} x {} texels of {} parts\n", map.width, map.height, count);
}

}  // namespace steradian::app
