// Open shafts: whether anything at all can stand between a group of points and lights, as a whole. Section "Open shafts" of
// docs/shadows.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "shadow/box.h"
#include "shadow/edges.h"

namespace steradian::shadow {

// Half spaces that hold the hull of two boxes: its sides, or fewer.
class HullOfBoxes {
 public:
  HullOfBoxes(const Box& a, const Box& b);
  bool may_meet(const Box& box) const;
  bool may_meet(const Vec3d (&corners)[3]) const;

 private:
  // A side along an axis of space, through an edge of each box. inside: u x + v y <= offset, in the two other coordinates.
  struct Slant {
    double u, v, offset;
    int x, y;
  };
  Box all_;
  Slant slants_[12];
  int count_ = 0;
};

// A bounding volume hierarchy of triangles.
class TriangleTree {
 public:
  explicit TriangleTree(const EdgeMesh& mesh);

  // Points that look through shafts, one group after another. Keeps what it finds of triangles.
  class Viewers {
   public:
    void take(const std::vector<Vec3d>& points);
    const Box& box() const { return box_; }

   private:
    friend class TriangleTree;
    // How far before a plane the points are, at least and at most.
    struct Range {
      double low, high;
    };
    Range over(const Plane& plane, std::uint32_t triangle);
    Box box_;
    std::vector<double> x_, y_, z_;
    std::vector<Range> ranges_;          // by triangle
    std::vector<std::uint32_t> stamps_;  // of the group for which the range is
    std::uint32_t stamp_ = 0;
  };

  // False where some triangle may come between a point and a place of the light's box. True is certain, up to what stands less than
  // `margin` out of the light's box.
  bool is_open(Viewers& viewers, const Box& light, double margin) const;

 private:
  struct Node {
    Box box;
    std::uint32_t first = 0, count = 0;  // of a leaf's triangles; count 0: its children stand at first and next to it
  };
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
  bool separates(std::uint32_t triangle, Viewers& viewers, const Box& light, double margin) const;

  const EdgeMesh& mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace steradian::shadow
