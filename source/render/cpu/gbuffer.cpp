#include "render/cpu/gbuffer.h"

#include <limits>

#include "render/cpu/surface.h"

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
  put(tile.view, i, view);
  put(tile.albedo, i, s.albedo);
  put(tile.f0, i, s.f0);
  put(tile.f90, i, s.f90);
  put(tile.tangent, i, s.tangent);
  tile.alpha_x[i] = s.alpha_x;
  tile.alpha_y[i] = s.alpha_y;
  tile.coat[i] = s.coat;
  tile.coat_alpha[i] = s.coat_alpha;
  put(tile.radiance, i, s.emission);
  tile.material[i] = s.material;
  tile.any_surface = true;
  tile.any_diffuse |= weighs(s.albedo);
  tile.any_specular |= weighs(s.f0) || weighs(s.f90);
  tile.any_coat |= s.coat > 0;
  tile.any_override |= !s.material->specular_override.empty();
}

// What packs read where there is no surface: finite, and weighing nothing.
void put_nothing(SurfaceTile& tile, std::size_t i) {
  for (TileVector* v : {&tile.position, &tile.normal, &tile.view, &tile.albedo, &tile.f0, &tile.f90, &tile.tangent,
                        &tile.radiance})
    put(*v, i, {});
  tile.alpha_x[i] = tile.alpha_y[i] = tile.coat_alpha[i] = 1;
  tile.coat[i] = 0;
  tile.material[i] = nullptr;
}

}  // namespace

void fill_tile(const Scene& scene, const RayScene& rays, const CameraRays& camera, TileArea area, PixelPlace place,
               SurfaceTile& tile) {
  tile.any_surface = tile.any_diffuse = tile.any_specular = tile.any_coat = tile.any_override = false;
  const Vec3f origin = camera.origin();
  for (int by = 0; by < kTileSide; by += 4)
    for (int bx = 0; bx < kTileSide; bx += 4) {
      alignas(64) RTCRayHit16 packet;
      alignas(64) int valid[16];
      bool any = false;
      for (int i = 0; i < 16; ++i) {
        const int x = bx + i % 4, y = by + i / 4;
        valid[i] = x < area.width && y < area.height ? -1 : 0;
        any |= valid[i] != 0;
        const Vec3f d = camera.direction(static_cast<float>(area.x + x) + place.x, static_cast<float>(area.y + y) + place.y);
        packet.ray.org_x[i] = origin.x;
        packet.ray.org_y[i] = origin.y;
        packet.ray.org_z[i] = origin.z;
        packet.ray.dir_x[i] = d.x;
        packet.ray.dir_y[i] = d.y;
        packet.ray.dir_z[i] = d.z;
        packet.ray.tnear[i] = 0;
        packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
        packet.ray.time[i] = 0;
        packet.ray.mask[i] = 1;
        packet.ray.id[i] = 0;
        packet.ray.flags[i] = 0;
        packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      }
      if (any) rays.intersect(valid, packet);
      for (int i = 0; i < 16; ++i) {
        const std::size_t slot = tile_slot(bx + i % 4, by + i / 4);
        if (valid[i] == 0 || packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
          put_nothing(tile, slot);
          continue;
        }
        const Vec3f view{-packet.ray.dir_x[i], -packet.ray.dir_y[i], -packet.ray.dir_z[i]};
        const Mesh& mesh = scene.meshes[packet.hit.geomID[i]];
        put_surface(tile, slot,
                    surface_at(scene, mesh, packet.hit.primID[i], packet.hit.u[i], packet.hit.v[i], view), view);
      }
    }
}

}  // namespace steradian
