#include "bake/encoding.h"

#include <algorithm>
#include <cmath>

namespace steradian::bake {
namespace {

float brightest(Vec3f c) { return std::max({c.x, c.y, c.z}); }

}  // namespace

MapEncoding encoding_of(const std::string& word) { return word == "rgb16" ? MapEncoding::rgb16 : MapEncoding::rgbm; }

float range_of(const std::vector<Vec3f>& colors) {
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

std::array<std::uint8_t, 6> rgb16_of(Vec3f color, float range) {
  std::array<std::uint8_t, 6> bytes{};
  std::size_t at = 0;
  for (const float channel : {color.x, color.y, color.z}) {
    const long steps = std::lround(65535 * std::clamp(static_cast<double>(channel) / static_cast<double>(range), 0.0, 1.0));
    bytes[at++] = static_cast<std::uint8_t>(steps >> 8);
    bytes[at++] = static_cast<std::uint8_t>(steps & 255);
  }
  return bytes;
}

Vec3f color_of_rgb16(const std::uint8_t* rgb16, float range) {
  const auto channel = [&](std::size_t i) { return range * static_cast<float>(rgb16[2 * i] << 8 | rgb16[2 * i + 1]) / 65535.0f; };
  return {channel(0), channel(1), channel(2)};
}

Vec3f color_of_rgbm(const std::uint8_t* rgbm, float range) {
  const float scale = range * static_cast<float>(rgbm[3]) / (255.0f * 255.0f);
  return Vec3f{static_cast<float>(rgbm[0]), static_cast<float>(rgbm[1]), static_cast<float>(rgbm[2])} * scale;
}

}  // namespace steradian::bake
