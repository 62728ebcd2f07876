// The CPU's back end of render.
#pragma once

#include "steradian/render.h"

namespace steradian {

// As render (steradian/render.h).
Picture render_on_cpu(const Scene& scene, const RenderOptions& options, RenderStats* stats, RenderState* state);

}  // namespace steradian
