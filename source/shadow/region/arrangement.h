// The arrangement of a point's segments: every segment is cut where others cross it, and every piece has a count on either side. All
// decisions are signs of whole numbers. See steps 5 and 6 of docs/shadows.md.
#pragma once

#include <cstdint>
#include <vector>

#include "shadow/edges/segments.h"
#include "shadow/lanes/packs.h"

namespace steradian::shadow {

// A piece of a segment, in cells, with the counts on its sides. Neither count includes triangles at the box's corner.
struct Piece {
  double ax = 0, ay = 0, bx = 0, by = 0;
  std::int32_t left = 0, right = 0;
  std::uint32_t segment = 0;

  std::int32_t low() const { return left < right ? left : right; }
  std::int32_t high() const { return left < right ? right : left; }
};

// Side of f's line on which a vertex lies: +1 left, -1 right, never 0.
int side_of(const Segment& f, const SnappedVertex& p);
// The same for the midpoint of a segment.
int side_of_midpoint(const Segment& f, const Segment& e);

// Crossing with another segment: fraction of the way from start to end, side of the middle, change of the count on the left.
struct Crossing {
  bool after;  // true: beyond the middle
  double t;
  std::int32_t change;
  bool operator<(const Crossing& c) const { return after != c.after ? c.after : t < c.t; }
};
struct CrossingPair {
  Crossing on_e, on_f;
};
// Returns true if two segments cross; `result` then says where.
bool cross(const Segment& e, const Segment& f, CrossingPair& result);

// Change that f adds to the count of a ray to the left from e's middle.
std::int32_t left_ray_crosses(const Segment& e, const Segment& f);
// Returns true if an event lies below e's middle.
bool lies_below_middle(const LeftEvent& event, const Segment& e);
bool runs_up(const Segment& e);

// Replaces `pieces`. They are in the order of segments, then along each segment.
void arrange(const SegmentSet& set, std::vector<Piece>& pieces);

// A set's segments as packs read them, with memory for the results.
struct SegmentArrays {
  std::vector<float> ax, ay, bx, by;
  std::vector<std::int32_t> weight;
  std::vector<float> block_low, block_high, block_left, block_right;
  std::vector<std::uint32_t> order, place;  // order[k]: segment at position k; place[i]: position of segment i
  std::vector<std::uint32_t> found;

  // Sorts many segments by height, the long ones first, so that each meets few blocks.
  void assign(const SegmentSet& set);
  SegmentView view() const {
    return {ax.size(),     ax.data(),        ay.data(),         bx.data(),         by.data(),
            weight.data(), block_low.data(), block_high.data(), block_left.data(), block_right.data()};
  }

 private:
  void sort(const SegmentSet& set);
};

// The same pieces, bit for bit: packs find the segments near each other, whole numbers decide. Along a chain, counts carry over at
// vertices that two segments share, so that one left ray serves the whole chain.
void arrange(const ShadowTable& packs, const SegmentSet& set, SegmentArrays& arrays, std::vector<Piece>& pieces);

// Count at a position that lies on no segment, in cells. The layers of a solid light are taken off.
std::int32_t count_at(const SegmentSet& set, double x, double y);

}  // namespace steradian::shadow
