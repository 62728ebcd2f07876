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
  // All points below the light's plane (in its frame, z < 0). up: where most of the points' surfaces look, if that is known; what lies
  // behind all of them is then left out.
  Shaft(const LightFrame& frame, const std::vector<Vec3d>& points, Vec3d up = {}, Sections sections = Sections::in_plane);
  // A box along the axes around points and a light that lies in a cube about `light`, however near they are.
  Shaft(Vec3d light, double half_side, const std::vector<Vec3d>& points, Vec3d up = {});

  bool may_meet_box(Vec3d low, Vec3d high) const;
  bool may_meet(const Vec3d* corners, int count) const;  // their hull
  bool may_meet_segment(Vec3d a, Vec3d b) const;

  // Whether the section of a triangle by the light's plane can be one.
  bool needs_triangle(const EdgeMesh& mesh, std::uint32_t triangle) const;

  // In a frame's coordinates, for packs.
  ShaftView view_from(const LightFrame& frame) const;

 private:
  struct Bound {  // inside: dot(normal, x) <= offset
    Vec3d normal;
    double offset, length;  // of the normal
  };
  static Bound bound_of(Vec3d normal, double offset) { return {normal, offset, length(normal)}; }
  // Puts the box around the points; returns how low they lie along its z.
  double enclose(const std::vector<Vec3d>& points, const Frame& axes);
  // How far off a place may be: points look at positions in float, and a vertex that one of them sees inside the box must not lose
  // its edges.
  double rounding(Vec3d p) const;
  std::array<Bound, kShaftSides> bounds_;  // the second: before the light's plane
  Sections sections_;
  Vec3d origin_;    // of the light
  double far_ = 0;  // distance of the farthest point from its plane
  Vec3d center_;    // of the points' box, in the world
  Vec3d half_[3];   // its half sides, as vectors
};

// A bounding volume hierarchy of edges.
class EdgeTree {
 public:
  explicit EdgeTree(const EdgeMesh& mesh);

  // Ascending numbers of the edges that the shaft needs: those that can be a segment for one of its points, since they may be contours
  // and may meet it.
  void gather(const ShadowTable& packs, const Shaft& shaft, std::vector<std::uint32_t>& edges) const;

 private:
  struct Node {
    Vec3f low, high;
    std::uint32_t leaf = 0, children = 0;  // children 0: a leaf; else there and next to it
  };
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
  EdgeLeaf leaf_of(const EdgeMesh& mesh, std::uint32_t begin, std::uint32_t end) const;

  Vec3d middle_;  // of all: coordinates count from here
  std::vector<Node> nodes_;
  std::vector<EdgeLeaf> leaves_;
};

}  // namespace steradian::shadow
