#include <filesystem>
#include <fstream>

#include "core/files.h"
#include "steradian/error.h"

namespace steradian {

Bytes read_file(const std::string& path, const std::string& place, Budget& budget) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw Error(place, "cannot find the file " + path, "check the path");
  if (!std::filesystem::is_regular_file(status)) throw Error(place, path + " is not a regular file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(place, "cannot read the file " + path, "check its permissions");
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw Error(place, "cannot read the file " + path);
  budget.take_memory(place, "the bytes of " + path, size);
  Bytes bytes(static_cast<std::size_t>(size));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (file.gcount() != static_cast<std::streamsize>(bytes.size())) throw Error(place, "the file " + path + " ended while it was read");
  return bytes;
}

void write_file(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace steradian
