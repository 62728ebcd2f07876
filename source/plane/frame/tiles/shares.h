// Light of each round light at the pixels of each tile, cached from one picture of a scene to the next. When a tile is drawn again, only
// the lights that have changed there are computed. All are summed in the same order as always.
#pragma once

#include <cstddef>
#include <vector>

#include "plane/frame/tiles/tile.h"

namespace steradian::plane {

struct TileShares {
  bool kept = false;          // are the lights of the tile known? If not, all are computed when it is drawn
  std::vector<int> emitters;  // in increasing order: the disks that light it
  std::vector<int> slots;     // for each of them the place of kTilePixels shares of its radiance, in the buffer's order, in `shares`
  std::vector<float> shares;
  std::vector<int> free_slots;
  std::vector<int> always;   // lights partly computed by the general rule: they are computed every time
  std::vector<int> changed;  // lights changed since it was drawn

  int take_slot() {
    if (!free_slots.empty()) {
      const int slot = free_slots.back();
      free_slots.pop_back();
      return slot;
    }
    shares.resize(shares.size() + kTilePixels);
    return static_cast<int>(shares.size() / kTilePixels) - 1;
  }
  float* at(int slot) { return shares.data() + static_cast<std::size_t>(slot) * kTilePixels; }
  void forget() {
    kept = false;
    emitters.clear();
    slots.clear();
    shares.clear();
    free_slots.clear();
    always.clear();
    changed.clear();
  }
};

class ShareStore {
 public:
  ShareStore(int columns, int rows) : columns_(columns), tiles_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}
  // Shares of the tile at a pixel.
  TileShares& at(int x, int y) {
    return tiles_[static_cast<std::size_t>(y / kTileSide) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x / kTileSide)];
  }
  void forget() {
    for (TileShares& tile : tiles_) tile.forget();
  }
  // Discards tiles, the last ones first, until they use no more than this.
  void keep_below(std::size_t bytes) {
    std::size_t taken = 0;
    for (TileShares& tile : tiles_)
      if ((taken += tile.shares.capacity() * sizeof(float)) > bytes) tile = {};
  }

 private:
  int columns_;
  std::vector<TileShares> tiles_;
};

}  // namespace steradian::plane
