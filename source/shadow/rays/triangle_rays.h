// TriangleRays: occlusion of two points by triangles, in double. It is the reference for the shadows of single points; pictures use
// Embree.
#pragma once

#include <cstdint>
#include <vector>

#include "core/box_tree.h"
#include "shadow/edges/edges.h"
#include "shadow/region/visible.h"

namespace steradian::shadow {

class TriangleRays : public Blockers {
 public:
  // Takes the mesh's triangles. Stores no reference to it.
  explicit TriangleRays(const EdgeMesh& mesh);

  bool between(Vec3d from, Vec3d to) const override;

 private:
  struct Triangle {
    Vec3d a, ab, ac;
  };

  BoxTree<Box3d> tree_;
  std::vector<Triangle> triangles_;  // in the tree's order
};

}  // namespace steradian::shadow
