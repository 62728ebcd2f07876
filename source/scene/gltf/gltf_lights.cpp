#include "scene/gltf/gltf_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <span>

#include "scene/emitters/emitters.h"

namespace steradian::scene {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostIntensity = 1e30;
// Memory [bytes] of the largest mesh that shows a light: an ellipsoid's or a tube's rows, with the material.
constexpr std::uint64_t kLargestLightMesh = 200'000;

// Default intensity of area lights, from the draft of EXT_lights_area [nits]. The default of punctual lights is 1.
constexpr double kNitsByDefault = 1000;

Vec3d read_color(const JsonCursor& light) {
  const Vec3d c = light.vector("color", {1, 1, 1});
  if (c.x < 0 || c.y < 0 || c.z < 0) light.at("color").fail("components must not be negative");
  return c;
}

// Colour times intensity.
Vec3d read_emission(const JsonCursor& light, double by_default) {
  const Vec3d emission = read_color(light) * light.number("intensity", by_default, 0, kMostIntensity);
  if (std::max({emission.x, emission.y, emission.z}) > kMostIntensity)
    light.fail("color times intensity is more than 1e30", "choose a smaller unit");
  return emission;
}

JsonElements lights_of(const GltfDocument& document, const char* extension) {
  const auto root = find_extension(document.root(), extension);
  return root ? root->elements("lights") : JsonElements{};
}

// Calls make(definition, node's JSON, node) for every visible node that carries a light of the extension.
template <class Make>
void for_each_light(const GltfDocument& document, const GltfNodes& nodes, const char* extension, Make make) {
  const auto lights = lights_of(document, extension);
  for (const GltfNode& visible : nodes.visible) {
    const JsonCursor node = document.object("nodes", visible.index);
    const auto reference = find_extension(node, extension);
    if (!reference) continue;
    const int light = reference->at("light").as_index(lights.size(), "light");
    make(lights[static_cast<std::size_t>(light)], node, visible);
  }
}

// The part of its node's transform that a flat light uses, as the draft demands: place, rotation, and one scale. The scale is the largest
// in size of the node's three in the world. If a parent's unequal scale shears the node, z and then x keep their directions. No scale of a
// visible node is zero.
Affine evenly_scaled(const Affine& world) {
  const double scale = std::max({length(world.x), length(world.y), length(world.z)});
  const Vec3d z = normalized(world.z), x = normalized(world.x - z * dot(z, world.x));
  return {x * scale, cross(z, x) * scale, z * scale, world.t};
}

// Half axes of a flat light in the node's plane z = 0. After the transform x cross y points along the node's -z.
Ellipse flat_axes(const Affine& world, double half_x, double half_y) {
  Ellipse e{world.t, world.x * -half_x, world.y * half_y};
  if (dot(cross(e.x, e.y), world.z) > 0) e.x = -e.x;
  return e;
}

// Knud Thomsen's formula, within 1.1 % of an ellipsoid's surface. That is accurate enough to rank lights.
double ellipsoid_area(Vec3d x, Vec3d y, Vec3d z) {
  constexpr double p = 1.6075;
  const double a = std::pow(length(x), p), b = std::pow(length(y), p), c = std::pow(length(z), p);
  return 4 * std::numbers::pi * std::pow((a * b + a * c + b * c) / 3, 1 / p);
}

// Reads "extras": {"steradian": ...}, for properties that the draft does not have (docs/lights.md, "EXT_lights_area").
std::optional<JsonCursor> extra_of_ours(const JsonCursor& light) {
  const auto extras = light.find("extras");
  if (!extras || !extras->value().is_object()) return {};
  auto ours = extras->find("steradian");
  if (!ours || !ours->value().is_object()) return {};
  return ours;
}

// With "scale": "axes" a flat light uses all of its node's transform.
Affine transform_of(const std::optional<JsonCursor>& ours, const Affine& world) {
  if (!ours || !ours->has("scale")) return evenly_scaled(world);
  const std::string scale = ours->at("scale").as_text();
  if (scale != "axes" && scale != "largest") ours->at("scale").fail("\"" + scale + "\" is not known", "axes, or largest: the draft's rule");
  return scale == "axes" ? world : evenly_scaled(world);
}

AreaLight read_area_light(const JsonCursor& json, const JsonCursor& node, const Affine& node_world) {
  AreaLight light;
  light.name = json.text("name", node.text("name", ""));
  const auto ours = extra_of_ours(json);
  const std::string type = ours && ours->has("type") ? ours->at("type").as_text() : json.at("type").as_text();
  const Vec3d radiance = read_emission(json, kNitsByDefault);
  const double half = json.number("size", 1, 0, 1e30) / 2;
  const bool flat = type == "rect" || type == "disk";
  const Affine world = flat ? transform_of(ours, node_world) : node_world;
  double area = 0;
  if (type == "rect") {
    const auto rect = json.find("rect");
    const double aspect = rect ? rect->number("aspect", 1, 0, 1e9) : 1;
    const Ellipse e = flat_axes(world, half * aspect, half);
    light.shape = Polygon{{e.center - e.x - e.y, e.center + e.x - e.y, e.center + e.x + e.y, e.center - e.x + e.y}, {}};
    area = 4 * length(cross(e.x, e.y));
  } else if (type == "disk") {
    const double aspect = ours ? ours->number("aspect", 1, 0, 1e9) : 1;
    const Ellipse e = flat_axes(world, half * aspect, half);
    light.shape = e;
    area = std::numbers::pi * length(cross(e.x, e.y));
  } else if (type == "sphere") {
    const Ellipsoid e{world.t, world.x * half, world.y * half, world.z * half};
    light.shape = e;
    area = ellipsoid_area(e.x, e.y, e.z);
  } else if (type == "capsule") {
    // The tube lies along the node's x. Its cross-section stays round: its scale is the geometric mean of the node's two other scales.
    const auto capsule = json.has("capsule") || !ours ? json.find("capsule") : ours->find("capsule");
    const double between = capsule ? capsule->number("length", 1, 0, 1e30) : 1;
    const Vec3d half_axis = world.x * (between / 2);
    const Capsule c{world.t - half_axis, world.t + half_axis, half * std::sqrt(length(world.y)) * std::sqrt(length(world.z))};
    light.shape = c;
    area = 4 * std::numbers::pi * c.radius * (c.radius + length(half_axis));
  } else {
    json.at("type").fail("\"" + type + "\" is not an area light", "known are rect, disk, sphere and capsule");
  }
  light.radiance = radiance;
  light.two_sided = light.is_flat() && ours && ours->flag("two_sided", false);
  light.power = luminance(radiance) * area;
  if (!std::isfinite(light.power)) json.fail("the light leaves the range of numbers");
  return light;
}

SurfaceMaterial material_of_light(const AreaLight& light) {
  SurfaceMaterial m;
  m.name = light.name;
  m.base_color = {0, 0, 0, 1};
  m.specular = 0;
  m.metallic = 0;
  m.double_sided = light.two_sided;
  m.emissive = static_cast<Vec3f>(light.radiance);
  return m;
}

Mesh flat_mesh(const PolygonLight& polygon) {
  Mesh mesh;
  Vec3d area{};
  const auto& v = polygon.vertices;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) {
    area += cross(v[i] - v[0], v[i + 1] - v[0]);
    mesh.indices.insert(mesh.indices.end(), {0u, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i + 1)});
  }
  for (const Vec3d& p : v) mesh.positions.push_back(static_cast<Vec3f>(p));
  mesh.normals.assign(v.size(), static_cast<Vec3f>(normalized(area)));
  return mesh;
}

