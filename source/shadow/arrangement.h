// The arrangement of a point's segments: every segment cut where others cross it, with the count on either side of every
// piece. All decisions are signs of whole numbers. Steps 5 and 6 of docs/shadows.md.
#pragma once

#include <cstdint>
#include <vector>

#include "shadow/packs.h"
#include "shadow/segments.h"

namespace steradian::shadow {

// A piece of a segment, in cells, with the counts on its sides; triangles at the box's corner are left out of both.
struct Piece {
  double ax = 0, ay = 0, bx = 0, by = 0;
  std::int32_t left = 0, right = 0;
  std::uint32_t segment = 0;

  std::int32_t low() const { return left < right ? left : right; }
  std::int32_t high() const { return left < right ? right : left; }
};

// On which side of f's line a vertex lies: +1 left, -1 right, never 0.
int side_of(const Segment& f, const Cell& p);
// The same for the midpoint of a segment.
int side_of_midpoint(const Segment& f, const Segment& e);

// Where another segment crosses: the share of the way from start to end, on which side of the middle, how the count on the left changes.
struct Crossing {
  bool after;  // the middle
  double t;
  std::int32_t change;
  bool operator<(const Crossing& c) const { return after != c.after ? c.after : t < c.t; }
};
struct CrossingPair {
  Crossing on_e, on_f;
};
// Whether two segments cross, and where.
bool cross(const Segment& e, const Segment& f, CrossingPair& result);

// What f adds to the count of a ray to the left from e's middle.
std::int32_t left_ray_crosses(const Segment& e, const Segment& f);
// Whether an event lies below e's middle.
bool lies_below_middle(const LeftEvent& event, const Segment& e);
bool runs_up(const Segment& e);

// Replaces `pieces`. Order: by segment, then along it.
void arrange(const SegmentSet& set, std::vector<Piece>& pieces);

// A set's segments for packs, with memory for what they find.
struct SegmentArrays {
  std::vector<float> ax, ay, bx, by;
  std::vector<std::int32_t> weight;
  std::vector<float> block_low, block_high, block_left, block_right;
  std::vector<std::uint32_t> order, place;  // order[k]: which segment stands at k; place[i]: where segment i stands
  std::vector<std::uint32_t> found;

  // Many segments are sorted by height, the long ones first, so that each meets few blocks.
  void assign(const SegmentSet& set);
  SegmentView view() const {
    return {ax.size(),     ax.data(),        ay.data(),         bx.data(),         by.data(),
            weight.data(), block_low.data(), block_high.data(), block_left.data(), block_right.data()};
  }

 private:
  void sort(const SegmentSet& set);
};

// The same pieces, to the bit: packs find out what lies near each segment, whole numbers decide. Along a chain of segments counts
// are handed on at vertices that two of them share, so that one left ray serves them all.
void arrange(const ShadowTable& packs, const SegmentSet& set, SegmentArrays& arrays, std::vector<Piece>& pieces);

// The count at a place that lies on no segment, in cells.
std::int32_t count_at(const SegmentSet& set, double x, double y);

}  // namespace steradian::shadow
