// The device's part of a tile's shadows: slots that see all of a light, and groups of points for the device to answer. Numbers are laid out
// as in shaders/shadow/shadow_layout.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "render/shadow/taker.h"

namespace steradian::vulkan {

class TileShadows : public ShadowTaker {
 public:
  void clear();

  bool find(const Group& group) override;
  void take(const PackLight& light, TileShadow& shadow) override;

  struct Light {
    const PackLight* light;
    std::array<std::uint32_t, kTilePixels> states{};
    bool searched = false;  // the device finds the states of some
    bool shares = false;    // parts may count as fractions of a polygon's light
  };
  struct Point {
    std::uint32_t light, slot;
    const LightSide* side;
    bool shares;
    shadow::Viewpoint at;
  };
  struct Search {
    std::array<std::uint32_t, 68> header;  // places counted from the tile's first vector, the first answer from its first point
    std::size_t points;
    const void* key;  // of the frame
    Frame axes;
    Vec3d origin;
  };
  std::vector<Light> by_light;
  std::vector<Search> groups;
  std::vector<std::uint32_t> values;  // data of groups
  std::vector<Point> points;
  std::deque<LightSide> sides;  // sides that are not stored elsewhere
};

}  // namespace steradian::vulkan
