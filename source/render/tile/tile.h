// Surfaces as packs read them: SurfaceTile, the G-buffer of a tile, and Points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "steradian/vector.h"

namespace steradian {

// SurfaceTile: the G-buffer of one tile, as a structure of arrays that packs read.

struct SurfaceMaterial;

inline constexpr int kTileSide = 32;
inline constexpr std::size_t kTilePixels = std::size_t{kTileSide} * kTileSide;

// Slot of pixel (x, y): blocks of 4 x 4 pixels, row by row. Sixteen neighbours in a pack (and in a packet of rays) agree on branches far
// more often than sixteen pixels of a row.
constexpr std::size_t tile_slot(int x, int y) {
  const int block = (y / 4) * (kTileSide / 4) + x / 4;
  return static_cast<std::size_t>(block * 16 + (y % 4) * 4 + x % 4);
}

inline constexpr std::uint32_t kNoSlot = UINT32_MAX;

// A plane is one cache line longer than its pixels. Planes a multiple of 4 KB apart would compete for the same few cache lines when a
// pixel's values are written to all of them.
using TilePlane = std::array<float, kTilePixels + 16>;

struct TileVector {
  alignas(64) TilePlane x, y, z;
};
inline Vec3f get(const TileVector& v, std::size_t i) { return {v.x[i], v.y[i], v.z[i]}; }
inline void put(TileVector& v, std::size_t i, Vec3f a) {
  v.x[i] = a.x;
  v.y[i] = a.y;
  v.z[i] = a.z;
}

// Slots without a surface hold a normal of zero; every light sends them nothing.
struct SurfaceTile {
  std::uint64_t seed = 0;  // seed of its random decisions: differs for each tile and sample of a frame
  TileVector position, normal, view;
  TileVector geometric_normal;  // triangle's normal, unit, turned to the viewer
  TileVector albedo;            // diffuse
  alignas(64) TilePlane fresnel_loss;
  TileVector f0, f90;  // specular GGX; zero without such a lobe
  TileVector tangent;
  alignas(64) TilePlane alpha_x, alpha_y;
  alignas(64) TilePlane coat, coat_alpha;
  TileVector coat_normal;
  TileVector sheen;  // colour of Charlie's lobe; black without sheen
  alignas(64) TilePlane sheen_alpha;
  TileVector passes;                                         // fraction of the light from behind that comes through; only where any_passing
  TileVector radiance;                                       // the result
  std::array<const SurfaceMaterial*, kTilePixels> material;  // null without a surface
  bool any_surface, any_diffuse, any_specular, any_sheen, any_coat, any_override, any_passing;
};

// Points: surface points in the form that packs read, a structure of arrays.

struct VectorArrays {
  const float *x = nullptr, *y = nullptr, *z = nullptr;
};

// All arrays hold `count` floats, and `count` is a multiple of 16 (repeat the last point). Arrays that a function does not read may be
// null.
struct Points {
  std::size_t count = 0;
  VectorArrays position, normal, view;                 // unit normals and views
  VectorArrays tangent = {};                           // direction of alpha_x; zero: any
  const float *alpha_x = nullptr, *alpha_y = nullptr;  // a lobe's widths; an isotropic lobe uses alpha_x
  const float* fresnel_loss = nullptr;                 // loss at the boundary above a diffuse lobe (kernels/lobe/lambert.glsl); null: none
};

inline VectorArrays arrays_of(const TileVector& v) { return {v.x.data(), v.y.data(), v.z.data()}; }

// Points of every slot of a tile, with one lobe's normals and widths.
inline Points points_of(const SurfaceTile& tile, const TileVector& normal, const TilePlane& alpha_x, const TilePlane& alpha_y) {
  return {kTilePixels,    arrays_of(tile.position), arrays_of(normal),       arrays_of(tile.view), arrays_of(tile.tangent),
          alpha_x.data(), alpha_y.data(),           tile.fresnel_loss.data()};
}
inline Points points_of(const SurfaceTile& tile, const TilePlane& alpha_x, const TilePlane& alpha_y) {
  return points_of(tile, tile.normal, alpha_x, alpha_y);
}
inline Points points_of(const SurfaceTile& tile) { return points_of(tile, tile.alpha_x, tile.alpha_y); }

}  // namespace steradian
