#include <algorithm>
#include <cmath>
#include <type_traits>

#include "integrals/ggx/charlie.h"
#include "integrals/ggx/ggx.h"
#include "integrals/ggx/half_vector.h"
#include "integrals/ggx/ltc.h"
#include "integrals/ggx/representative_point.h"
#include "integrals/methods.h"
#include "render/direct/lobe_loop_pack.h"
#include "render/direct/table_pack.h"

STERADIAN_BEGIN_ISA

__attribute__((flatten)) void diffuse_on_packs(const PackLight& light, const Points& points, const PackLobe&, const LobeRadiance& result) {
  for_each_pack(light, points, result, [&](std::size_t i, const PackVec3& p, const SeenLight& seen) {
    integrals::Part<Pack> r{PackReal(0.0), PackReal(0.0)};
    if (!any_lane(seen.lit)) return r;
    const auto frame = PackKernels().frame_from_normal(load(points.normal, i));
    if (points.fresnel_loss == nullptr) {
      r.x = irradiance_of(seen, frame, p);
    } else {
      const PackVec3 e = irradiance_vector(seen, frame, p), view = transform_transposed(frame, load(points.view, i));
      r.x = irradiance_below(e, view, fresnel_loss(points, i));
    }
    return r;
  });
}

__attribute__((flatten)) void closed_form_on_packs(const PackLight& light, const Points& points, const PackLobe& lobe,
                                                   const LobeRadiance& result) {
  const Quality quality = lobe.options.quality;
  integrals::GgxIntegral<Pack> integral;  // one for all points: it keeps its memory
  integral.quality = quality;
  integrate_lobe(light, points, result, [&](std::size_t i, const PackVec3& n, const PackVec3& v) {
    PackKernels k;
    // x is the part of the tangent that is perpendicular to the normal, or any direction if there is none.
    const auto frame = k.frame_from_normal_and_view(n, load(points.tangent, i));
    const PackVec3 view = transform_transposed(frame, v);
    integral.alpha_x = load(points.alpha_x + i);
    integral.alpha_y = load(points.alpha_y + i);
    const AboutLobe about = {k.phong_mirror(view), PackReal(2.0) * max(integral.alpha_x, integral.alpha_y),
                             quality == Quality::high ? 16 : 12};
    return LobeHere<integrals::GgxIntegral<Pack>&>{frame, view, about, integral};
  });
}

__attribute__((flatten)) void sheen_on_packs(const PackLight& light, const Points& points, const PackLobe&, const LobeRadiance& result) {
  integrals::CharlieIntegral<Pack> integral;  // as above
  integrate_lobe(light, points, result, [&](std::size_t i, const PackVec3& n, const PackVec3& v) {
    const auto frame = PackKernels().frame_from_normal(n);
    integral.alpha = load(points.alpha_x + i);
    // About the normal, and wide: the lobe has no peak for a round light's corners to gather about.
    const AboutLobe about = {PackVec3(0.0, 0.0, 1.0), PackReal(1.0), 12};
    return LobeHere<integrals::CharlieIntegral<Pack>&>{frame, transform_transposed(frame, v), about, integral};
  });
}

namespace {

// The methods for comparison. integral_at(i, view): the integral for the points from i on, whose view is (s, 0, c).
template <class IntegralAt>
void compare(const PackLight& light, const Points& points, const LobeRadiance& result, const IntegralAt& integral_at) {
  integrate_lobe(light, points, result, [&](std::size_t i, const PackVec3& n, const PackVec3& v) {
    const auto frame = PackKernels().frame_from_normal_and_view(n, v);
    const PackReal c = dot(n, v);
    const PackVec3 view(dot(frame.c0, v), PackReal(0.0), c);
    const AboutLobe about = {PackVec3(-view.x, PackReal(0.0), c), PackReal(2.0) * load(points.alpha_x + i), 12};
    return LobeHere<decltype(integral_at(i, view))>{frame, view, about, integral_at(i, view)};
  });
}

}  // namespace

__attribute__((flatten)) void ltc_clipless_on_packs(const PackLight& light, const Points& points, const PackLobe& lobe,
                                                    const LobeRadiance& result) {
  compare(light, points, result, [&](std::size_t i, const PackVec3& view) {
    PackKernels k;
    const auto at = k.ltc_coordinates(sqrt(load(points.alpha_x + i)), view.z);
    const auto look = [&](const PackTable& t) { return look_up(t.nodes.data(), t.size, at.x, at.y); };
    const auto scale = look(lobe.tables->magnitude);
    return integrals::CliplessLtc<Pack>({k.ltc_from_classic(look(lobe.tables->matrix)), scale.x, scale.y});
  });
}

__attribute__((flatten)) void representative_point_on_packs(const PackLight& light, const Points& points, const PackLobe&,
                                                            const LobeRadiance& result) {
  compare(light, points, result,
          [&](std::size_t i, const PackVec3&) { return integrals::RepresentativePoint<Pack>(load(points.alpha_x + i)); });
}

