// Culling: selects the virtual lights of a set that can matter to a tile of receivers, and to each of its blocks.
#pragma once

#include <array>
#include <vector>

#include "core/simd.h"
#include "render/bounce/light_sets.h"
#include "render/bounce/receivers/receivers.h"

namespace steradian::indirect {

// Arrays of bounds of one kind of light, side by side, with indices if the lights are a selection.
inline constexpr std::size_t kEggPlanes = 8;
inline constexpr std::size_t kSpheroidPlanes = 16;
template <std::size_t planes>
struct Bounds {
  std::array<const float*, planes> plane;
  const std::uint32_t* index = nullptr;  // null: 0, 1, 2, ...
  std::size_t count = 0;
};

// Output for the lights that pass. Planes may be null if only indices are wanted. Needs capacity for 16 more than can pass.
template <std::size_t planes>
struct Passed {
  std::array<float*, planes> plane{};
  std::uint32_t* index = nullptr;
};

struct LightCullTable {
  // Returns the number of lights that may reach the box.
  std::size_t (*eggs)(const Bounds<kEggPlanes>& bounds, const ReceiverBounds& box, const Passed<kEggPlanes>& passed);
  std::size_t (*spheroids)(const Bounds<kSpheroidPlanes>& bounds, const ReceiverBounds& box, const Passed<kSpheroidPlanes>& passed);
};

// The lights of every block of a tile, as indices into the set. The memory of one thread, reused for every tile.
class BlockLists {
 public:
  // Fills the lists of the tile of receivers that begins at `first`.
  void cull(const LightCullTable& table, const LightSet& set, const Receivers& receivers, std::size_t first);

  struct List {
    const std::uint32_t* begin = nullptr;
    std::size_t count = 0;
  };
  List diffuse(std::size_t block) const { return {diffuse_.index[block].data(), diffuse_.count[block]}; }
  List glossy(std::size_t block) const { return {glossy_.index[block].data(), glossy_.count[block]}; }

 private:
  template <std::size_t planes>
  struct Kind {
    std::array<std::vector<float>, planes> plane;
    std::vector<std::uint32_t> passed;
    std::array<std::vector<std::uint32_t>, kBlocks> index;
    std::array<std::size_t, kBlocks> count{};

    template <class Cull>
    void run(Cull cull, const Bounds<planes>& all, const ReceiverBounds& box, const std::array<ReceiverBounds, kBlocks>& blocks);
  };
  Kind<kEggPlanes> diffuse_;
  Kind<kSpheroidPlanes> glossy_;
};

}  // namespace steradian::indirect

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(indirect::LightCullTable, cull_table)
}
