// Compiled if STERADIAN_VULKAN is OFF: the plane has no device.
#include "device/plane/plane_device.h"
#include "steradian/error.h"
#include "steradian/plane_device.h"

namespace steradian {

struct PlaneDevice::Impl {
  std::string name;
  PlaneDeviceStats stats;
};

PlaneDevice::PlaneDevice(const std::string&) {
  throw Error("--backend vulkan", "this program was built without Vulkan", "build it with -DSTERADIAN_VULKAN=ON, as ./dev build does");
}
PlaneDevice::PlaneDevice(std::shared_ptr<const vulkan::Device>) : PlaneDevice(std::string()) {}
PlaneDevice::~PlaneDevice() = default;
PlaneDevice::PlaneDevice(PlaneDevice&&) noexcept = default;
PlaneDevice& PlaneDevice::operator=(PlaneDevice&&) noexcept = default;

// No object exists, so nothing calls these.
const std::string& PlaneDevice::name() const { return impl_->name; }
const PlaneDeviceStats& PlaneDevice::stats() const { return impl_->stats; }
Picture PlaneDevice::render(const PlaneWorld&, const PlaneFrameOptions&, PlaneFrameStats*) { return {}; }
void PlaneDevice::render_into(Picture&, const PlaneWorld&, const PlaneFrameOptions&, PlaneFrameStats*) {}

std::vector<vulkan::PipelineReport> plane::compile_picture(const PlaneWorld&, const PlaneFrameOptions&, const std::string& device) {
  const PlaneDevice none(device);  // throws
  return {};
}

}  // namespace steradian
