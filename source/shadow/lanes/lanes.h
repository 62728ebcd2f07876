// Lanes: sixteen points of a group process a light together, one point per lane. Work that their edges share is done once; differences are
// a bit or a number per lane. Plain arrays, for packs.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd.h"
#include "shadow/lanes/packs.h"

namespace steradian::shadow {

inline constexpr std::size_t kPoints = 16;
using LaneBits = std::uint16_t;  // bit i: lane i

struct alignas(64) LaneReals {
  float at[kPoints];
};
struct alignas(64) LaneInts {
  std::int32_t at[kPoints];
};

// The points and their views of the light's plane (Projection). Lanes without a point repeat another one.
struct LaneView {
  LaneBits valid = 0;
  LaneReals at[3];             // in the coordinates of the edges
  LaneReals eye[3], shift[3];  // of the point in its light's frame (shadow_project)
  LaneReals box_x, box_y, height;
  LaneReals axes[9];    // axes of its frame in world space, row by row
  LaneReals origin[3];  // anchor of its frame, in the coordinates of the edges
  bool turned = false;  // true: axes and origin are not those of the edges' frame and differ from lane to lane
  LaneReals normal[3];  // shading normal in world space
  LaneInts base;        // count at the lower left corner
};

// The edges of a group (EdgeArrays).
struct LaneEdges {
  EdgeView edges;
  std::size_t edge_count = 0, plane_count = 0, vertex_count = 0;
  VectorView vertices, normals;
  const float* offsets = nullptr;
  struct More {
    std::uint32_t edge, first, count;
  };
  struct Incidence {
    std::uint32_t plane;
    std::int32_t walks;
  };
  const More* more = nullptr;  // edges of more than two triangles, ascending
  std::size_t more_count = 0;
  const Incidence* incidences = nullptr;
  const CrossingTriangle* crossing = nullptr;
  std::size_t crossing_count = 0;
  const std::uint32_t* vertex_numbers = nullptr;  // in the mesh
  std::size_t of_light = 0;                       // first vertex of a solid light: the plane does not cut its edges
};

// A vertex as seen from all points.
struct VertexLanes {
  LaneReals x, y, z;  // result of shadow_project
  LaneReals cell_x, cell_y;
  LaneBits left, right, bottom, top, above;  // OutsideBits, one mask per side
};

// A segment as seen from all points, in cells. Values of absent lanes have no meaning.
struct SegmentLanes {
  LaneReals ax, ay, bx, by;
  LaneInts weight;
  LaneBits present;
  LaneBits clipped_a, clipped_b;  // the end is clipped by the box or cut by the light's plane: a vertex of its own
  LaneBits cut_a, cut_b;          // the part of these that the plane cuts, not the box
  LaneBits left_a, left_b;        // the part of these that the box's left side clips: an event
  std::int32_t place_a, place_b;  // places of its ends among the vertices, followed by the outline's corners; -1: none
  std::uint32_t row;              // row of its edge or crossing triangle in the group, or index in its own kind

