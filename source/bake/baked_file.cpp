#include "bake/baked_file.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "bake/added_data.h"
#include "image/codecs.h"
#include "scene/gltf/gltf_accessor.h"
#include "scene/gltf/gltf_meshes.h"
#include "scene/gltf/gltf_nodes.h"

namespace steradian::bake {
namespace {

using scene::GltfDocument;
using scene::GltfFile;
using scene::Json;

// A vertex of the new file: a mean of the file's vertices.
struct MapVertex {
  std::array<std::uint32_t, 3> from{};
  std::array<float, 3> weights{1, 0, 0};
  std::array<float, 3> shows{};  // place in the map, or irradiance
};

struct MapPrimitive {
  int node = 0, mesh = 0, primitive = 0;
  std::vector<MapVertex> vertices;
  std::vector<std::uint32_t> indices;
};

// Finds the new vertices of a scene's mesh: those of two charts become two.
class PrimitiveBuilder {
 public:
  PrimitiveBuilder(const LightMap& map, std::uint32_t mesh, const std::vector<std::uint32_t>& corners, bool turned)
      : map_(map), mesh_(mesh), cuts_(map.cuts.size() > mesh ? map.cuts[mesh] : none_), corners_(corners), turned_(turned) {
    places_.resize(cuts_.empty() ? corners.size() / 3 : cuts_.size());
    for (std::uint32_t c = 0; c < map.charts.size(); ++c)
      if (map.charts[c].mesh == mesh)
        for (const ChartTriangle& t : map.charts[c].triangles) places_[t.triangle] = ChartPlace{c, t.at};
  }

  void fill(MapPrimitive& primitive) {
    for (std::uint32_t t = 0; t < places_.size(); ++t)
      for (const std::size_t k : turned_ ? std::array<std::size_t, 3>{0, 2, 1} : std::array<std::size_t, 3>{0, 1, 2})
        primitive.indices.push_back(vertex(primitive, t, k));
  }

 private:
  struct ChartPlace {
    std::uint32_t chart = Chart::kWhole;
    std::array<Vec2d, 3> at;
  };

  std::array<float, 3> shown_by(std::uint32_t t, std::size_t k) const {
    if (!map_.corners.empty()) {
      const Vec3f light = map_.corners[mesh_].irradiance[3 * std::size_t{t} + k];
      return {light.x, light.y, light.z};
    }
    const ChartPlace& place = places_[t];
    if (place.chart == Chart::kWhole) return {};
    return {static_cast<float>(place.at[k].x / map_.width), static_cast<float>(place.at[k].y / map_.height), 0};
  }

  std::uint32_t vertex(MapPrimitive& primitive, std::uint32_t t, std::size_t k) {
    MapVertex v;
    std::uint32_t source = t;
    std::array<double, 3> weights{};
    weights[k] = 1;
    if (!cuts_.empty()) source = cuts_[t][k].triangle, weights = cuts_[t][k].weights;
    for (std::size_t i = 0; i < 3; ++i) {
      // The scene's triangles run the other way where a node mirrors them.
      v.from[i] = corners_[3 * std::size_t{source} + (turned_ ? (3 - i) % 3 : i)];
      v.weights[i] = static_cast<float>(weights[i]);
    }
    constexpr float kAtCorner = 1 - 1e-6f;
    for (std::size_t i = 0; i < 3; ++i)
      if (v.weights[i] >= kAtCorner) v = {{v.from[i], v.from[i], v.from[i]}, {1, 0, 0}, {}};
    v.shows = shown_by(t, k);
    const auto [it, fresh] = known_.try_emplace({v.from, v.weights, v.shows}, static_cast<std::uint32_t>(primitive.vertices.size()));
    if (fresh) primitive.vertices.push_back(v);
    return it->second;
  }

