// State of the shadow pass for one tile, and the memory of one thread.
#pragma once

#include "render/shadow/pass.h"
#include "shadow/lanes/point_lanes.h"
#include "shadow/region/visible.h"

namespace steradian {

// Closer than ten half diagonals, no integral uses a light's elements (least_distance2 of kernels/outline/light_elements.glsl).
inline constexpr double kNeverSmall = 100;

// Occluders of lights, found by rays.
class RayBlockers : public shadow::Blockers {
 public:
  explicit RayBlockers(const RayScene& rays) : rays_(rays) {}
  bool between(Vec3d from, Vec3d to) const override { return rays_.between(from, to); }

 private:
  const RayScene& rays_;
};

struct ShadowPass::Work {
  const std::vector<shadow::Viewpoint>* points = nullptr;
  TileShadow* result = nullptr;
  ShadowCounts* counts = nullptr;
  ShadowTaker* taker = nullptr;
  shadow::EdgeArrays tile, group;
  shadow::Scratch scratch;
  shadow::VisibleRegion region;
  shadow::PointLanes lanes;
  shadow::TriangleTree::Viewers viewers;
  std::vector<Vec3d> positions;
  Vec3d up;  // sum of their surfaces' normals
  std::vector<std::uint32_t> slots, edges, crossing;
  shadow::LightFrame base;     // for round lights: the frame of the arrays' coordinates
  bool turned = false;         // the arrays are in that frame
  bool gathered = false;       // `tile` has the edges of the groups
  bool whole_outline = false;  // parts come with their light's polygon
  bool cut_outs = false;       // the group's shaft meets cut-outs
  bool in_parts_only = false;  // the light is never found whole: that of a solid has no whole outline
  bool in_parts = false;       // the group sees the tube in its flat parts, one point at a time
  const Flat* flat = nullptr;  // of the round light
  const Capsule* tube = nullptr;
  struct PlaneEdge {
    double ax, ay, bx, by;
  };
  std::vector<PlaneEdge> visible, all;  // edges in the plane of a point's side

  const shadow::Viewpoint& at(std::uint32_t slot) const { return (*points)[slot]; }
  // Replaces `positions` and `up` by those of some slots; add() appends them.
  void take(const std::vector<std::uint32_t>& of) {
    positions.clear();
    up = {};
    add(of);
  }
  // Puts the triangles of a list into `crossing` whose sections the shaft needs.
  void find_crossing(const shadow::Shaft& shaft, const shadow::EdgeMesh& mesh, const std::vector<std::uint32_t>& triangles) {
    crossing.clear();
    for (const std::uint32_t t : triangles)
      if (shaft.needs_triangle(mesh, t)) crossing.push_back(t);
  }
  void add(const std::vector<std::uint32_t>& of) {
    for (const std::uint32_t i : of) {
      positions.push_back(at(i).position);
      up += at(i).geometric_normal.value_or(at(i).normal);
    }
  }
};

}  // namespace steradian
