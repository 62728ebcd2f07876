// The Vulkan back end, as seen by the renderer.
#pragma once

#include "steradian/render_cache.h"

namespace steradian::vulkan {

// Renders a picture on a Vulkan device, as render() does. `cache` and `stats` may be null. Throws Error if there is no device, or if the
// program was built without Vulkan.
Picture render_on_device(const Scene& scene, const RenderOptions& options, RenderCache* cache, RenderStats* stats, RenderState* state);

}  // namespace steradian::vulkan
