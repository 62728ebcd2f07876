#include "document/outline.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/box.h"
#include "scene/emitters/merge_polygons.h"
#include "scene/gltf/gltf_accessor.h"
#include "steradian/error.h"
#include "shapes/triangulate.h"

namespace steradian::view {
namespace {

constexpr const char* kOutlineName = "steradian view: an outline";  // name of the buffer that holds it
constexpr std::size_t kMostCorners = 1000;                          // every step of a drag tests all pairs of edges

std::string indexed(const char* array, std::size_t i) { return std::string("/") + array + "/" + std::to_string(i); }

struct PrimitivePlace {
  std::string primitive;  // its JSON pointer
  const Json* json = nullptr;
};

// The only primitive with the lamp's material.
std::optional<PrimitivePlace> place_of(const EditedDocument& document, const Lamp& lamp) {
  if (lamp.kind != LampKind::mesh) return {};
  const int mesh = document.index("/nodes/" + std::to_string(lamp.node) + "/mesh");
  if (mesh < 0 || document.find("/nodes/" + std::to_string(lamp.node) + "/skin") != nullptr) return {};
  const std::string primitives = indexed("meshes", static_cast<std::size_t>(mesh)) + "/primitives";
  std::optional<PrimitivePlace> found;
  for (std::size_t i = 0; i < document.count(primitives); ++i) {
    const std::string at = primitives + "/" + std::to_string(i);
    if (document.index(at + "/material") != lamp.light) continue;
    if (found || document.find(at + "/targets") != nullptr) return {};
    found = PrimitivePlace{at, document.find(at)};
  }
  return found;
}

bool has_texture(const Json& json) {
  if (!json.is_structured()) return false;
  for (const auto& [key, value] : json.items())
    if (key.ends_with("Texture") || has_texture(value)) return true;
  return false;
}

// Two axes of the outline's plane, right-handed with its normal.
Contours flattened(const Outline& outline, const Frame& frame) {
  Contours result;
  for (const auto& contour : outline.contours) {
    auto& flat = result.emplace_back();
    for (const Vec3d& p : contour) flat.push_back({dot(p, frame.x), dot(p, frame.y)});
  }
  return result;
}

// Bytes in the form of a buffer in the file's text.
class PackedBytes {
 public:
  template <class T>
  void add(const std::vector<T>& values) {
    offsets_.push_back(bytes_.size());
    const auto* first = reinterpret_cast<const std::uint8_t*>(values.data());
    bytes_.insert(bytes_.end(), first, first + values.size() * sizeof(T));
  }
  Json buffer() const {
    return {
        {"name", kOutlineName}, {"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + scene::base64(bytes_)}};
  }
  Json view(std::size_t part, std::size_t buffer) const {
    const std::size_t end = part + 1 < offsets_.size() ? offsets_[part + 1] : bytes_.size();
    return {{"buffer", buffer}, {"byteOffset", offsets_[part]}, {"byteLength", end - offsets_[part]}};
  }

 private:
  Bytes bytes_;
  std::vector<std::size_t> offsets_;
};

// The first of the three accessors of an outline written here; the next free number if the primitive has none yet.
std::size_t first_accessor(const EditedDocument& document, const Json& primitive) {
  const Json::json_pointer at("/attributes/POSITION");
  if (primitive.contains(at) && primitive.at(at).is_number_unsigned()) {
    const auto accessor = primitive.at(at).get<std::size_t>();
    const int view = document.index(indexed("accessors", accessor) + "/bufferView");
    const int buffer = view < 0 ? -1 : document.index(indexed("bufferViews", static_cast<std::size_t>(view)) + "/buffer");
    if (buffer >= 0 && document.text(indexed("buffers", static_cast<std::size_t>(buffer)) + "/name", "") == kOutlineName) return accessor;
  }
  return document.count("/accessors");
}

}  // namespace

std::optional<Outline> outline_of(const EditedDocument& document, const Lamp& lamp) try {
  const auto place = place_of(document, lamp);
  if (!place || has_texture(*document.find("/materials/" + std::to_string(lamp.light)))) return {};
  Budget budget;
  const scene::GltfDocument file = scene::document_of(document.file(), budget);
  const nlohmann::json json = *place->json;  // a copy, because a cursor only refers to its JSON
  const scene::JsonCursor primitive(json, place->primitive);
  if (primitive.integer("mode", 4, 0, 6) != 4) return {};
  const std::size_t accessors = file.count("accessors");
  const auto positions = scene::read_floats(file, primitive.at("attributes").at("POSITION").as_index(accessors, "accessor"), "VEC3");
  std::vector<std::uint32_t> corners(positions.count);
  for (std::uint32_t i = 0; i < corners.size(); ++i) corners[i] = i;
  if (const int indices = primitive.index("indices", accessors, "accessor"); indices >= 0)
    corners = scene::read_unsigned(file, indices, "SCALAR");
  if (corners.size() > 3 * kMostCorners) return {};

  std::vector<scene::Triangle> triangles;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    scene::Triangle t;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t v = 3 * std::size_t{corners[i + c]};
      if (v + 2 >= positions.values.size()) return {};
      const auto at = [&](std::size_t k) { return static_cast<double>(positions.values[v + k]); };
      t[c] = {at(0), at(1), at(2)};
    }
    triangles.push_back(t);
  }
  scene::MergedPolygons merged = scene::merge_coplanar(triangles, [](std::size_t, std::size_t) { return true; });
  if (merged.polygons.size() != 1 || merged.without_area > 0) return {};
  scene::MergedPolygon& polygon = merged.polygons[0];
  Outline outline;
  const scene::Triangle& largest = triangles[polygon.triangles.front()];
  outline.normal = normalized(cross(largest[1] - largest[0], largest[2] - largest[0]));
  outline.contours.push_back(std::move(polygon.outline));
  for (auto& hole : polygon.holes) outline.contours.push_back(std::move(hole));
  return outline;
} catch (const std::exception&) {
  return {};  // the file is broken; the error appears when it is read
}

bool set_outline(EditedDocument& document, const Lamp& lamp, const Outline& outline) {
  const auto place = place_of(document, lamp);
  if (!place || outline.contours.empty()) return false;
  const Frame frame = Frame::from_normal(outline.normal);
  const auto triangles = triangles_of(flattened(outline, frame));
  if (!triangles) return false;

  std::vector<Vec3f> positions, normals;
  Box3f box;
  const double height = dot(outline.contours[0][0], frame.z);  // puts all corners on one plane: dragged corners are only near it
  for (const auto& contour : outline.contours)
    for (const Vec3d& p : contour) {
      const auto q = static_cast<Vec3f>(p + frame.z * (height - dot(p, frame.z)));
      box.add(q);
      positions.push_back(q);
    }
  if (positions.size() > kMostCorners) return false;
  normals.assign(positions.size(), static_cast<Vec3f>(frame.z));
  std::vector<std::uint32_t> indices;
  for (const auto& t : *triangles) indices.insert(indices.end(), t.begin(), t.end());

  const std::size_t accessor = first_accessor(document, *place->json);
  const bool is_new = accessor == document.count("/accessors");
  const std::size_t view =
      is_new ? document.count("/bufferViews") : static_cast<std::size_t>(document.index(indexed("accessors", accessor) + "/bufferView"));
  const std::size_t buffer =
      is_new ? document.count("/buffers") : static_cast<std::size_t>(document.index(indexed("bufferViews", view) + "/buffer"));
  PackedBytes packed;
  packed.add(positions);
  packed.add(normals);
  packed.add(indices);
  document.set(indexed("buffers", buffer), packed.buffer());
  for (std::size_t i = 0; i < 3; ++i) document.set(indexed("bufferViews", view + i), packed.view(i, buffer));
  const auto list = [](Vec3f v) { return Json::array({v.x, v.y, v.z}); };
  document.set(indexed("accessors", accessor), {{"bufferView", view},
                                                {"componentType", 5126},
                                                {"type", "VEC3"},
                                                {"count", positions.size()},
                                                {"min", list(box.low)},
                                                {"max", list(box.high)}});
  document.set(indexed("accessors", accessor + 1),
               {{"bufferView", view + 1}, {"componentType", 5126}, {"type", "VEC3"}, {"count", normals.size()}});
  document.set(indexed("accessors", accessor + 2),
               {{"bufferView", view + 2}, {"componentType", 5125}, {"type", "SCALAR"}, {"count", indices.size()}});
  if (is_new) {
    document.set(place->primitive + "/attributes", {{"POSITION", accessor}, {"NORMAL", accessor + 1}});
    document.set(place->primitive + "/indices", accessor + 2);
  }
  return true;
}

int add_polygon_light(EditedDocument& document, Vec3d position, Vec3d direction, double size) {
  const std::size_t material = document.count("/materials"), mesh = document.count("/meshes");
  use_extension(document, "KHR_materials_emissive_strength");
  const std::string name = "polygon " + std::to_string(mesh + 1);
  document.set(indexed("materials", material), {{"name", name},
                                                {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}}},
                                                {"emissiveFactor", {1, 1, 1}},
                                                {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5}}}}}});
  document.set(indexed("meshes", mesh),
               {{"name", name}, {"primitives", Json::array({{{"attributes", Json::object()}, {"material", material}}})}});
  const int node = add_node(document, {{"name", name}, {"mesh", mesh}}, position, direction);
  Outline outline;
  outline.normal = {0, 0, -1};  // the direction in which area lights shine
  auto& contour = outline.contours.emplace_back();
  for (int i = 0; i < 5; ++i) {
    const double angle = std::numbers::pi / 2 - 2 * std::numbers::pi * i / 5;
    contour.push_back({size / 2 * std::cos(angle), size / 2 * std::sin(angle), 0});
  }
  set_outline(document, {LampKind::mesh, node, static_cast<int>(material), name, "mesh"}, outline);
  return node;
}

}  // namespace steradian::view
