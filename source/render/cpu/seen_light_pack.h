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

// What integrate asks of an outline's light (integrals/small_light.h). The elements are a function of their own, seldom called.
__attribute__((flatten, noinline)) inline PackKernels::LightElements elements_in(const SeenLight& light, const PackKernels::mat3& frame,
                                                                                const PackVec3& p) {
  if (const auto* polygon = std::get_if<packed::Polygon>(&light.light.shape)) return shapes::elements_in<Pack>(*polygon, light.seen, frame, p);
  PackKernels::LightElements e;
  light.light.with_round([&](const auto& shape) { e = shapes::elements_in<Pack>(shape, light.seen, frame, p); });
  return e;
}
STERADIAN_INLINE PackReal deviation2_of(const PackLight& light) {
  if (const auto* polygon = std::get_if<packed::Polygon>(&light.shape)) return shapes::deviation2<Pack>(*polygon);
  PackReal result(0.0);
  light.with_round([&](const auto& shape) { result = shapes::deviation2<Pack>(shape); });
  return result;
}

// The contours of a polygon.
struct PolygonOutline {
  const SeenLight& seen;
  const PackKernels::mat3& frame;
  const PackVec3& p;

  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    shapes::contours_in<Pack>(polygon(), frame, p).walk(end, add);
  }
  PackKernels::LightElements elements() const { return elements_in(seen, frame, p); }
  STERADIAN_INLINE PackReal deviation2() const { return shapes::deviation2<Pack>(polygon()); }
  STERADIAN_INLINE PackReal distance2() const { return seen.seen.distance2; }

 private:
  STERADIAN_INLINE const packed::Polygon& polygon() const { return *std::get_if<packed::Polygon>(&seen.light.shape); }
};

// The polygon that stands in for a round light under the lobe: of its outline's area, its corners gathered where the lobe is
// sharp.
struct RoundOutline {
  const SeenLight& seen;
  const PackKernels::mat3& frame;
  const PackVec3& p;
  const AboutLobe& lobe;

  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    const auto walk_corners = [&](auto corner, int count) {
      auto previous = end(corner(count - 1));
      for (int i = 0; i < count; ++i) {
        const auto next = end(corner(i));
        add(previous, next);
        previous = next;
      }
    };
    seen.light.with_round([&](const auto& shape) { shapes::with_corners<Pack>(shape, seen.seen, lobe, frame, p, walk_corners); });
  }
  PackKernels::LightElements elements() const { return elements_in(seen, frame, p); }
  STERADIAN_INLINE PackReal deviation2() const { return deviation2_of(seen.light); }
  STERADIAN_INLINE PackReal distance2() const { return seen.seen.distance2; }
};

// Either of the two, where one place in the code must serve both.
struct AnyOutline {
  RoundOutline round;

  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    if (round.seen.light.is_round())
      round.walk(end, add);
    else
      PolygonOutline{round.seen, round.frame, round.p}.walk(end, add);
  }
  PackKernels::LightElements elements() const { return round.elements(); }
  STERADIAN_INLINE PackReal deviation2() const { return round.deviation2(); }
  STERADIAN_INLINE PackReal distance2() const { return round.distance2(); }
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
  return integrate(PolygonOutline{light, frame, p}, light.shading(PackVec3(0.0, 0.0, 1.0)), integral);
}

STERADIAN_END_ISA
