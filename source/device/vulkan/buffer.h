// Buffers of a device: Buffer, and KeptBuffer, which stays from picture to picture.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/fingerprint.h"
#include "device/vulkan/device.h"

namespace steradian::vulkan {

// A buffer that both the host and shaders read and write.

// Main use by the host: memory near the device is slow for the host to read.
enum class BufferUse { host_writes, host_reads };

// Form in which shaders read it: a storage buffer, or also texels of four floats or four bytes (0 to 1), which devices fetch in one go.
enum class BufferForm { storage, texels, colors };

class Buffer {
 public:
  // Throws Error with the number of bytes that the device does not have.
  Buffer(const Device& device, std::size_t bytes, BufferUse use = BufferUse::host_reads, BufferForm form = BufferForm::storage);
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;
  ~Buffer();

  std::size_t bytes() const { return bytes_; }
  void write(const void* data, std::size_t bytes);
  void read(void* data, std::size_t bytes) const;
  void* mapped() const;  // all of it, as long as the buffer lives

  struct Handles;
  const Handles& handles() const { return *handles_; }

 private:
  std::size_t bytes_;
  std::unique_ptr<Handles> handles_;
};

// A buffer that stays from picture to picture: it grows on demand, and knows its contents.

class KeptBuffer {
 public:
  // The device must outlive this object. Nothing is allocated yet.
  explicit KeptBuffer(const Device& device, BufferUse use = BufferUse::host_writes, BufferForm form = BufferForm::storage)
      : device_(device), use_(use), form_(form) {}

  // Grows to at least `bytes`. Growing discards the contents. fit_with_room is for sizes that differ from picture to picture. It grows to
  // half as much again, as far as most() allows, so that the following pictures need no growth. Throws Error if `bytes` exceed most().
  Buffer& fit(std::size_t bytes) { return grow(bytes, bytes); }
  Buffer& fit_with_room(std::size_t bytes, const std::string& what, const std::string& advice = "use --backend cpu");
  // Bytes of the largest buffer that shaders of the device read in this form.
  std::size_t most() const;
  // Makes the buffer hold these bytes; writes them only if it holds others.
  Buffer& hold(const void* data, std::size_t bytes);
  template <class Value>
  Buffer& hold(const std::vector<Value>& values) {
    return hold(values.data(), values.size() * sizeof(Value));
  }

  bool is_made() const { return buffer_.has_value(); }
  // Valid once allocated. Writes through these references are not tracked.
  Buffer& get() { return *buffer_; }
  const Buffer& get() const { return *buffer_; }

 private:
  Buffer& grow(std::size_t bytes, std::size_t room);

  const Device& device_;
  const BufferUse use_;
  const BufferForm form_;
  std::optional<Buffer> buffer_;
  std::optional<Fingerprint> held_;
};

}  // namespace steradian::vulkan
