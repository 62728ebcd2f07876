#include "steradian/texture.h"

#include <array>
#include <cmath>

#include "core/texel.h"

namespace steradian {
namespace {

std::array<float, 256> srgb_table() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double c = static_cast<double>(i) / 255;
    table[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return table;
}

int wrapped(double i, int n, Wrap wrap) {
  const double size = n;
  switch (wrap) {
    case Wrap::clamp_to_edge: i = std::fmin(std::fmax(i, 0.0), size - 1); break;
    case Wrap::repeat: i -= size * std::floor(i / size); break;
    case Wrap::mirrored_repeat:
      i -= 2 * size * std::floor(i / (2 * size));
      if (i >= size) i = 2 * size - 1 - i;
      break;
  }
  // Rounding of huge coordinates may land on the end.
  return static_cast<int>(std::fmin(std::fmax(i, 0.0), size - 1));
}

Vec4f mixed(Vec4f a, Vec4f b, float t) {
  return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, a.w + (b.w - a.w) * t};
}

}  // namespace

float linear_from_srgb8(std::uint8_t code) {
  static const std::array<float, 256> table = srgb_table();
  return table[code];
}

Vec4f texel_of(const Image& image, int x, int y, ColorSpace space) {
  const std::uint8_t* p =
      image.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  const auto rgb = [&](int c) { return space == ColorSpace::srgb ? linear_from_srgb8(p[c]) : static_cast<float>(p[c]) / 255.0f; };
  return {rgb(0), rgb(1), rgb(2), static_cast<float>(p[3]) / 255.0f};
}

Vec4f bilinear(const Image& image, const TextureUse& use, Vec2f uv) {
  const double x = static_cast<double>(uv.x) * image.width, y = static_cast<double>(uv.y) * image.height;
  const auto at = [&](double i, double j) {
    return texel_of(image, wrapped(i, image.width, use.wrap_u), wrapped(j, image.height, use.wrap_v), use.color_space);
  };
  // Texel centres lie at half-integers.
  const double i = std::floor(x - 0.5), j = std::floor(y - 0.5);
  const auto fx = static_cast<float>(x - 0.5 - i), fy = static_cast<float>(y - 0.5 - j);
  return mixed(mixed(at(i, j), at(i + 1, j), fx), mixed(at(i, j + 1), at(i + 1, j + 1), fx), fy);
}

Vec4f sample_texture(const std::vector<Image>& images, const TextureUse& use, Vec2f t) {
  if (!use.present()) return {1, 1, 1, 1};
  const Image& image = images[static_cast<std::size_t>(use.image)];
  const Vec2f uv = use.transformed(t);
  if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return texel_of(image, 0, 0, use.color_space);
  if (use.filter == Filter::linear) return bilinear(image, use, uv);
  const double i = std::floor(static_cast<double>(uv.x) * image.width), j = std::floor(static_cast<double>(uv.y) * image.height);
  return texel_of(image, wrapped(i, image.width, use.wrap_u), wrapped(j, image.height, use.wrap_v), use.color_space);
}

}  // namespace steradian
