// What packs do for shadows: the loops over vertices, planes, edges and segments. Plain arrays in, plain arrays out; what they
// cannot decide in float they name, and the scalar code decides it.
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

// Where a vertex lies outside of the box, bit by bit; kAbove: it does not block, since it lies beyond the plane.
enum OutsideBits { kLeftOut = 1, kRightOut = 2, kBottomOut = 4, kTopOut = 8, kBoxOut = 15, kAbove = 16 };

// How a point looks at a light's plane.
struct Projection {
  float eye_x = 0, eye_y = 0, eye_z = 0;  // the point stands at (eye_x, eye_y, -eye_z)
  float box_x = 0, box_y = 0;
  float height = 0;  // only what lies below blocks
};
struct ProjectedView {
  VectorSpan homogeneous;                      // shadow_project
  float *cell_x = nullptr, *cell_y = nullptr;  // where it lies in the box
  float* outside = nullptr;                    // OutsideBits
};

// Edges by their places in the arrays of vertices and planes. walks are 0 where an edge has fewer triangles.
struct EdgeView {
  std::size_t count = 0;
  const std::int32_t *v0 = nullptr, *v1 = nullptr, *plane0 = nullptr, *plane1 = nullptr;
  const float *walks0 = nullptr, *walks1 = nullptr;
};

// A shaft in float: a vertex x is inside where dot(normal, x) <= offset for all sides; the box of points by its middle and half
// sides. reach: how far the light and the points lie from where coordinates count, which is what their roundings go by.
inline constexpr std::size_t kShaftSides = 7;
struct ShaftView {
  float normal[kShaftSides][3], offset[kShaftSides];
  float middle[3], half[3][3];
  float reach;
};

// Edges side by side, with the planes of their triangles; walks are 0 where an edge has fewer than two.
struct EdgeLeaf {
  float a[3][kPadding], b[3][kPadding];
  float normal0[3][kPadding], offset0[kPadding], walks0[kPadding];
  float normal1[3][kPadding], offset1[kPadding], walks1[kPadding];
  std::uint32_t valid, many;  // bits of edges; of those of more than two triangles, whose planes are not here
};

// Segments in cells, which floats hold exactly, padded by segments above all others. Blocks of kPadding: none of a block's segments
// reaches beyond its low, high, left and right.
struct SegmentView {
  std::size_t count = 0;  // padded
  const float *ax = nullptr, *ay = nullptr, *bx = nullptr, *by = nullptr;
  const std::int32_t* weight = nullptr;
  const float *block_low = nullptr, *block_high = nullptr, *block_left = nullptr, *block_right = nullptr;
};

// The left ray from a segment's middle.
struct LeftRay {
  std::int32_t count = 0;     // what it counts for sure, events and base left out
  std::size_t uncertain = 0;  // segments of which only whole numbers can tell
};

struct ShadowTable {
  // Turns vertices: row i of the axes is the i-th coordinate.
  void (*turn)(const VectorView& from, std::size_t count, const float axes[9], const float origin[3], const VectorSpan& to);
  void (*project)(const VectorView& vertices, std::size_t count, const Projection& projection, const ProjectedView& to);
  // 1 where the point sees the front of a plane, -1 elsewhere.
  void (*facing)(const VectorView& normals, const float* offsets, std::size_t count, const float at[3], float* to);
  // The edges that are contours and may lie in the box, ascending, with their weights; returns how many.
  std::size_t (*contours)(const EdgeView& edges, const float* facing, const float* outside, std::uint32_t* found, std::int32_t* weights);
  // The edges that a shaft may need, ascending. Edges of more than two triangles are kept where they may meet it.
  std::size_t (*filter)(const EdgeView& edges, const VectorView& vertices, const VectorView& normals, const float* offsets,
                        const ShaftView& shaft, const std::uint8_t* has_more, std::uint32_t* found);
  // The edges of a leaf that a shaft may need, bit by bit.
  std::uint32_t (*needed)(const EdgeLeaf& leaf, const ShaftView& shaft);

  // Lists must have room for all segments; segment e itself may be among them.
  LeftRay (*left_ray)(const SegmentView& segments, std::size_t e, std::uint32_t* uncertain);
  // The segments behind e that may cross it; returns how many.
  std::size_t (*may_cross)(const SegmentView& segments, std::size_t e, std::uint32_t* found);
  // How far it is from a place along a unit direction to the next segment but one; infinite where there is none.
  float (*distance_to_next)(const SegmentView& segments, float x, float y, float dx, float dy, std::size_t but);
  // What a ray to the left from a place counts, events and base left out; kUncertain where float cannot tell.
  std::int32_t (*count_at)(const SegmentView& segments, float x, float y);
  // Square of the distance to the nearest segment.
  float (*clearance2)(const SegmentView& segments, float x, float y);
};

inline constexpr std::int32_t kUncertain = INT32_MIN;

}  // namespace steradian::shadow

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(shadow::ShadowTable, shadow_table)
}
