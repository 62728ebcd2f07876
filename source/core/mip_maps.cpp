#include "core/mip_maps.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "steradian/kernels.h"
#include "steradian/texture.h"

namespace steradian {
namespace {

// Texels in linear light, four numbers each.
struct LinearImage {
  int width, height;
  std::vector<float> rgba;
};

Vec4f texel_of(const LinearImage& image, int x, int y) {
  const float* c = &image.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x))];
  return {c[0], c[1], c[2], c[3]};
}

// Half of a length, and what each of its places averages: the first place of the full length, and the weights of up to four.
struct LengthHalving {
  int length;
  explicit LengthHalving(int whole) : length(std::max(1, whole / 2)), step_(static_cast<double>(whole) / length) {}
  struct Shares {
    int first, count;
    std::array<float, 4> share;
  };
  Shares operator()(int place) const {
    const double from = place * step_, to = (place + 1) * step_;
    Shares s{static_cast<int>(from), 0, {}};
    for (int i = s.first; i < to - 1e-9 && s.count < 4; ++i)
      s.share[static_cast<std::size_t>(s.count++)] = static_cast<float>((std::min(to, i + 1.0) - std::max(from, double(i))) / step_);
    return s;
  }

 private:
  double step_;
};

// texel(x, y): texel of the picture that is to be halved.
template <class Texel>
LinearImage halved(int width, int height, Texel texel) {
  const LengthHalving across(width), down(height);
  LinearImage to{across.length, down.length, {}};
  to.rgba.assign(4 * static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height), 0.0f);
  float* out = to.rgba.data();
  for (int y = 0; y < to.height; ++y) {
    const auto rows = down(y);
    for (int x = 0; x < to.width; ++x, out += 4) {
      const auto columns = across(x);
      for (int j = 0; j < rows.count; ++j)
        for (int i = 0; i < columns.count; ++i) {
          const float share = rows.share[static_cast<std::size_t>(j)] * columns.share[static_cast<std::size_t>(i)];
          const Vec4f c = texel(columns.first + i, rows.first + j);
          out[0] += share * c.x;
          out[1] += share * c.y;
          out[2] += share * c.z;
          out[3] += share * c.w;
        }
    }
  }
  return to;
}

std::uint8_t code_of(float x, bool srgb) {
  const double v = std::clamp(static_cast<double>(x), 0.0, 1.0);
  const double coded = !srgb ? v : v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * coded));
}

Image coded(const LinearImage& from, ColorSpace space) {
  Image image{"", from.width, from.height, {}};
  image.rgba.reserve(from.rgba.size());
  for (std::size_t i = 0; i < from.rgba.size(); ++i) image.rgba.push_back(code_of(from.rgba[i], space == ColorSpace::srgb && i % 4 != 3));
  return image;
}

}  // namespace

struct MipMaps::Pyramid {
  std::once_flag once;
  std::vector<Image> smaller;

  const std::vector<Image>& below(const Image& whole, ColorSpace space) {
    std::call_once(once, [&] {
      LinearImage image{whole.width, whole.height, {}};
      while (image.width > 1 || image.height > 1) {
        image = image.rgba.empty() ? halved(whole.width, whole.height, [&](int x, int y) { return texel_of(whole, x, y, space); })
                                   : halved(image.width, image.height, [&](int x, int y) { return texel_of(image, x, y); });
        smaller.push_back(coded(image, space));
      }
    });
    return smaller;
  }
};

struct MipMaps::Levels {
  std::shared_ptr<Pyramid> pyramid;
  std::once_flag once;
  std::vector<const Image*> whole, all;
};

MipMaps::MipMaps(const std::vector<Image>& images) : images_(images), levels_(std::make_unique<Levels[]>(2 * images.size())) {
  for (std::size_t i = 0; i < 2 * images.size(); ++i) {
    levels_[i].pyramid = std::make_shared<Pyramid>();
    levels_[i].whole = {&images[i / 2]};
  }
}

MipMaps::MipMaps(const std::vector<Image>& images, Pyramids& last) : MipMaps(images) {
  Pyramids these;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Fingerprint texels = fingerprint(std::span<const std::uint8_t>(images[i].rgba));
    for (const ColorSpace space : {ColorSpace::linear, ColorSpace::srgb}) {
      std::shared_ptr<Pyramid>& pyramid = levels_[2 * i + (space == ColorSpace::srgb ? 1 : 0)].pyramid;
      const Pyramids::key_type key(texels, images[i].width, images[i].height, space);
      if (const auto found = last.find(key); found != last.end()) pyramid = found->second;
      pyramid = these.try_emplace(key, pyramid).first->second;
    }
  }
  last = std::move(these);
}

MipMaps::~MipMaps() = default;

MipMaps::Levels& MipMaps::of(const TextureUse& use) const {
  return levels_[2 * static_cast<std::size_t>(use.image) + (use.color_space == ColorSpace::srgb ? 1 : 0)];
}

const std::vector<const Image*>& MipMaps::whole(const TextureUse& use) const { return of(use).whole; }

const std::shared_ptr<MipMaps::Pyramid>& MipMaps::pyramid(const TextureUse& use) const { return of(use).pyramid; }

const std::vector<const Image*>& MipMaps::levels(const TextureUse& use) const {
  Levels& levels = of(use);
  std::call_once(levels.once, [&] {
    levels.all = levels.whole;
    for (const Image& smaller : levels.pyramid->below(*levels.whole.front(), use.color_space)) levels.all.push_back(&smaller);
  });
  return levels.all;
}

int level_count(const Image& image) { return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(image.width, image.height)))); }

Vec4f sample_texture(const MipMaps& maps, const TextureUse& use, Vec2f t, const TextureFootprint& footprint) {
  if (!use.present()) return {1, 1, 1, 1};
  const Image& image = maps.images()[static_cast<std::size_t>(use.image)];
  using Kernel = Kernels<float>;
  const auto turned = [&](Vec2f d) {
    return Kernel::vec2{Kernel::real::of(use.uv[0] * d.x + use.uv[1] * d.y), Kernel::real::of(use.uv[3] * d.x + use.uv[4] * d.y)};
  };
  const auto taps = Kernel().texture_taps({double(image.width), double(image.height)}, turned(footprint.right), turned(footprint.down));
  const Vec2f middle = use.transformed(t);
  if (!taps.covers.m || !std::isfinite(middle.x) || !std::isfinite(middle.y)) return sample_texture(maps.images(), use, t);
  const auto& levels = maps.levels(use);
  const float coarseness = std::min(static_cast<float>(level_count(image) - 1), std::log2(taps.width.v)), count = taps.count.v;
  const auto level = static_cast<std::size_t>(coarseness);
  const float coarser = coarseness - static_cast<float>(level);
  Vec4f sum;
  const auto add = [&](const Image& of, float weight) {
    for (float i = 0; i < count; ++i) {
      const float at = (i + 0.5f) / count - 0.5f;
      const Vec4f c = bilinear(of, use, {middle.x + taps.axis.x.v * at, middle.y + taps.axis.y.v * at});
      sum = {sum.x + weight * c.x, sum.y + weight * c.y, sum.z + weight * c.z, sum.w + weight * c.w};
    }
  };
  const float each = 1 / count;
  add(*levels[level], each * (1 - coarser));
  if (coarser > 0) add(*levels[level + 1], each * coarser);
  return sum;
}

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
