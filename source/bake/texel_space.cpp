#include <algorithm>
#include <cmath>
#include <utility>

#include "bake/fit_space.h"

namespace steradian::bake {
namespace {

// Weight of a seam's two sides over that of light. A larger one makes seams smaller and the fit beside them worse.
constexpr double kSeam = 100;

Vec2d place_on(const std::array<Vec2d, 2>& ends, double t) { return ends[0] + (ends[1] - ends[0]) * t; }

}  // namespace

Vec3d shown_at(const std::vector<Vec3f>& texels, int width, Vec2d at) {
  const int height = static_cast<int>(texels.size() / static_cast<std::size_t>(width));
  const double x = std::clamp(at.x - 0.5, 0.0, width - 1.0), y = std::clamp(at.y - 0.5, 0.0, height - 1.0);
  const int i = std::min(static_cast<int>(x), width - 2), j = std::min(static_cast<int>(y), height - 2);
  const double fx = x - i, fy = y - j;
  const auto texel = [&](int a, int b) {
    return static_cast<Vec3d>(texels[static_cast<std::size_t>(b) * static_cast<std::size_t>(width) + static_cast<std::size_t>(a)]);
  };
  return (texel(i, j) * (1 - fx) + texel(i + 1, j) * fx) * (1 - fy) + (texel(i, j + 1) * (1 - fx) + texel(i + 1, j + 1) * fx) * fy;
}

TexelSpace::TexelSpace(const std::vector<Chart>& charts, std::vector<std::uint32_t> group, std::vector<const Seam*> seams, double texel,
                       MapTexels& map)
    : charts_(charts), group_(std::move(group)), seams_(std::move(seams)), texel_(texel), map_(map) {
  for (const std::uint32_t c : group_) {
    first_.emplace_back(c, count_);
    count_ += static_cast<std::size_t>(charts[c].width) * static_cast<std::size_t>(charts[c].height);
  }
}

std::uint32_t TexelSpace::of(std::uint32_t chart, int x, int y) const {
  const auto at = std::lower_bound(first_.begin(), first_.end(), std::pair(chart, std::size_t{0}));
  return static_cast<std::uint32_t>(at->second + static_cast<std::size_t>(y) * static_cast<std::size_t>(charts_[chart].width) +
                                    static_cast<std::size_t>(x));
}

std::array<Hat, 4> TexelSpace::at(std::uint32_t chart, Vec2d p) const {
  const Chart& c = charts_[chart];
  const double x = std::clamp(p.x - 0.5 - c.x, 0.0, c.width - 1.0), y = std::clamp(p.y - 0.5 - c.y, 0.0, c.height - 1.0);
  const int i = std::min(static_cast<int>(x), c.width - 2), j = std::min(static_cast<int>(y), c.height - 2);
  const double fx = x - i, fy = y - j;
  const std::uint32_t first = of(chart, i, j), below = first + static_cast<std::uint32_t>(c.width);
  return {{{first, (1 - fx) * (1 - fy)}, {first + 1, fx * (1 - fy)}, {below, (1 - fx) * fy}, {below + 1, fx * fy}}};
}

std::array<Hat, 8> TexelSpace::difference(const Seam& seam, double t) const {
  std::array<Hat, 8> hats;
  const auto one = at(seam.chart[0], place_on(seam.ends[0], t)), other = at(seam.chart[1], place_on(seam.ends[1], t));
  for (std::size_t i = 0; i < 4; ++i) {
    hats[i] = one[i];
    hats[4 + i] = {other[i].unknown, -other[i].value};
  }
  return hats;
}

// Eight places a texel of the longer side: enough for every piece of the blends between two texels.
int TexelSpace::places_on(const Seam& seam) {
  const double texels = std::max(length(seam.ends[0][1] - seam.ends[0][0]), length(seam.ends[1][1] - seam.ends[1][0]));
  return std::max(3, static_cast<int>(std::ceil(8 * texels)) + 1);
}

void TexelSpace::add_conditions(HatFit& fit) const {
  for (const std::uint32_t c : group_) {
    const Chart& chart = charts_[c];
    const auto smooth = [&](int x, int y, int x1, int y1) {
      const Hat pair[2] = {{of(c, x, y), 1}, {of(c, x1, y1), -1}};
      fit.add_zero(pair, kSmooth * texel_ * texel_);
    };
    for (int y = 0; y < chart.height; ++y)
      for (int x = 0; x < chart.width; ++x) {
        if (x + 1 < chart.width) smooth(x, y, x + 1, y);
        if (y + 1 < chart.height) smooth(x, y, x, y + 1);
      }
  }
  for (const Seam* seam : seams_) {
    const int places = places_on(*seam);
    for (int k = 0; k < places; ++k) fit.add_zero(difference(*seam, k / (places - 1.0)), kSeam * texel_ * seam->length / places);
  }
}

void TexelSpace::store(const std::vector<Vec3d>& values, const std::vector<Vec3d>& errors) const {
  for (const std::uint32_t c : group_) {
    const Chart& chart = charts_[c];
    for (int y = 0; y < chart.height; ++y)
      for (int x = 0; x < chart.width; ++x) {
        const auto to =
            static_cast<std::size_t>(chart.y + y) * static_cast<std::size_t>(map_.width) + static_cast<std::size_t>(chart.x + x);
        map_.irradiance[to] = static_cast<Vec3f>(values[of(c, x, y)]);
        map_.error[to] = static_cast<Vec3f>(errors[of(c, x, y)]);
      }
  }
}

}  // namespace steradian::bake
