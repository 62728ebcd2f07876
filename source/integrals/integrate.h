// integrate: the single implementation of an integral over a light's outline, for every kind of number.
//
// An integral is a type with
//
//   static constexpr Clip kClip;
//   void anchor(u);                     // optional: a direction of the horizon that lies in the light's plane, or the zero vector
//   Mask<S> begin(const Shading<S>&);   // resets the integral; returns true where this light can send anything
//   end(u)                              // the stored value of a corner, the unit direction u in the shading frame: mostly u itself
//   void add(a, b);                     // adds one edge, from the values of `end`
//   void close(a, b);                   // optional: adds an arc of the horizon, if it is to be told from the edges
//   finish(Mask<S> reversed);           // the integral: Part<S> of a lobe
//
// Each is in a file of its own beside this one. It manages memory that it reuses from light to light itself.
#pragma once

#include "shapes/outline.h"
#include "shapes/small_light.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// Radiance towards the view under a light of radiance 1: x with F = 1, y with F = (1 - v.h)^5. A channel of a lobe with Schlick's Fresnel
// is f0 (x - y) + f90 y (ggx_radiance). An integral without Fresnel returns y = 0.
template <class S>
using Part = typename Kernels<S>::vec2;

template <class S>
Vec3d radiance_of(const Part<S>& part, Vec3d f0, Vec3d f90, Vec3d light) {
  const auto channel = [&](double at_normal, double at_grazing, double radiance) {
    return radiance * static_cast<double>(Kernels<S>().ggx_radiance(part, at_normal, at_grazing).v);
  };
  return {channel(f0.x, f90.x, light.x), channel(f0.y, f90.y, light.y), channel(f0.z, f90.z, light.z)};
}

// View of a light from a point.
template <class S>
struct Shading {
  typename Kernels<S>::vec3 view;  // unit, in the shading frame
  Mask<S> lit;                     // the light shines towards the point
  Mask<S> reversed;                // it is seen from behind: its edges run in reverse order
};

// side: for a plane light, 1 or -1 if it is seen from the front or the back, 0 if it sends nothing.
template <class S>
Shading<S> shading_from(int side, const typename Kernels<S>::vec3& view) {
  return {view, Mask<S>(side != 0), Mask<S>(side < 0)};
}

enum class Clip {
  none,     // unchanged edges: the integral has no horizon, or clips by itself
  horizon,  // the edges' parts above z = 0, and the arcs of the horizon that close them
};

template <class R>
STERADIAN_INLINE void set_to_zero(Vec2<R>& v) {
  v = Vec2<R>(0.0, 0.0);
}
template <class R>
STERADIAN_INLINE void set_to_zero(Vec3<R>& v) {
  v = Vec3<R>(0.0, 0.0, 0.0);
}

// Two integrals in one walk: a corner is transformed into the shading frame once for both.
template <class First, class Second>
struct Together {
  First first;
  Second second;

  static constexpr Clip kClip = First::kClip;
  static_assert(First::kClip == Second::kClip);
  template <class A, class B>
  struct Pair {
    A first;
    B second;
    STERADIAN_INLINE friend void set_to_zero(Pair& p) {
      set_to_zero(p.first);
      set_to_zero(p.second);
    }
    template <class M>
    STERADIAN_INLINE friend Pair select(M m, const Pair& a, const Pair& b) {
      return {select(m, a.first, b.first), select(m, a.second, b.second)};
    }
    template <class M, class N>
    STERADIAN_INLINE friend Pair select(const BothSmall<M, N>& m, const Pair& a, const Pair& b) {
      return {select(m.first, a.first, b.first), select(m.second, a.second, b.second)};
    }
    template <class R>
    STERADIAN_INLINE friend Pair operator*(const Pair& a, R s) {
      return {a.first * s, a.second * s};
    }
    STERADIAN_INLINE friend Pair operator+(const Pair& a, const Pair& b) { return {a.first + b.first, a.second + b.second}; }
  };

  template <class S>
  STERADIAN_INLINE Mask<S> begin(const Shading<S>& shading) {
    return first.begin(shading) || second.begin(shading);
  }
  template <class V>
  void anchor(const V& u) {
    if constexpr (requires { first.anchor(u); }) first.anchor(u);
    if constexpr (requires { second.anchor(u); }) second.anchor(u);
  }
  template <class V>
  STERADIAN_INLINE auto end(const V& u) const {
    return Pair<decltype(first.end(u)), decltype(second.end(u))>{first.end(u), second.end(u)};
  }
  template <class End>
  STERADIAN_INLINE void add(const End& a, const End& b) {
    first.add(a.first, b.first);
    second.add(a.second, b.second);
  }
  template <class M>
  STERADIAN_INLINE auto finish(M reversed) {
    return Pair<decltype(first.finish(reversed)), decltype(second.finish(reversed))>{first.finish(reversed), second.finish(reversed)};
  }
  auto least_distance2() const { return min(first.least_distance2(), second.least_distance2()); }
  template <class V>
  auto small_light(const V& center) const {
    return BothSmall<decltype(first.small_light(center)), decltype(second.small_light(center))>{first.small_light(center),
                                                                                                second.small_light(center)};
  }
  template <class V>
  auto at(const V& u) const {
    return Pair<decltype(first.at(u)), decltype(second.at(u))>{first.at(u), second.at(u)};
  }
};

