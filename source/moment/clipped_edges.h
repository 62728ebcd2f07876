// Walks a light's edges, clipped to the horizon, for any integral along them.
#pragma once

#include <cstddef>

#include "steradian/kernels.h"
#include "steradian/polygon_light.h"

STERADIAN_BEGIN_ISA

// The sum of share(a, b) over the edges of the clipped outline.
//
//   direction  of a vertex (Vec3d) from the shading point, in the shading frame: Kernels<S>::vec3
//   share      of one edge, its ends in walk order: Real<S>
template <class S, class Direction, class Share>
STERADIAN_INLINE Real<S> sum_over_clipped_edges(const PreparedPolygon& light, const Direction& direction,
                                                const Share& share) {
  Kernels<S> k;
  const Vec3d* vertices = light.vertices.data();
  const std::size_t* contours = light.contours.data();
  const std::size_t contour_count = light.contours.size() - 1;
  Real<S> sum(0.0);
  auto clip = k.horizon_clip_begin();
  for (std::size_t c = 0; c < contour_count; ++c) {
    const std::size_t begin = contours[c], end = contours[c + 1];
    if (begin == end) continue;
    auto previous = direction(vertices[end - 1]);
    for (std::size_t i = begin; i < end; ++i) {
      const auto next = direction(vertices[i]);
      clip = k.horizon_clip_edge(clip, previous, next);
      sum += share(clip.start, clip.end);
      if (any_lane(clip.closes)) sum += share(clip.arc_start, clip.arc_end);
      previous = next;
    }
  }
  clip = k.horizon_clip_finish(clip);
  if (any_lane(clip.closes)) sum += share(clip.arc_start, clip.arc_end);
  return sum;
}

STERADIAN_END_ISA
