// Area lights as packs of points see them: lit or not, their outlines, their irradiance. One file a shape in source/shapes.
#pragma once

#include "core/pack.h"
#include "integrals/irradiance.h"
#include "render/cpu/light_list.h"
#include "render/cpu/points.h"

STERADIAN_BEGIN_ISA

STERADIAN_INLINE PackVec3 load(const VectorArrays& v, std::size_t i) { return {load(v.x + i), load(v.y + i), load(v.z + i)}; }

using AboutLobe = shapes::AboutLobe<Pack>;

struct SeenLight {
  const PackLight& light;
  shapes::Seen<Pack> seen;

  STERADIAN_INLINE SeenLight(const PackLight& l, const PackVec3& p) : light(l) {
    if (const auto* polygon = std::get_if<packed::Polygon>(&l.shape))
      seen = shapes::see<Pack>(*polygon, p);
    else
      l.with_round([&](const auto& shape) { seen = shapes::see<Pack>(shape, p); });
  }
  STERADIAN_INLINE integrals::Shading<Pack> shading(const PackVec3& view) const { return {view, seen.lit, seen.reversed}; }
};

STERADIAN_INLINE auto contours_in(const PackLight& light, const PackKernels::mat3& frame, const PackVec3& p) {
  return shapes::contours_in<Pack>(*std::get_if<packed::Polygon>(&light.shape), frame, p);
}

// The polygon that stands in for a round light under the lobe: of its outline's area, its corners gathered where the lobe is
// sharp.
struct RoundOutline {
  const SeenLight& seen;
  const PackKernels::mat3& frame;
  const PackVec3& p;
  const AboutLobe& lobe;

  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    const auto walk_corners = [&](auto corner) {
      auto previous = end(corner(lobe.corners - 1));
      for (int i = 0; i < lobe.corners; ++i) {
        const auto next = end(corner(i));
        add(previous, next);
        previous = next;
      }
    };
    seen.light.with_round([&](const auto& shape) { shapes::with_corners<Pack>(shape, seen.seen, lobe, frame, p, walk_corners); });
  }
};

// Either of the two, where one place in the code must serve both.
struct AnyOutline {
  RoundOutline round;

  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    if (round.seen.light.is_round())
      round.walk(end, add);
    else
      contours_in(round.seen.light, round.frame, round.p).walk(end, add);
  }
};

// Of a round light, exact. Functions of their own: g++ flattens nothing that reaches it through a caller that is itself
// always inlined.
__attribute__((flatten, noinline)) inline PackVec3 round_irradiance_vector(const SeenLight& light, const PackKernels::mat3& frame,
                                                                           const PackVec3& p) {
  PackVec3 e(0.0, 0.0, 0.0);
  light.light.with_round([&](const auto& shape) { e = select(light.seen.lit, shapes::irradiance_vector<Pack>(shape, light.seen, frame, p), e); });
  return e;
}

// Irradiance vector of radiance 1 in the frame; its z is the irradiance, in [0, pi].
__attribute__((flatten, noinline)) inline PackVec3 irradiance_vector(const SeenLight& light, const PackKernels::mat3& frame,
                                                                     const PackVec3& p) {
  if (light.light.is_round()) return round_irradiance_vector(light, frame, p);
  integrals::Irradiance<Pack> integral;
  return integrate(contours_in(light.light, frame, p), light.shading(PackVec3(0.0, 0.0, 1.0)), integral);
}

// What of it reaches a diffuse lobe under a dielectric's boundary (kernels/lobe/lambert.glsl). view: in the frame.
STERADIAN_INLINE PackReal irradiance_below(const PackVec3& e, const PackVec3& view, const PackReal& loss) {
  return any_lane(loss > PackReal(0.0)) ? PackKernels().lambert_irradiance_below(e, view, loss) : e.z;
}

// The loss at points i and on; 0 where there is no boundary.
STERADIAN_INLINE PackReal fresnel_loss(const Points& points, std::size_t i) {
  return points.fresnel_loss != nullptr ? load(points.fresnel_loss + i) : PackReal(0.0);
}

STERADIAN_END_ISA
