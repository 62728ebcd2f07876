// Walks lights on packs: the loop that every pack of area lights shares.
#pragma once

#include "core/pack.h"
#include "render/cpu/capsule_pack.h"
#include "render/cpu/light_list.h"

STERADIAN_BEGIN_ISA

// Calls start(last vertex) and then edge(vertex) for each vertex of each contour, with unit directions in the frame
// `frame` at the points p. An edge runs from the vertex before.
template <class Start, class Edge>
STERADIAN_INLINE void walk_contours(const Vec3f* vertices, const std::size_t* contours, std::size_t contour_count,
                                    const PackKernels::mat3& frame, const PackVec3& p, Start start, Edge edge) {
  PackKernels k;
  const auto direction = [&](const Vec3f& v) {
    return k.polygon_direction(transform_transposed(frame, broadcast(v) - p));
  };
  for (std::size_t c = 0; c < contour_count; ++c) {
    const std::size_t begin = contours[c], end = contours[c + 1];
    start(direction(vertices[end - 1]));
    for (std::size_t i = begin; i < end; ++i) edge(direction(vertices[i]));
  }
}

// An outline in the shading frame, in units of its distance: squares of squares stay in the range of float.
STERADIAN_INLINE PackKernels::Ellipse outline_in_frame(const PackKernels::EllipsoidOutline& outline,
                                                       const PackKernels::mat3& frame) {
  PackKernels k;
  const PackReal size2 = dot(outline.center, outline.center) + dot(outline.axis_a, outline.axis_a) +
                         dot(outline.axis_b, outline.axis_b);
  const PackReal unit = inversesqrt(max(size2, PackReal(1.0e-30)));
  return k.ellipse_prepare(transform_transposed(frame, outline.center) * unit,
                           transform_transposed(frame, outline.axis_a) * unit,
                           transform_transposed(frame, outline.axis_b) * unit);
}

// The outline as a polygon of its area whose corners gather where the lobe is sharp, in walk order.
//
//   axis, width  of the lobe, in the frame: see kernels/outline/ellipse.glsl, ellipse_fan_concentrated
template <class Start, class Edge>
STERADIAN_INLINE void walk_outline_about(const PackKernels::EllipsoidOutline& outline, int corners,
                                         const PackKernels::mat3& frame, const PackVec3& axis, const PackReal& width,
                                         Start start, Edge edge) {
  PackKernels k;
  const auto fan = k.ellipse_fan_concentrated(outline_in_frame(outline, frame), axis, width);
  start(k.polygon_direction(k.ellipse_fan_corner(fan, corners - 1, corners)));
  for (int i = 0; i < corners; ++i) edge(k.polygon_direction(k.ellipse_fan_corner(fan, i, corners)));
}

// A lobe as the polygons of round lights need it: its axis in the shading frame, and its width [rad].
struct PackLobe {
  PackVec3 axis;
  PackReal width;
  int corners;  // of the polygon: 12, or 16 for high quality (docs/ggx.md)
};

// An area light from the points of a pack.
struct SeenLight {
  const PackLight& light;
  PackKernels::mask lit;     // it shines here
  PackKernels::mask behind;  // it is walked the wrong way round: seen from behind
  PackKernels::EllipsoidOutline outline;

  STERADIAN_INLINE SeenLight(const PackLight& l, const PackVec3& p) : light(l) {
    PackKernels k;
    if (light.kind == PackLight::Kind::capsule) {
      lit = is_outside_capsule(light, p);
      behind = !(p.x <= p.x);  // nowhere
    } else if (light.kind == PackLight::Kind::ellipsoid) {
      const PackKernels::mat3 s(broadcast(light.axis_x), broadcast(light.axis_y), broadcast(light.axis_z));
      // Columns of the inverse, from its rows.
      const PackKernels::mat3 inverse(
          PackVec3(broadcast(light.unit_x.x), broadcast(light.unit_y.x), broadcast(light.unit_z.x)),
          PackVec3(broadcast(light.unit_x.y), broadcast(light.unit_y.y), broadcast(light.unit_z.y)),
          PackVec3(broadcast(light.unit_x.z), broadcast(light.unit_y.z), broadcast(light.unit_z.z)));
      outline = k.ellipsoid_outline(broadcast(light.center) - p, s, inverse);
      lit = outline.outside;
      behind = !(p.x <= p.x);  // nowhere
    } else {
      const PackReal height = dot(p - broadcast(light.plane_point), broadcast(light.plane_normal));
      behind = height < PackReal(0.0);
      lit = light.two_sided ? behind || height > PackReal(0.0) : height > PackReal(0.0);
      if (light.kind == PackLight::Kind::ellipse) {
        outline.center = broadcast(light.center) - p;
        outline.axis_a = broadcast(light.axis_x);
        outline.axis_b = broadcast(light.axis_y);
        behind = !(p.x <= p.x);  // its outline is walked as it is seen
      }
    }
  }

  // Contours of a polygon; of a round light, the polygon that stands in for it under the lobe.
  template <class Start, class Edge>
  STERADIAN_INLINE void walk(const PackKernels::mat3& frame, const PackVec3& p, const PackLobe& lobe, Start start,
                             Edge edge) const {
    if (light.is_round())
      walk_round(frame, p, lobe, start, edge);
    else
      walk_contours(light.vertices.data(), light.contours.data(), light.contours.size() - 1, frame, p, start, edge);
  }

  // The polygon that stands in for a round light under the lobe.
  template <class Start, class Edge>
  STERADIAN_INLINE void walk_round(const PackKernels::mat3& frame, const PackVec3& p, const PackLobe& lobe, Start start,
                                   Edge edge) const {
    if (light.kind != PackLight::Kind::capsule)
      return walk_outline_about(outline, lobe.corners, frame, lobe.axis, lobe.width, start, edge);
    CapsuleCorners corners;
    capsule_corners(light, lobe.corners, frame, p, lobe.axis, lobe.width, corners);
    start(corners[static_cast<std::size_t>(lobe.corners - 1)]);
    for (int i = 0; i < lobe.corners; ++i) edge(corners[static_cast<std::size_t>(i)]);
  }
};

// Irradiance of a round light, exact.
__attribute__((flatten, noinline)) inline PackReal round_light_irradiance(const SeenLight& seen, const PackKernels::mat3& frame,
                                                                          const PackVec3& p) {
  if (seen.light.radius > 0) return select(seen.lit, capsule_irradiance(seen.light, frame, p), PackReal(0.0));
  PackKernels k;
  return select(seen.lit, k.ellipse_irradiance_vector(outline_in_frame(seen.outline, frame)).z, PackReal(0.0));
}

// Irradiance of radiance 1, in [0, pi]. A function of its own: g++ flattens nothing that reaches it through a caller
// that is itself always inlined.
__attribute__((flatten, noinline)) inline PackReal area_light_irradiance(const SeenLight& seen, const PackKernels::mat3& frame,
                                                const PackVec3& p) {
  if (seen.light.is_round()) return round_light_irradiance(seen, frame, p);
  PackKernels k;
  auto walk = k.polygon_begin();
  PackVec3 previous;
  const PackLight& light = seen.light;
  walk_contours(
      light.vertices.data(), light.contours.data(), light.contours.size() - 1, frame, p,
      [&](const PackVec3& v) { previous = v; },
      [&](const PackVec3& v) {
        walk = k.polygon_add_edge(walk, previous, v);
        previous = v;
      });
  return select(seen.lit, k.polygon_irradiance(walk, seen.behind), PackReal(0.0));
}

STERADIAN_END_ISA
