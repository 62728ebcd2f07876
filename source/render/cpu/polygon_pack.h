// Area lights as packs of points see them: lit or not, and their outlines.
#pragma once

#include "core/pack.h"
#include "integrals/irradiance.h"
#include "render/cpu/capsule_pack.h"
#include "render/cpu/light_list.h"

STERADIAN_BEGIN_ISA

// The contours of a polygon from the points p.
STERADIAN_INLINE auto contours_in(const PackLight& light, const PackKernels::mat3& frame, const PackVec3& p) {
  const auto direction = [&frame, &p](const Vec3f& v) {
    return PackKernels{}.polygon_direction(transform_transposed(frame, broadcast(v) - p));
  };
  return integrals::Contours<Vec3f, decltype(direction)>{light.vertices.data(), light.contours.data(), light.contours.size() - 1, direction};
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

  STERADIAN_INLINE integrals::Shading<Pack> shading(const PackVec3& view) const { return {view, lit, behind}; }
};

// The polygon that stands in for a round light under the lobe: of its outline's area, its corners gathered where the lobe is
// sharp (kernels/outline/ellipse.glsl, ellipse_fan_concentrated; kernels/outline/capsule.glsl, capsule_fan).
struct RoundOutline {
  static constexpr bool kInOrder = true;
  const SeenLight& seen;
  const PackKernels::mat3& frame;
  const PackVec3& p;
  const PackLobe& lobe;

  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    if (seen.light.kind == PackLight::Kind::capsule) {
      CapsuleCorners corners;
      capsule_corners(seen.light, lobe.corners, frame, p, lobe.axis, lobe.width, corners);
      return walk_corners([&](int i) { return corners[static_cast<std::size_t>(i)]; }, end, add);
    }
    PackKernels k;
    const auto fan = k.ellipse_fan_concentrated(outline_in_frame(seen.outline, frame), lobe.axis, lobe.width);
    walk_corners([&](int i) { return k.polygon_direction(k.ellipse_fan_corner(fan, i, lobe.corners)); }, end, add);
  }

 private:
  template <class Corner, class End, class Add>
  STERADIAN_INLINE void walk_corners(Corner corner, End end, Add add) const {
    auto previous = end(corner(lobe.corners - 1));
    for (int i = 0; i < lobe.corners; ++i) {
      const auto next = end(corner(i));
      add(previous, next);
      previous = next;
    }
  }
};

// Either of the two, where one place in the code must serve both.
struct AnyOutline {
  static constexpr bool kInOrder = true;
  RoundOutline round;

  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    if (round.seen.light.is_round())
      round.walk(end, add);
    else
      contours_in(round.seen.light, round.frame, round.p).walk(end, add);
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
  integrals::Irradiance<Pack> integral;
  return integrate(contours_in(seen.light, frame, p), seen.shading(PackVec3(0.0, 0.0, 1.0)), integral).z;
}

STERADIAN_END_ISA
