// Textures on packs: the mean over a footprint as in mip_maps.h, each lane with its own footprint.
#pragma once

#include <array>

#include "core/mip_maps.h"
#include "core/pack.h"

STERADIAN_BEGIN_ISA

struct PackVec2 {
  PackReal x, y;
};

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

// Texels on both sides of a coordinate (0 to 1 over the image), and the weight of the second.
struct PackTexels {
  alignas(64) std::array<float, kLanes> low, high, share;

  STERADIAN_INLINE PackTexels(PackReal u, PackReal size, Wrap wrap) {
    const PackReal zero(0.0), one(1.0), last = size - one;
    if (wrap == Wrap::repeat) u = u - floor(u);
    if (wrap == Wrap::mirrored_repeat) {
      u = u - PackReal(2.0) * floor(u * PackReal(0.5));
      u = min(u, PackReal(2.0) - u);
    }
    const PackReal x = min(max(u, zero), one) * size - PackReal(0.5), at = floor(x), next = at + one;
    store(share.data(), x - at);
    if (wrap == Wrap::repeat) {
      store(low.data(), select(at < zero, last, at));
      store(high.data(), select(next > last, zero, next));
    } else {
      store(low.data(), max(at, zero));
      store(high.data(), min(next, last));
    }
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
  PackVec2 middle = turned(l.t);
  // Coordinates that are not numbers, or are too large to have a fraction, become 0.
  const auto usual = [&](PackReal u) { return select(abs(u) < PackReal(1e7), u, zero); };
  middle = {usual(middle.x + broadcast(use.uv[2])), usual(middle.y + broadcast(use.uv[5]))};

  // The same as texture_taps, lane by lane.
  const PackVec2 right = turned(l.right), down = turned(l.down);
  const PackVec2 a{right.x * width, right.y * height}, b{down.x * width, down.y * height};
  const PackReal xx = a.x * a.x + b.x * b.x, xy = a.x * a.y + b.x * b.y, yy = a.y * a.y + b.y * b.y;
  const PackReal half = PackReal(0.5) * (xx - yy), longer2 = PackReal(0.5) * (xx + yy) + sqrt(half * half + xy * xy);
  const auto covers = longer2 > one;
  std::array<Wrap, 2> wraps{use.wrap_u, use.wrap_v};
  if (use.filter == Filter::nearest) {  // the middle of a texel, where neighbours weigh nothing
    const auto centre = [&](PackReal u, PackReal size) { return (floor(u * size) + PackReal(0.5)) / size; };
    middle = {select(covers, middle.x, centre(middle.x, width)), select(covers, middle.y, centre(middle.y, height))};
  }
  PackReal count = one, level = zero;
  PackVec2 axis{zero, zero};
  if (any_lane(covers)) {
    const auto wide = covers && !(longer2 < PackReal(1e12));
    const PackReal square = select(covers && !wide, longer2, one), longer = sqrt(square);
    const PackReal shorter = max(one, abs(a.x * b.y - a.y * b.x) / longer);
    const PackReal taps = min(max(-floor(PackReal(1e-3) - longer / shorter), one), PackReal(16.0));
    const PackReal last = broadcast(static_cast<float>(level_count(image) - 1));
    const PackReal coarse = log(max(shorter, longer * PackReal(1.0 / 16))) * PackReal(1.4426950408889634);
    const auto flat = half > zero;
    const PackVec2 along{select(flat, square - yy, xy), select(flat, xy, square - xx)};
    const PackReal size2 = along.x * along.x + along.y * along.y;
    const PackReal size = select(size2 > zero, longer / sqrt(max(size2, PackReal(1e-30))), zero);
    count = select(wide, one, select(covers, taps, one));
    level = select(wide, last, select(covers, min(last, coarse), zero));
    const auto spread = covers && !wide;
    axis = {select(spread, along.x * size / width, zero), select(spread, along.y * size / height, zero)};
  }

  alignas(64) std::array<float, kLanes> counts, wholes;
  const PackReal whole = floor(level), coarser = level - whole;
  store(counts.data(), count);
  store(wholes.data(), whole);
  float most = 1;
  for (std::size_t k = 0; k < kLanes; ++k) most = std::max(most, counts[k]);

  const auto& levels = any_lane(covers) ? l.maps.levels(use) : l.maps.whole(use);

  alignas(64) std::array<std::array<float, kLanes>, 4> sum{};
  const float* linear = use.color_space == ColorSpace::srgb ? codes.srgb.data() : codes.linear.data();
  for (std::size_t j = 0; j < (any_lane(coarser > zero) ? 2u : 1u); ++j) {
    LaneLevels lanes;
    for (std::size_t k = 0; k < kLanes; ++k) {
      lanes.image[k] = levels[std::min(static_cast<std::size_t>(wholes[k]) + j, levels.size() - 1)];
      lanes.width[k] = static_cast<float>(lanes.image[k]->width);
      lanes.height[k] = static_cast<float>(lanes.image[k]->height);
    }
    store(lanes.weight.data(), (j == 0 ? one - coarser : coarser) / count);
    for (float i = 0; i < most; ++i) {
      const PackReal at = (broadcast(i) + PackReal(0.5)) / count - PackReal(0.5);
      const PackTexels x(middle.x + axis.x * at, load(lanes.width.data()), wraps[0]);
      const PackTexels y(middle.y + axis.y * at, load(lanes.height.data()), wraps[1]);
      for (std::size_t k = 0; k < kLanes; ++k)
        if (i < counts[k] && lanes.weight[k] > 0) add_texels(lanes, x, y, k, linear, codes.linear.data(), sum);
    }
  }
  return {{load(sum[0].data()), load(sum[1].data()), load(sum[2].data())}, load(sum[3].data())};
}

}  // namespace

STERADIAN_END_ISA