Mesh mesh_of(const Ellipsoid& ellipsoid) {
  constexpr std::uint32_t kAround = 64, kDown = 32;
  const Affine m{ellipsoid.x, ellipsoid.y, ellipsoid.z, ellipsoid.center};
  Mesh mesh;
  for (std::uint32_t j = 0; j <= kDown; ++j)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double theta = std::numbers::pi * j / kDown, phi = 2 * std::numbers::pi * i / kAround;
      const Vec3d u{std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)};
      mesh.positions.push_back(static_cast<Vec3f>(m.point(u)));
      mesh.normals.push_back(static_cast<Vec3f>(m.normal(u)));
    }
  for (std::uint32_t j = 0; j < kDown; ++j)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = j * kAround + i, b = j * kAround + (i + 1) % kAround, c = a + kAround, d = b + kAround;
      if (j > 0) mesh.indices.insert(mesh.indices.end(), {a, c, b});
      if (j + 1 < kDown) mesh.indices.insert(mesh.indices.end(), {b, c, d});
    }
  if (m.determinant() < 0)
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  return mesh;
}

// Two hemispheres and the wall between them.
Mesh mesh_of(const Capsule& capsule) {
  constexpr std::uint32_t kAround = 64, kRows = 34;  // two of the rows are the wall's rims
  const Vec3d axis = capsule.end_b - capsule.end_a;
  const Frame frame = length(axis) > 0 ? Frame::from_normal(normalized(axis)) : Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Mesh mesh;
  for (std::uint32_t j = 0; j < kRows; ++j)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const bool second = j >= kRows / 2;
      const double theta = std::numbers::pi * (second ? j - 1 : j) / (kRows - 2), phi = 2 * std::numbers::pi * i / kAround;
      const Vec3d u = frame.to_world({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
      mesh.positions.push_back(static_cast<Vec3f>((second ? capsule.end_a : capsule.end_b) + u * capsule.radius));
      mesh.normals.push_back(static_cast<Vec3f>(u));
    }
  for (std::uint32_t j = 0; j + 1 < kRows; ++j)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = j * kAround + i, b = j * kAround + (i + 1) % kAround, c = a + kAround, d = b + kAround;
      if (j > 0) mesh.indices.insert(mesh.indices.end(), {a, c, b});
      if (j + 2 < kRows) mesh.indices.insert(mesh.indices.end(), {b, c, d});
    }
  return mesh;
}

