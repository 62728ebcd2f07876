// Walks a light's outline, clipped to the horizon and closed along it, as edges of unit directions in a frame.
#pragma once

#include "steradian/kernels.h"
#include "steradian/polygon_light.h"

namespace steradian {

template <class S>
typename Kernels<S>::vec3 to_kernel(Vec3d v) {
  return {v.x, v.y, v.z};
}

// add_edge(a, b): in walk order, none below the horizon z = 0.
template <class S, class AddEdge>
void walk_clipped_edges(const PreparedPolygon& light, const Frame& frame, Vec3d position, AddEdge add_edge) {
  Kernels<S> k;
  auto clip = k.horizon_clip_begin();
  const auto direction = [&](Vec3d v) { return k.polygon_direction(to_kernel<S>(frame.to_local(v - position))); };
  for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
    const std::size_t begin = light.contours[c], end = light.contours[c + 1];
    auto previous = direction(light.vertices[end - 1]);
    for (std::size_t i = begin; i < end; ++i) {
      const auto next = direction(light.vertices[i]);
      clip = k.horizon_clip_edge(clip, previous, next);
      add_edge(clip.start, clip.end);
      if (any_lane(clip.closes)) add_edge(clip.arc_start, clip.arc_end);
      previous = next;
    }
  }
  clip = k.horizon_clip_finish(clip);
  if (any_lane(clip.closes)) add_edge(clip.arc_start, clip.arc_end);
}

}  // namespace steradian
