// The tiles of a frame as lists, for a caller that sums their light elsewhere than on this processor's packs.
#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

#include "plane/frame/events/events.h"
#include "plane/frame/tiles/tile.h"
#include "steradian/vector2.h"

namespace steradian::plane {

class TileLists {
 public:
  virtual ~TileLists() = default;
  // By emitter: round lights whose lists are also computed elsewhere; null: none.
  virtual const std::vector<char>* elsewhere() const { return nullptr; }
  // Begins the tile whose first pixel is (x, y): the calls up to end_tile describe its light.
  virtual void begin_tile(int x, int y, Vec2d center) = 0;
  // The data to which the light and its lists point is invalid afterwards.
  virtual void add(const TileLight& light) = 0;
  // A round light by event lines, with pairs of the kinds convex and round. Returns false to request the general rules instead.
  virtual bool add(const EventLight& light, const int* pairs, int count) = 0;
  // Pixel (x, y) of the tile is bit 16 y + x: no light from outside arrives at filled pixels.
  virtual void end_tile(const std::bitset<kTilePixels>& filled) = 0;
};

}  // namespace steradian::plane
