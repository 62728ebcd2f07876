// Walks lights on packs: the loop that every pack of area lights shares.
#pragma once

#include "core/pack.h"
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

// Corners of a regular polygon inscribed in the unit circle, 64 of them; fewer by leaving out.
inline constexpr int kOutlineCorners = 64;
struct OutlineCorners {
  float cosine[kOutlineCorners], sine[kOutlineCorners];
};
constexpr OutlineCorners outline_corners() {
  OutlineCorners t{};
  const double step_cosine = 0.99518472667219693, step_sine = 0.098017140329560604;  // of 2 pi / 64
  double c = 1, s = 0;
  for (int i = 0; i < kOutlineCorners; ++i) {
    t.cosine[i] = static_cast<float>(c);
    t.sine[i] = static_cast<float>(s);
    const double next = c * step_cosine - s * step_sine;
    s = c * step_sine + s * step_cosine;
    c = next;
  }
  return t;
}

// The outline of an ellipsoid as a polygon of its area, in walk order. corners: 64 or 16.
template <class Start, class Edge>
STERADIAN_INLINE void walk_outline(const PackKernels::EllipsoidOutline& outline, int corners,
                                   const PackKernels::mat3& frame, Start start, Edge edge) {
  static constexpr OutlineCorners kCorners = outline_corners();
  PackKernels k;
  // What gives a regular polygon the area of its circle: sqrt(2 pi / (K sin(2 pi / K))).
  const double scale = corners == kOutlineCorners ? 1.000803771517661 : 1.0130015562559769;
  const int stride = kOutlineCorners / corners;
  const PackVec3 c = transform_transposed(frame, outline.center);
  const PackVec3 a = transform_transposed(frame, outline.axis_a) * PackReal(scale);
  const PackVec3 b0 = transform_transposed(frame, outline.axis_b) * PackReal(scale);
  const PackVec3 b = select(dot(c, cross(a, b0)) < PackReal(0.0), -b0, b0);
  const auto corner = [&](int i) {
    return k.polygon_direction(c + a * broadcast(kCorners.cosine[i]) + b * broadcast(kCorners.sine[i]));
  };
  start(corner(kOutlineCorners - stride));
  for (int i = 0; i < kOutlineCorners; i += stride) edge(corner(i));
}

// For glossy lobes: 16 corners leave 0.06 % of the full GGX lobe (docs/ggx.md).
inline constexpr int kOutlineCornersOfLobes = 16;

// An area light from the points of a pack.
struct SeenLight {
  const PackLight& light;
  PackKernels::mask lit;     // it shines here
  PackKernels::mask behind;  // it is walked the wrong way round: seen from behind
  PackKernels::EllipsoidOutline outline;

  STERADIAN_INLINE SeenLight(const PackLight& l, const PackVec3& p) : light(l) {
    PackKernels k;
    if (light.kind == PackLight::Kind::ellipsoid) {
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
    }
  }

  // corners: of the polygon that stands for an ellipsoid, 64 or 16.
  template <class Start, class Edge>
  STERADIAN_INLINE void walk(const PackKernels::mat3& frame, const PackVec3& p, int corners, Start start,
                             Edge edge) const {
    if (light.kind == PackLight::Kind::ellipsoid)
      walk_outline(outline, corners, frame, start, edge);
    else
      walk_contours(light.vertices.data(), light.contours.data(), light.contours.size() - 1, frame, p, start, edge);
  }
};

// Irradiance of radiance 1, in [0, pi]. A function of its own: g++ flattens nothing that reaches it through a caller
// that is itself always inlined.
__attribute__((flatten, noinline)) inline PackReal area_light_irradiance(const SeenLight& seen, const PackKernels::mat3& frame,
                                                const PackVec3& p) {
  PackKernels k;
  auto walk = k.polygon_begin();
  PackVec3 previous;
  seen.walk(
      frame, p, kOutlineCorners, [&](const PackVec3& v) { previous = v; },
      [&](const PackVec3& v) {
        walk = k.polygon_add_edge(walk, previous, v);
        previous = v;
      });
  return select(seen.lit, k.polygon_irradiance(walk, seen.behind), PackReal(0.0));
}

STERADIAN_END_ISA
