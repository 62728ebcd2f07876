// What of a light reaches the surfaces of a tile: nothing, all of it, or the pieces that triangles leave.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/cpu/light_list.h"
#include "render/cpu/tile.h"

namespace steradian {

// How one light reaches a tile.
struct TileShadow {
  // dark: the surface looks away from all of the light, which sends nothing past its horizon, whatever stands between. elsewhere: a
  // ShadowTaker finds out.
  enum class Seen : std::uint8_t { dark, none, whole, part, share, elsewhere };
  // Edges, and where it is small the elements that stand for it, relative to the point.
  struct Outline {
    std::size_t first = 0, count = 0;
    std::optional<LightQuarters> elements;
    Vec3d area{};  // of the elements, towards the point
  };
  // A slot that sees a part of the light, found by itself.
  struct Part {
    std::uint32_t slot = 0;
    Outline visible;   // edges in no order
    Outline all;       // round and textured lights: the polygon of which `visible` is the part, in walk order
    float passes = 1;  // share that cut-outs let through
  };
  struct Edge {
    Vec3f a, b;  // relative to the point, in the world's frame
  };
  // Slots that see a part, side by side, for packs: not more than a tile has.
  struct Batch {
    std::vector<std::uint32_t> slots;  // kNoSlot: none
    std::vector<float> passes;         // shares that cut-outs let through
    packed::Pieces visible, all;

    void clear();
  };
  std::array<Seen, kTilePixels> seen;
  std::array<float, kTilePixels> share;  // of Seen::share: by rays
  std::vector<Part> parts;
  std::vector<Edge> edges;
  std::vector<Batch> batches;  // of these, batch_count; the others are memory
  std::size_t batch_count = 0;

  void clear();
  // Whether it is as if nothing stood between.
  bool is_plain() const;
  // Where the next sixteen slots go.
  Batch& batch_with_room();
  // Moves the parts into batches, those of about one length side by side.
  void batch_parts();
};

}  // namespace steradian
