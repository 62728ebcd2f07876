// A buffer that stays from picture to picture: it grows where one needs more room, and knows what it holds.
#pragma once

#include <optional>
#include <span>

#include "core/fingerprint.h"
#include "render/vulkan/buffer.h"

namespace steradian::vulkan {

class KeptBuffer {
 public:
  // The device must stay. Nothing is made yet.
  explicit KeptBuffer(const Device& device, BufferUse use = BufferUse::host_writes, BufferForm form = BufferForm::storage)
      : device_(device), use_(use), form_(form) {}

  // At least so many bytes; what it held is lost where it must be made anew. with_room, for what is not the same from picture to picture:
  // then half as much again, at most `most` bytes, so that pictures that follow find it.
  Buffer& fit(std::size_t bytes) { return fit_with_room(bytes, bytes); }
  Buffer& fit_with_room(std::size_t bytes, std::size_t most);
  // Holds these bytes: written where it holds others.
  Buffer& hold(const void* data, std::size_t bytes);
  template <class Value>
  Buffer& hold(const std::vector<Value>& values) {
    return hold(values.data(), values.size() * sizeof(Value));
  }

  bool is_made() const { return buffer_.has_value(); }
  // Once made. What is written by the way of these is not what it knows of.
  Buffer& get() { return *buffer_; }
  const Buffer& get() const { return *buffer_; }

 private:
  const Device& device_;
  const BufferUse use_;
  const BufferForm form_;
  std::optional<Buffer> buffer_;
  std::optional<Fingerprint> held_;
};

}  // namespace steradian::vulkan
