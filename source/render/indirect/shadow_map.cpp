#include "render/indirect/shadow_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/float_mode.h"
#include "render/cpu/surface.h"
#include "scene/gltf_lights.h"
#include "shapes/punctual.h"

namespace steradian::indirect {
namespace {

constexpr double kPi = 3.14159265358979324;
constexpr unsigned kCastsShadow = 2;  // RayScene: light passes the shapes that only stand for lights

// A ray from a light, the flux it carries, and how its direction changes from column to column and row to row.
struct LightRay {
  Vec3d origin, direction;  // direction of any length
  Vec3d flux;
  Vec3d step_x, step_y;  // of the direction (or of the origin, for parallel light), to the next texel
  bool parallel = false;
  double solid_angle = 0;  // of the texel, where the ray is no part of a perspective or parallel grid
  double back = 0;         // how far behind the origin its apex is taken to be
  double range = 0;        // 0: none
};

// A light as a side x side grid of rays.
struct Emitter {
  double power = 0;
  std::function<LightRay(int column, int row, int side)> ray;
};

double spot_falloff(const PunctualLight& light, Vec3d unit) {
  const double scale = 1 / std::max(0.001, light.cos_inner - light.cos_outer);
  const double c = std::clamp((dot(light.direction, unit) - light.cos_outer) * scale, 0.0, 1.0);
  return c * c;
}

// A grid over the cone's square, in the plane at distance 1: a texel's solid angle is 4 tan^2 / side^2 cos^3.
Emitter spot(const PunctualLight& light) {
  const Frame frame = Frame::from_normal(light.direction);
  const double t = std::sqrt(1 - light.cos_outer * light.cos_outer) / light.cos_outer;
  return {luminance(light.intensity) * 2 * kPi * (1 - light.cos_outer), [=](int i, int j, int side) {
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

// Equal solid angles over the sphere. Wide spot lights too: their square would reach the horizon.
Emitter sphere(const PunctualLight& light) {
  const Frame frame = Frame::from_normal(light.direction);
  const packed::Punctual source = packed::prepare(light);
  const double power = source.profile != nullptr ? luminous_flux(*source.profile) : 4 * kPi;
  return {luminance(light.intensity) * power, [=](int i, int j, int side) {
            LightRay r;
            const double z = 1 - 2 * (j + 0.5) / side, s = std::sqrt(1 - z * z), phi = 2 * kPi * (i + 0.5) / side;
            r.origin = light.position;
            r.direction = frame.to_world({s * std::cos(phi), s * std::sin(phi), z});
            r.solid_angle = 4 * kPi / (static_cast<double>(side) * side);
            const double falloff = light.kind == PunctualKind::spot ? spot_falloff(light, r.direction)
                                   : source.profile != nullptr
                                       ? packed::profile_intensity(source, r.direction.x, r.direction.y, r.direction.z)
                                       : 1;
            r.flux = light.intensity * (falloff * r.solid_angle);
            r.range = light.range;
            return r;
          }};
}

Emitter directional(const PunctualLight& light, const Scene& scene) {
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
  double area_before;  // of the triangles before this one
};

// Points spread evenly over the light's triangles, directions by the cosine: every ray carries the same flux.
Emitter area(const AreaLight& light, const std::vector<LightTriangle>& triangles, double total) {
  if (!(total > 0)) return {};
  const Vec3d radiance = light.radiance;
  const double sides = light.two_sided ? 2 : 1;
  const double lum = luminance(radiance);
  const double surface = lum > 0 && light.power > 0 ? light.power / lum : total;  // without the tessellation's deficit
  return {lum * kPi * surface * sides, [=](int i, int j, int side) {
            LightRay r;
            // Where on the light: the additive recurrence of Roberts 2018 in three dimensions.
            constexpr double kRoot = 1.2207440846057596;  // of x^4 = x + 1
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
            const double w = (j + 0.5) / side, s = std::sqrt(w), z = std::sqrt(1 - w), phi = 2 * kPi * (i + 0.5) / side;
            r.direction = Frame::from_normal(normal).to_world({s * std::cos(phi), s * std::sin(phi), z});
            const double rays = static_cast<double>(side) * side;
            r.flux = radiance * (kPi * surface * sides / rays);
            r.solid_angle = kPi * sides / (rays * std::max(z, 0.05));
            r.back = std::sqrt(surface / kPi);
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
  for (std::size_t l = 0; l < all.size(); ++l) {  // a light that nobody sees
    if (!all[l].empty()) continue;
    const Mesh mesh = scene::mesh_of_light(scene.area_lights[l]);
    for (std::size_t k = 0; k < mesh.triangle_count(); ++k) add(all[l], mesh, k);
  }
  return all;
}

std::vector<Emitter> emitters_of(const Scene& scene) {
  std::vector<Emitter> emitters;
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
  std::erase_if(emitters, [](const Emitter& e) { return !(e.power > 0); });
  return emitters;
}

// One texel before its fields are taken apart.
struct Texel {
  Surface surface;
  Vec3f incoming, flux, edge_x, edge_y;
  float area = 0;
  std::uint16_t column = 0, row = 0;
  bool lit = false;
};

bool weighs(Vec3f v) { return v.x > 0 || v.y > 0 || v.z > 0; }

// How far the section of the texel's cone with the tangent plane reaches along one step.
Vec3d section(const LightRay& r, Vec3d step, Vec3d normal, double along) {
  const double facing = dot(normal, r.direction);
  const double least = 0.02 * length(r.direction);  // a grazing cone's section is cut at fifty times its width
  const Vec3d e = step - r.direction * (dot(normal, step) / (std::fabs(facing) > least ? facing : std::copysign(least, facing)));
  return e * (0.5 * along);
}

Texel shade(const Scene& scene, const LightRay& r, const RTCRayHit16& packet, int k) {
  Texel texel;
  const Vec3d unit = normalized(r.direction);
  texel.incoming = static_cast<Vec3f>(-unit);
  texel.surface =
      surface_at(scene, scene.meshes[packet.hit.geomID[k]], packet.hit.primID[k], packet.hit.u[k], packet.hit.v[k], texel.incoming);
  const Surface& s = texel.surface;
  const Vec3d n = static_cast<Vec3d>(s.normal);
  const double distance = static_cast<double>(packet.ray.tfar[k]);
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

// A block of 4 x 4 texels.
void trace_block(const Scene& scene, const RayScene& rays, const Emitter& emitter, int x, int y, int side, Texel* texels) {
  alignas(64) RTCRayHit16 packet;
  alignas(64) int valid[16];
  LightRay light_rays[16];
  for (int k = 0; k < 16; ++k) {
    const int i = x + k % 4, j = y + k / 4;
    const LightRay r = light_rays[k] = emitter.ray(i, j, side);
    const auto o = static_cast<Vec3f>(r.origin), d = static_cast<Vec3f>(normalized(r.direction));
    packet.ray.org_x[k] = o.x, packet.ray.org_y[k] = o.y, packet.ray.org_z[k] = o.z;
    packet.ray.dir_x[k] = d.x, packet.ray.dir_y[k] = d.y, packet.ray.dir_z[k] = d.z;
    packet.ray.tnear[k] = 1e-4f;
    packet.ray.tfar[k] = std::numeric_limits<float>::infinity();
    packet.ray.time[k] = 0;
    packet.ray.mask[k] = kCastsShadow;
    packet.ray.id[k] = packet.ray.flags[k] = 0;
    packet.hit.geomID[k] = packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    valid[k] = weighs(static_cast<Vec3f>(r.flux)) ? -1 : 0;
  }
  rays.intersect(valid, packet);
  for (int k = 0; k < 16; ++k) {
    Texel& texel = texels[k];
    if (valid[k] != 0 && packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID) texel = shade(scene, light_rays[k], packet, k);
    texel.column = static_cast<std::uint16_t>(x + k % 4);
    texel.row = static_cast<std::uint16_t>(y + k / 4);
  }
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

ShadowMap make_shadow_map(const Scene& scene, const RayScene& rays, int count) {
  const std::vector<Emitter> emitters = emitters_of(scene);
  double power = 0;
  for (const Emitter& e : emitters) power += e.power;
  ShadowMap map;
  for (const Emitter& emitter : emitters) {
    // Multiples of eight, so that the grid falls into 64 sets of one size.
    const int side = 8 * std::clamp(static_cast<int>(std::lround(std::sqrt(count * emitter.power / power) / 8)), 1, 512);
    const std::size_t begin = map.count;
    map.resize(begin + static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    tbb::parallel_for(0, side / 4, [&](int by) {
      const FlushDenormals flush;
      for (int bx = 0; bx < side / 4; ++bx) {
        Texel texels[16];
        trace_block(scene, rays, emitter, 4 * bx, 4 * by, side, texels);
        const std::size_t first = begin + static_cast<std::size_t>(16 * (by * (side / 4) + bx));
        for (std::size_t k = 0; k < 16; ++k) put(map, first + k, texels[k]);
      }
    });
  }
  return map;
}

}  // namespace steradian::indirect
