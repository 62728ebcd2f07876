// Monte Carlo integration with occluders.
#pragma once

#include <functional>

#include "steradian/reference.h"

namespace steradian::reference {

// sees: returns true if a unit direction of the world meets the light unblocked.
SampledResult sampled_radiance_past(const std::function<bool(Vec3d)>& sees, const PreparedPolygon& light, const ShadingPoint& at,
                                    const Material& material, const SampledOptions& options);

}  // namespace steradian::reference
