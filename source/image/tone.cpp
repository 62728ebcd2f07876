// The tone curves of PNG output.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>
#include <xsimd/xsimd.hpp>

#include "core/words.h"
#include "image/tone.h"
#include "steradian/area_light.h"  // luminance
#include "steradian/error.h"

namespace steradian {
namespace {

// Khronos PBR Neutral: values below start_compression stay, highlights are compressed and desaturated.
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

Vec3f reinhard(Vec3f c) { return c / (1.0f + static_cast<float>(luminance(static_cast<Vec3d>(c)))); }

Vec3f filmic(Vec3f c) {
  const auto curve = [](float x) { return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f); };
  return {curve(c.x), curve(c.y), curve(c.z)};
}

Vec3f curved(Vec3f c, ToneCurve curve) {
  switch (curve) {
    case ToneCurve::neutral: return pbr_neutral(c);
    case ToneCurve::clip: return c;
    case ToneCurve::reinhard: return reinhard(c);
    case ToneCurve::filmic: return filmic(c);
  }
  return c;
}

}  // namespace

const char* name_of(ToneCurve curve) { return words::name_of(curve); }

ToneCurve tone_curve_named(const std::string& name) {
  if (const auto curve = words::find<ToneCurve>(name)) return *curve;
  throw UsageError("tone", "no curve is named '" + name + "'", "there are " + words::choices<ToneCurve>(", "));
}

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
  double sum = 0;
  std::vector<double> lit;
  for (const Vec3f& c : picture.pixels) {
    const double y = luminance_of(c);
    if (!(y > 1e-6 * largest)) continue;
    sum += std::log2(y);
    lit.push_back(y);
  }
  if (lit.empty()) return 0.0f;
  double stops = std::log2(0.18) - sum / static_cast<double>(lit.size());
  if (2 * lit.size() < picture.pixels.size()) {
    constexpr double kDarker = 0.95;  // of the pixels that are lit
    const auto bright = lit.begin() + static_cast<std::ptrdiff_t>(kDarker * static_cast<double>(lit.size() - 1));
    std::nth_element(lit.begin(), bright, lit.end());
    stops = std::min(stops, -std::log2(*bright));
  }
  return static_cast<float>(std::clamp(stops, -30.0, 30.0));
}

Vec3f tone_map(Vec3f radiance, float exposure_stops) { return tone_map(radiance, exposure_stops, ToneCurve::neutral); }

Vec3f tone_map(Vec3f radiance, float exposure_stops, ToneCurve curve) {
  const Vec3f c = image::tone_curve(radiance, std::exp2(exposure_stops), curve);
  const auto encode = [](float x) { return std::clamp(srgb_encode(x), 0.0f, 1.0f); };
  return {encode(c.x), encode(c.y), encode(c.z)};
}

namespace image {

Vec3f tone_curve(Vec3f radiance, float scale, ToneCurve curve) {
  const auto finite = [](float x) { return std::isfinite(x) ? std::clamp(x, 0.0f, 1e6f) : 0.0f; };
  const Vec3f c = curved({finite(radiance.x * scale), finite(radiance.y * scale), finite(radiance.z * scale)}, curve);
  return {std::clamp(c.x, 0.0f, 1.0f), std::clamp(c.y, 0.0f, 1.0f), std::clamp(c.z, 0.0f, 1.0f)};
}

namespace {

std::uint8_t encoded_byte(float linear) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(srgb_encode(linear), 0.0f, 1.0f) * 255.0f));
}

// The value at which each code begins, and the code at the beginning of each of a float's 2^16 leading halves.
struct CodeTable {
  std::array<float, 257> begins;
  std::array<std::uint8_t, (0x3F80u) + 1> first;  // of bits up to those of 1

