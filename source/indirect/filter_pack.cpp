#include "indirect/filter.h"

#include "core/pack.h"

STERADIAN_BEGIN_ISA
namespace {

using indirect::kFilterReach;
using indirect::VectorArray;

// A tap belongs to the same surface where normals differ by less than 26 degrees and it lies within a twentieth of its
// distance of the plane; a hundredth of a millimetre is rounding.
constexpr double kLeastCosine = 0.9, kSlope = 0.05, kRounding = 1e-5;
// Glossy light of lobes that differ in width by more than this share is not the same light.
constexpr double kWidths = 0.2;

STERADIAN_INLINE PackVec3 load_at(const VectorArray& a, std::size_t i) {
  return {load(a.x.data() + i), load(a.y.data() + i), load(a.z.data() + i)};
}
STERADIAN_INLINE void store_at(VectorArray& a, std::size_t i, const PackVec3& v) {
  store(a.x.data() + i, v.x);
  store(a.y.data() + i, v.y);
  store(a.z.data() + i, v.z);
}

__attribute__((flatten)) void run(const indirect::FilterGeometry& g, const indirect::Raster& raster,
                                  const indirect::FilterWeights& weights, indirect::FilterAxis axis, int begin, int end, int first,
                                  int last, const indirect::Light& from, indirect::Light& to) {
  const bool along_x = axis == indirect::FilterAxis::x;
  const std::ptrdiff_t step = along_x ? 1 : raster.pitch();
  const PackReal none(0.0);
  for (int y = first; y < last; ++y)
    for (int x = begin; x < end; x += static_cast<int>(kLanes)) {
      const std::size_t i = raster.at(x, y);
      const PackVec3 p = load_at(g.position, i), n = load_at(g.normal, i);
      if (!any_lane(dot(n, n) > none)) continue;
      const PackReal width = load(g.width + i);
      const auto glossy = width > none, sharp = glossy && width < PackReal(0.1);
      const bool any_glossy = any_lane(glossy);
      PackVec3 diffuse(0.0, 0.0, 0.0), shine(0.0, 0.0, 0.0);
      PackReal diffuse_sum(0.0), shine_sum(0.0);
      for (int k = -kFilterReach; k <= kFilterReach; ++k) {
        const float wd = weights.diffuse[k + kFilterReach];
        if (wd == 0) continue;  // the widest
        if (!along_x && (y + k < 0 || y + k >= raster.height)) continue;
        const std::size_t j = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + k * step);
        const PackVec3 m = load_at(g.normal, j), d = load_at(g.position, j) - p;
        const PackReal off = dot(n, d);
        const auto same = dot(n, m) > PackReal(kLeastCosine) &&
                          off * off < dot(d, d) * PackReal(kSlope * kSlope) + PackReal(kRounding * kRounding);
        const PackReal w = select(same, broadcast(wd), none);
        diffuse = diffuse + load_at(from.diffuse, j) * w;
        diffuse_sum += w;
        if (!any_glossy) continue;
        const PackReal ws = select(sharp, broadcast(weights.sharp[k + kFilterReach]), broadcast(weights.glossy[k + kFilterReach]));
        const PackReal wg = select(same && abs(load(g.width + j) - width) < width * PackReal(kWidths), ws, none);
        shine = shine + load_at(from.glossy, j) * wg;
        shine_sum += wg;
      }
      const auto mean = [&](const PackVec3& sum, PackReal weight) { return sum * (PackReal(1.0) / max(weight, PackReal(1e-12))); };
      store_at(to.diffuse, i, mean(diffuse, diffuse_sum));
      store_at(to.glossy, i, mean(shine, shine_sum));
    }
}

}  // namespace

const indirect::FilterTable& filter_table() {
  static constexpr indirect::FilterTable table = {run};
  return table;
}

STERADIAN_END_ISA