  const LightMap& map_;
  const std::uint32_t mesh_;
  const std::vector<std::array<CutCorner, 3>> none_;
  const std::vector<std::array<CutCorner, 3>>& cuts_;
  const std::vector<std::uint32_t>& corners_;
  const bool turned_;
  std::vector<ChartPlace> places_;  // by triangle of the baked mesh
  std::map<std::tuple<std::array<std::uint32_t, 3>, std::array<float, 3>, std::array<float, 3>>, std::uint32_t> known_;
};

// The primitives with a map, in the order of the scene's meshes.
std::vector<MapPrimitive> primitives_of(const GltfDocument& document, const LoadedScene& loaded, const LightMap& map) {
  std::set<std::uint32_t> lit;
  for (const Chart& chart : map.charts) lit.insert(chart.mesh);
  const scene::GltfNodes nodes = scene::read_nodes(document);
  std::map<int, std::size_t> shown;  // primitives of a node so far
  std::vector<MapPrimitive> result;
  for (std::uint32_t m = 0; m < loaded.scene.meshes.size(); ++m) {
    if (loaded.scene.meshes[m].is_light_shape) continue;
    const int node = loaded.mesh_nodes[m];
    const scene::JsonCursor json = document.object("nodes", node);
    const int mesh = json.index("mesh", document.count("meshes"), "mesh");
    const std::vector<int> numbers = scene::triangle_primitives(document, mesh);
    const int primitive = numbers[shown[node]++];
    if (lit.count(m) == 0) continue;
    const bool skinned =
        json.has("skin") &&
        document.object("meshes", mesh).elements("primitives")[static_cast<std::size_t>(primitive)].at("attributes").has("JOINTS_0");
    const bool turned = !skinned && nodes.world[static_cast<std::size_t>(node)].determinant() < 0;
    const std::vector<std::uint32_t> corners = scene::read_corners(document, mesh, primitive);
    MapPrimitive& out = result.emplace_back(MapPrimitive{node, mesh, primitive, {}, {}});
    PrimitiveBuilder(map, m, corners, turned).fill(out);
  }
  return result;
}

// The set of texture coordinates for the map: the first from 1 on that no texture uses.
int free_set(const Json& json) {
  int last = 0;
  const std::function<void(const Json&)> look = [&](const Json& value) {
    if (value.is_object() && value.contains("index") && value.contains("texCoord") && value["texCoord"].is_number_integer())
      last = std::max(last, value["texCoord"].get<int>());
    if (value.is_structured())
      for (const Json& part : value) look(part);
  };
  if (json.contains("materials")) look(json["materials"]);
  return last + 1;
}

// Writes the vertices of a primitive again, in the map's order.
class AttributeWriter {
 public:
  AttributeWriter(const GltfDocument& document, NewData& data, const std::vector<MapVertex>& vertices)
      : document_(document), data_(data), vertices_(vertices) {}

  Json written(const Json& attributes) {
    Json result = Json::object();
    for (const auto& [name, accessor] : attributes.items()) {
      if (!accessor.is_number_integer()) continue;
      result[name] = name.starts_with("JOINTS_") ? joints(accessor.get<int>()) : means(name, accessor.get<int>());
    }
    return result;
  }

 private:
  std::size_t means(const std::string& name, int accessor) {
    const scene::FloatArray all = scene::read_floats(document_, accessor, "SCALAR VEC2 VEC3 VEC4", scene::NotFinite::zero);
    const auto n = static_cast<std::size_t>(all.components);
    std::vector<float> values;
    values.reserve(n * vertices_.size());
    for (const MapVertex& v : vertices_)
      for (std::size_t c = 0; c < n; ++c) {
        float sum = 0;
        for (std::size_t k = 0; k < 3; ++k)
          if (v.weights[k] != 0) sum += all.values[n * v.from[k] + c] * v.weights[k];
        // The sign of a tangent's fourth number is a side, and has no mean.
        if (name == "TANGENT" && c == 3) sum = all.values[n * v.from[0] + c];
        values.push_back(sum);
      }
    const std::size_t number = data_.add_floats(values, all.components);
    if (name == "POSITION") {
      std::vector<float> low(n, std::numeric_limits<float>::max()), high(n, std::numeric_limits<float>::lowest());
      for (std::size_t i = 0; i < values.size(); ++i) {
        low[i % n] = std::min(low[i % n], values[i]);
        high[i % n] = std::max(high[i % n], values[i]);
      }
      data_.set_bounds(number, low, high);
    }
    return number;
  }

  // A cut corner takes the joints of its heaviest vertex.
  std::size_t joints(int accessor) {
    const std::vector<std::uint32_t> all = scene::read_unsigned(document_, accessor, "VEC4");
    std::vector<std::uint16_t> values;
    for (const MapVertex& v : vertices_) {
      const std::size_t k = static_cast<std::size_t>(std::max_element(v.weights.begin(), v.weights.end()) - v.weights.begin());
      for (std::size_t c = 0; c < 4; ++c) values.push_back(static_cast<std::uint16_t>(all[4 * v.from[k] + c]));
    }
    const std::size_t view = data_.add_view(values.data(), values.size() * sizeof(std::uint16_t));
    return data_.add_accessor(view, kUnsignedShort, vertices_.size(), "VEC4");
  }

