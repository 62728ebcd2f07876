// Assembly of a point's segments: code that the scalar version and the packs share.
#pragma once

#include "shadow/edges/segments.h"

namespace steradian::shadow {

// Kinds of ids, in the top bits.
inline constexpr std::uint64_t kCutId = 1ull << 60, kCornerId = 2ull << 60, kClipId = 3ull << 60;

// The id of the end of a segment where the box clips it.
inline std::uint64_t clip_id(Source source, std::uint32_t index, int end) {
  return kClipId | static_cast<std::uint64_t>(source) << 56 | static_cast<std::uint64_t>(index) << 1 | static_cast<unsigned>(end);
}

// Adds a segment, and an event for each end that the box's left side clipped.
inline void add_cells(SegmentSet& result, const Cell& a, const Cell& b, bool from_left, bool to_left, std::int32_t weight, Source source,
                      std::uint32_t index) {
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

}  // namespace steradian::shadow
