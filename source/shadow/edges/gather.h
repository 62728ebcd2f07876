// Gathering: the edges that a group of points needs to test for a light. See section "A picture" of docs/theory/shadows.md.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shadow/edges/edges.h"
#include "shadow/region/light_frame.h"
#include "shadow/lanes/packs.h"

namespace steradian::shadow {

// Planes by which triangles are cut: the plane of the shaft's frame, or a plane of each point's own.
enum class Sections { in_plane, anywhere };

// The hull of a group of points and a light, and the parts of the points' box that its tests need.
class Shaft {
 public:
  // All points are below the light's plane (in its frame, z < 0). up: direction that most of the points' surfaces face, if known.
  // Everything behind all of them is then left out.
  Shaft(const LightFrame& frame, const std::vector<Vec3d>& points, Vec3d up = {}, Sections sections = Sections::in_plane);
  // An axis-aligned box around points and a light that lies in a cube about `light`, however near they are.
  Shaft(Vec3d light, double half_side, const std::vector<Vec3d>& points, Vec3d up = {});

  bool may_meet_box(Vec3d low, Vec3d high) const;
  bool may_meet(const Vec3d* corners, int count) const;  // tests their hull
  bool may_meet_segment(Vec3d a, Vec3d b) const;

  // Returns true if a triangle's section by the light's plane may be a segment.
  bool needs_triangle(const EdgeMesh& mesh, std::uint32_t triangle) const;

  // The shaft in a frame's coordinates, for packs.
  ShaftView view_from(const LightFrame& frame) const;

 private:
  struct Bound {  // inside: dot(normal, x) <= offset
    Vec3d normal;
    double offset, length;  // length: of the normal
  };
  static Bound bound_of(Vec3d normal, double offset) { return {normal, offset, length(normal)}; }
  // Puts the box around the points; returns their least coordinate along its z axis.
  double enclose(const std::vector<Vec3d>& points, const Frame& axes);
  // Bound on a position's error. Points use positions in float, and a vertex that a point sees inside the box must not lose its edges.
  double rounding(Vec3d p) const;
  std::array<Bound, kShaftSides> bounds_;  // the second one is the light's plane
  Sections sections_;
  Vec3d origin_;    // the light's origin
  double far_ = 0;  // distance of the farthest point from its plane
  Vec3d center_;    // center of the points' box, in world space
  Vec3d half_[3];   // half sides of that box, as vectors
};

// A bounding volume hierarchy of edges.
class EdgeTree {
 public:
  explicit EdgeTree(const EdgeMesh& mesh);

  // Ascending numbers of the edges that the shaft needs: edges that may be contours and may meet the shaft. Each can be a segment for one
  // of its points.
  void gather(const ShadowTable& packs, const Shaft& shaft, std::vector<std::uint32_t>& edges) const;

 private:
  struct Node {
    Vec3f low, high;
    std::uint32_t leaf = 0, children = 0;  // children 0: a leaf; else index of two adjacent children
  };
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
  EdgeLeaf leaf_of(const EdgeMesh& mesh, std::uint32_t begin, std::uint32_t end) const;

  Vec3d middle_;  // middle of all edges, origin of the coordinates
  std::vector<Node> nodes_;
  std::vector<EdgeLeaf> leaves_;
};

}  // namespace steradian::shadow
