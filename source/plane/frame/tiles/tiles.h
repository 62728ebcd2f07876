// The pixels of a frame, tile by tile.
#pragma once

#include <functional>
#include <vector>

#include "plane/frame/scene.h"
#include "plane/frame/tiles/shares.h"
#include "plane/frame/tiles/tile.h"
#include "plane/frame/tiles/tile_lists.h"
#include "steradian/picture.h"

namespace steradian::plane {

struct PixelGrid {
  Vec2d origin, step;  // the picture's corner, the size of a pixel
  int width, height;
  Vec2d at(int x, int y) const { return {origin.x + step.x * (x + 0.5), origin.y + step.y * (y + 0.5)}; }
};

// Tiles of 16 x 16 pixels, by rows.
struct TileSet {
  int columns, rows;
  std::vector<char> marked;
  std::vector<std::uint16_t> blocks;  // by tile: the blocks of 4 x 4 pixels that need light, in the buffer's order; empty: all
  explicit TileSet(const PixelGrid& grid)
      : columns((grid.width + kTileSide - 1) / kTileSide),
        rows((grid.height + kTileSide - 1) / kTileSide),
        marked(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0) {}
  // Marks the tiles of a square of `side` pixels from (x, y) on.
  void mark(int x, int y, int side);
  bool any(int x, int y, int side) const;
  unsigned blocks_of(int x, int y) const {
    return blocks[static_cast<std::size_t>(y / kTileSide) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x / kTileSide)];
  }
};

// Fills the picture's pixels, or those of some tiles, and the counts of the statistics. With a store, the light of round lights on a tile
// is cached there, and computed again only if it has changed.
void render_tiles(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, Picture& picture,
                  PlaneFrameStats& stats, const TileSet* only = nullptr, ShareStore* store = nullptr);

// The same, but the light of tiles goes to the lists of each square of 256 pixels. They are requested by the square's number, row by row,
// from any thread. The picture holds the parts that only the host computes: filled pixels, and lights that only the general method serves.
using ListsOfSquare = std::function<TileLists&(std::size_t square)>;
std::size_t squares_of(const PixelGrid& grid);
void list_tiles(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, const ListsOfSquare& lists,
                Picture& picture, PlaneFrameStats& stats);
PixelGrid grid_of(const PlaneScene& scene, int width, int height);

}  // namespace steradian::plane
