#include "device/vulkan/buffer.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "core/budget.h"
#include "device/vulkan/buffer_handles.h"

namespace steradian::vulkan {
namespace {

std::optional<std::uint32_t> memory_type(const vk::raii::PhysicalDevice& device, std::uint32_t allowed, vk::MemoryPropertyFlags wanted) {
  const auto properties = device.getMemoryProperties();
  for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i)
    if ((allowed >> i & 1u) != 0 && (properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  return {};
}

// Type of memory that the host can map, of the kind that suits the use if there is one.
std::uint32_t memory_type_for(const vk::raii::PhysicalDevice& device, std::uint32_t allowed, BufferUse use) {
  using Flag = vk::MemoryPropertyFlagBits;
  const vk::MemoryPropertyFlags needed = Flag::eHostVisible | Flag::eHostCoherent;
  if (const auto best = memory_type(device, allowed, needed | (use == BufferUse::host_reads ? Flag::eHostCached : Flag::eDeviceLocal)))
    return *best;
  if (const auto any = memory_type(device, allowed, needed)) return *any;
  throw Error("Vulkan", "the device has no memory that the host can read");
}

void check_size(std::size_t bytes, std::size_t available) {
  if (bytes > available) throw Error("Vulkan", std::to_string(bytes) + " bytes do not fit a buffer of " + std::to_string(available));
}

}  // namespace

Buffer::Buffer(const Device& device, std::size_t bytes, BufferUse use, BufferForm form)
    : bytes_(bytes), handles_(std::make_unique<Handles>()) {
  checked(device, "make a buffer of " + readable_bytes(bytes), [&] {
    const Device::Handles& d = device.handles();
    Handles& h = *handles_;
    h.device = &d;
    if (device.only_compiles()) {
      h.only_host.resize(bytes);
      h.mapped = h.only_host.data();
      return;
    }
    using Usage = vk::BufferUsageFlagBits;
    vk::BufferUsageFlags usage =
        Usage::eStorageBuffer | Usage::eTransferSrc | Usage::eTransferDst | Usage::eIndirectBuffer | Usage::eVertexBuffer;
    if (form != BufferForm::storage) usage |= Usage::eUniformTexelBuffer;
    h.buffer = d.device.createBuffer({{}, bytes, usage});
    const auto needed = h.buffer.getMemoryRequirements();
    h.memory = d.allocate({needed.size, memory_type_for(d.physical, needed.memoryTypeBits, use)});
    h.buffer.bindMemory(*h.memory, 0);
    h.mapped = h.memory.mapMemory(0, bytes);
    if (form == BufferForm::storage) return;
    const vk::Format format = form == BufferForm::texels ? vk::Format::eR32G32B32A32Sfloat : vk::Format::eR8G8B8A8Unorm;
    h.texels = d.device.createBufferView({{}, *h.buffer, format, 0, VK_WHOLE_SIZE});
  });
}

Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  std::swap(handles_, other.handles_);
  return *this;
}
Buffer::~Buffer() {
  if (handles_ != nullptr && handles_->device != nullptr) handles_->device->leave(handles_);
}

void Buffer::write(const void* data, std::size_t bytes) {
  check_size(bytes, bytes_);
  std::memcpy(handles_->mapped, data, bytes);
}

void Buffer::read(void* data, std::size_t bytes) const {
  check_size(bytes, bytes_);
  std::memcpy(data, handles_->mapped, bytes);
}

void* Buffer::mapped() const { return handles_->mapped; }

std::size_t KeptBuffer::most() const {
  const DeviceInfo& device = device_.info();
  if (form_ == BufferForm::storage) return device.storage_buffer;
  const std::size_t texel = (form_ == BufferForm::texels ? 4 : 1) * sizeof(float);
  return std::min(device.storage_buffer, device.texel_buffer * texel);
}

Buffer& KeptBuffer::fit_with_room(std::size_t bytes, const std::string& what, const std::string& advice) {
  if (bytes > most())
    throw Error("Vulkan device '" + device_.info().name + "'",
                what + " take " + readable_bytes(bytes) + ", more than the " + readable_bytes(most()) + " of a buffer", advice);
  return grow(bytes, std::min(bytes + bytes / 2, most()));
}

Buffer& KeptBuffer::grow(std::size_t bytes, std::size_t room) {
  constexpr std::size_t kLeast = 256;  // no buffer is empty
  if (!buffer_ || buffer_->bytes() < bytes) {
    buffer_.reset();  // there may be no memory for both
    held_.reset();
    buffer_.emplace(device_, std::max(room, kLeast), use_, form_);
  }
  return *buffer_;
}

Buffer& KeptBuffer::hold(const void* data, std::size_t bytes) {
  const Fingerprint wanted = fingerprint(data, bytes);
  if (held_ != wanted) {
    fit(bytes);
    held_.reset();
    if (bytes > 0) buffer_->write(data, bytes);
    held_ = wanted;
  }
  return *buffer_;
}

}  // namespace steradian::vulkan