// Computes the integral over the outline, after begin.
template <class S, class Outline, class Integral>
STERADIAN_INLINE auto integrate_edges(const Outline& outline, const Shading<S>& shading, Integral& integral) {
  Kernels<S> k;
  if constexpr (requires { integral.anchor(outline.on_horizon()); }) integral.anchor(outline.on_horizon());
  const auto end = [&](const auto& u) { return integral.end(u); };
  if constexpr (Integral::kClip == Clip::horizon) {
    auto clip = k.horizon_clip_begin();
    const auto add_arc = [&](const auto& a, const auto& b) {
      if constexpr (requires { integral.close(a, b); })
        integral.close(a, b);
      else
        integral.add(a, b);
    };
    const auto close = [&] {
      if (!any_lane(clip.closes)) return;
      const auto wide = k.horizon_arc_wide(clip.arc_start, clip.arc_end);
      auto start = clip.arc_start;
      if (any_lane(wide)) {
        const auto middle = k.horizon_arc_middle(start, clip.arc_end, select(shading.reversed, Real<S>(-1.0), Real<S>(1.0)));
        const auto to = select(wide, middle, start);
        add_arc(start, to);
        start = to;
      }
      add_arc(start, clip.arc_end);
    };
    outline.walk(end, [&](const auto& a, const auto& b) {
      clip = k.horizon_clip_edge(clip, a, b);
      integral.add(clip.start, clip.end);
      close();
    });
    clip = k.horizon_clip_finish(clip);
    close();
  } else {
    outline.walk(end, [&](const auto& a, const auto& b) { integral.add(a, b); });
  }
  return integral.finish(shading.reversed);
}

// Uses the light's elements where they serve, and walks the outline if a lane needs it. It is not inlined and takes copies, so that it
// costs the usual path no memory.
template <class S, class Outline, class Integral>
__attribute__((noinline)) auto integrate_small(Outline outline, Shading<S> shading, Integral integral, Mask<S> lit) {
  Kernels<S> k;
  auto elements = outline.elements();
  elements.area = select(shading.reversed, -elements.area, elements.area);
  const auto serve = elements_serve<S>(elements, integral.small_light(elements.center));
  decltype(integral.finish(shading.reversed)) nothing;
  set_to_zero(nothing);
  auto sum = nothing;
  for (int i = 0; i < 4; ++i) {
    const auto element = k.light_element_at(elements, i);
    sum = sum + select(element.direction.z > Real<S>(0.0), integral.at(element.direction), nothing) * element.solid_angle;
  }
  if (any_lane(lit && !in_every_part(serve))) sum = select(serve, sum, integrate_edges(outline, shading, integral));
  return select(lit, sum, nothing);
}

template <class S, class Outline, class Integral>
STERADIAN_INLINE auto integrate(const Outline& outline, const Shading<S>& shading, Integral& integral) {
  decltype(integral.finish(shading.reversed)) nothing;
  set_to_zero(nothing);
  const Mask<S> lit = integral.begin(shading);
  if (!any_lane(lit)) return nothing;
  if constexpr (requires {
                  outline.elements();
                  integral.least_distance2();
                }) {
    const auto beyond = outline.distance2() > outline.deviation2() * integral.least_distance2();
    if (any_lane(lit && beyond)) return integrate_small(outline, shading, integral, lit);
  }
  return select(lit, integrate_edges(outline, shading, integral), nothing);
}

}  // namespace integrals
STERADIAN_END_ISA

// The sum of any function of an edge over an outline clipped to the horizon.

STERADIAN_BEGIN_ISA
namespace integrals {

// share(a, b): contribution of an edge that is not below the horizon, a Real<S>. x: the sum, in walk order.
template <class S, class Share>
class EdgeSum {
 public:
  static constexpr Clip kClip = Clip::horizon;
  using vec3 = typename Kernels<S>::vec3;

  STERADIAN_INLINE explicit EdgeSum(Share share) : share_(share) {}
  STERADIAN_INLINE Mask<S> begin(const Shading<S>& shading) {
    sum_ = 0.0;
    return shading.lit;
  }
  STERADIAN_INLINE vec3 end(const vec3& u) const { return u; }
  STERADIAN_INLINE void add(const vec3& a, const vec3& b) { sum_ += share_(a, b); }
  STERADIAN_INLINE Part<S> finish(Mask<S>) { return {sum_, Real<S>(0.0)}; }

 private:
  Share share_;
  Real<S> sum_{0.0};
};

template <class S, class Outline, class Share>
Real<S> sum_over_edges(const Outline& outline, Share share) {
  EdgeSum<S, Share> integral(share);
  return integrate(outline, shading_from<S>(1, {0.0, 0.0, 1.0}), integral).x;
}

}  // namespace integrals
STERADIAN_END_ISA