  // Results of arranging, along the segment from its start to its end.
  LaneInts left;                      // count on the left at the start
  LaneInts change, change_to_middle;  // sum over all crossings; over those before the middle
  LaneInts low;                       // least count of its pieces
  LaneBits known, crossed, bounds;
  LaneBits tied;  // some crossing was decided by displacements: its position does not give its order among others
};

// Padded by boxes that meet nothing. Blocks of kPadding consecutive segments are padded in the same way.
struct BoxArrays {
  float *low_x, *high_x, *low_y, *high_y;  // bounds over the lanes where it is present
  float *block_low_x, *block_high_x, *block_low_y, *block_high_y;
};

// Crossing of two segments, in the lanes of `mask`.
struct CrossingLanes {
  LaneReals t_e, t_f;
  std::uint32_t e, f;
  LaneBits mask;
  LaneBits tied;                  // decided by displacements
  LaneBits e_to_left, f_to_left;  // e runs to f's left; f runs to e's left
  LaneBits after_e, after_f;      // the crossing lies after their middles
};

// A piece of a crossed segment, in one lane, that bounds the region on its left.
struct CrossedPiece {
  float ax, ay, bx, by;
  std::uint32_t segment;
  std::uint16_t lane;
};

// A list in memory that its owner can grow.
template <class T>
struct Room {
  T* data = nullptr;
  std::size_t size = 0, capacity = 0;
};

// Exact decisions by whole numbers, for cases that floats cannot decide.
struct ExactLanes {
  const void* self = nullptr;
  // Adds the lane's crossing of e and f to `to`, if they cross.
  void (*cross)(const void* self, std::uint32_t e, std::uint32_t f, std::size_t lane, CrossingLanes& to) = nullptr;
  // Change that f adds to the left ray from e's middle.
  std::int32_t (*left_ray)(const void* self, std::uint32_t e, std::uint32_t f, std::size_t lane) = nullptr;
  // Returns true if the event at f's start (0) or end (1) lies below e's middle.
  bool (*event_below)(const void* self, std::uint32_t e, std::uint32_t f, int end, std::size_t lane) = nullptr;
  bool (*runs_up)(const void* self, std::uint32_t e, std::size_t lane) = nullptr;
};

struct LaneWork {
  SegmentLanes* segments = nullptr;
  std::size_t count = 0;
  std::uint32_t outline = 0;  // first segment of the light's outline
  bool layered = false;       // the light's outline may lie on itself
  BoxArrays boxes;
  Room<CrossingLanes> crossings;
  Room<CrossedPiece> pieces;
  std::uint32_t *crossing_first = nullptr, *crossing_list = nullptr;  // by segment, count + 1 entries; two entries per crossing
  LaneReals* sorted_t = nullptr;                                      // a segment's crossings from its start on, same size;
  LaneInts* sorted_change = nullptr;                                  // absent lanes come last and have no change
  std::uint32_t *end_first = nullptr, *ends = nullptr;                // by place: ends of its segments, 2 * segment + end
  LaneBits* shared_by_two = nullptr;                                  // by place: lanes where exactly two segments end
  std::size_t place_count = 0;
  std::uint32_t *stack = nullptr, *events = nullptr;  // one number per segment
  ExactLanes exact;
};

// The visible region, as far as edges determine it.
struct RegionLanes {
  LaneInts floor;  // input: lower levels, and this one, are passed over
  LaneInts level;  // the lowest level above the floor
  LaneBits none;   // lanes without any region
  LaneBits wide;   // lanes whose region is not thin
  LaneBits found;  // lanes with a position well inside
  LaneReals place_x, place_y;
};

// Numbers of vertices and segments that see() wrote.
struct SeenByLanes {
  std::size_t vertices = 0, edges = 0, sections = 0;
};

struct LaneTable {
  // Writes the segments of edges, then the sections of crossing triangles. front: one number per plane; place_of: one per vertex;
  // vertices and to: capacity for all.
  SeenByLanes (*see)(const LaneEdges& edges, const LaneView& view, std::uint16_t* front, std::int32_t* place_of, VertexLanes* vertices,
                     SegmentLanes* to);
  // Computes the boxes of segments.
  void (*bound)(const SegmentLanes* segments, std::size_t count, const BoxArrays& boxes);
  // Finds all crossings; returns false if the capacity is too small.
  bool (*cross)(LaneWork& work);
  // Computes the counts along all segments.
  void (*count)(LaneWork& work, const LaneView& view);
  // Finds the lowest level above the floor, its boundary and the boundary pieces of crossed segments. Returns false if the capacity is too
  // small.
  bool (*cut)(LaneWork& work, LaneBits lanes, RegionLanes& result);
  // Finds a position inside the region.
  void (*region)(LaneWork& work, const LaneView& view, LaneBits lanes, RegionLanes& result);
  // Count the edges that bound the region in some lane, and write them relative to the point: planes of a block of packed::Pieces.
  std::size_t (*count_edges)(const LaneWork& work, LaneBits lanes);
  void (*write_edges)(const LaneWork& work, const LaneView& view, const RegionLanes& region, LaneBits lanes, float* to);
};

}  // namespace steradian::shadow

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(shadow::LaneTable, lane_table)
}
