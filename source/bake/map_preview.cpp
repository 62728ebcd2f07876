#include "bake/map_preview.h"

#include <algorithm>
#include <map>

#include "bake/added_data.h"
#include "image/codecs.h"
#include "image/tone.h"

namespace steradian::bake {
namespace {

using scene::GltfFile;
using scene::Json;

// Irradiance that is shown as white.
float white_of(const LightMap& map) {
  std::vector<float> lit;
  for (const Vec3f& e : map.irradiance)
    if (const float brightest = std::max({e.x, e.y, e.z}); brightest > 0) lit.push_back(brightest);
  if (lit.empty()) return 1;
  const auto place = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() * 19 / 20);
  std::nth_element(lit.begin(), place, lit.end());
  return *place;
}

bool shines(const Json& material) {
  if (!material.contains("emissiveFactor") || !material["emissiveFactor"].is_array()) return false;
  for (const Json& channel : material["emissiveFactor"])
    if (channel.is_number() && channel.get<double>() > 0) return true;
  return false;
}

Json unlit(const Json& material, std::size_t texture, int set) {
  Json color = {{"baseColorTexture", {{"index", texture}, {"texCoord", set}}}};
  if (const auto pbr = material.find("pbrMetallicRoughness"); pbr != material.end() && pbr->contains("baseColorFactor"))
    color["baseColorFactor"] = (*pbr)["baseColorFactor"];
  Json result = {{"pbrMetallicRoughness", std::move(color)}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
  for (const char* kept : {"name", "doubleSided"})
    if (material.contains(kept)) result[kept] = material[kept];
  return result;
}

}  // namespace

GltfFile map_preview(const GltfFile& baked, const LightMap& map) {
  GltfFile file = baked;
  NewData data(file);
  const float white = white_of(map);
  const std::string png = image::encode_png_bytes(map.width, map.height, [&](int y, std::uint8_t* row) {
    const Vec3f* texels = map.irradiance.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
    for (int x = 0; x < map.width; ++x)
      for (const float channel : {texels[x].x, texels[x].y, texels[x].z})
        *row++ = image::srgb_byte(std::clamp(channel / white, 0.0f, 1.0f));
  });
  const std::size_t texture = data.add_picture("light map on the screen", png);
  std::map<std::size_t, std::size_t> unlit_of;  // by material
  constexpr std::size_t kNone = SIZE_MAX;
  for (Json& mesh : file.json["meshes"])
    for (Json& primitive : mesh["primitives"]) {
      const auto set = primitive.find("extras");
      if (set == primitive.end() || !set->contains("steradian") || !(*set)["steradian"].contains("lightMap")) continue;
      const std::size_t number = primitive.contains("material") ? primitive["material"].get<std::size_t>() : kNone;
      const Json material = number == kNone ? Json::object() : file.json["materials"][number];
      if (shines(material)) continue;
      const auto [it, fresh] = unlit_of.try_emplace(number, 0);
      if (fresh) {
        Json& materials = array_of(file.json, "materials");
        it->second = materials.size();
        materials.push_back(unlit(material, texture, (*set)["steradian"]["lightMap"]["texCoord"].get<int>()));
      }
      primitive["material"] = it->second;
    }
  Json& used = array_of(file.json, "extensionsUsed");
  if (std::find(used.begin(), used.end(), "KHR_materials_unlit") == used.end()) used.push_back("KHR_materials_unlit");
  data.finish();
  return file;
}

}  // namespace steradian::bake
