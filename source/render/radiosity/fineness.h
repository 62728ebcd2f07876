// Fineness: the number of patches, rays and directions by which the light between surfaces is computed.
#pragma once

#include <cstddef>

#include "steradian/render.h"

namespace steradian::radiosity {

// Difference of a rough solid's true lobe from the one that stands for it, over that, rms over the lobe: the spread of the light in the
// lobe times this is an error of its light. Rough balls and slabs against paths are within it up to the roughness 0.5 (docs/glass.md).
inline constexpr float kShapeOfSolids = 0.5f;

struct Fineness {
  std::size_t patches;      // of the whole scene, if its triangles are large
  std::size_t rays;         // of each side
  std::size_t shadow_rays;  // of each patch to each light; 0: exact shadows
  int rows;                 // of a pixel's directions over the sphere, even; there are twice as many columns
  std::size_t lobe_rays;    // of a glossy lobe
  std::size_t bright;       // places on bright sides, of which a pixel takes one in sixteen
  bool every_other;         // in planes, one pixel of 2 x 2 gathers
};

inline Fineness fineness_of(Quality quality) {
  switch (quality) {
    case Quality::draft: return {8'000, 64, 16, 12, 64, 1024, false};
    case Quality::high: return {120'000, 256, 0, 32, 64, 1024, false};
    case Quality::normal: break;
  }
  return {40'000, 64, 16, 12, 64, 1024, false};
}

inline Fineness fineness_of(const RenderOptions& options) {
  return options.bounce_preview ? Fineness{2'000, 32, 16, 4, 16, 256, true} : fineness_of(options.quality);
}

}  // namespace steradian::radiosity
