// Points: surface points in the form that packs read, a structure of arrays.
#pragma once

#include <cstddef>

#include "render/tile/tile.h"

namespace steradian {

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
