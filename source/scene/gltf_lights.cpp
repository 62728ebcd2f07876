#include "scene/gltf_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <span>

namespace steradian::scene {
namespace {

constexpr double kPi = 3.14159265358979324;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostIntensity = 1e30;
// What the light's shape takes as a mesh of its own: an ellipsoid's rows, or a tube's, with its material.
constexpr std::uint64_t kLargestLightMesh = 200'000;

// Colour times intensity.
Vec3d read_emission(const JsonCursor& light) {
  const Vec3d c = light.vector("color", {1, 1, 1});
  if (c.x < 0 || c.y < 0 || c.z < 0) light.at("color").fail("components must not be negative");
  const Vec3d emission = c * light.number("intensity", 1, 0, kMostIntensity);
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

// Half axes of a flat light in the node's plane z = 0, x cross y along the node's -z after the transform.
Ellipse flat_axes(const Affine& world, double half_x, double half_y) {
  Ellipse e{world.t, world.x * -half_x, world.y * half_y};
  if (dot(cross(e.x, e.y), world.z) > 0) e.x = -e.x;
  return e;
}

// Knud Thomsen's formula, within 1.1 % of an ellipsoid's surface: good enough to rank lights by.
double ellipsoid_area(Vec3d x, Vec3d y, Vec3d z) {
  constexpr double p = 1.6075;
  const double a = std::pow(length(x), p), b = std::pow(length(y), p), c = std::pow(length(z), p);
  return 4 * kPi * std::pow((a * b + a * c + b * c) / 3, 1 / p);
}

// "extras": {"steradian": {"two_sided": true}}: the extension has no word for it.
bool shines_to_both_sides(const JsonCursor& light) {
  const auto extras = light.find("extras");
  if (!extras || !extras->value().is_object()) return false;
  const auto ours = extras->find("steradian");
  return ours && ours->value().is_object() && ours->flag("two_sided", false);
}

AreaLight read_area_light(const JsonCursor& json, const JsonCursor& node, const Affine& world) {
  AreaLight light;
  light.name = json.text("name", node.text("name", ""));
  const std::string type = json.at("type").as_text();
  const Vec3d radiance = read_emission(json);
  const double half = json.number("size", 1, 0, 1e30) / 2;
  double area = 0;
  if (type == "rect") {
    const auto rect = json.find("rect");
    const double aspect = rect ? rect->number("aspect", 1, 0, 1e9) : 1;
    const Ellipse e = flat_axes(world, half * aspect, half);
    light.shape = Polygon{{e.center - e.x - e.y, e.center + e.x - e.y, e.center + e.x + e.y, e.center - e.x + e.y}, {}};
    area = 4 * length(cross(e.x, e.y));
  } else if (type == "disk") {
    const Ellipse e = flat_axes(world, half, half);
    light.shape = e;
    area = kPi * length(cross(e.x, e.y));
  } else if (type == "sphere") {
    const Ellipsoid e{world.t, world.x * half, world.y * half, world.z * half};
    light.shape = e;
    area = ellipsoid_area(e.x, e.y, e.z);
  } else if (type == "capsule") {
    // Along the node's x. Across it the tube stays round: with the geometric mean of the node's two scales there.
    const auto capsule = json.find("capsule");
    const double between = capsule ? capsule->number("length", 1, 0, 1e30) : 1;
    const Vec3d half_axis = world.x * (between / 2);
    const Capsule c{world.t - half_axis, world.t + half_axis, half * std::sqrt(length(world.y)) * std::sqrt(length(world.z))};
    light.shape = c;
    area = 4 * kPi * c.radius * (c.radius + length(half_axis));
  } else {
    json.at("type").fail("\"" + type + "\" is not an area light", "known are rect, disk, sphere and capsule");
  }
  light.radiance = radiance;
  light.two_sided = light.is_flat() && shines_to_both_sides(json);
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
      const double theta = kPi * j / kDown, phi = 2 * kPi * i / kAround;
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

// Two half balls and the wall between them.
Mesh mesh_of(const Capsule& capsule) {
  constexpr std::uint32_t kAround = 64, kRows = 34;  // two of the rows are the wall's rims
  const Vec3d axis = capsule.end_b - capsule.end_a;
  const Frame frame = length(axis) > 0 ? Frame::from_normal(normalized(axis)) : Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Mesh mesh;
  for (std::uint32_t j = 0; j < kRows; ++j)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const bool second = j >= kRows / 2;
      const double theta = kPi * (second ? j - 1 : j) / (kRows - 2), phi = 2 * kPi * i / kAround;
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
  for_each_light(document, nodes, "EXT_lights_area", [&](const JsonCursor& json, const JsonCursor& node, const GltfNode& visible) {
    AreaLight light = read_area_light(json, node, visible.world);
    if (light.power > 0) {
      Mesh mesh = mesh_of_light(light);
      for (const Vec3f& p : mesh.positions) check_reach(node, static_cast<Vec3d>(p), "the light");
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

// Lights that a profile describes: candela times the node's multiplier and colour, aimed along its -z.
void add_profile_lights(const GltfDocument& document, const GltfNodes& nodes, std::vector<PunctualLight>& lights) {
  constexpr const char* kExtension = "EXT_lights_ies";
  std::map<std::string, std::shared_ptr<const LightProfile>> read;  // by place
  for_each_light(document, nodes, kExtension, [&](const JsonCursor& json, const JsonCursor& node, const GltfNode& visible) {
    const Affine& world = visible.world;
    PunctualLight light;
    light.name = json.text("name", node.text("name", ""));
    light.position = world.t;
    check_reach(node, light.position, "the light");
    light.direction = normalized(world.vector({0, 0, -1}));
    const JsonCursor use = *find_extension(node, kExtension);
    const Vec3d color = use.vector("color", {1, 1, 1});
    if (color.x < 0 || color.y < 0 || color.z < 0) use.at("color").fail("components must not be negative");
    light.intensity = color * use.number("multiplier", 1, 0, kMostIntensity);
    auto& profile = read[json.place()];
    if (profile == nullptr) profile = read_profile(document, json);
    light.profile = profile;
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
    light.position = world.t;
    check_reach(node, light.position, "the light");
    light.direction = normalized(world.vector({0, 0, -1}));
    light.intensity = read_emission(json);
    light.range = json.number("range", kInfinity, 1e-30, kInfinity);
    if (const auto spot = json.find("spot")) {
      const double outer = spot->number("outerConeAngle", kPi / 4, 1e-9, kPi / 2 + 1e-6);
      const double inner = spot->number("innerConeAngle", 0, 0, kPi / 2);
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
