// Receivers: the surfaces of a picture, in an order that groups pixels with the same virtual lights.
#pragma once

#include "render/bounce/arrays.h"
#include "steradian/indirect.h"

namespace steradian::indirect {

// Planes of a picture with a margin left and right of every row, so that packs and filters may read past the row's ends.
struct Raster {
  int width = 0, height = 0;
  static constexpr int kMargin = 32;
  int pitch() const { return (width + 15) / 16 * 16 + 2 * kMargin; }
  std::size_t size() const { return static_cast<std::size_t>(pitch()) * static_cast<std::size_t>(height); }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(pitch()) + static_cast<std::size_t>(x + kMargin);
  }
};

// Surfaces in the picture's order. A normal of zero marks a pixel without a surface that takes light, and the margins.
struct PictureSurfaces {
  Raster raster;
  VectorArray position, normal, view, albedo, f0, f90;
  FloatArray alpha;

  explicit PictureSurfaces(Raster r)
      : raster(r), position(r.size()), normal(r.size()), view(r.size()), albedo(r.size()), f0(r.size()), f90(r.size()), alpha(r.size()) {}
};

inline constexpr int kTile = 16;  // side of a tile of a sub-image, in receivers
inline constexpr int kBlock = 4;  // side of a block, which is a pack of the widest instruction set
inline constexpr std::size_t kTileReceivers = std::size_t{kTile} * kTile;
inline constexpr std::size_t kBlockReceivers = std::size_t{kBlock} * kBlock;
inline constexpr std::size_t kBlocks = kTileReceivers / kBlockReceivers;

// Pixels (x, y) with the same x mod stride and y mod stride form a sub-image. Sub-images follow one another, each as tiles, each tile as
// blocks.
struct Layout {
  int width, height, stride, tiles_x, tiles_y;

  Layout(int w, int h, int s)
      : width(w), height(h), stride(s), tiles_x(((w + s - 1) / s + kTile - 1) / kTile), tiles_y(((h + s - 1) / s + kTile - 1) / kTile) {}
  int tiles() const { return tiles_x * tiles_y; }
  int sets() const { return stride * stride; }
  std::size_t size() const { return static_cast<std::size_t>(sets()) * static_cast<std::size_t>(tiles()) * kTileReceivers; }
  std::size_t tile_begin(int set, int tile) const {
    return (static_cast<std::size_t>(set) * static_cast<std::size_t>(tiles()) + static_cast<std::size_t>(tile)) * kTileReceivers;
  }
  // An index is the sum of a row's part and a column's part.
  std::size_t row_part(int y) const {
    const int v = y / stride;
    return tile_begin(y % stride * stride, v / kTile * tiles_x) +
           static_cast<std::size_t>(v % kTile / kBlock * (kTile * kBlock) + v % kBlock * kBlock);
  }
  std::size_t column_part(int x) const {
    const int u = x / stride;
    return tile_begin(x % stride, u / kTile) + static_cast<std::size_t>(u % kTile / kBlock * (kBlock * kBlock) + u % kBlock);
  }
  std::size_t at(int x, int y) const { return row_part(y) + column_part(x); }
};

// Data that the lighting pass reads. f0 and f90 are filled for mode ggx only.
struct Receivers {
  VectorArray position, normal, view, f0, f90;
  FloatArray alpha;
  FloatArray glossy;  // 1 with a glossy lobe, else 0
};

// Incoming light, demodulated: `diffuse` times albedo / pi and `glossy` times the mean reflectance is radiance.
struct IncomingLight {
  VectorArray diffuse, glossy;
};

// Widens glossy lobes by the angle through which their surface turns within a pattern, in the mean square. The pixels of a pattern share
// the virtual lights. On metal that bends within the pattern, a lobe narrower than that would show a light in one pixel only, and the
// filter would make a block of it.
void widen_over_pattern(PictureSurfaces& surfaces, int side);

Receivers interleave(const PictureSurfaces& surfaces, const Layout& layout, IndirectMode mode);

// Restores the picture's order, as planes of a raster.
IncomingLight deinterleave(const IncomingLight& light, const Layout& layout);

// Bounds of the surfaces among `count` receivers, and of their normals; empty if there are none.
struct ReceiverBounds {
  Vec3f center, half;
  Vec3f normal, normal_half;
  bool empty = true;
};
ReceiverBounds bounds_of(const Receivers& receivers, std::size_t first, std::size_t count);

}  // namespace steradian::indirect