  CodeTable() {
    begins[0] = 0;
    begins[256] = 2;
    for (unsigned code = 1; code < 256; ++code) {
      std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.0f);  // low is below, high is not: positive floats have the order of
                                                                         // their bits
      while (high - low > 1) {
        const std::uint32_t middle = low + (high - low) / 2;
        (encoded_byte(std::bit_cast<float>(middle)) < code ? low : high) = middle;
      }
      begins[code] = std::bit_cast<float>(high);
    }
    for (std::uint32_t half = 0; half < first.size(); ++half) first[half] = encoded_byte(std::bit_cast<float>(half << 16));
  }

  // Code of a value in [0, 1]. Leading halves are at most 1/128 of their value apart, so at most one code begins between two: the next is
  // 1/107 away.
  std::uint8_t code(float linear) const {
    const std::uint8_t low = first[std::bit_cast<std::uint32_t>(linear) >> 16];
    return static_cast<std::uint8_t>(low + (linear >= begins[low + 1u] ? 1 : 0));
  }
};

const CodeTable& code_table() {
  static const CodeTable table;
  return table;
}

}  // namespace

std::uint8_t srgb_byte(float linear) {
  const CodeTable& table = code_table();
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  return table.code(linear);
}

namespace {

using Row = xsimd::batch<float, xsimd::sse2>;  // on every x86-64; the order of operations is tone_curve's
constexpr std::size_t kRow = Row::size;

struct RowColor {
  Row x, y, z;
};

RowColor neutral(RowColor c) {
  const Row start_compression(0.8f - 0.04f), desaturation(0.15f), one(1.0f);
  const Row low = xsimd::min(xsimd::min(c.x, c.y), c.z);
  const Row offset = xsimd::select(low < Row(0.08f), low - Row(6.25f) * low * low, Row(0.04f));
  c = {c.x - offset, c.y - offset, c.z - offset};
  const Row peak = xsimd::max(xsimd::max(c.x, c.y), c.z);
  const auto kept = peak < start_compression;
  if (xsimd::all(kept)) return c;
  const Row d = one - start_compression;
  const Row new_peak = one - d * d / (peak + d - start_compression), ratio = new_peak / peak;
  const Row g = one - one / (desaturation * (peak - new_peak) + one);
  const auto compressed = [&](Row v) { return xsimd::select(kept, v, v * ratio * (one - g) + new_peak * g); };
  return {compressed(c.x), compressed(c.y), compressed(c.z)};
}

}  // namespace

void tone_row(const Vec3f* pixels, std::size_t count, float scale, std::uint8_t* rgba, ToneCurve curve) {
  if (curve != ToneCurve::neutral) {
    for (std::size_t i = 0; i < count; ++i, rgba += 4) {
      const Vec3f c = tone_curve(pixels[i], scale, curve);
      rgba[0] = srgb_byte(c.x);
      rgba[1] = srgb_byte(c.y);
      rgba[2] = srgb_byte(c.z);
      rgba[3] = 255;
    }
    return;
  }
  const CodeTable& table = code_table();
  const Row zero(0.0f), one(1.0f), most(std::numeric_limits<float>::max());
  for (std::size_t i = 0; i < count; i += kRow) {
    alignas(16) float x[kRow] = {}, y[kRow] = {}, z[kRow] = {};
    const std::size_t n = std::min(kRow, count - i);
    for (std::size_t k = 0; k < n; ++k) {
      x[k] = pixels[i + k].x;
      y[k] = pixels[i + k].y;
      z[k] = pixels[i + k].z;
    }
    const auto exposed = [&](const float* v) {
      const Row r = Row::load_aligned(v) * Row(scale);
      return xsimd::select((r > zero) & (r <= most), xsimd::min(r, Row(1e6f)), zero);
    };
    const RowColor c = neutral({exposed(x), exposed(y), exposed(z)});
    const auto clamped = [&](Row r, float* to) { xsimd::select(r > zero, xsimd::min(r, one), zero).store_aligned(to); };
    clamped(c.x, x);
    clamped(c.y, y);
    clamped(c.z, z);
    for (std::size_t k = 0; k < n; ++k) {
      std::uint8_t* p = rgba + 4 * (i + k);
      p[0] = table.code(x[k]);
      p[1] = table.code(y[k]);
      p[2] = table.code(z[k]);
      p[3] = 255;
    }
  }
}

}  // namespace image

}  // namespace steradian
