// The part of a light that reaches the surfaces of a tile: nothing, all of it, or the pieces that triangles leave visible.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/lights/light_list.h"
#include "render/tile/tile.h"

namespace steradian {

// Visibility of one light over a tile.
struct TileShadow {
  // dark: the surface faces away from all of the light, which sends nothing past its horizon, with or without occluders. elsewhere: a
  // ShadowTaker computes it.
  enum class Seen : std::uint8_t { dark, none, whole, part, share, elsewhere };
  // Edges relative to the point, and, if the outline is small, the elements that stand for it.
  struct Outline {
    std::size_t first = 0, count = 0;
    std::optional<LightQuarters> elements;
    Vec3d area{};  // area vector of the elements, towards the point
  };
  // A slot that sees a part of the light, computed by itself.
  struct Part {
    std::uint32_t slot = 0;
    Outline visible;   // edges in no order
    Outline all;       // round lights: the polygon of which `visible` is the part, in walk order
    float passes = 1;  // fraction that passes cut-outs
  };
  struct Edge {
    Vec3f a, b;  // relative to the point, in world axes
  };
  // Slots that see a part of the light, side by side for packs. A batch has at most as many slots as a tile.
  struct Batch {
    std::vector<std::uint32_t> slots;  // kNoSlot: none
    std::vector<float> passes;         // fractions that pass cut-outs
    packed::Pieces visible, all;

    void clear();
  };
  std::array<Seen, kTilePixels> seen;
  std::array<float, kTilePixels> share;  // visible fraction by rays, for Seen::share
  std::vector<Part> parts;
  std::vector<Edge> edges;
  std::vector<Batch> batches;  // the first batch_count are in use; the others keep their memory
  std::size_t batch_count = 0;

  void clear();
  // True if nothing occludes the light.
  bool is_plain() const;
  // The batch for the next sixteen slots.
  Batch& batch_with_room();
  // Moves the parts into batches. Parts of similar length stand side by side.
  void batch_parts();
};

}  // namespace steradian
