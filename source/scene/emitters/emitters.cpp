#include "scene/emitters/emitters.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/emitters/closed_parts.h"
#include "scene/emitters/fit_round.h"
#include "scene/emitters/merge_polygons.h"

namespace steradian::scene {

float roundings_of_plane(const AreaLight& light) {
  if (!light.is_flat()) return 0;
  const PolygonLight polygon = flat_polygon(light, 8);
  double largest = 0;
  Vec3d low = polygon.vertices.front(), high = low;
  for (const Vec3d& v : polygon.vertices) {
    largest = std::max({largest, std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  return static_cast<float>(0x1p-18 * largest + 1e-5 * length(high - low));
}

namespace {

// The most samples per triangle side for the mean over a texture, whatever the texture's size.
constexpr int kMostSamples = 64;

struct UvMap {
  Vec3d origin, du, dv;
  double u0 = 0, v0 = 0;
  bool valid = false;
};

Triangle world_triangle(const Mesh& mesh, std::size_t t) {
  const auto at = [&](std::size_t c) { return static_cast<Vec3d>(mesh.positions[mesh.indices[3 * t + c]]); };
  return {at(0), at(1), at(2)};
}

Vec2f texcoord(const Mesh& mesh, int set, std::size_t t, std::size_t corner) {
  return mesh.texcoords[set].empty() ? Vec2f{} : mesh.texcoords[set][mesh.indices[3 * t + corner]];
}

// The gradients of u and v in the triangle's plane.
UvMap uv_map(const Mesh& mesh, int set, std::size_t t) {
  const Triangle p = world_triangle(mesh, t);
  const Vec3d e1 = p[1] - p[0], e2 = p[2] - p[0], n = cross(e1, e2);
  const double n2 = dot(n, n);
  UvMap map;
  if (!(n2 > 0)) return map;
  const Vec3d g1 = cross(e2, n) / n2, g2 = cross(n, e1) / n2;  // dual to e1, e2
  const Vec2f t0 = texcoord(mesh, set, t, 0), t1 = texcoord(mesh, set, t, 1), t2 = texcoord(mesh, set, t, 2);
  const auto d = [](float a, float b) { return static_cast<double>(a) - static_cast<double>(b); };
  map.origin = p[0];
  map.du = g1 * d(t1.x, t0.x) + g2 * d(t2.x, t0.x);
  map.dv = g1 * d(t1.y, t0.y) + g2 * d(t2.y, t0.y);
  map.u0 = static_cast<double>(t0.x);
  map.v0 = static_cast<double>(t0.y);
  map.valid = true;
  return map;
}

// True if the texture map `map` also holds at the corners of triangle t, to a thousandth of the texture.
bool continues(const UvMap& map, const Mesh& mesh, int set, std::size_t t) {
  const Triangle p = world_triangle(mesh, t);
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec2f uv = texcoord(mesh, set, t, c);
    const Vec3d r = p[c] - map.origin;
    if (std::fabs(dot(r, map.du) + map.u0 - static_cast<double>(uv.x)) > 1e-3) return false;
    if (std::fabs(dot(r, map.dv) + map.v0 - static_cast<double>(uv.y)) > 1e-3) return false;
  }
  return map.valid;
}

int samples_per_side(const Image& image, const TextureUse& use, Vec2f a, Vec2f b, Vec2f c) {
  const Vec2f ta = use.transformed(a), tb = use.transformed(b), tc = use.transformed(c);
  const float du = std::max({ta.x, tb.x, tc.x}) - std::min({ta.x, tb.x, tc.x});
  const float dv = std::max({ta.y, tb.y, tc.y}) - std::min({ta.y, tb.y, tc.y});
  const float texels = std::max(du * static_cast<float>(image.width), dv * static_cast<float>(image.height));
  return static_cast<int>(std::clamp(std::ceil(texels), 1.0f, static_cast<float>(kMostSamples)));
}

// The mean texel of a triangle, sampled at the centroids of n^2 equal small triangles.
Vec3d mean_texel(const Scene& scene, const TextureUse& use, Vec2f a, Vec2f b, Vec2f c) {
  const int n = samples_per_side(scene.images[static_cast<std::size_t>(use.image)], use, a, b, c);
  Vec3d sum{};
  const auto add = [&](double i, double j) {
    const auto u = static_cast<float>(i / n), v = static_cast<float>(j / n), w = 1 - u - v;
    const Vec4f s = sample_texture(scene.images, use, {a.x * w + b.x * u + c.x * v, a.y * w + b.y * u + c.y * v});
    sum += static_cast<Vec3d>(Vec3f{s.x, s.y, s.z});
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      add(i + 1 / 3.0, j + 1 / 3.0);
      if (i + j + 1 < n) add(i + 2 / 3.0, j + 2 / 3.0);
    }
  return sum / (static_cast<double>(n) * n);
}

Vec3d mean_radiance(const Scene& scene, const Mesh& mesh, const SurfaceMaterial& m, const std::vector<std::size_t>& triangles) {
  const Vec3d factor = static_cast<Vec3d>(m.emissive);
  if (!m.emissive_texture.present()) return factor;
  const int set = m.emissive_texture.texcoord;
  Vec3d sum{};
  double total = 0;
  for (const std::size_t t : triangles) {
    const Triangle p = world_triangle(mesh, t);
    const double area = length(cross(p[1] - p[0], p[2] - p[0]));
    sum += mean_texel(scene, m.emissive_texture, texcoord(mesh, set, t, 0), texcoord(mesh, set, t, 1), texcoord(mesh, set, t, 2)) * area;
    total += area;
  }
  return total > 0 ? factor * (sum / total) : Vec3d{};
}

// In the worst case every triangle becomes a light, and each is averaged over as many texels as it covers.
void take_for_lights(const Scene& scene, const Mesh& mesh, const SurfaceMaterial& m, Budget& budget, const std::string& path) {
  const std::string place = path + ": the emissive mesh \"" + mesh.name + "\"";
  constexpr std::uint64_t kWelding = 400;  // bytes that merging holds per triangle
  budget.take_memory(place, "the lights of its emissive triangles", mesh.triangle_count() * (sizeof(AreaLight) + kWelding));
  if (!m.emissive_texture.present()) return;
  constexpr std::uint64_t kStepsPerSample = 50;
  const int set = m.emissive_texture.texcoord;
  const Image& image = scene.images[static_cast<std::size_t>(m.emissive_texture.image)];
  std::uint64_t samples = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto side = static_cast<std::uint64_t>(
        samples_per_side(image, m.emissive_texture, texcoord(mesh, set, t, 0), texcoord(mesh, set, t, 1), texcoord(mesh, set, t, 2)));
    samples += side * side;
  }
  budget.take_work(place, "the means of its emissive texture", kStepsPerSample * samples);
}

// An outline that matches an ellipse becomes a disk light, which is exact and has one edge.
void become_disk(AreaLight& light) {
  const auto& polygon = std::get<Polygon>(light.shape);
  if (light.texture || !polygon.holes.empty()) return;
  if (const std::optional<Ellipse> ellipse = fit_ellipse(polygon.vertices)) light.shape = *ellipse;
}

AreaLight to_light(const Scene& scene, const Mesh& mesh, MergedPolygon polygon) {
  const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
  AreaLight light;
  light.name = mesh.name.empty() ? m.name : mesh.name;
  light.radiance = mean_radiance(scene, mesh, m, polygon.triangles);
  light.two_sided = m.double_sided;
  if (m.emissive_texture.present()) {
    const UvMap map = uv_map(mesh, m.emissive_texture.texcoord, polygon.triangles.front());
    light.texture = LightTexture{m.emissive_texture, map.origin, map.du, map.dv, map.u0, map.v0, static_cast<Vec3d>(m.emissive)};
  }
  light.shape = Polygon{std::move(polygon.outline), std::move(polygon.holes)};
  light.power = luminance(light.radiance) * prepare_polygon(flat_polygon(light)).area;
  become_disk(light);
  return light;
}

AreaLight to_round_light(const Scene& scene, const Mesh& mesh, const Shape& shape, double area) {
  const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
  AreaLight light;
  light.name = mesh.name.empty() ? m.name : mesh.name;
  light.shape = shape;
  light.radiance = static_cast<Vec3d>(m.emissive);
  light.power = luminance(light.radiance) * area;
  return light;
}

double area_of(const std::vector<Triangle>& triangles, const MeshPart& part) {
  double area = 0;
  for (const std::size_t t : part.triangles)
    area += length(cross(triangles[t][1] - triangles[t][0], triangles[t][2] - triangles[t][0])) / 2;
  return area;
}

std::optional<Shape> fit_round(const std::vector<Triangle>& triangles, const MeshPart& part) {
  if (const std::optional<Ellipsoid> ellipsoid = fit_ellipsoid(triangles, part.triangles)) return *ellipsoid;
  if (const std::optional<Capsule> capsule = fit_capsule(triangles, part.triangles)) return *capsule;
  return {};
}

// One light per part if every part matches an ellipsoid or a tube that emits outwards; otherwise no lights.
std::vector<AreaLight> as_round_lights(const Scene& scene, const Mesh& mesh, const std::vector<Triangle>& triangles,
                                       const std::vector<MeshPart>& parts, const std::vector<Shines>& shines) {
  std::vector<AreaLight> lights;
  if (scene.materials[static_cast<std::size_t>(mesh.material)].emissive_texture.present()) return lights;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (shines[i] == Shines::as_the_file_says) return {};
    const std::optional<Shape> shape = fit_round(triangles, parts[i]);
    if (!shape) return {};
    lights.push_back(to_round_light(scene, mesh, *shape, area_of(triangles, parts[i])));
  }
  return lights;
}

// Adds the polygons that a mesh's triangles merge to as lights.
std::size_t add_polygons(Scene& scene, Mesh& mesh, const std::vector<Triangle>& triangles, const std::vector<MeshPart>& parts,
                         const std::vector<Shines>& shines) {
  const TextureUse& texture = scene.materials[static_cast<std::size_t>(mesh.material)].emissive_texture;
  MergedPolygons merged = merge_coplanar(triangles, [&](std::size_t a, std::size_t b) {
    return !texture.present() || continues(uv_map(mesh, texture.texcoord, a), mesh, texture.texcoord, b);
  });
  std::vector<Shines> of_triangle(triangles.size(), Shines::as_the_file_says);
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const std::size_t t : parts[i].triangles) of_triangle[t] = shines[i];
  for (MergedPolygon& polygon : merged.polygons) {
    const Shines where = of_triangle[polygon.triangles.front()];
    if (where == Shines::outwards_and_faces_inwards) turn_over(polygon);
    for (const std::size_t t : polygon.triangles) mesh.triangle_lights[t] = static_cast<std::int32_t>(scene.area_lights.size());
    AreaLight light = to_light(scene, mesh, std::move(polygon));
    if (where != Shines::as_the_file_says) light.two_sided = false;
    scene.area_lights.push_back(std::move(light));
  }
  return merged.without_area;
}

}  // namespace

