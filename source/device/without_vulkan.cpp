// Compiled if STERADIAN_VULKAN is OFF: there are no devices.
#include "device/frame/back_end.h"
#include "device/vulkan/device.h"
#include "steradian/error.h"

namespace steradian::vulkan {

std::vector<DeviceInfo> list_devices() { return {}; }

namespace {

[[noreturn]] void refuse(const char* option) {
  throw Error(option, "this program was built without Vulkan", "build it with -DSTERADIAN_VULKAN=ON, as ./dev build does");
}

}  // namespace

Picture render_on_device(const Scene&, const RenderOptions&, RenderCache*, RenderStats*, RenderState*) { refuse("--backend vulkan"); }

std::vector<PipelineReport> compile_picture(const Scene&, const RenderOptions&) { refuse("--pipelines"); }

}  // namespace steradian::vulkan
