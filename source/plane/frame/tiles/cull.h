// Finds the blockers that touch the hull of a tile and a light, on packs: most of a frame's list work.
#pragma once

#include <cstddef>
#include <vector>

#include "core/simd.h"

namespace steradian::plane {

// Bounding circles of blockers, one array for each column, and one entry's circles after another's. Packs read and write up to kRoom floats
// past an entry's end.
class BlockerList {
 public:
  static constexpr std::size_t kRoom = 16;

  std::vector<float> x, y, radius;
  std::vector<float> core;  // the radius of a circle that may occlude a light alone; -1: never
  std::vector<int> index;   // into FrameScene::blockers; for a disk, into FrameScene::pairs
  std::size_t size = 0;

  void clear() { size = 0; }
  // Reserves capacity for `count` more.
  void reserve_more(std::size_t count) {
    const std::size_t needed = size + count + kRoom;
    if (needed <= index.size()) return;
    for (std::vector<float>* column : {&x, &y, &radius, &core}) column->resize(2 * needed);
    index.resize(2 * needed);
  }
  void set(std::size_t i, float cx, float cy, float r, float core_radius, int blocker) {
    x[i] = cx;
    y[i] = cy;
    radius[i] = r;
    core[i] = core_radius;
    index[i] = blocker;
  }
};

// The hull of two circles, around a tile and around a light. At the fraction t of the way from one to the other a circle of radius r
// touches it if it is within (base + t growth + r) widen of the axis.
struct HullOfCircles {
  float x, y;             // the tile's centre
  float axis_x, axis_y;   // from there to the light's centre
  float inverse_length2;  // 1 / squared length of the axis
  float base, growth, widen;
};

struct BlockerCullTable {
  // Appends to `to` the blockers of from[begin, end) that touch the hull, and to `hiders` those of them whose core is wide enough to test.
  // Returns the number of hiders. `to` has capacity for end - begin more, and `hiders` for all.
  std::size_t (*cull)(const HullOfCircles& hull, const BlockerList& from, std::size_t begin, std::size_t end, BlockerList& to, int* hiders);
};

STERADIAN_DECLARE_PACK_TABLE(BlockerCullTable, cull_table)

}  // namespace steradian::plane
