// A long render that may be interrupted. Its state is stored beside its output, and --resume continues from it.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "steradian/render.h"

namespace steradian::app {

// While an object exists, SIGINT and SIGTERM request a stop. A second signal ends the program as usual.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  const std::atomic<bool>& asked() const;
  [[noreturn]] void end_by_it() const;  // ends as a program without a handler for the signal
};

// The path of the partial result: a viewable picture whose metadata lists the finished tiles.
std::string partial_path(const std::string& output);

// identity: describes everything that the picture depends on; a state with another identity is refused.
void write_state(const RenderState& state, const std::string& identity, const std::string& output);
RenderState read_state(const std::string& identity, const std::string& output);  // an empty state if there is none

// A text that distinguishes scenes. It covers the bytes of the scene's files, except names that are no file, and the meshes and pictures
// taken from other files.
std::string fingerprint(const std::vector<std::string>& files, const Scene& scene);

}  // namespace steradian::app
