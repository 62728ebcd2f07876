// The loop over packs of points that every lobe runs, and the functions of LobePacks.
#pragma once

#include "render/direct/lobe_packs.h"
#include "render/direct/seen_light_pack.h"

STERADIAN_BEGIN_ISA

#define STERADIAN_DECLARE_LOBE(name) \
  void name##_on_packs(const PackLight& light, const Points& points, const PackLobe& lobe, const LobeRadiance& result);
STERADIAN_PROCEDURES(STERADIAN_DECLARE_LOBE)
STERADIAN_DECLARE_LOBE(punctual_ltc)
#undef STERADIAN_DECLARE_LOBE

// radiance_at(i, p, seen): plain and fresnel of the points from i on, whose positions are p. A caller asks the compiler to flatten it, so
// that the loop and the integral stand in one function.
template <class RadianceAt>
void for_each_pack(const PackLight& light, const Points& points, const LobeRadiance& result, const RadianceAt& radiance_at) {
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i);
    const SeenLight seen(light, p, i);
    const integrals::Part<Pack> r = radiance_at(i, p, seen);
    store(result.plain + i, r.x);
    if (result.fresnel != nullptr) store(result.fresnel + i, r.y);
  }
}

// A lobe at a pack of points: its frame, the view in it, where a round light's corners gather, and its integral.
template <class Integral>
struct LobeHere {
  PackKernels::mat3 frame;
  PackVec3 view;
  AboutLobe about;
  Integral integral;
};

// lobe_at(i, n, v): the lobe of the points from i on, whose normals are n and views v.
template <class LobeAt>
void integrate_lobe(const PackLight& light, const Points& points, const LobeRadiance& result, const LobeAt& lobe_at) {
  for_each_pack(light, points, result, [&](std::size_t i, const PackVec3& p, const SeenLight& seen) {
    const PackVec3 n = load(points.normal, i), v = load(points.view, i);
    integrals::Part<Pack> r{PackReal(0.0), PackReal(0.0)};
    if (any_lane(seen.lit && dot(n, v) > PackReal(0.0))) {
      auto here = lobe_at(i, n, v);
      r = integrate(AnyOutline{{seen, here.frame, p, here.about}}, seen.shading(here.view), here.integral);
    }
    return r;
  });
}

STERADIAN_END_ISA
