// SideRays: the directions in which the side of a patch looks for others, in proportion to the cosine.
#pragma once

#include <cstddef>
#include <vector>

#include "render/surface/surface.h"
#include "steradian/vector.h"

namespace steradian::radiosity {

class SideRays {
 public:
  explicit SideRays(std::size_t count = 0);
  std::size_t count() const { return directions_.size(); }
  // In the frame of a side; z is the cosine.
  Vec3d direction(std::size_t ray) const { return directions_[ray]; }
  // Each side turns the directions by its own angle.
  static Frame frame(const Surface& surface, std::size_t side);

 private:
  std::vector<Vec3d> directions_;  // those that are traced together are neighbours
};

}  // namespace steradian::radiosity
