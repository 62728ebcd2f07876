#include "render/bounce/receivers/filter.h"

#include <algorithm>

#include "render/bounce/receivers/arrays_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using indirect::kFilterReach;
using indirect::VectorArray;
using K = PackKernels;

struct FilterSums {
  PackVec3 diffuse{0.0, 0.0, 0.0}, shine{0.0, 0.0, 0.0};
  PackReal diffuse_weight{0.0}, shine_weight{0.0};
};

// Taps of one pack of pixels.
struct Taps {
  const indirect::FilterGeometry& g;
  const indirect::FilterWeights& weights;
  const indirect::IncomingLight& from;
  std::size_t i;
  std::ptrdiff_t step;
  int first, last;
  PackVec3 p, n;
  PackReal width;
  K::mask sharp;
  bool any_glossy;

  STERADIAN_INLINE FilterSums gather(const K::IndirectLikeness& like) const {
    const PackReal none(0.0), widths = width * like.widths;
    FilterSums s;
    for (int k = first; k <= last; ++k) {
      const float wd = weights.diffuse[k + kFilterReach];
      const std::size_t j = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + k * step);
      const auto same = K().indirect_same_surface(like, n, load_at(g.normal, j), load_at(g.position, j) - p);
      const PackReal w = select(same, broadcast(wd), none);
      s.diffuse = s.diffuse + load_at(from.diffuse, j) * w;
      s.diffuse_weight += w;
      if (!any_glossy || weights.glossy[k + kFilterReach] == 0) continue;  // the sharp lobes' reach is smaller
      const PackReal ws = select(sharp, broadcast(weights.sharp[k + kFilterReach]), broadcast(weights.glossy[k + kFilterReach]));
      const PackReal wg = select(same && abs(load(g.width + j) - width) < widths, ws, none);
      s.shine = s.shine + load_at(from.glossy, j) * wg;
      s.shine_weight += wg;
    }
    return s;
  }
};

__attribute__((flatten)) void run(const indirect::FilterGeometry& g, const indirect::Raster& raster, const indirect::FilterWeights& weights,
                                  indirect::FilterAxis axis, int begin, int end, int first, int last, const indirect::IncomingLight& from,
                                  indirect::IncomingLight& to) {
  const bool along_x = axis == indirect::FilterAxis::x;
  int reach_low = -kFilterReach, reach_high = kFilterReach;  // the diffuse taps are the widest
  while (weights.diffuse[reach_low + kFilterReach] == 0) ++reach_low;
  while (weights.diffuse[reach_high + kFilterReach] == 0) --reach_high;
  K k;
  const PackReal none(0.0), enough = k.indirect_enough();
  for (int y = first; y < last; ++y)
    for (int x = begin; x < end; x += static_cast<int>(kLanes)) {
      const std::size_t i = raster.at(x, y);
      const PackVec3 n = load_at(g.normal, i);
      const auto there = dot(n, n) > none;
      if (!any_lane(there)) continue;
      const PackReal width = load(g.width + i);
      const auto glossy = width > none;
      const int low = along_x ? reach_low : std::max(reach_low, -y),
                high = along_x ? reach_high : std::min(reach_high, raster.height - 1 - y);
      const Taps taps{g,
                      weights,
                      from,
                      i,
                      along_x ? 1 : raster.pitch(),
                      low,
                      high,
                      load_at(g.position, i),
                      n,
                      width,
                      glossy && width < k.indirect_sharp(),
                      any_lane(glossy)};
      const FilterSums same = taps.gather(k.indirect_alike());
      PackVec3 diffuse = k.indirect_over(same.diffuse, same.diffuse_weight), shine = k.indirect_over(same.shine, same.shine_weight);
      if (any_lane(there && (same.diffuse_weight < enough || (glossy && same.shine_weight < enough)))) {
        const FilterSums loose = taps.gather(k.indirect_alike_loosely());
        diffuse = k.indirect_filtered(same.diffuse, same.diffuse_weight, loose.diffuse, loose.diffuse_weight);
        shine = k.indirect_filtered(same.shine, same.shine_weight, loose.shine, loose.shine_weight);
      }
      store_at(to.diffuse, i, diffuse);
      store_at(to.glossy, i, shine);
    }
}

}  // namespace

const indirect::FilterTable& filter_table() {
  static constexpr indirect::FilterTable table = {run};
  return table;
}

STERADIAN_END_ISA
