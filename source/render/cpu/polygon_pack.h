// Walks a polygon's contours on packs: the loop that every pack of polygon lights shares.
#pragma once

#include "core/pack.h"

STERADIAN_BEGIN_ISA

// Calls add_edge(a, b) for every edge, with unit directions in the frame `frame` at the points p.
template <class T, class AddEdge>
STERADIAN_INLINE void walk_contours(const Vector3<T>* vertices, const std::size_t* contours, std::size_t contour_count,
                                    const PackKernels::mat3& frame, const PackVec3& p, AddEdge add_edge) {
  PackKernels k;
  const auto direction = [&](const Vector3<T>& v) {
    return k.polygon_direction(transform_transposed(frame, broadcast(static_cast<Vec3f>(v)) - p));
  };
  for (std::size_t c = 0; c < contour_count; ++c) {
    const std::size_t begin = contours[c], end = contours[c + 1];
    PackVec3 previous = direction(vertices[end - 1]);
    for (std::size_t i = begin; i < end; ++i) {
      const PackVec3 next = direction(vertices[i]);
      add_edge(previous, next);
      previous = next;
    }
  }
}

STERADIAN_END_ISA