std::shared_ptr<const LightProfile> read_profile(const GltfDocument& document, const JsonCursor& json) {
  std::span<const std::uint8_t> bytes;
  std::string name = json.place();
  if (const auto uri = json.find("uri")) {
    bytes = read_uri(document, *uri);
    if (!uri->as_text().starts_with("data:")) name += ": " + uri->as_text();
  } else if (json.has("bufferView")) {
    bytes = view_bytes(document, json.index("bufferView", document.count("bufferViews"), "bufferView"));
  } else {
    json.fail("has neither \"uri\" nor \"bufferView\"");
  }
  document.budget().take_memory(name, "its profile", bytes.size() * 32);
  return std::make_shared<const LightProfile>(
      read_light_profile_from_memory({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name, document.budget().limits()));
}

constexpr const char* kProfiles = "EXT_lights_ies";

// Reads each file of the extension once.
class Profiles {
 public:
  explicit Profiles(const GltfDocument& document) : document_(document) {}

  std::shared_ptr<const LightProfile> of(const JsonCursor& definition) {
    auto& profile = read_[definition.place()];
    if (profile == nullptr) profile = read_profile(document_, definition);
    return profile;
  }

  // Sets the profile that the light's extra names, if it names one: candela times color and the extra's multiplier.
  void give_to(AreaLight& light, const JsonCursor& json, const Affine& world) {
    const auto ours = extra_of_ours(json);
    if (!ours || !ours->has("profile")) return;
    const JsonCursor use = ours->at("profile");
    const JsonElements definitions = lights_of(document_, kProfiles);
    const JsonCursor definition = definitions[static_cast<std::size_t>(use.at("light").as_index(definitions.size(), "light"))];
    if (!light.is_flat()) use.fail("only rects and disks shine by a profile", "use another type, or EXT_lights_ies on the node: a point");
    set_emission(light, of(definition), world.x, read_color(json) * use.number("multiplier", 1, 0, kMostIntensity));
    ProfileAxes& axes = light.emission->axes;
    if (dot(axes.y, world.y) < 0) axes.y = -axes.y;
    if (!std::isfinite(light.power)) json.fail("the light leaves the range of numbers");
  }

 private:
  const GltfDocument& document_;
  std::map<std::string, std::shared_ptr<const LightProfile>> read_;  // by place
};

}  // namespace

Mesh mesh_of_light(const AreaLight& light) {
  const auto* ellipsoid = std::get_if<Ellipsoid>(&light.shape);
  const auto* capsule = std::get_if<Capsule>(&light.shape);
  Mesh mesh = ellipsoid != nullptr ? mesh_of(*ellipsoid) : capsule != nullptr ? mesh_of(*capsule) : flat_mesh(flat_polygon(light));
  mesh.name = light.name;
  mesh.is_light_shape = true;
  return mesh;
}

