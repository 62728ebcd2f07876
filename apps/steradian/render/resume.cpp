#include "render/resume.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

#include "steradian/error.h"
#include "steradian/picture.h"

namespace steradian::app {
namespace {

std::atomic<bool> stop_asked{false};
std::atomic<int> stop_signal{0};

void ask_to_stop(int number) {
  stop_signal = number;
  stop_asked = true;
  std::signal(number, SIG_DFL);
}

constexpr const char* kDone = "steradian.done";
constexpr const char* kIdentity = "steradian.identity";

}  // namespace

StopSignals::StopSignals() {
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
}
StopSignals::~StopSignals() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}
const std::atomic<bool>& StopSignals::asked() const { return stop_asked; }
void StopSignals::end_by_it() const {
  std::signal(stop_signal, SIG_DFL);
  std::raise(stop_signal);
  std::abort();
}

std::string partial_path(const std::string& output) { return output + ".partial.exr"; }

void write_state(const RenderState& state, const std::string& identity, const std::string& output) {
  Picture picture = state.picture;
  picture.metadata[kIdentity] = identity;
  std::string& done = picture.metadata[kDone];
  for (const std::uint8_t tile : state.done) done += tile != 0 ? '1' : '0';
  write_picture(picture, partial_path(output));
}

RenderState read_state(const std::string& identity, const std::string& output) {
  const std::string path = partial_path(output);
  RenderState state;
  if (!std::filesystem::exists(path)) return state;
  state.picture = read_picture(path);
  if (state.picture.metadata[kIdentity] != identity)
    throw Error(path, "was begun with another scene or other options", "give the same ones, or remove the file to begin anew");
  for (const char tile : state.picture.metadata[kDone]) state.done.push_back(tile == '1' ? 1 : 0);
  state.picture.metadata.clear();
  return state;
}

std::string fingerprint(const std::vector<std::string>& files, const Scene& scene) {
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a of 64 bits (Fowler, Noll, Vo)
  const auto add = [&](const auto& numbers) {
    for (const std::byte byte : std::as_bytes(std::span(numbers))) hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3u;
  };
  for (const std::string& file : files) {
    if (!std::filesystem::is_regular_file(file)) continue;
    std::ifstream stream(file, std::ios::binary);
    add(std::vector<char>(std::istreambuf_iterator<char>(stream), {}));
  }
  for (const Mesh& mesh : scene.meshes) {
    add(mesh.positions);
    add(mesh.indices);
  }
  for (const Image& image : scene.images) add(image.rgba);
  return fmt::format("{:016x}", hash);
}

}  // namespace steradian::app
