// The CPU's back end of render.
#pragma once

#include "steradian/render_cache.h"

namespace steradian {

// The same as render (steradian/render.h). cache: null caches nothing.
Picture render_on_cpu(const Scene& scene, const RenderOptions& options, RenderCache* cache, RenderStats* stats, RenderState* state);

}  // namespace steradian
