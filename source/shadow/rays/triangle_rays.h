// TriangleRays: occlusion of two points by triangles, in double. It is the reference for the shadows of single points; pictures use
// Embree.
#pragma once

#include <cstdint>
#include <vector>

#include "shadow/edges/edges.h"
#include "shadow/region/visible.h"

namespace steradian::shadow {

class TriangleRays : public Blockers {
 public:
  // Takes the mesh's triangles. Stores no reference to it.
  explicit TriangleRays(const EdgeMesh& mesh);

  bool between(Vec3d from, Vec3d to) const override;

 private:
  struct Node {
    Vec3d low, high;
    std::uint32_t first = 0, count = 0;  // triangles of a leaf; count 0: children at first and first + 1
  };
  struct Triangle {
    Vec3d a, ab, ac;
  };
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
};

}  // namespace steradian::shadow