std::size_t add_emitters(Scene& scene, Budget& budget, const std::string& path) {
  std::size_t without_area = 0;
  const std::vector<Box3d> others = bounds_of_the_others(scene);
  for (std::size_t index = 0; index < scene.meshes.size(); ++index) {
    Mesh& mesh = scene.meshes[index];
    const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
    if (mesh.is_light_shape || m.unlit || !m.emits()) continue;
    take_for_lights(scene, mesh, m, budget, path);
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) triangles.push_back(world_triangle(mesh, t));
    mesh.triangle_lights.assign(triangles.size(), -1);
    const std::vector<MeshPart> parts = mesh_parts(triangles);
    std::vector<Shines> shines;
    for (const MeshPart& part : parts) shines.push_back(where_it_shines(m, part, others[index]));
    std::vector<AreaLight> round = as_round_lights(scene, mesh, triangles, parts, shines);
    if (round.empty()) {
      without_area += add_polygons(scene, mesh, triangles, parts, shines);
      continue;
    }
    mesh.casts_shadow = false;  // its facets lie on both sides of the light
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (const std::size_t t : parts[i].triangles) mesh.triangle_lights[t] = static_cast<std::int32_t>(scene.area_lights.size());
      scene.area_lights.push_back(std::move(round[i]));
    }
  }
  return without_area;
}

}  // namespace steradian::scene
