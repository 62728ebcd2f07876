// A long render that may be interrupted: what it has is kept beside its output, and --resume goes on with it.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "steradian/render.h"

namespace steradian::app {

// While one lives, SIGINT and SIGTERM ask to stop; a second one ends the program as ever.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  const std::atomic<bool>& asked() const;
  [[noreturn]] void end_by_it() const;  // the way of a program that does not handle the signal
};

// The file of what is done: a picture to look at, whose metadata says which tiles are done.
std::string partial_path(const std::string& output);

// identity: of everything that the picture depends on; a state of another is refused.
void write_state(const RenderState& state, const std::string& identity, const std::string& output);
RenderState read_state(const std::string& identity, const std::string& output);  // an empty one where there is none

// A text that tells two scenes apart: of the bytes of its files, those that are no file aside, and of the meshes and pictures that it took
// from others.
std::string fingerprint(const std::vector<std::string>& files, const Scene& scene);

}  // namespace steradian::app
