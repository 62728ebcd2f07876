// The Vulkan back end, as seen by the renderer.
#pragma once

#include <vector>

#include "device/vulkan/pipeline_report.h"
#include "steradian/render_cache.h"

namespace steradian::vulkan {

// Renders a picture on a Vulkan device, as render() does. `cache` and `stats` may be null. Throws Error if there is no device, or if the
// program was built without Vulkan.
Picture render_on_device(const Scene& scene, const RenderOptions& options, RenderCache* cache, RenderStats* stats, RenderState* state);

// The pipelines that a device makes for a picture, and their work. The device runs nothing: the host answers in its place. Throws Error as
// render_on_device does, and UsageError for pictures that no device renders.
std::vector<PipelineReport> compile_picture(const Scene& scene, const RenderOptions& options);

}  // namespace steradian::vulkan
