// Round lights whose tile lists the device computes: the data for each, and the lights that may reach a tile.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plane/frame/scene.h"
#include "plane/frame/tiles/tiles.h"

namespace steradian::plane {

class ListedDisks {
 public:
  // Selects the lights whose pairs are all among the device's first `pairs`, with kinds that have their own lines. mask_words: capacity of
  // the masks.
  void choose(const FrameScene& frame, const PixelGrid& grid, std::size_t pairs, std::size_t mask_words);

  std::size_t count() const { return records_.size() / kRecord; }
  const std::vector<std::uint32_t>& records() const { return records_; }  // shaders/plane/plane_layout.glsl, kDisk words each
  std::size_t mask_words() const { return mask_words_; }
  std::size_t most_cells() const { return most_cells_; }             // most tiles of a disk
  const std::vector<char>& is_listed() const { return is_listed_; }  // by emitter

  struct Entry {
    std::uint32_t disk, mask;  // number of the disk, place of the tile's mask
    std::uint32_t pairs;
  };
  // The entries of tile (column, row).
  std::span<const Entry> of_tile(int column, int row) const;

 private:
  static constexpr std::size_t kRecord = 20;

  template <class Use>
  void for_each_tile(const FrameScene& frame, const PixelGrid& grid, Use use) const;

  std::vector<std::uint32_t> records_;
  std::vector<int> emitters_;  // emitters of the records
  std::vector<char> is_listed_;
  std::vector<std::uint32_t> first_;  // by tile, and one more: index in entries_
  std::vector<Entry> entries_;
  int columns_ = 0;
  std::size_t mask_words_ = 0, most_cells_ = 0;
};

}  // namespace steradian::plane
