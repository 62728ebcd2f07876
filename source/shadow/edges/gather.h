// The edges that points need to test for a light: gathering for a group, and the segments of a point.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/box_tree.h"
#include "shadow/edges/edges.h"
#include "shadow/edges/segments.h"
#include "shadow/lanes/packs.h"
#include "shadow/region/light_frame.h"

namespace steradian::shadow {

// Assembly of a point's segments: code that the scalar version and the packs share.

// Kinds of ids, in the top bits.
inline constexpr std::uint64_t kCutId = 1ull << 60, kCornerId = 2ull << 60, kClipId = 3ull << 60;

// The id of the end of a segment where the box clips it.
inline std::uint64_t clip_id(Source source, std::uint32_t index, int end) {
  return kClipId | static_cast<std::uint64_t>(source) << 56 | static_cast<std::uint64_t>(index) << 1 | static_cast<unsigned>(end);
}

// Adds a segment, and an event for each end that the box's left side clipped.
inline void add_cells(SegmentSet& result, const SnappedVertex& a, const SnappedVertex& b, bool from_left, bool to_left, std::int32_t weight,
                      Source source, std::uint32_t index) {
  if (from_left) result.events.push_back({a.y, a.dy, weight});
  if (to_left) result.events.push_back({b.y, b.dy, -weight});
  result.segments.push_back({a, b, weight, source, index});
}

// Adds the light's outline.
void add_outline(const LightFrame& frame, SegmentSet& result);

// Adds the half plane in front of a normal as a line of weight -H, with the part above on its left. Returns H if the lower left corner
// lies below, else 0.
//
//   eye  (x, y, -z) of the point in the frame
std::int32_t add_horizon(const LightFrame& frame, Vec3d eye, Vec3d normal, Source source, SegmentSet& result);

// Adds the base of all counts and the horizons of a point; `point` is in the frame.
void add_horizons(const LightFrame& frame, const Viewpoint& from, Vec3d point, SegmentSet& result);

// Adds the section of a triangle by the light's plane. If a coincident triangle has added the section already, only its weight is added.
template <class Add>
void add_section(SegmentSet& result, std::size_t first_section, Add add) {
  const std::size_t before = result.segments.size();
  add();
  if (result.segments.size() == before) return;
  // Two segments with the same ends could not decide which one lies left of the other.
  const Segment last = result.segments.back();
  for (std::size_t i = first_section; i + 1 < result.segments.size(); ++i) {
    Segment& earlier = result.segments[i];
    const bool same = earlier.a.id == last.a.id && earlier.b.id == last.b.id;
    const bool opposite = earlier.a.id == last.b.id && earlier.b.id == last.a.id;
    if (!same && !opposite) continue;
    earlier.weight += same ? last.weight : -last.weight;
    result.segments.pop_back();
    return;
  }
}

// Gathering: the edges that a group of points needs to test for a light. See section "A picture" of docs/theory/shadows.md.

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

  bool may_meet(const Box3d& box) const;
  bool may_meet(const Vec3d* corners, int count) const;  // tests their hull
  bool may_meet_segment(Vec3d a, Vec3d b) const;

  // Returns true if a triangle's section by the light's plane may be a segment.
  bool needs_triangle(const EdgeMesh& mesh, std::uint32_t triangle) const;

  // The shaft for packs: in coordinates along some axes, relative to an anchor.
  ShaftView view_from(const Frame& axes, Vec3d anchor) const;

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
  EdgeLeaf leaf_of(const EdgeMesh& mesh, std::uint32_t begin, std::uint32_t end) const;

  Vec3d middle_;  // middle of all edges, origin of the coordinates
  std::vector<EdgeLeaf> leaves_;
  BoxTree<Box3f> tree_;  // of the leaves
};

}  // namespace steradian::shadow
