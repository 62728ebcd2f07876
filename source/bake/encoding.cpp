#include "bake/encoding.h"

#include <algorithm>
#include <cmath>

namespace steradian::bake {
namespace {

float brightest(Vec3f c) { return std::max({c.x, c.y, c.z}); }

}  // namespace

float rgbm_range(const std::vector<Vec3f>& colors) {
  float range = 0;
  for (const Vec3f& c : colors) range = std::max(range, brightest(c));
  return range > 0 ? range : 1;
}

std::array<std::uint8_t, 4> rgbm_of(Vec3f color, float range) {
  const float part = std::clamp(brightest(color) / range, 0.0f, 1.0f);
  // The smallest multiplier that holds the colour wastes none of the other bytes' steps.
  const float steps = std::max(std::ceil(part * 255 - 1e-4f), 1.0f);
  const float scale = 255 * 255 / (range * steps);
  const auto byte = [&](float x) { return static_cast<std::uint8_t>(std::lround(std::clamp(x * scale, 0.0f, 255.0f))); };
  return {byte(color.x), byte(color.y), byte(color.z), static_cast<std::uint8_t>(steps)};
}

Vec3f color_of_rgbm(const std::uint8_t* rgbm, float range) {
  const float scale = range * static_cast<float>(rgbm[3]) / (255.0f * 255.0f);
  return Vec3f{static_cast<float>(rgbm[0]), static_cast<float>(rgbm[1]), static_cast<float>(rgbm[2])} * scale;
}

}  // namespace steradian::bake