std::vector<int> add_area_lights(const GltfDocument& document, const GltfNodes& nodes, Scene& scene) {
  for_each_light(document, nodes, "EXT_lights_area", [&](const JsonCursor&, const JsonCursor& node, const GltfNode&) {
    document.budget().take_memory(node.place(), "its light's mesh", kLargestLightMesh);
  });
  std::vector<int> nodes_of_meshes;
  Profiles profiles(document);
  for_each_light(document, nodes, "EXT_lights_area", [&](const JsonCursor& json, const JsonCursor& node, const GltfNode& visible) {
    AreaLight light = read_area_light(json, node, visible.world);
    profiles.give_to(light, json, visible.world);
    light.node = visible.index;
    const auto ours = extra_of_ours(json);
    if (light.power > 0 && !(ours && !ours->flag("seen", true))) {
      Mesh mesh = mesh_of_light(light);
      for (const Vec3f& p : mesh.positions) check_reach(node, static_cast<Vec3d>(p), "the light");
      // Lifts the mesh in front of a surface at exactly the same place, such as a ceiling. The mesh stays below the points that
      // lift_off_lights lifts off the light.
      const float lift = light.two_sided ? 0 : 0.5f * roundings_of_plane(light);
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) mesh.positions[i] += mesh.normals[i] * lift;
      mesh.material = static_cast<int>(scene.materials.size());
      mesh.triangle_lights.assign(mesh.triangle_count(), static_cast<std::int32_t>(scene.area_lights.size()));
      scene.materials.push_back(material_of_light(light));
      scene.meshes.push_back(std::move(mesh));
      nodes_of_meshes.push_back(visible.index);
    }
    scene.area_lights.push_back(std::move(light));
  });
  return nodes_of_meshes;
}

namespace {

// Adds the lights that a profile describes: candela times the node's multiplier and colour, aimed along the node's -z.
void add_profile_lights(const GltfDocument& document, const GltfNodes& nodes, std::vector<PunctualLight>& lights) {
  Profiles profiles(document);
  for_each_light(document, nodes, kProfiles, [&](const JsonCursor& json, const JsonCursor& node, const GltfNode& visible) {
    const Affine& world = visible.world;
    PunctualLight light;
    light.name = json.text("name", node.text("name", ""));
    light.position = world.t;
    check_reach(node, light.position, "the light");
    light.direction = normalized(world.vector({0, 0, -1}));
    const JsonCursor use = *find_extension(node, kProfiles);
    light.intensity = read_color(use) * use.number("multiplier", 1, 0, kMostIntensity);
    light.profile = profiles.of(json);
    light.node = visible.index;
    light.profile_axes = profile_axes(light.direction, world.x);
    if (dot(light.profile_axes.y, world.y) < 0) light.profile_axes.y = -light.profile_axes.y;
    lights.push_back(std::move(light));
  });
}

}  // namespace

std::vector<PunctualLight> read_punctual_lights(const GltfDocument& document, const GltfNodes& nodes) {
  std::vector<PunctualLight> result;
  for_each_light(document, nodes, "KHR_lights_punctual", [&](const JsonCursor& json, const JsonCursor& node, const GltfNode& visible) {
    const Affine& world = visible.world;
    PunctualLight light;
    light.name = json.text("name", node.text("name", ""));
    const std::string type = json.at("type").as_text();
    if (type == "spot")
      light.kind = PunctualKind::spot;
    else if (type == "directional")
      light.kind = PunctualKind::directional;
    else if (type != "point")
      json.at("type").fail("\"" + type + "\" is not a light", "known are point, spot and directional");
    light.node = visible.index;
    light.position = world.t;
    check_reach(node, light.position, "the light");
    light.direction = normalized(world.vector({0, 0, -1}));
    light.intensity = read_emission(json, 1);
    light.range = json.number("range", kInfinity, 1e-30, kInfinity);
    if (const auto spot = json.find("spot")) {
      const double outer = spot->number("outerConeAngle", std::numbers::pi / 4, 1e-9, std::numbers::pi / 2 + 1e-6);
      const double inner = spot->number("innerConeAngle", 0, 0, std::numbers::pi / 2);
      if (inner >= outer) spot->fail("innerConeAngle must be less than outerConeAngle");
      light.cos_inner = std::cos(inner);
      light.cos_outer = std::fmax(std::cos(outer), 0.0);
    }
    result.push_back(light);
  });
  add_profile_lights(document, nodes, result);
  return result;
}

}  // namespace steradian::scene