  const GltfDocument& document_;
  NewData& data_;
  const std::vector<MapVertex>& vertices_;
};

// The map as a picture in the file, and the texture that shows it.
std::size_t add_texture(NewData& data, const LightMap& map, const std::vector<Vec3f>& texels, float range, MapEncoding encoding) {
  const auto fill = [&](auto encoded) {
    return [&texels, &map, range, encoded](int y, std::uint8_t* row) {
      for (int x = 0; x < map.width; ++x)
        for (const std::uint8_t byte :
             encoded(texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)], range))
          *row++ = byte;
    };
  };
  const std::string png = encoding == MapEncoding::rgbm ? image::encode_png_rgba(map.width, map.height, fill(rgbm_of))
                                                        : image::encode_png_rgb16(map.width, map.height, fill(rgb16_of));
  return data.add_picture("light map", png);
}

const char* key_of(MapEncoding encoding) { return encoding == MapEncoding::rgbm ? "RGBM" : "RGB16"; }

Json& extras_of(Json& object) {
  if (!object.contains("extras") || !object["extras"].is_object()) object["extras"] = Json::object();
  Json& extras = object["extras"];
  if (!extras.contains("steradian") || !extras["steradian"].is_object()) extras["steradian"] = Json::object();
  return extras["steradian"];
}

// The mesh of a node alone: the file's own where no other node shows it, else a copy.
std::size_t own_mesh(Json& json, int node, int mesh) {
  std::size_t shown = 0;
  for (const Json& other : json["nodes"]) shown += other.contains("mesh") && other["mesh"] == mesh;
  if (shown == 1) return static_cast<std::size_t>(mesh);
  Json copy = json["meshes"][static_cast<std::size_t>(mesh)];
  json["meshes"].push_back(std::move(copy));
  json["nodes"][static_cast<std::size_t>(node)]["mesh"] = json["meshes"].size() - 1;
  return json["meshes"].size() - 1;
}

}  // namespace

void add_light_map(GltfFile& file, const LoadedScene& loaded, const LightMap& map, const std::string& exr, const Limits& limits,
                   MapEncoding encoding) {
  const GltfFile before = file;
  Budget budget(limits);
  const GltfDocument document = scene::document_of(before, budget);
  const bool at_vertices = !map.corners.empty();
  const int set = free_set(file.json);
  NewData data(file);
  if (!at_vertices) {
    Json maps = Json::array();
    const auto add = [&](const std::string& group, const std::vector<Vec3f>& texels) {
      const float range = range_of(texels);
      maps.push_back({{"group", group}, {"texture", add_texture(data, map, texels, range, encoding)}, {"range", range}, {"intensity", 1}});
    };
    if (map.groups.empty()) add("all", map.irradiance);
    for (const GroupTexels& group : map.groups) add(group.name, group.irradiance);
    extras_of(file.json)["lightMap"] = {
        {"exr", exr}, {"width", map.width}, {"height", map.height}, {"encoding", key_of(encoding)}, {"maps", std::move(maps)}};
  }
  std::map<int, std::size_t> meshes;  // by node
  for (const MapPrimitive& p : primitives_of(document, loaded, map)) {
    if (meshes.count(p.node) == 0) meshes[p.node] = own_mesh(file.json, p.node, p.mesh);
    Json primitive = file.json["meshes"][meshes[p.node]]["primitives"][static_cast<std::size_t>(p.primitive)];
    AttributeWriter writer(document, data, p.vertices);
    primitive["attributes"] = writer.written(primitive["attributes"]);
    const std::size_t numbers = at_vertices ? 3 : 2;
    std::vector<float> values;
    for (const MapVertex& v : p.vertices)
      values.insert(values.end(), v.shows.begin(), v.shows.begin() + static_cast<std::ptrdiff_t>(numbers));
    primitive["attributes"][at_vertices ? "_IRRADIANCE" : "TEXCOORD_" + std::to_string(set)] =
        data.add_floats(values, static_cast<int>(numbers));
    if (primitive.contains("targets"))
      for (Json& target : primitive["targets"]) target = writer.written(target);
    const std::size_t view = data.add_view(p.indices.data(), p.indices.size() * sizeof(std::uint32_t));
    primitive["indices"] = data.add_accessor(view, kUnsignedInt, p.indices.size(), "SCALAR");
    primitive["mode"] = 4;
    if (at_vertices)
      extras_of(primitive)["irradiance"] = "_IRRADIANCE";
    else
      extras_of(primitive)["lightMap"] = {{"texCoord", set}};
    file.json["meshes"][meshes[p.node]]["primitives"][static_cast<std::size_t>(p.primitive)] = std::move(primitive);
  }
  data.finish();
}

Picture picture_of(const LightMap& map) {
  Picture picture(map.width, map.height);
  picture.pixels = map.irradiance;
  picture.layers["error"] = map.error;
  for (const GroupTexels& group : map.groups) picture.layers["group." + group.name] = group.irradiance;
  return picture;
}

}  // namespace steradian::bake
