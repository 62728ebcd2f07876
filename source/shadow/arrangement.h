// The arrangement of a point's segments: every segment cut where others cross it, with the count on either side of every
// piece. All decisions are signs of whole numbers. Steps 5 and 6 of docs/shadows.md.
#pragma once

#include <cstdint>
#include <vector>

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

// Replaces `pieces`. Order: by segment, then along it.
void arrange(const SegmentSet& set, std::vector<Piece>& pieces);

// The count at a place that lies on no segment, in cells.
std::int32_t count_at(const SegmentSet& set, double x, double y);

}  // namespace steradian::shadow
