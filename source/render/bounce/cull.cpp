#include "render/bounce/cull.h"

namespace steradian::indirect {

// Culls against the tile first, then culls the rest against its blocks. A block's test costs a fortieth of its pairs' work.
template <std::size_t planes>
template <class Cull>
void BlockLists::Kind<planes>::run(Cull cull, const Bounds<planes>& all, const ReceiverBounds& box,
                                   const std::array<ReceiverBounds, kBlocks>& blocks) {
  count.fill(0);
  if (all.count == 0 || box.empty) return;
  const std::size_t room = all.count + 32;
  Passed<planes> to;
  for (std::size_t p = 0; p < planes; ++p) {
    if (plane[p].size() < room) plane[p].resize(room);
    to.plane[p] = plane[p].data();
  }
  if (passed.size() < room) passed.resize(room);
  to.index = passed.data();
  Bounds<planes> near;
  near.count = cull(all, box, to);
  near.index = passed.data();
  for (std::size_t p = 0; p < planes; ++p) near.plane[p] = plane[p].data();
  for (std::size_t b = 0; b < kBlocks; ++b) {
    if (blocks[b].empty) continue;
    if (index[b].size() < near.count + 32) index[b].resize(near.count + 32);
    Passed<planes> last;
    last.index = index[b].data();
    count[b] = cull(near, blocks[b], last);
  }
}

void BlockLists::cull(const LightCullTable& table, const LightSet& set, const Receivers& receivers, std::size_t first) {
  std::array<ReceiverBounds, kBlocks> blocks;
  for (std::size_t b = 0; b < kBlocks; ++b) blocks[b] = bounds_of(receivers, first + b * kBlockReceivers, kBlockReceivers);
  const ReceiverBounds box = bounds_of(receivers, first, kTileReceivers);
  const EggArrays& eggs = set.eggs;
  diffuse_.run(table.eggs,
               {{eggs.position.x.data(), eggs.position.y.data(), eggs.position.z.data(), eggs.range.data(), eggs.normal.x.data(),
                 eggs.normal.y.data(), eggs.normal.z.data(), eggs.offset.data()},
                nullptr,
                set.diffuse.size()},
               box, blocks);
  const SpheroidArrays& s = set.spheroids;
  glossy_.run(
      table.spheroids,
      {{s.x.x.data(), s.x.y.data(), s.x.z.data(), s.y.x.data(), s.y.y.data(), s.y.z.data(), s.z.x.data(), s.z.y.data(), s.z.z.data(),
        s.g.x.data(), s.g.y.data(), s.g.z.data(), s.normal.x.data(), s.normal.y.data(), s.normal.z.data(), s.offset.data()},
       nullptr,
       set.glossy.size()},
      box, blocks);
}

}  // namespace steradian::indirect
