#include "render/bounce/receivers/filter.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/float_mode.h"

namespace steradian::indirect {
namespace {

// A box of `width` taps from -width / 2, convolved with a box of `second` taps about the middle.
void boxes(int width, int second, float (&taps)[2 * kFilterReach + 1]) {
  std::fill(std::begin(taps), std::end(taps), 0.0f);
  for (int a = 0; a < width; ++a)
    for (int b = 0; b < second; ++b) {
      const int tap = a - width / 2 + b - (second - 1) / 2;
      taps[tap + kFilterReach] += 1.0f / static_cast<float>(width * second);
    }
}

}  // namespace

FilterWeights filter_weights(int stride) {
  FilterWeights w;
  boxes(2 * stride, 2 * stride, w.diffuse);
  boxes(stride, stride, w.glossy);
  boxes(stride, 1, w.sharp);
  return w;
}

IncomingLight filter(const PictureSurfaces& surfaces, const FloatArray& width, int stride, const IncomingLight& light) {
  const Raster& raster = surfaces.raster;
  const FilterGeometry geometry{surfaces.position, surfaces.normal, width.data()};
  const FilterWeights weights = filter_weights(stride);
  const FilterTable& table = filter_table_for(active_simd());
  IncomingLight rows, result;
  for (IncomingLight* l : {&rows, &result}) {
    l->diffuse.resize(raster.size());
    l->glossy.resize(raster.size());
  }
  // Strips are so narrow that all rows that a tap can reach stay in the cache.
  constexpr int kStrip = 128, kRows = 64;
  const int across = (raster.width + kStrip - 1) / kStrip, down = (raster.height + kRows - 1) / kRows;
  const auto pass = [&](FilterAxis axis, const IncomingLight& from, IncomingLight& to) {
    tbb::parallel_for(0, across * down, [&](int i) {
      const FlushDenormals flush;
      const int x = i % across * kStrip, y = i / across * kRows;
      table.run(geometry, raster, weights, axis, x, std::min(x + kStrip, raster.width), y, std::min(y + kRows, raster.height), from, to);
    });
  };
  pass(FilterAxis::x, light, rows);
  pass(FilterAxis::y, rows, result);
  return result;
}

}  // namespace steradian::indirect
