// SVG drawings that move: the scene of a file at a time, by its SMIL animations.
//
//   PlaneAnimation animation("level.svg");
//   PlaneScene scene = animation.at(1.5).scene;     // as it is after a second and a half
//
// docs/plane.md says which animations count; what does not is named in PlaneSvg::ignored.
#pragma once

#include <string>

#include "steradian/plane.h"

namespace steradian {

class PlaneAnimation {
 public:
  // Throws Error as load_plane_scene does.
  explicit PlaneAnimation(const std::string& path, const Limits& limits = {});
  // From the SVG itself; `name` stands for the file in messages.
  PlaneAnimation(std::string svg, std::string name, const Limits& limits);

  bool moves() const { return moves_; }  // is there an animation in it that counts?
  PlaneSvg at(double seconds) const;     // from the beginning of the document
  // When everything in it has happened once; what is repeated without end goes on after it.
  double duration() const;  // [s]
  bool endless() const;     // something is repeated without end

 private:
  std::string svg_, name_;
  Limits limits_;
  bool moves_ = false;
};

}  // namespace steradian