namespace {

// Arcs in half-vector space, the width about which a round light's corners gather, and the lobe's tangent.
template <class Arcs>
struct ArcsHere {
  Arcs arcs;
  PackReal width;
  PackVec3 tangent;
};

// A function for each kind of arcs. arcs_at(i): the arcs of the points from i on.
template <class ArcsAt>
__attribute__((flatten, noinline)) void walk_half_vectors(const PackLight& light, const Points& points, const HalfVectorOptions& options,
                                                          const LobeRadiance& result, const ArcsAt& arcs_at) {
  integrate_lobe(light, points, result, [&](std::size_t i, const PackVec3& n, const PackVec3& v) {
    PackKernels k;
    const auto lobe = arcs_at(i);
    const auto frame = k.frame_from_normal_and_view(n, lobe.tangent);
    const PackVec3 view = transform_transposed(frame, v);
    const AboutLobe about = {k.phong_mirror(view), lobe.width, options.arcs > 4 ? 16 : 12};
    using Integral = integrals::HalfVector<Pack, std::decay_t<decltype(lobe.arcs)>>;
    return LobeHere<Integral>{frame, view, about, Integral(lobe.arcs, options)};
  });
}

}  // namespace

// GGX, Beckmann's or Blinn and Phong's lobe.
void half_vector_on_packs(const PackLight& light, const Points& points, const PackLobe& lobe, const LobeRadiance& result) {
  const Material& m = lobe.lobe;
  const HalfVectorOptions options = methods::half_vector_options(lobe.options.quality);
  const auto one_for_all = [&](const auto& arcs, double width) {
    walk_half_vectors(light, points, options, result, [&](std::size_t i) {
      return ArcsHere<std::decay_t<decltype(arcs)>>{
          arcs, PackReal(width), m.tangent == Vec3d{} ? load(points.tangent, i) : broadcast(static_cast<Vec3f>(m.tangent))};
    });
  };
  if (m.brdf == Brdf::beckmann)
    one_for_all(integrals::BeckmannArcs<Pack>{PackReal(m.alpha_x), PackReal(m.alpha_y)}, 2 * std::max(m.alpha_x, m.alpha_y));
  else if (m.brdf == Brdf::blinn_phong)
    one_for_all(integrals::BlinnPhongArcs<Pack>(m.exponent), 2 / std::sqrt(m.exponent + 1));
  else
    walk_half_vectors(light, points, options, result, [&](std::size_t i) {
      const PackReal ax = load(points.alpha_x + i), ay = load(points.alpha_y + i);
      return ArcsHere<integrals::GgxHalfVectorArcs<Pack>>{{ax, ay, PackReal(1.0)}, PackReal(2.0) * max(ax, ay), load(points.tangent, i)};
    });
}

namespace {

using K = PackKernels;

// GGX under a punctual light: the lobe times the incident light.
__attribute__((flatten)) void punctual_ggx(const PackLight& light, const Points& points, const PackLobe&, const LobeRadiance& result) {
  K k;
  const packed::Punctual& source = *std::get_if<packed::Punctual>(&light.shape);
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const auto frame = k.frame_from_normal_and_view(load(points.normal, i), load(points.tangent, i));
    const PackVec3 v = transform_transposed(frame, load(points.view, i));
    const auto incident = shapes::incident<Pack>(source, load(points.position, i));
    const PackVec3 l = transform_transposed(frame, incident.direction);
    const PackReal lobe = incident.irradiance * k.ggx_lobe(l, v, load(points.alpha_x + i), load(points.alpha_y + i));
    store(result.plain + i, lobe);
    store(result.fresnel + i, lobe * k.fresnel_schlick(PackReal(0.0), PackReal(1.0), dot(v, k.microfacet_half_vector(l, v))));
  }
}

__attribute__((flatten)) void add_diffuse(SurfaceTile& tile, const PackLight* const* lights, std::size_t light_count) {
  K k;
  const Points points = points_of(tile);
  for (std::size_t i = 0; i < kTilePixels; i += kLanes) {
    const PackVec3 albedo = load(arrays_of(tile.albedo), i);
    if (!any_lane(albedo.x + albedo.y + albedo.z > PackReal(0.0))) continue;
    const PackVec3 p = load(points.position, i), n = load(points.normal, i);
    const auto frame = k.frame_from_normal(n);
    const PackVec3 v = load(points.view, i);
    const PackReal loss = fresnel_loss(points, i);
    PackVec3 irradiance(0.0, 0.0, 0.0);
    for (std::size_t l = 0; l < light_count; ++l) {
      const PackLight& light = *lights[l];
      PackReal e(0.0);
      if (const auto* source = std::get_if<packed::Punctual>(&light.shape)) {
        const auto incident = shapes::incident<Pack>(*source, p);
        e = incident.irradiance * max(dot(n, incident.direction), PackReal(0.0));
        if (any_lane(loss > PackReal(0.0))) e = e * (PackReal(1.0) - loss * k.lambert_grazing(incident.direction, v));
      } else if (const SeenLight seen(light, p, i); any_lane(seen.lit)) {
        e = any_lane(loss > PackReal(0.0))
                ? k.lambert_irradiance_below(irradiance_vector(seen, frame, p), transform_transposed(frame, v), loss)
                : irradiance_of(seen, frame, p);
      }
      irradiance = irradiance + broadcast(light.radiance) * e;
    }
    const auto add = [&](TilePlane& plane, PackReal a, PackReal e) {
      store(plane.data() + i, load(plane.data() + i) + a * k.lambert_radiance(e));
    };
    add(tile.radiance.x, albedo.x, irradiance.x);
    add(tile.radiance.y, albedo.y, irradiance.y);
    add(tile.radiance.z, albedo.z, irradiance.z);
  }
}

}  // namespace

const LobePacks& lobe_packs() {
#define STERADIAN_LOBE(name) name##_on_packs,
  static constexpr LobePacks table = {{STERADIAN_PROCEDURES(STERADIAN_LOBE)}, punctual_ggx, punctual_ltc_on_packs, add_diffuse};
#undef STERADIAN_LOBE
  return table;
}

STERADIAN_END_ISA
