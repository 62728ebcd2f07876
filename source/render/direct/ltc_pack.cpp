#include "integrals/ggx/ltc.h"
#include "render/direct/lobe_loop_pack.h"
#include "render/direct/table_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using Lobe = integrals::LtcLobe<Pack>;

struct Both {
  PackVec3 irradiance;
  integrals::Part<Pack> specular;
};

// Walks once, for both lobes or for one.
template <bool with_diffuse, class Outline>
STERADIAN_INLINE Both integrate_over(const Outline& outline, const integrals::Shading<Pack>& shading, const Lobe& lobe) {
  if constexpr (with_diffuse) {
    integrals::Together<integrals::Irradiance<Pack>, integrals::Ltc<Pack>> both{{}, integrals::Ltc<Pack>(lobe)};
    const auto r = integrate(outline, shading, both);
    return {r.first, r.second};
  } else {
    integrals::Ltc<Pack> ltc(lobe);
    return {PackVec3(0.0, 0.0, 0.0), integrate(outline, shading, ltc)};
  }
}

// These are functions of their own, so that each holds one walk in registers.
template <bool with_diffuse, class Outline>
__attribute__((flatten, noinline)) Both integrate_polygon(const Outline& outline, const PackVec3& view, const Lobe& lobe) {
  return integrate_over<with_diffuse>(outline, outline.seen.shading(view), lobe);
}

template <bool with_diffuse>
__attribute__((flatten, noinline)) Both integrate_round(const SeenLight& seen, const PackKernels::mat3& frame, const PackVec3& p,
                                                        const PackVec3& view, const Lobe& lobe, const AboutLobe& about) {
  return integrate_over<with_diffuse>(RoundOutline{seen, frame, p, about}, seen.shading(view), lobe);
}

template <bool with_diffuse>
__attribute__((flatten, noinline)) Both integrate_pieces(const SeenLight& seen, const PackKernels::mat3& frame, const PackVec3& view,
                                                         const Lobe& lobe) {
  return integrate_over<with_diffuse>(PiecesOutline{seen, frame}, seen.shading(view), lobe);
}

template <bool with_diffuse, class Decode>
__attribute__((flatten, noinline)) void run(const PackLight& light, const Points& points, const LtcPackTables& tables,
                                            const LobeRadiance& result, const Decode& decode) {
  for_each_pack(light, points, result, [&](std::size_t i, const PackVec3& p, const SeenLight& seen) {
    PackKernels k;
    const PackVec3 n = load(points.normal, i), v = load(points.view, i);
    const PackReal roughness = sqrt(load(points.alpha_x + i));
    const auto frame = k.frame_from_normal_and_view(n, v);
    const PackReal c = dot(n, v);
    const PackVec3 view(dot(frame.c0, v), PackReal(0.0), c);
    const auto coordinates = k.ltc_coordinates(roughness, c);
    const auto lobe_of = [&](const PackTable& matrix, const PackTable& magnitude) {
      const auto scale = look_up(magnitude.nodes.data(), magnitude.size, coordinates.x, coordinates.y);
      return Lobe{decode(look_up(matrix.nodes.data(), matrix.size, coordinates.x, coordinates.y), roughness, view), scale.x, scale.y};
    };
    const Lobe lobe = lobe_of(tables.matrix, tables.magnitude);

    Both both = {PackVec3(0.0, 0.0, 0.0), {PackReal(0.0), PackReal(0.0)}};
    if (any_lane(seen.lit)) {
      const AboutLobe about = {PackVec3(-view.x, PackReal(0.0), c), PackReal(2.0) * roughness * roughness, 12};
      const PolygonOutline polygon = {{seen, frame, p}};
      both = light.is_round()    ? integrate_round<with_diffuse>(seen, frame, p, view, lobe, about)
             : light.is_pieces() ? integrate_pieces<with_diffuse>(seen, frame, view, lobe)
             : polygon.may_be_small(PackKernels().light_elements_transformed().least_distance2)
                 ? integrate_polygon<with_diffuse>(polygon, view, lobe)
                 : integrate_polygon<with_diffuse>(PolygonEdges{seen, frame, p}, view, lobe);
      if (tables.fresnel_matrix.size > 0) {
        const Lobe fresnel = lobe_of(tables.fresnel_matrix, tables.fresnel_magnitude);
        both.specular.y = (light.is_round()    ? integrate_round<false>(seen, frame, p, view, fresnel, about)
                           : light.is_pieces() ? integrate_pieces<false>(seen, frame, view, fresnel)
                                               : integrate_polygon<false>(polygon, view, fresnel))
                              .specular.x;
      }
    }
    if (with_diffuse) store(result.irradiance + i, irradiance_below(both.irradiance, view, fresnel_loss(points, i)));
    return both.specular;
  });
}

}  // namespace

void ltc_on_packs(const PackLight& light, const Points& points, const PackLobe& lobe, const LobeRadiance& result) {
  const LtcPackTables& tables = *lobe.tables;
  const auto by = [&](const auto& decode) {
    if (result.irradiance != nullptr)
      run<true>(light, points, tables, result, decode);
    else
      run<false>(light, points, tables, result, decode);
  };
  if (tables.compact)
    by([](const PackKernels::vec4& e, PackReal roughness, const PackVec3& view) {
      return PackKernels{}.ltc_from_compact(e, max(roughness * roughness, PackReal(1.0e-4)), view);
    });
  else
    by([](const PackKernels::vec4& t, PackReal, const PackVec3&) { return PackKernels{}.ltc_from_classic(t); });
}

STERADIAN_END_ISA
