// Backdrops: filled shapes that leave no light in the picture if they block, as a page or a layer "Background" does. And lights that lie
// inside other occluders.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "steradian/plane.h"

namespace steradian::plane::svg {

struct Backdrop {
  std::size_t body;
  PlaneLeftOut::Why why;
};

// Returns those of the numbered bodies that cover the picture but for a thousandth of its larger side, or hold every light without
// touching its outline, in a scene without suns. `tolerance`: of the flattened outlines; `spend` receives the number of tested pairs of
// edges.
std::vector<Backdrop> backdrops_among(const PlaneScene& scene, const std::vector<std::size_t>& bodies, double tolerance,
                                      const std::function<void(std::uint64_t)>& spend);

struct BuriedLight {
  std::size_t light, occluder;  // numbers of bodies
};

// Lights whose outline lies inside occluders, of one or of several together, so that they light nothing. Glass and stones do not count,
// since they let light pass. The work is bounded: in a scene of very many lights and occluders, only some are tested.
std::vector<BuriedLight> buried_lights(const PlaneScene& scene, double tolerance);

}  // namespace steradian::plane::svg
