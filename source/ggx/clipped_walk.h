// Walks a light's outline, clipped to the horizon and closed along it, as edges of unit directions in a frame.
#pragma once

#include "moment/clipped_edges.h"

namespace steradian {

template <class S>
typename Kernels<S>::vec3 to_kernel(Vec3d v) {
  return {v.x, v.y, v.z};
}

// add_edge(a, b): in walk order, none below the horizon z = 0. For integrals that are more than one number.
template <class S, class AddEdge>
void walk_clipped_edges(const PreparedPolygon& light, const Frame& frame, Vec3d position, AddEdge add_edge) {
  const auto direction = [&](Vec3d v) {
    return Kernels<S>().polygon_direction(to_kernel<S>(frame.to_local(v - position)));
  };
  sum_over_clipped_edges<S>(light, direction, [&](const auto& a, const auto& b) {
    add_edge(a, b);
    return Real<S>(0.0);
  });
}

}  // namespace steradian
