// Pixels of a tile within bodies: dark ones within an occluder, and pixels within a light, which see it from inside. Pixels on outlines,
// whose side floats cannot decide, are answered like queries of points.
#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

#include "plane/frame/scene.h"
#include "plane/frame/tiles/interior.h"
#include "plane/frame/tiles/tiles.h"

namespace steradian::plane {

class Filling {
 public:
  Filling(const FrameScene& frame, const PixelGrid& grid);

  // Finds the filled pixels of the tile from (x0, y0) on, among the bodies that come near it. It uses double, and the same test as a query.
  void find(const std::vector<int>& bodies, int x0, int y0, const TileRectangle& tile);
  // Writes the light of the filled pixels.
  void draw(Picture& picture);

  bool all() const { return marked_.size() == static_cast<std::size_t>(columns_ * rows_); }
  bool is_open(int x, int y) const { return inside_[y * kTileSide + x] == kOutside; }
  std::uint32_t open_blocks() const;  // blocks with pixels that are not filled
  std::bitset<kTilePixels> pixels() const;

 private:
  static constexpr int kOutside = -1, kDark = -2, kOnOutline = -3;
  void find_on_outlines(std::size_t body);
  void mark_on_outline(std::size_t body, int x, int y) {
    const int pixel = y * kTileSide + x;
    int& inside = inside_[pixel];
    if (inside == kOutside) marked_.push_back(pixel);
    if (inside == static_cast<int>(body))
      on_own_outline_.set(static_cast<std::size_t>(pixel));
    else if (inside != kDark)
      inside = kOnOutline;
  }
  void guess_row(const PlaneBody& body, double y, double first, int& begin, int& end) const;
  Vec3d interior(std::size_t body, Vec2d p);
  Vec3d interior_of_polygon(const LightInterior& inside, std::size_t body, Vec2d p);

  const FrameScene& frame_;
  const World& world_;
  const PixelGrid& grid_;
  TileRectangle tile_;
  int x0_ = 0, y0_ = 0, columns_ = 0, rows_ = 0;
  int inside_[kTilePixels];                  // the body that fills each pixel, row by row
  std::bitset<kTilePixels> on_own_outline_;  // pixels within a light and near its outline
  std::vector<int> marked_;                  // pixels that are filled
  int interior_body_ = -1;                   // the body whose curves these are, of those that matter to the tile
  std::vector<const Curve*> interior_curves_;
  SeenWithin seen_within_, seen_from_;  // within a polygon: for the tile, for a pixel
};

}  // namespace steradian::plane
