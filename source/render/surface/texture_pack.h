// Textures on packs: the mean over a footprint as in mip_maps.h, each lane with its own footprint.
#pragma once

#include <array>

#include "core/mip_maps.h"
#include "core/pack.h"

STERADIAN_BEGIN_ISA

using PackVec2 = PackKernels::vec2;

struct PackColor {
  PackVec3 rgb;
  PackReal alpha;
};

// A texture to look up, and the footprints of a block of points in it. The coordinates are the mesh's.
struct PackLookup {
  const MipMaps& maps;
  const TextureUse& use;
  PackVec2 t, right, down;
};

namespace {

// The level that each lane reads: its image, and the weight of each of its taps.
struct LaneLevels {
  std::array<const Image*, kLanes> image;
  alignas(64) std::array<float, kLanes> width, height, weight;
};

// The texels that each lane's tap reads in one direction.
struct PackTexels {
  alignas(64) std::array<float, kLanes> low, high, share;

  STERADIAN_INLINE PackTexels(PackReal u, PackReal size, Wrap wrap) {
    const auto texels = PackKernels().texture_texels(u, size, static_cast<int>(wrap));
    store(low.data(), texels.low);
    store(high.data(), texels.high);
    store(share.data(), texels.share);
  }
};

// Adds the four weighted texels of a tap.
STERADIAN_INLINE void add_texels(const LaneLevels& levels, const PackTexels& x, const PackTexels& y, std::size_t k, const float* linear,
                                 const float* linear_alpha, std::array<std::array<float, kLanes>, 4>& sum) {
  const std::size_t row = 4 * static_cast<std::size_t>(levels.image[k]->width);
  const std::uint8_t* texels = levels.image[k]->rgba.data();
  const std::uint8_t *top = texels + row * static_cast<std::size_t>(y.low[k]), *bottom = texels + row * static_cast<std::size_t>(y.high[k]);
  const std::size_t left = 4 * static_cast<std::size_t>(x.low[k]), right = 4 * static_cast<std::size_t>(x.high[k]);
  const float lower = y.share[k] * levels.weight[k], upper = levels.weight[k] - lower, s = x.share[k];
  const float a = upper * (1 - s), b = upper * s, c = lower * (1 - s), d = lower * s;
  for (std::size_t i = 0; i < 4; ++i) {
    const float* value = i < 3 ? linear : linear_alpha;
    sum[i][k] += a * value[top[left + i]] + b * value[top[right + i]] + c * value[bottom[left + i]] + d * value[bottom[right + i]];
  }
}

// Values of 8-bit codes.
struct CodeTables {
  std::array<float, 256> srgb, linear;
  CodeTables() {
    for (std::size_t i = 0; i < 256; ++i) {
      srgb[i] = linear_from_srgb8(static_cast<std::uint8_t>(i));
      linear[i] = static_cast<float>(i) / 255.0f;
    }
  }
};

PackColor sample_texture(const PackLookup& l) {
  static const CodeTables codes;
  const TextureUse& use = l.use;
  const Image& image = l.maps.images()[static_cast<std::size_t>(use.image)];
  const auto turned = [&](const PackVec2& d) {
    return PackVec2{broadcast(use.uv[0]) * d.x + broadcast(use.uv[1]) * d.y, broadcast(use.uv[3]) * d.x + broadcast(use.uv[4]) * d.y};
  };
  const PackReal zero(0.0), one(1.0);
  const PackReal width = broadcast(static_cast<float>(image.width)), height = broadcast(static_cast<float>(image.height));
  PackKernels kernels;
  PackVec2 middle = turned(l.t);
  middle = {kernels.texture_coordinate(middle.x + broadcast(use.uv[2])), kernels.texture_coordinate(middle.y + broadcast(use.uv[5]))};
  const auto taps = kernels.texture_taps({width, height}, turned(l.right), turned(l.down));
  if (use.filter == Filter::nearest)
    middle = select(taps.covers, middle, {kernels.texture_center(middle.x, width), kernels.texture_center(middle.y, height)});
  const bool covers = any_lane(taps.covers);
  PackReal level = zero;
  if (covers) {
    const PackReal last = broadcast(static_cast<float>(level_count(image) - 1));
    level = select(taps.covers, min(last, log(taps.width) * PackReal(1.4426950408889634)), zero);
  }

  alignas(64) std::array<float, kLanes> counts, wholes;
  const PackReal whole = floor(level), coarser = level - whole;
  store(counts.data(), taps.count);
  store(wholes.data(), whole);
  float most = 1;
  for (std::size_t k = 0; k < kLanes; ++k) most = std::max(most, counts[k]);

  const auto& levels = covers ? l.maps.levels(use) : l.maps.whole(use);

  alignas(64) std::array<std::array<float, kLanes>, 4> sum{};
  const float* linear = use.color_space == ColorSpace::srgb ? codes.srgb.data() : codes.linear.data();
  for (std::size_t j = 0; j < (any_lane(coarser > zero) ? 2u : 1u); ++j) {
    LaneLevels lanes;
    for (std::size_t k = 0; k < kLanes; ++k) {
      lanes.image[k] = levels[std::min(static_cast<std::size_t>(wholes[k]) + j, levels.size() - 1)];
      lanes.width[k] = static_cast<float>(lanes.image[k]->width);
      lanes.height[k] = static_cast<float>(lanes.image[k]->height);
    }
    store(lanes.weight.data(), (j == 0 ? one - coarser : coarser) / taps.count);
    for (float i = 0; i < most; ++i) {
      const PackReal at = (broadcast(i) + PackReal(0.5)) / taps.count - PackReal(0.5);
      const PackTexels x(middle.x + taps.axis.x * at, load(lanes.width.data()), use.wrap_u);
      const PackTexels y(middle.y + taps.axis.y * at, load(lanes.height.data()), use.wrap_v);
      for (std::size_t k = 0; k < kLanes; ++k)
        if (i < counts[k] && lanes.weight[k] > 0) add_texels(lanes, x, y, k, linear, codes.linear.data(), sum);
    }
  }
  return {{load(sum[0].data()), load(sum[1].data()), load(sum[2].data())}, load(sum[3].data())};
}

}  // namespace

STERADIAN_END_ISA
