// SVG drawings that move: the scene of a file at a time, by its SMIL animations.
//
//   PlaneAnimation animation("level.svg");
//   PlaneScene scene = animation.at(1.5).scene;     // after a second and a half
//
// docs/plane-drawings.md says which animations are supported; PlaneSvg::ignored names the others.
#pragma once

#include <map>
#include <set>
#include <string>

#include "steradian/plane.h"

namespace steradian {

class PlaneAnimation {
 public:
  // Throws Error like load_plane_scene.
  explicit PlaneAnimation(const std::string& path, const Limits& limits = {});
  // Takes the SVG itself; `name` is the file's name in messages.
  PlaneAnimation(std::string svg, std::string name, const Limits& limits);

  bool moves() const { return moves_; }  // true if it has a supported animation
  PlaneSvg at(double seconds) const;     // from the beginning of the document
  // The time when all animations have run once; those that repeat without end continue after it.
  double duration() const;  // [s]
  bool endless() const;     // true if an animation repeats without end

 private:
  // The drawing at a time, without its animations, and those that are not supported.
  struct Still {
    std::string svg;
    std::set<std::string> ignored;
  };
  Still still_at(double seconds) const;

  std::string svg_, name_;
  Limits limits_;
  bool moves_ = false;
  std::map<std::size_t, PlaneLeftOut::Why> backdrops_;  // by element; judged at the beginning, so that they remain while things move
};

}  // namespace steradian
