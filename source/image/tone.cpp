// The tone curve of PNG output.
#include <algorithm>
#include <cmath>

#include "steradian/area_light.h"  // luminance
#include "steradian/picture.h"

namespace steradian {
namespace {

// Khronos PBR Neutral: what is below start_compression keeps its value, highlights are compressed and desaturated.
Vec3f pbr_neutral(Vec3f c) {
  const float start_compression = 0.8f - 0.04f;
  const float desaturation = 0.15f;
  const float low = std::min({c.x, c.y, c.z});
  const float offset = low < 0.08f ? low - 6.25f * low * low : 0.04f;
  c -= Vec3f{offset, offset, offset};
  const float peak = std::max({c.x, c.y, c.z});
  if (peak < start_compression) return c;
  const float d = 1.0f - start_compression;
  const float new_peak = 1.0f - d * d / (peak + d - start_compression);
  c *= new_peak / peak;
  const float g = 1.0f - 1.0f / (desaturation * (peak - new_peak) + 1.0f);
  return c * (1.0f - g) + Vec3f{new_peak, new_peak, new_peak} * g;
}

}  // namespace

float srgb_encode(float linear) {
  if (linear <= 0.0031308f) return 12.92f * linear;
  return 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float srgb_decode(float encoded) {
  if (encoded <= 0.04045f) return encoded / 12.92f;
  return std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float auto_exposure(const Picture& picture) {
  const auto luminance_of = [](Vec3f c) {
    const double y = luminance(static_cast<Vec3d>(c));
    return std::isfinite(y) ? y : 0.0;
  };
  double largest = 0;
  for (const Vec3f& c : picture.pixels) largest = std::max(largest, luminance_of(c));
  double sum = 0, count = 0;
  for (const Vec3f& c : picture.pixels) {
    const double y = luminance_of(c);
    if (!(y > 1e-6 * largest)) continue;
    sum += std::log2(y);
    ++count;
  }
  return count > 0 ? static_cast<float>(std::clamp(std::log2(0.18) - sum / count, -30.0, 30.0)) : 0.0f;
}

Vec3f tone_map(Vec3f radiance, float exposure_stops) {
  const auto finite = [](float x) { return std::isfinite(x) ? std::clamp(x, 0.0f, 1e6f) : 0.0f; };
  const float scale = std::exp2(exposure_stops);
  const Vec3f c = pbr_neutral({finite(radiance.x * scale), finite(radiance.y * scale), finite(radiance.z * scale)});
  const auto encode = [](float x) { return std::clamp(srgb_encode(std::clamp(x, 0.0f, 1.0f)), 0.0f, 1.0f); };
  return {encode(c.x), encode(c.y), encode(c.z)};
}

}  // namespace steradian
