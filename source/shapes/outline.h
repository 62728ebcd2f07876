// Outlines: a light as visible from a shading point, as oriented edges between unit directions in the shading frame.
//
// An outline is a type with
//
//   template <class End, class Add> void walk(End end, Add add) const;
//
// which calls add(end(a), end(b)) for each edge from a to b in walk order (kernels/outline/polygon.glsl). Together the edges are closed.
// `end` computes the values that an integral needs of a corner; along a contour it is called once a corner. An integral does not know the
// kind of edges: a polygon's contours, the corners of a round light, or the visible rest of one behind occluders.
#pragma once

#include <utility>
#include <cstddef>

#include "steradian/kernels.h"
#include "steradian/polygon_light.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// The loop over contours: add(end(v), end(w)) for each edge from the vertex v to the vertex w.
//
//   contours  where each contour begins, and the number of vertices at the end. One of two vertices is the one edge from the
//             first to the second: such contours, in any order, bound the part that is visible behind occluders. They lie above the
//             horizon, since clipping joins a contour's crossings in their order
template <class Vertex, class End, class Add>
STERADIAN_INLINE void walk_contours(const Vertex* vertices, const std::size_t* contours, std::size_t contour_count, End end, Add add) {
  for (std::size_t c = 0; c < contour_count; ++c) {
    const std::size_t first = contours[c], last = contours[c + 1];
    if (first == last) continue;
    const bool closed = last - first > 2;
    auto previous = end(vertices[closed ? last - 1 : first]);
    for (std::size_t i = closed ? first : first + 1; i < last; ++i) {
      const auto next = end(vertices[i]);
      add(previous, next);
      previous = next;
    }
  }
}

// Contours of a flat light. direction(vertex) is the unit direction in the shading frame.
template <class Vertex, class Direction>
struct Contours {
  const Vertex* vertices;
  const std::size_t* contours;
  std::size_t contour_count;
  Direction direction;

  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    walk_contours(
        vertices, contours, contour_count, [&](const Vertex& v) { return end(direction(v)); }, add);
  }
};

template <class Direction>
Contours<Vec3d, Direction> contours_of(const PreparedPolygon& light, Direction direction) {
  const std::size_t count = light.contours.empty() ? 0 : light.contours.size() - 1;
  return {light.vertices.data(), light.contours.data(), count, direction};
}

template <class S, class T>
STERADIAN_INLINE typename Kernels<S>::vec3 to_kernel(Vector3<T> v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

// Point of the line through a and b that is nearest to the origin.
inline Vec3d foot_on_line(Vec3d a, Vec3d b) {
  const Vec3d along = b - a;
  return a - along * (dot(a, along) / dot(along, along));
}

// The contours of one light, with its elements: see small_light.h.
//
//   turned(v)  a vector (Vec3d) in the shading frame
template <class S, class Direction, class Turned>
struct LightContours : Contours<Vec3d, Direction> {
  const PreparedPolygon& light;
  Vec3d position;
  Turned turned;

  // An edge that subtends more than 179 degrees is walked in two, by way of its point next to the shading point. Ends that are nearly
  // opposite determine no direction in between, however near the edge passes.
  template <class End, class Add>
  void walk(End end, Add add) const {
    using Unit = decltype(this->direction(position));
    using Kept = decltype(end(std::declval<Unit>()));
    struct Corner {
      Vec3d vertex;
      Unit u;
      Kept kept;
    };
    walk_contours(
        this->vertices, this->contours, this->contour_count,
        [&](const Vec3d& v) {
          const Unit u = this->direction(v);
          return Corner{v, u, end(u)};
        },
        [&](const Corner& a, const Corner& b) {
          if (any_lane(dot(a.u, b.u) < Real<S>(-0.9999))) {
            const Vec3d span = b.vertex - a.vertex, foot = foot_on_line(a.vertex - position, b.vertex - position);
            if (dot(foot, foot) > 1e-28 * dot(span, span)) {
              const auto between = end(Kernels<S>().polygon_direction(turned(foot)));
              add(a.kept, between);
              add(between, b.kept);
              return;
            }
          }
          add(a.kept, b.kept);
        });
  }

  // The middle one of the horizon's directions in which the light's plane lies; zero if the plane is level.
  auto on_horizon() const {
    const double side = dot(light.normal, light.centroid - position) < 0 ? -1 : 1;
    auto to = turned(light.normal * side);
    to.z = 0.0;
    const Real<S> length2 = dot(to, to);
    return to * select(length2 > Real<S>(1e-12), inversesqrt(max(length2, Real<S>(1e-12))), Real<S>(0.0));
  }

  auto elements() const {
    typename Kernels<S>::LightElements e;
    e.center = turned(light.quarters.center - position);
    e.reach_a = turned(light.quarters.reach_a);
    e.reach_b = turned(light.quarters.reach_b);
    e.area = turned(light.normal * light.area);
    return e;
  }
  Real<S> deviation2() const {
    const LightQuarters& q = light.quarters;
    return (dot(q.reach_a, q.reach_a) + dot(q.reach_b, q.reach_b)) / 2;
  }
  Real<S> distance2() const { return dot(light.quarters.center - position, light.quarters.center - position); }
};

template <class S, class Turned>
auto contours_turned(const PreparedPolygon& light, Vec3d position, Turned turned) {
  auto direction = [position, turned](const Vec3d& v) { return Kernels<S>().polygon_direction(turned(v - position)); };
  return LightContours<S, decltype(direction), Turned>{contours_of(light, direction), light, position, turned};
}

// The contours of a light as seen from a point, turned into the shading frame in double, or in S.
template <class S>
auto contours_in(const PreparedPolygon& light, const Frame& frame, Vec3d position) {
  return contours_turned<S>(light, position, [frame](const Vec3d& v) { return to_kernel<S>(frame.to_local(v)); });
}
template <class S>
auto contours_in(const PreparedPolygon& light, const Mat3<Real<S>>& frame, Vec3d position) {
  return contours_turned<S>(light, position, [frame](const Vec3d& v) { return transform_transposed(frame, to_kernel<S>(v)); });
}

}  // namespace integrals
STERADIAN_END_ISA
