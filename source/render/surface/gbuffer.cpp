#include "render/surface/gbuffer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "render/surface/surface_pack.h"
#include "scene/emitters/emitters.h"

namespace steradian {
namespace {

// Unit normals closer than this share a horizon, which moves by 1e-5 of a light's solid angle.
constexpr float kSameNormal = 1e-5f;

// Updates the kinds that the tile holds after this surface was added.
void note(SurfaceTile& tile, const Surface& s) {
  tile.any_surface = true;
  tile.any_passing |= weighs(s.passes);
  tile.any_diffuse |= weighs(s.albedo);
  tile.any_specular |= weighs(s.f0) || weighs(s.f90);
  tile.any_sheen |= weighs(s.sheen);
  tile.any_coat |= s.coat > 0;
  tile.any_override |= !s.material->unlit && !s.material->specular_override.empty();
}

std::array<TileVector*, 12> vectors_of(SurfaceTile& t) {
  return {&t.position, &t.normal, &t.geometric_normal, &t.view,   &t.albedo,  &t.f0, &t.f90,
          &t.tangent,  &t.sheen,  &t.coat_normal,      &t.passes, &t.radiance};
}

}  // namespace

void clear_kinds(SurfaceTile& tile) {
  tile.any_surface = tile.any_diffuse = tile.any_specular = tile.any_sheen = tile.any_coat = tile.any_override = tile.any_passing = false;
}

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
  tile.material[i] = s.material;
  note(tile, s);
}

void put_nothing(SurfaceTile& tile, std::size_t i) {
  for (TileVector* v : vectors_of(tile)) put(*v, i, {});
  tile.alpha_x[i] = tile.alpha_y[i] = tile.coat_alpha[i] = tile.sheen_alpha[i] = 1;
  tile.coat[i] = tile.fresnel_loss[i] = 0;
  tile.material[i] = nullptr;
}

std::size_t take_slots(const SurfaceTile& from, const std::vector<std::uint32_t>& slots, std::size_t filled, SurfaceTile& to) {
  clear_kinds(to);
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (slots[i] == kNoSlot)
      put_nothing(to, i);
    else
      put_surface(to, i, surface_in(from, slots[i]), get(from.view, slots[i]));
  for (std::size_t i = slots.size(); i < filled; ++i) put_nothing(to, i);
  return slots.size();
}

bool take_coats(SurfaceTile& from, SurfaceTile& to) {
  const auto bent = [&](std::size_t i) {
    return from.material[i] != nullptr && from.coat[i] > 0 && length(get(from.coat_normal, i) - get(from.normal, i)) > kSameNormal;
  };
  std::size_t first = 0;
  while (first < kTilePixels && !bent(first)) ++first;
  if (first == kTilePixels) return false;
  clear_kinds(to);
  to.seed = from.seed;
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (!bent(i)) {
      put_nothing(to, i);
      continue;
    }
    Surface coat;
    coat.material = from.material[i];
    coat.position = get(from.position, i);
    coat.normal = coat.coat_normal = get(from.coat_normal, i);
    coat.geometric_normal = get(from.geometric_normal, i);
    coat.tangent = get(from.tangent, i);
    const float weight = from.coat[i];
    coat.f0 = Vec3f{kCoatF0, kCoatF0, kCoatF0} * weight;
    coat.f90 = {weight, weight, weight};
    coat.alpha_x = coat.alpha_y = from.coat_alpha[i];
    put_surface(to, i, coat, get(from.view, i));
    from.coat[i] = 0;
  }
  to.any_override = false;  // lobes of a material that replace the layers below the coat
  return true;
}

void put_back_coats(const SurfaceTile& coats, SurfaceTile& to) {
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (coats.material[i] == nullptr) continue;
    to.coat[i] = coats.f90.x[i];
    to.radiance.x[i] += coats.radiance.x[i];
    to.radiance.y[i] += coats.radiance.y[i];
    to.radiance.z[i] += coats.radiance.z[i];
  }
}

