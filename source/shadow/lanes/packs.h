// Pack functions for shadows: the loops over vertices, planes, edges and segments. Input and output are plain arrays. They name the cases
// that float cannot decide, and the scalar code decides those.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd.h"

namespace steradian::shadow {

// Arrays are padded to a multiple of this.
inline constexpr std::size_t kPadding = 16;
constexpr std::size_t padded(std::size_t n) { return (n + kPadding - 1) / kPadding * kPadding; }

struct VectorView {
  const float *x = nullptr, *y = nullptr, *z = nullptr;
};
struct VectorSpan {
  float *x = nullptr, *y = nullptr, *z = nullptr;
};

// Bits of the sides on which a vertex lies outside of the box. kAbove: it lies beyond the plane and does not block.
enum OutsideBits { kLeftOut = 1, kRightOut = 2, kBottomOut = 4, kTopOut = 8, kBoxOut = 15, kAbove = 16 };

// A point's view of a light's plane.
struct Projection {
  float eye[3], shift[3];  // shadow_project
  float box[2];
  float height;  // only geometry below it blocks
};
struct ProjectedView {
  VectorSpan homogeneous;                      // result of shadow_project
  float *cell_x = nullptr, *cell_y = nullptr;  // position in the box
  float* outside = nullptr;                    // OutsideBits
};

// Edges by their places in the arrays of vertices and planes. A `walks` entry is 0 if an edge has fewer triangles.
struct EdgeView {
  std::size_t count = 0;
  const std::int32_t *v0 = nullptr, *v1 = nullptr, *plane0 = nullptr, *plane1 = nullptr;
  const float *walks0 = nullptr, *walks1 = nullptr;
};

// A triangle that crosses the light's plane. plane and corners: places in the arrays; edges: mesh numbers of the edges that begin at the
// corners.
struct CrossingTriangle {
  std::uint32_t number, plane, corners[3], edges[3];
  std::int32_t twin;    // place of the first triangle with the same corners among the crossing ones; -1: none
  bool same_direction;  // true: it walks its corners as its twin does
};

// A shaft in float. A vertex x is inside if dot(normal, x) <= offset for all sides. The box of points is given by its middle and half
// sides. reach: distance of the light and the points from the coordinates' origin, which scales their rounding.
inline constexpr std::size_t kShaftSides = 7;
struct ShaftView {
  float normal[kShaftSides][3], offset[kShaftSides];
  float middle[3], half[3][3];
  float reach;
};

// Edges side by side, with the planes of their triangles. A `walks` entry is 0 if an edge has fewer than two.
struct EdgeLeaf {
  float a[3][kPadding], b[3][kPadding];
  float normal0[3][kPadding], offset0[kPadding], walks0[kPadding];
  float normal1[3][kPadding], offset1[kPadding], walks1[kPadding];
  std::uint32_t valid,
      many;  // valid: bits of edges; many: bits of edges of more than two triangles or at a body, whose planes are not here
};

// Segments in cells, which floats hold exactly, padded by segments above all others. No segment of a block of kPadding reaches beyond the
// block's low, high, left and right.
struct SegmentView {
  std::size_t count = 0;  // padded
  const float *ax = nullptr, *ay = nullptr, *bx = nullptr, *by = nullptr;
  const std::int32_t* weight = nullptr;
  const float *block_low = nullptr, *block_high = nullptr, *block_left = nullptr, *block_right = nullptr;
};

// The left ray from a segment's middle.
struct LeftRay {
  std::int32_t count = 0;     // certain part of the count, without events and base
  std::size_t uncertain = 0;  // segments that only whole numbers can decide
};

struct ShadowTable {
  // Turns vertices: row i of the axes is the i-th coordinate.
  void (*turn)(const VectorView& from, std::size_t count, const float axes[9], const float origin[3], const VectorSpan& to);
  void (*project)(const VectorView& vertices, std::size_t count, const Projection& projection, const ProjectedView& to);
  // 1 where the point sees the front of a plane, -1 elsewhere.
  void (*facing)(const VectorView& normals, const float* offsets, std::size_t count, const float at[3], float* to);
  // Finds the edges that are contours and may lie in the box, ascending, with their weights; returns their number.
  std::size_t (*contours)(const EdgeView& edges, const float* facing, const float* outside, std::uint32_t* found, std::int32_t* weights);
  // Finds the edges that a shaft may need, ascending. Edges of more than two triangles remain if they may meet it.
  std::size_t (*filter)(const EdgeView& edges, const VectorView& vertices, const VectorView& normals, const float* offsets,
                        const ShaftView& shaft, const std::uint8_t* has_more, std::uint32_t* found);
  // Bits of a leaf's edges that a shaft may need.
  std::uint32_t (*needed)(const EdgeLeaf& leaf, const ShaftView& shaft);

  // Lists must have capacity for all segments; segment e itself may be among them.
  LeftRay (*left_ray)(const SegmentView& segments, std::size_t e, std::uint32_t* uncertain);
  // Finds the segments behind e that may cross it; returns their number.
  std::size_t (*may_cross)(const SegmentView& segments, std::size_t e, std::uint32_t* found);
  // Distance from a position along a unit direction to the next segment other than `but`; infinite if there is none.
  float (*distance_to_next)(const SegmentView& segments, float x, float y, float dx, float dy, std::size_t but);
  // Count of a ray to the left from a position, without events and base; kUncertain if float cannot decide.
  std::int32_t (*count_at)(const SegmentView& segments, float x, float y);
  // Squared distance to the nearest segment.
  float (*clearance2)(const SegmentView& segments, float x, float y);
};

inline constexpr std::int32_t kUncertain = INT32_MIN;

}  // namespace steradian::shadow

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(shadow::ShadowTable, shadow_table)
}
