#include "render/shadow/tile.h"

#include <algorithm>

namespace steradian {

bool TileShadow::is_plain() const {
  return std::all_of(seen.begin(), seen.end(), [](Seen s) { return s == Seen::whole || s == Seen::dark; });
}

void TileShadow::Batch::clear() {
  slots.clear();
  passes.clear();
  visible.clear();
  all.clear();
}

void TileShadow::clear() {
  seen.fill(Seen::dark);
  parts.clear();
  edges.clear();
  batch_count = 0;
}

TileShadow::Batch& TileShadow::batch_with_room() {
  if (batch_count == 0 || batches[batch_count - 1].slots.size() + packed::Pieces::kBlock > kTilePixels) {
    if (batches.size() == batch_count) batches.emplace_back();
    batches[batch_count++].clear();
  }
  return batches[batch_count - 1];
}

void TileShadow::batch_parts() {
  constexpr std::size_t kBlock = packed::Pieces::kBlock;
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.visible.count > b.visible.count; });
  for (std::size_t first = 0; first < parts.size(); first += kBlock) {
    const std::size_t last = std::min(first + kBlock, parts.size());
    Batch& batch = batch_with_room();
    const std::size_t at = batch.slots.size();
    batch.slots.resize(at + kBlock, kNoSlot);
    batch.passes.resize(at + kBlock, 1.0f);
    for (std::size_t i = first; i < last; ++i) {
      batch.slots[at + i - first] = parts[i].slot;
      batch.passes[at + i - first] = parts[i].passes;
    }
    const auto add = [&](packed::Pieces& pieces, Outline Part::*which) {
      std::size_t most = 0;
      for (std::size_t i = first; i < last; ++i) most = std::max(most, (parts[i].*which).count);
      if (most == 0) return;
      pieces.add_block(most);
      for (std::size_t i = first; i < last; ++i) {
        const Outline& outline = parts[i].*which;
        for (std::size_t k = 0; k < most; ++k) {
          // Shorter lists are padded with edges of no length.
          const Edge& e = edges[outline.first + std::min(k, outline.count - 1)];
          pieces.set_edge(at + i - first, k, k < outline.count ? e.a : e.b, e.b);
        }
        if (outline.elements) pieces.set_elements(at + i - first, *outline.elements, outline.area);
      }
      // The other lanes of the last block hold no surface.
      for (std::size_t i = last; i < first + kBlock; ++i)
        for (std::size_t k = 0; k < most; ++k) pieces.set_edge(at + i - first, k, {0, 1, 0}, {0, 1, 0});
    };
    add(batch.visible, &Part::visible);
    add(batch.all, &Part::all);
  }
}

}  // namespace steradian
