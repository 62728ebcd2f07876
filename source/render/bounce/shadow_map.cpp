#include "render/bounce/shadow_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "core/float_mode.h"
#include "render/surface/surface.h"
#include "scene/gltf/gltf_lights.h"
#include "shapes/punctual.h"

namespace steradian::indirect {
namespace {

constexpr unsigned kCastsShadow = 2;  // as in RayScene: light passes shapes that only stand for lights

// A ray from a light, its flux, and the changes of its direction from column to column and row to row.
struct LightRay {
  Vec3d origin, direction;  // direction of any length
  Vec3d flux;
  Vec3d step_x, step_y;  // change of the direction (or of the origin, for parallel light) to the next texel
  bool parallel = false;
  double solid_angle = 0;  // that of the texel, if the ray is not part of a perspective or parallel grid
  double back = 0;         // distance of its assumed apex behind the origin
  double range = 0;        // 0: unlimited
};

// A light as a side x side grid of rays.
struct LightRayGrid {
  double power = 0;
  std::function<LightRay(int column, int row, int side)> ray;
};

double spot_falloff(const PunctualLight& light, Vec3d unit) {
  const double scale = 1 / std::max(0.001, light.cos_inner - light.cos_outer);
  const double c = std::clamp((dot(light.direction, unit) - light.cos_outer) * scale, 0.0, 1.0);
  return c * c;
}

// A grid over the square around the cone, in the plane at distance 1. A texel's solid angle is 4 tan^2 / side^2 cos^3.
LightRayGrid spot(const PunctualLight& light) {
  const Frame frame = Frame::from_normal(light.direction);
  const double t = std::sqrt(1 - light.cos_outer * light.cos_outer) / light.cos_outer;
  return {luminance(light.intensity) * 2 * std::numbers::pi * (1 - light.cos_outer), [=](int i, int j, int side) {
            LightRay r;
            const double step = 2 * t / side;
            r.origin = light.position;
            r.step_x = frame.x * step;
            r.step_y = frame.y * step;
            r.direction = light.direction + r.step_x * (i + 0.5 - side * 0.5) + r.step_y * (j + 0.5 - side * 0.5);
            const double cosine = 1 / length(r.direction);
            r.flux = light.intensity * (spot_falloff(light, r.direction * cosine) * step * step * cosine * cosine * cosine);
            r.range = light.range;
            return r;
          }};
}

// Equal solid angles over the sphere. Wide spot lights use this too: their square would reach the horizon.
LightRayGrid sphere(const PunctualLight& light) {
  const Frame frame = Frame::from_normal(light.direction);
  const packed::Punctual source = packed::prepare(light);
  const double power = source.profile != nullptr ? luminous_flux(*source.profile) : 4 * std::numbers::pi;
  return {luminance(light.intensity) * power, [=](int i, int j, int side) {
            LightRay r;
            const double z = 1 - 2 * (j + 0.5) / side, s = std::sqrt(1 - z * z), phi = 2 * std::numbers::pi * (i + 0.5) / side;
            r.origin = light.position;
            r.direction = frame.to_world({s * std::cos(phi), s * std::sin(phi), z});
            r.solid_angle = 4 * std::numbers::pi / (static_cast<double>(side) * side);
            const double falloff = light.kind == PunctualKind::spot ? spot_falloff(light, r.direction)
                                   : source.profile != nullptr
                                       ? packed::profile_intensity(source, r.direction.x, r.direction.y, r.direction.z)
                                       : 1;
            r.flux = light.intensity * (falloff * r.solid_angle);
            r.range = light.range;
            return r;
          }};
}

LightRayGrid directional(const PunctualLight& light, const Scene& scene) {
  const Frame frame = Frame::from_normal(light.direction);
  const Vec3d center = (scene.bounds_min + scene.bounds_max) * 0.5;
  const double radius = std::max(length(scene.bounds_max - scene.bounds_min) * 0.5, 1e-6);
  return {luminance(light.intensity) * 4 * radius * radius, [=](int i, int j, int side) {
            LightRay r;
            const double step = 2 * radius / side;
            r.parallel = true;
            r.step_x = frame.x * step;
            r.step_y = frame.y * step;
            r.direction = light.direction;
            r.origin = center - light.direction * (2 * radius) + r.step_x * (i + 0.5 - side * 0.5) + r.step_y * (j + 0.5 - side * 0.5);
            r.flux = light.intensity * (step * step);
            return r;
          }};
}

struct LightTriangle {
  Vec3d a, b, c;
  double area_before;  // area of the triangles before this one
};

// Points are spread evenly over the light's triangles, directions follow the cosine, and every ray carries the same flux.
LightRayGrid area(const AreaLight& light, const std::vector<LightTriangle>& triangles, double total) {
  if (!(total > 0)) return {};
  const Vec3d radiance = light.radiance;
  const double sides = light.two_sided ? 2 : 1;
  const double lum = luminance(radiance);
  const double surface = lum > 0 && light.power > 0 ? light.power / lum : total;  // without the tessellation's deficit
  return {lum * std::numbers::pi * surface * sides, [=](int i, int j, int side) {
            LightRay r;
            // Place on the light, by the additive recurrence of Roberts 2018 in three dimensions.
            constexpr double kRoot = 1.2207440846057596;  // root of x^4 = x + 1
            const double k = static_cast<double>(j) * side + i + 1;
            const auto fraction = [](double x) { return x - std::floor(x); };
            const double u = fraction(0.5 + k / kRoot) * total;
            const auto next =
                std::upper_bound(triangles.begin(), triangles.end(), u, [](double x, const LightTriangle& t) { return x < t.area_before; });
            const LightTriangle& t = *(next - 1);
            const double root = std::sqrt(fraction(0.5 + k / (kRoot * kRoot)));
            const double v = fraction(0.5 + k / (kRoot * kRoot * kRoot));
            Vec3d normal = normalized(cross(t.b - t.a, t.c - t.a));
            if (sides == 2 && (i + j) % 2 == 1) normal = -normal;
            r.origin = t.a * (1 - root) + t.b * (root * (1 - v)) + t.c * (root * v);
            const double w = (j + 0.5) / side, s = std::sqrt(w), z = std::sqrt(1 - w), phi = 2 * std::numbers::pi * (i + 0.5) / side;
            r.direction = Frame::from_normal(normal).to_world({s * std::cos(phi), s * std::sin(phi), z});
            const double rays = static_cast<double>(side) * side;
            r.flux = radiance * (std::numbers::pi * surface * sides / rays);
            r.solid_angle = std::numbers::pi * sides / (rays * std::max(z, 0.05));
            r.back = std::sqrt(surface / std::numbers::pi);
            return r;
          }};
}

std::vector<std::vector<LightTriangle>> triangles_of_lights(const Scene& scene) {
  std::vector<std::vector<LightTriangle>> all(scene.area_lights.size());
  const auto add = [](std::vector<LightTriangle>& to, const Mesh& mesh, std::size_t k) {
    const auto corner = [&](std::size_t c) { return static_cast<Vec3d>(mesh.positions[mesh.indices[3 * k + c]]); };
    LightTriangle t{corner(0), corner(1), corner(2), 0};
    if (!to.empty()) {
      const LightTriangle& last = to.back();
      t.area_before = last.area_before + length(cross(last.b - last.a, last.c - last.a)) / 2;
    }
    to.push_back(t);
  };
  for (const Mesh& mesh : scene.meshes)
    for (std::size_t k = 0; k < mesh.triangle_lights.size(); ++k)
      if (mesh.triangle_lights[k] >= 0) add(all[static_cast<std::size_t>(mesh.triangle_lights[k])], mesh, k);
  for (std::size_t l = 0; l < all.size(); ++l) {  // for a light without a mesh in the scene
    if (!all[l].empty()) continue;
    const Mesh mesh = scene::mesh_of_light(scene.area_lights[l]);
    for (std::size_t k = 0; k < mesh.triangle_count(); ++k) add(all[l], mesh, k);
  }
  return all;
}

std::vector<LightRayGrid> emitters_of(const Scene& scene) {
  std::vector<LightRayGrid> emitters;
  for (const PunctualLight& light : scene.punctual_lights) {
    constexpr double kWide = 0.26;  // 75 degrees: beyond, a plane's texels differ 200-fold in solid angle
    if (light.kind == PunctualKind::directional)
      emitters.push_back(directional(light, scene));
    else
      emitters.push_back(light.kind == PunctualKind::spot && light.cos_outer > kWide ? spot(light) : sphere(light));
  }
  const auto triangles = triangles_of_lights(scene);
  for (std::size_t l = 0; l < triangles.size(); ++l) {
    if (triangles[l].empty()) continue;
    const LightTriangle& last = triangles[l].back();
    emitters.push_back(area(scene.area_lights[l], triangles[l], last.area_before + length(cross(last.b - last.a, last.c - last.a)) / 2));
  }
  std::erase_if(emitters, [](const LightRayGrid& e) { return !(e.power > 0); });
  return emitters;
}

// One texel before its fields are stored separately.
struct Texel {
  Surface surface;
  Vec3f incoming, flux, edge_x, edge_y;
  float area = 0;
  std::uint16_t column = 0, row = 0;
  bool lit = false;
};

// Half axis, along one step, of the section of the texel's cone with the tangent plane.
Vec3d section(const LightRay& r, Vec3d step, Vec3d normal, double along) {
  const double facing = dot(normal, r.direction);
  const double least = 0.02 * length(r.direction);  // a grazing cone's section is limited to fifty times its width
  const Vec3d e = step - r.direction * (dot(normal, step) / (std::fabs(facing) > least ? facing : std::copysign(least, facing)));
  return e * (0.5 * along);
}

// The place that a ray meets: a triangle, the weights of its second and third corners, and the distance.
struct HitPlace {
  unsigned mesh = 0, triangle = 0;
  float u = 0, v = 0, distance = 0;
};

Texel shade(const Scene& scene, const LightRay& r, const HitPlace& place) {
  Texel texel;
  const Vec3d unit = normalized(r.direction);
  texel.incoming = static_cast<Vec3f>(-unit);
  texel.surface = surface_at(scene, scene.meshes[place.mesh], place.triangle, place.u, place.v, texel.incoming);
  const Surface& s = texel.surface;
  const Vec3d n = static_cast<Vec3d>(s.normal);
  const double distance = static_cast<double>(place.distance);
  Vec3d flux = r.flux;
  if (std::isfinite(r.range) && r.range > 0) flux = flux * std::clamp(1 - std::pow(distance / r.range, 4), 0.0, 1.0);
  texel.flux = static_cast<Vec3f>(flux);
  texel.lit =
      weighs(texel.flux) && !s.material->unlit && dot(s.normal, texel.incoming) > 0 && (weighs(s.albedo) || weighs(s.f0) || weighs(s.f90));
  const double cosine = std::max(-dot(n, unit), 0.02);
  if (r.solid_angle > 0) {
    const double far = distance + r.back;
    texel.area = static_cast<float>(r.solid_angle * far * far / cosine);
    const Frame f = Frame::from_normal_and_tangent(n, unit);
    const double half = 0.5 * std::sqrt(static_cast<double>(texel.area));
    texel.edge_x = static_cast<Vec3f>(f.x * half);
    texel.edge_y = static_cast<Vec3f>(f.y * half);
  } else {
    const double along = r.parallel ? 1 : distance / length(r.direction);
    const Vec3d x = section(r, r.step_x, n, along), y = section(r, r.step_y, n, along);
    texel.edge_x = static_cast<Vec3f>(x);
    texel.edge_y = static_cast<Vec3f>(y);
    texel.area = static_cast<float>(4 * length(cross(x, y)));
  }
  return texel;
}

MapRay map_ray(const LightRay& r, const RayScene& rays) {
  if (!weighs(static_cast<Vec3f>(r.flux))) return {};
  return {static_cast<Vec3f>(r.origin), 1e-5f * rays.reach(), static_cast<Vec3f>(normalized(r.direction))};
}
bool is_ray(const MapRay& r) { return dot(r.direction, r.direction) > 0; }

// Intersects a ray with a triangle's plane and moves the place into the triangle: whatever found the triangle may have rounded.
HitPlace place_on(const Scene& scene, FirstHit hit, const MapRay& ray) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const auto corner = [&](std::size_t c) { return static_cast<Vec3d>(mesh.positions[mesh.indices[3 * hit.triangle + c]]); };
  const Vec3d p0 = corner(0), e1 = corner(1) - p0, e2 = corner(2) - p0;
  const Vec3d from = static_cast<Vec3d>(ray.origin) - p0, direction = static_cast<Vec3d>(ray.direction);
  const Vec3d across = cross(direction, e2), q = cross(from, e1);
  const double determinant = dot(e1, across);
  if (determinant == 0) return {hit.mesh, hit.triangle, 0, 0, static_cast<float>(-dot(from, direction))};
  const double u = std::clamp(dot(from, across) / determinant, 0.0, 1.0), v = std::clamp(dot(direction, q) / determinant, 0.0, 1.0);
  const double sum = std::max(1.0, u + v);
  return {hit.mesh, hit.triangle, static_cast<float>(u / sum), static_cast<float>(v / sum), static_cast<float>(dot(e2, q) / determinant)};
}

constexpr int kMapBlock = 16;  // texels, 4 x 4

// A row of blocks in a light's grid.
struct BlockRow {
  const LightRayGrid* emitter;
  int side, y;
  std::size_t first;  // first texel in the map
  std::size_t size() const { return 4 * static_cast<std::size_t>(side); }
};

LightRay light_ray(const BlockRow& row, int block, int k) { return row.emitter->ray(4 * block + k % 4, row.y + k / 4, row.side); }

// Finds the places that the rays of a block meet. hits: the known ones, null if none. Sets bit k of the result if ray k meets something.
unsigned meet(const Scene& scene, const RayScene& rays, const MapRay (&of)[kMapBlock], const FirstHit* hits,
              HitPlace (&places)[kMapBlock]) {
  alignas(64) RTCRayHit16 packet;
  alignas(64) int valid[kMapBlock];
  bool any = false;
  unsigned met = 0;
  for (int k = 0; k < kMapBlock; ++k) {
    const MapRay& r = of[k];
    packet.ray.org_x[k] = r.origin.x, packet.ray.org_y[k] = r.origin.y, packet.ray.org_z[k] = r.origin.z;
    packet.ray.dir_x[k] = r.direction.x, packet.ray.dir_y[k] = r.direction.y, packet.ray.dir_z[k] = r.direction.z;
    packet.ray.tnear[k] = r.begin;
    packet.ray.tfar[k] = std::numeric_limits<float>::infinity();
    packet.ray.time[k] = 0;
    packet.ray.mask[k] = kCastsShadow;
    packet.ray.id[k] = packet.ray.flags[k] = 0;
    packet.hit.geomID[k] = packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    const bool ask = is_ray(r) && (hits == nullptr || hits[k].mesh == FirstHit::kUnknown);
    valid[k] = ask ? -1 : 0;
    any |= ask;
    if (ask || !is_ray(r) || hits[k].mesh == FirstHit::kNothing) continue;
    places[k] = place_on(scene, hits[k], r);
    met |= 1u << k;
  }
  if (any) rays.intersect(valid, packet);
  for (int k = 0; k < kMapBlock; ++k) {
    if (valid[k] == 0 || packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
    places[k] = {packet.hit.geomID[k], packet.hit.primID[k], packet.hit.u[k], packet.hit.v[k], packet.ray.tfar[k]};
    met |= 1u << k;
  }
  return met;
}

void put(ShadowMap& map, std::size_t n, const Texel& t) {
  map.column[n] = t.column;
  map.row[n] = t.row;
  if (!t.lit) {
    map.normal.put(n, {0, 0, 1});
    map.incoming.put(n, {0, 0, 1});
    map.alpha[n] = 1;
    return;
  }
  map.position.put(n, t.surface.position);
  map.normal.put(n, t.surface.normal);
  map.incoming.put(n, t.incoming);
  map.flux.put(n, t.flux);
  map.albedo.put(n, t.surface.albedo);
  map.f0.put(n, t.surface.f0);
  map.f90.put(n, t.surface.f90);
  map.alpha[n] = std::sqrt(t.surface.alpha_x * t.surface.alpha_y);
  map.area[n] = t.area;
  map.edge_x.put(n, t.edge_x);
  map.edge_y.put(n, t.edge_y);
}

}  // namespace

void ShadowMap::resize(std::size_t size) {
  count = size;
  for (VectorArray* a : {&position, &normal, &incoming, &flux, &albedo, &f0, &f90, &edge_x, &edge_y}) a->resize(size);
  alpha.resize(size);
  area.resize(size);
  column.resize(size);
  row.resize(size);
}

ShadowMap make_shadow_map(const Scene& scene, const RayScene& rays, int count, FirstHits* hits) {
  const std::vector<LightRayGrid> emitters = emitters_of(scene);
  double power = 0;
  for (const LightRayGrid& e : emitters) power += e.power;
  ShadowMap map;
  std::vector<BlockRow> rows;
  std::size_t texels = 0;
  for (const LightRayGrid& emitter : emitters) {
    // Sides are multiples of eight, so that the grid splits into 64 sets of one size.
    const int side = 8 * std::clamp(static_cast<int>(std::lround(std::sqrt(count * emitter.power / power) / 8)), 1, 512);
    for (int y = 0; y < side; y += 4, texels += rows.back().size()) rows.push_back({&emitter, side, y, texels});
  }
  map.resize(texels);
  for (std::size_t begin = 0, end = rows.size(); begin < rows.size(); begin = std::exchange(end, rows.size())) {
    const std::size_t first = rows[begin].first;
    if (hits != nullptr) {
      std::size_t size = rows[begin].size();
      for (end = begin + 1; end < rows.size() && size + rows[end].size() <= hits->most(); ++end) size += rows[end].size();
      MapRay* to = hits->rays(size);
      tbb::parallel_for(begin, end, [&](std::size_t r) {
        for (std::size_t i = 0; i < rows[r].size(); ++i)
          to[rows[r].first - first + i] =
              map_ray(light_ray(rows[r], static_cast<int>(i) / kMapBlock, static_cast<int>(i) % kMapBlock), rays);
      });
      hits->find(size);
    }
    tbb::parallel_for(begin, end, [&](std::size_t r) {
      const FlushDenormals flush;
      const BlockRow& row = rows[r];
      for (int block = 0; block < row.side / 4; ++block) {
        const std::size_t texel = row.first + static_cast<std::size_t>(kMapBlock * block);
        LightRay light_rays[kMapBlock];
        MapRay asked[kMapBlock];
        FirstHit known[kMapBlock];
        HitPlace places[kMapBlock];
        for (int k = 0; k < kMapBlock; ++k) {
          asked[k] = map_ray(light_rays[k] = light_ray(row, block, k), rays);
          if (hits != nullptr) known[k] = hits->hit(texel - first + static_cast<std::size_t>(k));
        }
        const unsigned met = meet(scene, rays, asked, hits != nullptr ? known : nullptr, places);
        for (int k = 0; k < kMapBlock; ++k) {
          Texel t;
          if ((met >> k & 1) != 0) t = shade(scene, light_rays[k], places[k]);
          t.column = static_cast<std::uint16_t>(4 * block + k % 4);
          t.row = static_cast<std::uint16_t>(row.y + k / 4);
          put(map, texel + static_cast<std::size_t>(k), t);
        }
      }
    });
  }
  return map;
}

}  // namespace steradian::indirect
