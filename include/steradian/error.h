// Error: bad input or a missing device. It states the place in the user's input, the problem, and what to do about it.
#pragma once

#include <stdexcept>
#include <string>

namespace steradian {

class Error : public std::runtime_error {
 public:
  // place: file, place in the file, option or key ("scene.gltf: meshes[2].primitives[0]"); may be empty
  // problem: the problem there; hint: what to do, may be empty
  Error(std::string place, std::string problem, std::string hint = {})
      : std::runtime_error((place.empty() ? "" : place + ": ") + problem + (hint.empty() ? "" : " (" + hint + ")")),
        place_(std::move(place)),
        problem_(std::move(problem)),
        hint_(std::move(hint)) {}

  const std::string& place() const { return place_; }
  const std::string& problem() const { return problem_; }
  const std::string& hint() const { return hint_; }

 private:
  std::string place_, problem_, hint_;
};

// An impossible request: an option or a method that does not fit. The program exits with 2 instead of 1.
class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace steradian
