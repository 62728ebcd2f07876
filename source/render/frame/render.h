// The CPU's back end of render.
#pragma once

#include "steradian/render_cache.h"

namespace steradian {

// Light of a picture that the CPU renders.
enum class LightOf {
  all_ways,
  bounces,  // of RenderOptions::bounces alone: another back end renders the rest
};

// The same as render (steradian/render.h). cache: null caches nothing.
Picture render_on_cpu(const Scene& scene, const RenderOptions& options, RenderCache* cache, RenderStats* stats, RenderState* state,
                      LightOf of = LightOf::all_ways);

}  // namespace steradian
