// The device's part of a tile's shadows: visibility of its lights from the slots, as far as the host knows it, and groups of points for
// the device to answer. Numbers are laid out as in shaders/shadow/shadow_layout.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "device/direct/light_records.h"
#include "render/shadow/taker.h"

namespace steradian::vulkan {

class TileShadows : public ShadowTaker {
 public:
  void clear();

  bool find(const Group& group) override;
  void take(const PackLight& light, const TileShadow& shadow) override;

  // Writes the visibility of a light from some slots.
  void set(std::size_t light, const std::vector<std::uint32_t>& slots, const TileShadow& shadow);

  struct Light {
    const PackLight* light;
    std::array<std::uint32_t, kTilePixels> states{};  // records of parts are counted from the tile's first one
    bool shares = false;                              // parts may count as fractions of a polygon's light
    bool listed = true;                               // the next run adds its light
  };
  struct Point {
    std::uint32_t light, slot;
    const LightSide* side;
    bool shares;
    shadow::Viewpoint at;
  };
  struct Search {
    std::array<std::uint32_t, 24> header;  // places counted from the tile's first vector, the first answer from its first point
    std::size_t points;
  };
  std::vector<Light> by_light;
  std::vector<Vec4Floats> records;  // records of parts
  std::vector<Search> groups;
  std::vector<std::uint32_t> values;  // data of groups
  std::vector<Point> points;
  std::deque<LightSide> sides;  // sides that are not stored elsewhere

 private:
  std::size_t add_record(const Vec4Floats& center, const Vec4Floats& reach_a, const Vec4Floats& reach_b, const Vec4Floats& area);
  std::size_t add_outline(const packed::Pieces& pieces, std::size_t point, float weight);
  std::uint32_t add_part(const TileShadow::Batch& batch, std::size_t point, Light& to);
};

}  // namespace steradian::vulkan
