// Compiled if STERADIAN_VULKAN is OFF: there are no devices.
#include "device/frame/back_end.h"
#include "device/vulkan/device.h"
#include "steradian/error.h"

namespace steradian::vulkan {

std::vector<DeviceInfo> list_devices() { return {}; }

Picture render_on_device(const Scene&, const RenderOptions&, RenderCache*, RenderStats*, RenderState*) {
  throw Error("--backend vulkan", "this program was built without Vulkan", "build it with -DSTERADIAN_VULKAN=ON, as ./dev build does");
}

}  // namespace steradian::vulkan