void SixteenSurfaces::take(const SurfaceTile& tile, std::size_t first) {
  lit = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (tile.material[first + i] == nullptr) continue;
    surface[i] = surface_in(tile, first + i);
    view[i] = get(tile.view, first + i);
    lit |= 1u << i;
  }
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
      if (any == 0 && behind != nullptr) {  // a first layer needs every direction, also for the background
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

namespace {

constexpr std::size_t kBlock = 16;  // slots that packets of rays and packs handle together

// Empties a whole block.
void put_nothing_in_block(SurfaceTile& tile, std::size_t first) {
  const auto fill = [&](TilePlane& plane, float value) { std::fill_n(plane.data() + first, kBlock, value); };
  for (TileVector* v : vectors_of(tile))
    for (TilePlane* plane : {&v->x, &v->y, &v->z}) fill(*plane, 0);
  for (TilePlane* plane : {&tile.alpha_x, &tile.alpha_y, &tile.coat_alpha, &tile.sheen_alpha}) fill(*plane, 1);
  for (TilePlane* plane : {&tile.coat, &tile.fresnel_loss}) fill(*plane, 0);
  std::fill_n(tile.material.data() + first, kBlock, nullptr);
}

// The mesh of the last hit: neighbours mostly hit the same mesh.
struct LastMesh {
  unsigned geometry = RTC_INVALID_GEOMETRY_ID;
  SurfaceKind kind = SurfaceKind::layered;
  bool covers = false;  // its textures are means over pixel footprints
  Surface like;         // for a plain mesh
};

// Moves positions onto the surfaces that the normals of their vertices describe.
void smooth_positions(const Scene& scene, const TileHits& hits, SurfaceTile& tile) {
  for (std::size_t i = 0; i < kTilePixels; ++i)
    if (tile.material[i] != nullptr)
      put(tile.position, i,
          smooth_position(scene.meshes[hits.geometry[i]], hits.triangle[i], hits.u[i], hits.v[i], get(tile.geometric_normal, i)));
}

// Moves positions off the flat lights whose faces they are, towards the visible side. There the light lies below the horizon and, if it has
// one side, shines away. Within roundings of its own plane, it would fill the sky at one pixel and vanish at the next.
void lift_off_lights(const Scene& scene, const TileHits& hits, SurfaceTile& tile) {
  std::int32_t last = -1;
  float lift = 0;
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (tile.material[i] == nullptr || !scene.meshes[hits.geometry[i]].is_emitter()) continue;
    const std::int32_t light = scene.meshes[hits.geometry[i]].triangle_lights[hits.triangle[i]];
    if (light < 0) continue;
    if (light != last) lift = scene::roundings_of_plane(scene.area_lights[static_cast<std::size_t>(light)]);
    last = light;
    put(tile.position, i, get(tile.position, i) + get(tile.geometric_normal, i) * lift);
  }
}

}  // namespace

void shade_tile(const Scene& scene, const HitShading& shading, const TileHits& hits, SurfaceTile& tile) {
  clear_kinds(tile);
  LastMesh last;
  const auto surface_of = [&](std::size_t i, Vec3f view) {
    const Mesh& mesh = scene.meshes[hits.geometry[i]];
    SurfaceFootprint footprint;
    if (last.covers) footprint = footprint_on(*shading.maps, mesh, hits.triangle[i], -view, hits.distance[i], shading.steps);
    return surface_at(scene, mesh, hits.triangle[i], hits.u[i], hits.v[i], view, footprint);
  };
  for (std::size_t first = 0; first < kTilePixels; first += kBlock) {
    std::uint32_t hit = 0;
    for (std::size_t k = 0; k < kBlock; ++k) hit |= std::uint32_t{hits.geometry[first + k] != RTC_INVALID_GEOMETRY_ID} << k;
    if (hit == 0) {
      put_nothing_in_block(tile, first);
      continue;
    }
    for (std::size_t k = 0; k < kBlock; ++k)
      if ((hit >> k & 1) == 0) put_nothing(tile, first + k);
    while (hit != 0) {  // the slots of one mesh at a time
      const std::size_t slot = first + static_cast<std::size_t>(std::countr_zero(hit));
      const unsigned geometry = hits.geometry[slot];
      const Mesh& mesh = scene.meshes[geometry];
      std::uint32_t of_mesh = 0;
      for (std::size_t k = 0; k < kBlock; ++k) of_mesh |= std::uint32_t{hits.geometry[first + k] == geometry} << k;
      hit &= ~of_mesh;
      if (geometry != last.geometry) {
        last.geometry = geometry;
        last.kind = kind_of(scene, mesh);
        last.covers = last.kind != SurfaceKind::plain && shading.maps != nullptr;
        if (last.kind == SurfaceKind::plain) last.like = surface_of(slot, -get(hits.direction, slot));
      }
      if (last.kind == SurfaceKind::plain) {
        note(tile, last.like);
        of_mesh &= ~shading.packs.fill_plain(mesh, last.like, hits, first, of_mesh, tile);
      } else if (last.kind == SurfaceKind::textured && shading.maps != nullptr) {
        of_mesh &= ~shading.packs.fill_textured(scene, mesh, shading, hits, first, of_mesh, tile);
      }
      for (; of_mesh != 0; of_mesh &= of_mesh - 1) {
        const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(of_mesh));
        const Vec3f view = -get(hits.direction, i);
        put_surface(tile, i, surface_of(i, view), view);
      }
    }
  }
  if (shading.terminator == Terminator::smooth) smooth_positions(scene, hits, tile);
  lift_off_lights(scene, hits, tile);
}

}  // namespace steradian
