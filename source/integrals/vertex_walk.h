// The derivatives of an integral by the vertices of a polygon, from those by the ends of its edges, in one walk.
#pragma once

#include <cstddef>

#include "steradian/config.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// Derivatives by the vertices at the ends of an edge. D has + .
template <class D>
struct EndSlopes {
  D a, b;
};

// Two parts of an integral (integrals::Part), a vector of derivatives for each.
template <class V>
struct PartVectors {
  V plain, fresnel;

  STERADIAN_INLINE friend PartVectors operator+(const PartVectors& a, const PartVectors& b) {
    return {a.plain + b.plain, a.fresnel + b.fresnel};
  }
};

// A vertex waits for its second edge alone, so that the sums of a short walk stay in registers.
//
//   contours     as in PreparedPolygon
//   corner(i)    the values of vertex i that edges need
//   edge(a, b)   EndSlopes of the edge from the corner a to b, in walk order
//   take(i, d)   the derivative by vertex i
template <class Corner, class Edge, class Take>
STERADIAN_INLINE void walk_vertices(const std::size_t* contours, std::size_t contour_count, Corner corner, Edge edge, Take take) {
  for (std::size_t c = 0; c < contour_count; ++c) {
    const std::size_t first = contours[c], last = contours[c + 1];
    if (last - first < 2) continue;
    const auto closing = corner(last - 1);
    auto previous = corner(first);
    if (last - first == 2) {  // a single edge
      const auto slopes = edge(previous, closing);
      take(first, slopes.a);
      take(first + 1, slopes.b);
      continue;
    }
    const auto opening = edge(closing, previous);
    auto pending = opening.b;
    for (std::size_t i = first + 1; i < last; ++i) {
      const auto next = i + 1 < last ? corner(i) : closing;
      const auto slopes = edge(previous, next);
      take(i - 1, pending + slopes.a);
      pending = slopes.b;
      previous = next;
    }
    take(last - 1, pending + opening.a);
  }
}

}  // namespace integrals
STERADIAN_END_ISA
