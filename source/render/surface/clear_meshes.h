// ClearMeshes: the meshes that let most light through, and the fraction that comes straight through them to the surfaces behind.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/surface/ray_scene.h"
#include "steradian/scene.h"

namespace steradian {

class ClearMeshes {
 public:
  explicit ClearMeshes(const Scene& scene);

  bool empty() const { return numbers_.empty(); }
  const std::vector<std::uint32_t>& numbers() const { return numbers_; }
  // Fraction of the light that a mesh passes as a whole: a pane once, a closed mesh on the way in and out. A solid absorbs over its mean
  // chord, four times the volume over the area.
  Vec3f passes(std::uint32_t mesh) const { return crossings_[mesh] == 2 ? at_face_[mesh] * at_face_[mesh] : at_face_[mesh]; }
  // The same for one crossing of a mesh's face; 1 for meshes that are not clear.
  Vec3f at_face(std::size_t mesh) const { return at_face_[mesh]; }
  // Fraction of light that comes straight from one place to another, through each face of clear meshes between them.
  Vec3d passes_between(const RayScene& rays, Vec3d from, Vec3d to) const;
  // Multiplies the light of sixteen rays, those of `asked`, by these fractions along each.
  using Sixteen = std::array<Vec3f, 16>;
  void tint(const RayScene& rays, RayScene::Sixteen& sixteen, std::uint32_t asked, Sixteen& light) const;

 private:
  std::vector<std::uint32_t> numbers_;
  std::vector<Vec3f> at_face_;           // by mesh; 1 where it is not clear
  std::vector<std::uint8_t> crossings_;  // by mesh
};

}  // namespace steradian
