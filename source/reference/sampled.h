// Monte Carlo integration with occluders.
#pragma once

#include <functional>

#include "steradian/area_light.h"
#include "steradian/reference.h"

namespace steradian::reference {

// sees: returns true if a unit direction of the world meets the light unblocked.
SampledResult sampled_radiance_past(const std::function<bool(Vec3d)>& sees, const PreparedPolygon& light, const ShadingPoint& at,
                                    const Material& material, const SampledOptions& options);

// The same for a disk, an ellipsoid or a tube, on its true surface. open: returns true if nothing blocks the way along a vector from the
// point.
SampledResult sampled_on_surface(const std::function<bool(Vec3d)>& open, const AreaLight& light, const ShadingPoint& at,
                                 const Material& material, const SampledOptions& options);

}  // namespace steradian::reference
