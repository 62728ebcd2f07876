// The Vulkan back end as the renderer sees it.
#pragma once

#include "steradian/render_cache.h"

namespace steradian::vulkan {

// Renders a picture on a Vulkan device, as render() does. `cache` and `stats` may be null. Throws Error where there is no device, and where
// the program was built without Vulkan.
Picture render_on_device(const Scene& scene, const RenderOptions& options, RenderCache* cache, RenderStats* stats, RenderState* state);

}  // namespace steradian::vulkan
