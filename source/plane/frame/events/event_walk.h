// Round lights and their blockers: the pairs, and the traversal of the frame with them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "plane/frame/events/events.h"
#include "plane/frame/scene.h"
#include "plane/frame/tiles/leaf.h"
#include "plane/frame/tiles/shares.h"
#include "plane/frame/tiles/tile_lists.h"
#include "plane/frame/tiles/tiles.h"

namespace steradian::plane {

// Pairs of a round light and its possible blockers, with their event lines.

// Writes a pair for each of the blockers, in their order, from `first` on. FrameScene::pairs must have capacity for them.
void make_event_pairs(FrameScene& frame, const Emitter& disk, const std::vector<int>& blockers, std::size_t first);

// Traversal of a frame by round lights: from squares of 256 pixels to 64 and to tiles of 16, with the pairs that matter to each.

// Least distance between a line and a place that it decides about.
float slack_of(const FrameScene& frame);

class EventWalk {
 public:
  // With a `store`, only changed lights are computed; null: all are.
  EventWalk(const FrameScene& frame, const PixelGrid& grid, const TileSet* only, ShareStore* store);

  // Removes lights that are computed elsewhere; `elsewhere` is by emitter.
  void leave_out(const std::vector<char>& elsewhere);

  // Selects the 256 pixels from (x, y) on, then 64 of them, for the calls that follow.
  void enter_256(int x, int y, const TileRectangle& tile);
  void enter_64(int x, int y);
  // Adds the light on the tile's blocks in `open`; `general` handles the cases for which there is no rule here.
  void add_lights(int x, int y, const TileRectangle& tile, std::uint32_t open, TileBuffer& buffer, LeafBuilder& general);

  // Writes the same lights into lists.
  void list_lights(int x, int y, const TileRectangle& tile, TileLists& lists, LeafBuilder& general);

  std::uint64_t tile_lights = 0, tile_blockers = 0;

 private:
  struct Entry {
    int emitter;
    std::size_t begin;
    int count;
  };
  // Lights by child, and their pairs one after another.
  struct Children {
    std::vector<Entry> lights[16];
    std::vector<int> pairs[16];
    std::size_t used[16];
  };

  int child_of_64(int x, int y) const { return (y - y_64_) / kTileSide * 4 + (x - x_64_) / kTileSide; }
  // The squares among sixteen that need a light: those in which it changes, and those in which everything is computed.
  struct Wanted {
    std::uint32_t any = 0, everything = 0;
  };
  Wanted wanted(int x, int y, int side) const;
  void find_changed(int x, int y);
  void split(const std::vector<Entry>& lights, const int* pairs, int x, int y, int side, const Wanted& wanted, Children& to) const;

  const FrameScene& frame_;
  const PixelGrid& grid_;
  const EventTable& table_ = event_table_for(active_simd());
  const TileTable& tiles_ = tile_table_for(active_simd());
  const BlockerCullTable& cull_ = cull_table_for(active_simd());
  const TileSet* only_;
  ShareStore* store_;
  float slack_;
  std::vector<int> disks_;  // emitters
  std::vector<int> hiders_;
  std::vector<Entry> top_;
  BlockerList top_pairs_;
  Children of_256_, of_64_;
  int x_256_ = 0, y_256_ = 0, x_64_ = 0, y_64_ = 0;
  EventRest rest_;
  std::vector<char> changed_;  // by emitter: has it changed in the 256 pixels?
  TileShares next_;            // the tile's next shares
};

// Marks the tiles on which the pair may have affected the light of a disk. These are the tiles that it reaches on the way down, by the same
// tests. Calls mark(x, y, side).
void mark_touched(const FrameScene& frame, const PixelGrid& grid, const Emitter& disk, int pair,
                  const std::function<void(int, int, int)>& mark);

}  // namespace steradian::plane
