// The filter that joins what the pixels of a pattern found: separable, along surfaces only.
#pragma once

#include "core/simd.h"
#include "render/indirect/receivers.h"

namespace steradian::indirect {

// What a tap must agree in. Planes of the raster.
struct FilterGeometry {
  const VectorArray& position;
  const VectorArray& normal;
  const float* width;  // alpha of the glossy lobe, -1 without one
};

// Weights of taps -kReach .. kReach.
inline constexpr int kFilterReach = 16;
struct FilterWeights {
  float diffuse[2 * kFilterReach + 1];
  float glossy[2 * kFilterReach + 1];  // where the lobe is not sharp
  float sharp[2 * kFilterReach + 1];   // where it is: the pattern itself
};
// Each is a box as wide as the pattern, convolved with another: all places of the pattern weigh the same.
FilterWeights filter_weights(int stride);

enum class FilterAxis { x, y };

struct FilterTable {
  // Filters rows [first, last) of columns [begin, end) along one axis; begin is a multiple of 16.
  void (*run)(const FilterGeometry& geometry, const Raster& raster, const FilterWeights& weights, FilterAxis axis, int begin, int end,
              int first, int last, const Light& from, Light& to);
};

Light filter(const FrameSurfaces& surfaces, const FloatArray& width, int stride, const Light& light);

}  // namespace steradian::indirect

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(indirect::FilterTable, filter_table)
}
