// Gathering: which edges a group of points need look at before a light. Section "A picture" of docs/shadows.md.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shadow/edges.h"
#include "shadow/light_frame.h"
#include "shadow/packs.h"

namespace steradian::shadow {

// Where triangles cross the plane of a light: that of the shaft's frame, or planes of the points' own.
enum class Sections { in_plane, anywhere };

// The hull of a group of points and a light, and what of the points' box its tests need.
class Shaft {
 public:
  // All points below the light's plane (in its frame, z < 0).
  Shaft(const LightFrame& frame, const std::vector<Vec3d>& points, Sections sections = Sections::in_plane);

  bool may_meet_box(Vec3d low, Vec3d high) const;
  bool may_meet(const Vec3d* corners, int count) const;  // their hull
  bool may_meet_segment(Vec3d a, Vec3d b) const;

  // Whether the edge can be a segment for one of the points: it may be a contour, and it may meet the shaft.
  bool needs(const EdgeMesh& mesh, std::uint32_t edge) const;
  // Whether the section of a triangle by the light's plane can be one.
  bool needs_triangle(const EdgeMesh& mesh, std::uint32_t triangle) const;

  // In a frame's coordinates, for packs.
  ShaftView view_from(const LightFrame& frame) const;

 private:
  struct Bound {  // inside: dot(normal, x) <= offset
    Vec3d normal;
    double offset, length;  // of the normal
  };
  // How far off a place may be: points look at positions in float, and a vertex that one of them sees inside the box must not lose
  // its edges.
  double rounding(Vec3d p) const;
  std::array<Bound, 6> bounds_;  // the second: before the light's plane
  Sections sections_;
  Vec3d origin_;                         // of the light
  double far_ = 0;                       // distance of the farthest point from its plane
  Vec3d center_;                         // of the points' box, in the world
  Vec3d half_[3];                        // its half sides, as vectors
  int facing(const Plane& plane) const;  // 1 the front for all points, -1 the back, 0 either
};

// A bounding volume hierarchy of edges.
class EdgeTree {
 public:
  explicit EdgeTree(const EdgeMesh& mesh);

  // Ascending numbers of the edges that the shaft needs.
  void gather(const EdgeMesh& mesh, const Shaft& shaft, std::vector<std::uint32_t>& edges) const;

 private:
  struct Node {
    Vec3f low, high;
    std::uint32_t first = 0, count = 0;  // edges of a leaf; count 0: children at first and first + 1
  };
  void build(const EdgeMesh& mesh, std::uint32_t node, std::uint32_t begin, std::uint32_t end);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace steradian::shadow
