#include "render/cpu/gbuffer.h"

#include <algorithm>
#include <limits>

namespace steradian {
namespace {

void put(TileVector& v, std::size_t i, Vec3f a) {
  v.x[i] = a.x;
  v.y[i] = a.y;
  v.z[i] = a.z;
}

bool weighs(Vec3f a) { return a.x > 0 || a.y > 0 || a.z > 0; }

void put_surface(SurfaceTile& tile, std::size_t i, const Surface& s, Vec3f view) {
  put(tile.position, i, s.position);
  put(tile.normal, i, s.normal);
  put(tile.geometric_normal, i, s.geometric_normal);
  put(tile.view, i, view);
  put(tile.albedo, i, s.albedo);
  tile.fresnel_loss[i] = s.fresnel_loss;
  put(tile.f0, i, s.f0);
  put(tile.f90, i, s.f90);
  put(tile.tangent, i, s.tangent);
  tile.alpha_x[i] = s.alpha_x;
  tile.alpha_y[i] = s.alpha_y;
  put(tile.sheen, i, s.sheen);
  tile.sheen_alpha[i] = s.sheen_alpha;
  tile.coat[i] = s.coat;
  tile.coat_alpha[i] = s.coat_alpha;
  put(tile.coat_normal, i, s.coat_normal);
  put(tile.radiance, i, s.emission);
  put(tile.passes, i, s.passes);
  tile.any_passing |= weighs(s.passes);
  tile.material[i] = s.material;
  tile.any_surface = true;
  tile.any_diffuse |= weighs(s.albedo);
  tile.any_specular |= weighs(s.f0) || weighs(s.f90);
  tile.any_sheen |= weighs(s.sheen);
  tile.any_coat |= s.coat > 0;
  tile.any_override |= !s.material->specular_override.empty();
}

Vec3f get(const TileVector& v, std::size_t i) { return {v.x[i], v.y[i], v.z[i]}; }

}  // namespace

void put_nothing(SurfaceTile& tile, std::size_t i) {
  for (TileVector* v : {&tile.position, &tile.normal, &tile.geometric_normal, &tile.view, &tile.albedo, &tile.f0, &tile.f90, &tile.tangent,
                        &tile.sheen, &tile.coat_normal, &tile.passes, &tile.radiance})
    put(*v, i, {});
  tile.alpha_x[i] = tile.alpha_y[i] = tile.coat_alpha[i] = tile.sheen_alpha[i] = 1;
  tile.coat[i] = tile.fresnel_loss[i] = 0;
  tile.material[i] = nullptr;
}

std::size_t take_slots(const SurfaceTile& from, const std::vector<std::uint32_t>& slots, std::size_t filled, SurfaceTile& to) {
  to.any_surface = to.any_diffuse = to.any_specular = to.any_sheen = to.any_coat = to.any_override = to.any_passing = false;
  for (std::size_t i = 0; i < slots.size(); ++i) put_surface(to, i, surface_in(from, slots[i]), get(from.view, slots[i]));
  for (std::size_t i = slots.size(); i < filled; ++i) put_nothing(to, i);
  return slots.size();
}

Surface surface_in(const SurfaceTile& tile, std::size_t i) {
  Surface s;
  s.position = get(tile.position, i);
  s.normal = get(tile.normal, i);
  s.geometric_normal = get(tile.geometric_normal, i);
  s.albedo = get(tile.albedo, i);
  s.fresnel_loss = tile.fresnel_loss[i];
  s.f0 = get(tile.f0, i);
  s.f90 = get(tile.f90, i);
  s.tangent = get(tile.tangent, i);
  s.alpha_x = tile.alpha_x[i];
  s.alpha_y = tile.alpha_y[i];
  s.sheen = get(tile.sheen, i);
  s.sheen_alpha = tile.sheen_alpha[i];
  s.coat = tile.coat[i];
  s.coat_alpha = tile.coat_alpha[i];
  s.coat_normal = get(tile.coat_normal, i);
  s.material = tile.material[i];
  return s;
}

void trace_tile(const RayScene& rays, const CameraRays& camera, TileArea area, PixelPlace place, TileHits& hits, const TilePlane* behind) {
  alignas(64) RTCRayHit16 packet;
  alignas(64) int valid[16];
  const Vec3f origin = camera.origin();
  std::fill_n(packet.ray.org_x, 16, origin.x);
  std::fill_n(packet.ray.org_y, 16, origin.y);
  std::fill_n(packet.ray.org_z, 16, origin.z);
  std::fill_n(packet.ray.time, 16, 0.0f);
  std::fill_n(packet.ray.mask, 16, 1u);
  std::fill_n(packet.ray.id, 16, 0u);
  std::fill_n(packet.ray.flags, 16, 0u);
  for (int by = 0; by < kTileSide; by += 4)
    for (int bx = 0; bx < kTileSide; bx += 4) {
      const std::size_t first = tile_slot(bx, by);
      int any = 0;
      for (int i = 0; i < 16; ++i) {
        const std::size_t slot = first + static_cast<std::size_t>(i);
        const bool traced = bx + i % 4 < area.width && by + i / 4 < area.height && (behind == nullptr || (*behind)[slot] > 0);
        any |= valid[i] = traced ? -1 : 0;
        packet.ray.tnear[i] = behind != nullptr ? (*behind)[slot] : 0;
      }
      if (any == 0 && behind != nullptr) {  // of a first layer every direction is wanted, the background's too
        std::fill_n(&hits.geometry[first], 16, RTC_INVALID_GEOMETRY_ID);
        continue;
      }
      camera.block_directions(static_cast<float>(area.x + bx) + place.x, static_cast<float>(area.y + by) + place.y, packet.ray.dir_x,
                              packet.ray.dir_y, packet.ray.dir_z);
      std::fill_n(packet.ray.tfar, 16, std::numeric_limits<float>::infinity());
      std::fill_n(packet.hit.geomID, 16, RTC_INVALID_GEOMETRY_ID);
      std::fill_n(packet.hit.instID[0], 16, RTC_INVALID_GEOMETRY_ID);
      rays.intersect(valid, packet);
      std::copy_n(packet.hit.geomID, 16, &hits.geometry[first]);
      std::copy_n(packet.hit.primID, 16, &hits.triangle[first]);
      std::copy_n(packet.hit.u, 16, &hits.u[first]);
      std::copy_n(packet.hit.v, 16, &hits.v[first]);
      std::copy_n(packet.ray.tfar, 16, &hits.distance[first]);
      std::copy_n(packet.ray.dir_x, 16, &hits.direction.x[first]);
      std::copy_n(packet.ray.dir_y, 16, &hits.direction.y[first]);
      std::copy_n(packet.ray.dir_z, 16, &hits.direction.z[first]);
    }
}

void shade_tile(const Scene& scene, const TileHits& hits, SurfaceTile& tile) {
  tile.any_surface = tile.any_diffuse = tile.any_specular = tile.any_sheen = tile.any_coat = tile.any_override = tile.any_passing = false;
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (hits.geometry[i] == RTC_INVALID_GEOMETRY_ID) {
      put_nothing(tile, i);
      continue;
    }
    const Vec3f view = -get(hits.direction, i);
    const Mesh& mesh = scene.meshes[hits.geometry[i]];
    put_surface(tile, i, surface_at(scene, mesh, hits.triangle[i], hits.u[i], hits.v[i], view), view);
  }
}

}  // namespace steradian
