#include "device/vulkan/kept_buffer.h"

#include <algorithm>

namespace steradian::vulkan {

Buffer& KeptBuffer::fit_with_room(std::size_t bytes, std::size_t most) {
  constexpr std::size_t kLeast = 256;  // no buffer is empty
  if (!buffer_ || buffer_->bytes() < bytes) {
    buffer_.reset();  // there may be no memory for both
    held_.reset();
    buffer_.emplace(device_, std::max({bytes, std::min(bytes + bytes / 2, most), kLeast}), use_, form_);
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
