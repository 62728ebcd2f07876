#include "device/vulkan/picture2d.h"

namespace steradian::vulkan {

Picture2d make_picture(const Device::Handles& d, vk::Extent2D size, vk::Format format, vk::ImageUsageFlags usage,
                       vk::ImageAspectFlags aspect) {
  Picture2d p;
  const vk::Extent3D extent(size, 1);
  p.image =
      d.device.createImage({{}, vk::ImageType::e2D, format, extent, 1, 1, vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, usage});
  const auto needed = p.image.getMemoryRequirements();
  const auto types = d.physical.getMemoryProperties();
  std::uint32_t type = 0;
  while (type < types.memoryTypeCount &&
         ((needed.memoryTypeBits >> type & 1u) == 0 || !(types.memoryTypes[type].propertyFlags & vk::MemoryPropertyFlagBits::eDeviceLocal)))
    ++type;
  if (type == types.memoryTypeCount) throw Error("Vulkan", "the device has no memory for pictures");
  p.memory = d.allocate({needed.size, type});
  p.image.bindMemory(*p.memory, 0);
  p.view = d.device.createImageView({{}, *p.image, vk::ImageViewType::e2D, format, {}, {aspect, 0, 1, 0, 1}});
  return p;
}

}  // namespace steradian::vulkan
