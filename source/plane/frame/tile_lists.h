// The tiles of a frame as lists, for whoever adds up their light elsewhere than on this processor's packs.
#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

#include "plane/frame/events.h"
#include "plane/frame/tile.h"
#include "steradian/vector2.h"

namespace steradian::plane {

class TileLists {
 public:
  virtual ~TileLists() = default;
  // By emitter: round lights whose lists are made elsewhere, too; null: none.
  virtual const std::vector<char>* elsewhere() const { return nullptr; }
  // The tile whose first pixel is (x, y): what follows, up to end_tile, is its light.
  virtual void begin_tile(int x, int y, Vec2d center) = 0;
  // What the light and its lists point to is gone afterwards.
  virtual void add(const TileLight& light) = 0;
  // A round light by event lines, with pairs of the kinds convex and round. False: it is wanted by the general rules instead.
  virtual bool add(const EventLight& light, const int* pairs, int count) = 0;
  // Pixel (x, y) of the tile is bit 16 y + x: in those that something fills no light arrives from outside.
  virtual void end_tile(const std::bitset<kTilePixels>& filled) = 0;
};

}  // namespace steradian::plane
