// NPZ: named arrays in an uncompressed ZIP, as numpy.savez writes and numpy.load reads them.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/budget.h"

namespace steradian::exchange {

// One array to write: its type in NumPy's words ("<f8", "<i4", "|S3"), its sizes (none: a scalar) and its bytes in pieces.
struct NpyArray {
  std::string name, type;
  std::vector<std::uint64_t> shape;
  std::vector<std::string_view> pieces;
};

// Writes all arrays to a file, whole or not at all.
void write_npz(const std::string& path, const std::vector<NpyArray>& arrays);

// An array that was read. The bytes are those of the file.
struct ReadArray {
  std::string type;
  std::vector<std::uint64_t> shape;
  std::string_view bytes;

  std::uint64_t count() const;
};

// The arrays of a file that this program or numpy.savez wrote, uncompressed and in C order.
class NpzFile {
 public:
  NpzFile(const std::string& path, Budget& budget);
  // Throws Error if the file has no such array or its type is another one.
  const ReadArray& array(const std::string& name, const std::string& type) const;
  bool has(const std::string& name) const { return arrays_.count(name) > 0; }
  template <class T>
  std::vector<T> values(const std::string& name, const std::string& type) const {
    const ReadArray& a = array(name, type);
    std::vector<T> result(a.bytes.size() / sizeof(T));
    copy_bytes(a.bytes, result.data());
    return result;
  }
  const std::string& path() const { return path_; }

 private:
  static void copy_bytes(std::string_view bytes, void* to);
  [[noreturn]] void fail(const std::string& problem) const;
  void read_array(const std::string& name, std::string_view npy);

  std::string path_;
  std::vector<std::uint8_t> file_;
  std::map<std::string, ReadArray> arrays_;
};

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace steradian::exchange
