// Lanes: sixteen points of a group look at a light together, each in a lane of its own. What their edges have in common is done once;
// what differs is a bit or a number of every lane. Plain arrays, for packs.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd.h"
#include "shadow/packs.h"

namespace steradian::shadow {

inline constexpr std::size_t kPoints = 16;
using LaneBits = std::uint16_t;  // bit i: lane i

struct alignas(64) LaneReals {
  float at[kPoints];
};
struct alignas(64) LaneInts {
  std::int32_t at[kPoints];
};

// The points and how each looks at the light's plane (Projection). Lanes without a point repeat another one.
struct LaneView {
  LaneBits valid = 0;
  LaneReals at[3];   // in the coordinates of the edges
  LaneReals eye[3];  // the point stands at (x, y, -z) of its light's frame
  LaneReals box_x, box_y, height;
  LaneReals axes[9];    // of its frame in the world, row by row
  LaneReals origin[3];  // of its frame, in the coordinates of the edges
  bool turned = false;  // these are not the frame's, which then differ from lane to lane
  LaneReals normal[3];  // of shading, in the world
  LaneInts base;        // the count at the lower left corner
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
};

// A vertex as all points see it.
struct VertexLanes {
  LaneReals x, y, z;  // shadow_project
  LaneReals cell_x, cell_y;
  LaneBits left, right, bottom, top, above;  // OutsideBits, lane by lane
};

// A segment as all points see it, in cells. What absent lanes hold has no meaning.
struct SegmentLanes {
  LaneReals ax, ay, bx, by;
  LaneInts weight;
  LaneBits present;
  LaneBits clipped_a, clipped_b;  // the end is where the box clips it, or the light's plane: a vertex of its own
  LaneBits cut_a, cut_b;          // of these, by the plane and not by the box
  LaneBits left_a, left_b;        // of these, by the box's left side: an event
  std::int32_t place_a, place_b;  // of its ends among the vertices and, behind them, the outline's corners; -1: none
  std::uint32_t row;              // of its edge in the group, or of its own kind

  // Where a segment stands from its start to its end: what arranging finds.
  LaneInts left;                      // the count on the left at the start
  LaneInts change, change_to_middle;  // of all crossings; of those before the middle
  LaneInts low;                       // the least count of its pieces
  LaneBits known, crossed, bounds;
  LaneBits tied;  // some crossing was decided by displacements: where it is says nothing of its order among others
};

// Padded by boxes that meet nothing; so are blocks, of kPadding segments in a row.
struct BoxArrays {
  float *low_x, *high_x, *low_y, *high_y;  // over the lanes where it is present
  std::uint32_t* order;                    // which segment stands there
  float *block_low_x, *block_high_x, *block_low_y, *block_high_y;
};

// Where two segments cross, in the lanes of `mask`.
struct CrossingLanes {
  LaneReals t_e, t_f;
  std::uint32_t e, f;
  LaneBits mask;
  LaneBits tied;                  // decided by displacements
  LaneBits e_to_left, f_to_left;  // e runs to f's left; f to e's
  LaneBits after_e, after_f;      // their middles
};

// A piece of a segment that others cross, in one lane, that bounds the region: on its left.
struct CrossedPiece {
  float ax, ay, bx, by;
  std::uint32_t segment;
  std::uint16_t lane;
};

// A list in memory that its owner makes larger.
template <class T>
struct Room {
  T* data = nullptr;
  std::size_t size = 0, capacity = 0;
};

// Whole numbers decide what floats cannot.
struct ExactLanes {
  const void* self = nullptr;
  // Adds to `to` what the lane has of a crossing of e and f, or nothing.
  void (*cross)(const void* self, std::uint32_t e, std::uint32_t f, std::size_t lane, CrossingLanes& to) = nullptr;
  // What f adds to the left ray from e's middle.
  std::int32_t (*left_ray)(const void* self, std::uint32_t e, std::uint32_t f, std::size_t lane) = nullptr;
  // Whether the event at f's start (0) or end (1) lies below e's middle.
  bool (*event_below)(const void* self, std::uint32_t e, std::uint32_t f, int end, std::size_t lane) = nullptr;
  bool (*runs_up)(const void* self, std::uint32_t e, std::size_t lane) = nullptr;
};

struct LaneWork {
  SegmentLanes* segments = nullptr;
  std::size_t count = 0;
  std::uint32_t outline = 0;  // the first segment of the light's outline
  BoxArrays boxes;
  Room<CrossingLanes> crossings;
  Room<CrossedPiece> pieces;
  std::uint32_t *crossing_first = nullptr, *crossing_list = nullptr;  // by segment: count + 1; two for each crossing
  LaneReals* sorted_t = nullptr;                                      // of a segment's crossings, from its start on: as many;
  LaneInts* sorted_change = nullptr;                                  // of absent lanes behind the others, without a change
  std::uint32_t *end_first = nullptr, *ends = nullptr;                // by place: its segments' ends, 2 * segment + end
  LaneBits* shared_by_two = nullptr;                                  // by place: lanes where exactly two segments end there
  std::size_t place_count = 0;
  std::uint32_t *found = nullptr, *stack = nullptr, *events = nullptr;  // a number a segment
  ExactLanes exact;
};

// The region that shows, as far as edges tell.
struct RegionLanes {
  LaneInts level;
  LaneBits none;   // no region at all
  LaneBits found;  // with a place well inside
  LaneReals place_x, place_y;
};

struct LaneTable {
  // Writes the segments of edges; returns how many. front: a number a plane; place_of: a number a vertex; vertices: room for all.
  std::size_t (*see)(const LaneEdges& edges, const LaneView& view, std::uint16_t* front, std::int32_t* place_of, VertexLanes* vertices,
                     std::size_t& vertex_count, SegmentLanes* to);
  // The boxes of segments, in their order.
  void (*bound)(const SegmentLanes* segments, std::size_t count, const BoxArrays& boxes);
  // All crossings, or false where there is no room for them.
  bool (*cross)(LaneWork& work);
  // Counts along all segments.
  void (*count)(LaneWork& work, const LaneView& view);
  // The lowest level, what bounds it, and the pieces of crossed segments that do, or false where there is no room.
  bool (*cut)(LaneWork& work, LaneBits lanes, RegionLanes& result);
  // A place in it.
  void (*region)(LaneWork& work, const LaneView& view, LaneBits lanes, RegionLanes& result);
  // How many edges bound it in some lane, and those edges, relative to the point: planes of a block of packed::Pieces.
  std::size_t (*count_edges)(const LaneWork& work, LaneBits lanes);
  void (*write_edges)(const LaneWork& work, const LaneView& view, const RegionLanes& region, LaneBits lanes, float* to);
};

}  // namespace steradian::shadow

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(shadow::LaneTable, lane_table)
}
