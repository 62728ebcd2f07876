#include "core/cache_file.h"

#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string_view>

#include "core/files.h"
#include "core/fingerprint.h"

namespace steradian {
namespace {

constexpr std::string_view kMagic = "steradian cache 1\n";
constexpr std::size_t kMostBytes = std::size_t{256} << 20;  // a larger file is ignored, and so starts anew

const char* value_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

std::string folder(const char* variable) {
  if (const char* given = std::getenv(variable)) return given;
  if (const char* caches = value_of("XDG_CACHE_HOME")) return std::string(caches) + "/steradian";
  if (const char* home = value_of("HOME")) return std::string(home) + "/.cache/steradian";
  return {};
}

// Identifies key and bytes. The file begins with kMagic and this number.
Fingerprint seal(const std::string& key, std::span<const char> bytes) {
  const Fingerprint both[] = {fingerprint(key.data(), key.size()), fingerprint(bytes)};
  return fingerprint(both, sizeof both);
}

}  // namespace

std::string cache_file(const char* variable, const std::string& name) {
  const std::string in = folder(variable);
  return in.empty() ? in : in + "/" + name;
}

std::vector<char> read_cache_file(const std::string& path, const std::string& key) {
  try {
    Limits limits;
    limits.memory = kMostBytes;
    Budget budget(limits);
    const Bytes bytes = read_file(path, path, budget);
    const std::size_t head = kMagic.size() + sizeof(Fingerprint);
    if (bytes.size() < head || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) return {};
    std::vector<char> contents(bytes.begin() + static_cast<std::ptrdiff_t>(head), bytes.end());
    Fingerprint stored = 0;
    std::memcpy(&stored, bytes.data() + kMagic.size(), sizeof stored);
    return stored == seal(key, contents) ? contents : std::vector<char>{};
  } catch (const std::exception&) {
    return {};
  }
}

void write_cache_file(const std::string& path, const std::string& key, std::span<const char> bytes) noexcept {
  try {
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    const Fingerprint number = seal(key, bytes);
    std::string text(kMagic);
    text.append(reinterpret_cast<const char*>(&number), sizeof number);
    text.append(bytes.data(), bytes.size());
    write_file(path, text);
  } catch (const std::exception&) {
  }
}

}  // namespace steradian
