// What fills the pixels of a tile: an occluder, and they are dark, or a light, and they see it from within. And pixels on outlines, of
// which floats would not know the side: they are answered as points are.
#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

#include "plane/frame/interior.h"
#include "plane/frame/scene.h"
#include "plane/frame/tiles.h"

namespace steradian::plane {

class Filling {
 public:
  Filling(const FrameScene& frame, const PixelGrid& grid);

  // Of the tile from (x0, y0) on, by those of the bodies that come near it: in double, and by the same test as a query.
  void find(const std::vector<int>& bodies, int x0, int y0, const TileArea& tile);
  // What light there is on what is filled.
  void draw(Picture& picture);

  bool all() const { return marked_.size() == static_cast<std::size_t>(columns_ * rows_); }
  bool is_open(int x, int y) const { return inside_[y * kTileSide + x] == kOutside; }
  std::uint32_t open_blocks() const;  // of which something is not filled
  std::bitset<kTilePixels> pixels() const;

 private:
  static constexpr int kOutside = -1, kDark = -2, kOnOutline = -3;
  void find_on_outlines(std::size_t body);
  void mark_on_outline(int x, int y) {
    int& inside = inside_[y * kTileSide + x];
    if (inside == kOutside) inside = kOnOutline, marked_.push_back(y * kTileSide + x);
  }
  void guess_row(const PlaneBody& body, double y, double first, int& begin, int& end) const;
  Vec3d interior(std::size_t body, Vec2d p);
  Vec3d interior_of_polygon(const LightInterior& inside, std::size_t body, Vec2d p);

  const FrameScene& frame_;
  const World& world_;
  const PixelGrid& grid_;
  TileArea tile_;
  int x0_ = 0, y0_ = 0, columns_ = 0, rows_ = 0;
  int inside_[kTilePixels];  // what fills each pixel, row by row
  std::vector<int> marked_;  // those that something fills
  int interior_body_ = -1;   // whose curves these are, of those that matter to the tile
  std::vector<const Curve*> interior_curves_;
  SeenWithin seen_within_, seen_from_;  // of a polygon: the tile, a pixel
};

}  // namespace steradian::plane
