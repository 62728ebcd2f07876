// The filter that joins the light of a pattern's pixels. It is separable and runs along surfaces only.
#pragma once

#include "core/simd.h"
#include "render/bounce/receivers/receivers.h"

namespace steradian::indirect {

// Surface data in which taps must agree. Planes of the raster.
struct FilterGeometry {
  const VectorArray& position;
  const VectorArray& normal;
  const float* width;  // alpha of the glossy lobe, -1 without one
};

// Weights of taps -kFilterReach .. kFilterReach.
inline constexpr int kFilterReach = 16;
struct FilterWeights {
  float diffuse[2 * kFilterReach + 1];
  float glossy[2 * kFilterReach + 1];  // for lobes that are not sharp
  float sharp[2 * kFilterReach + 1];   // for sharp lobes: the pattern itself
};
// Each filter is a box as wide as the pattern, convolved with another box. All places of the pattern then weigh the same.
FilterWeights filter_weights(int stride);

enum class FilterAxis { x, y };

struct FilterTable {
  // Filters rows [first, last) of columns [begin, end) along one axis; begin is a multiple of 16.
  void (*run)(const FilterGeometry& geometry, const Raster& raster, const FilterWeights& weights, FilterAxis axis, int begin, int end,
              int first, int last, const IncomingLight& from, IncomingLight& to);
};

IncomingLight filter(const PictureSurfaces& surfaces, const FloatArray& width, int stride, const IncomingLight& light);

}  // namespace steradian::indirect

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(indirect::FilterTable, filter_table)
}
