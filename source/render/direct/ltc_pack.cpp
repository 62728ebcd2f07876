#include "integrals/ggx/ltc.h"
#include "render/direct/lobe_loop_pack.h"
#include "render/direct/ltc_lobes_pack.h"

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

// About where a round light's corners gather: the mirrored view and GGX's width, or peak and width of a table's own lobe (lobes/fitted.h).
STERADIAN_INLINE AboutLobe about(const Lobe& lobe, const PackVec3& view, const PackReal& roughness, bool fitted) {
  if (!fitted) return {PackVec3(-view.x, PackReal(0.0), view.z), PackReal(2.0) * roughness * roughness, 12};
  const auto& m = lobe.matrix;
  const PackReal minor = m.xx * m.zz - m.xz * m.zx, over = inversesqrt(max(m.xz * m.xz + m.xx * m.xx, PackReal(1e-30)));
  return {PackVec3(-m.xz * over, PackReal(0.0), m.xx * over), min(minor * over * min(over, PackReal(1.0) / m.yy), PackReal(1.0)), 12};
}

template <bool with_diffuse, class Decode>
__attribute__((flatten, noinline)) void run(const PackLight& light, const Points& points, const LtcPackTables& tables,
                                            const LobeRadiance& result, const Decode& decode) {
  for_each_pack(light, points, result, [&](std::size_t i, const PackVec3& p, const SeenLight& seen) {
    const LobesHere here(points, i, tables, decode);
    const Lobe lobe = here.lobe();
    const PackKernels::mat3& frame = here.frame;
    const PackVec3& view = here.view;

    Both both = {PackVec3(0.0, 0.0, 0.0), {PackReal(0.0), PackReal(0.0)}};
    if (any_lane(seen.lit)) {
      const AboutLobe about_lobe = about(lobe, view, here.roughness, tables.fitted);
      const PolygonOutline polygon = {{seen, frame, p}};
      both = light.is_round()    ? integrate_round<with_diffuse>(seen, frame, p, view, lobe, about_lobe)
             : light.is_pieces() ? integrate_pieces<with_diffuse>(seen, frame, view, lobe)
             : polygon.may_be_small(PackKernels().light_elements_transformed().least_distance2)
                 ? integrate_polygon<with_diffuse>(polygon, view, lobe)
                 : integrate_polygon<with_diffuse>(PolygonEdges{seen, frame, p}, view, lobe);
      if (here.any_fresnel()) {
        const Lobe fresnel = here.fresnel();
        both.specular.y = (light.is_round()    ? integrate_round<false>(seen, frame, p, view, fresnel, about_lobe)
                           : light.is_pieces() ? integrate_pieces<false>(seen, frame, view, fresnel)
                                               : integrate_polygon<false>(polygon, view, fresnel))
                              .specular.x;
      }
    }
    if (with_diffuse) store(result.irradiance + i, irradiance_below(both.irradiance, view, fresnel_loss(points, i)));
    return both.specular;
  });
}

// A light without extent: the lobe in its direction, times the incident light. It is the limit of a small light's elements.
template <class Decode>
__attribute__((flatten, noinline)) void run_punctual(const packed::Punctual& source, const Points& points, const LtcPackTables& tables,
                                                     const LobeRadiance& result, const Decode& decode) {
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const LobesHere here(points, i, tables, decode);
    const auto incident = shapes::incident<Pack>(source, load(points.position, i));
    const PackVec3 l = transform_transposed(here.frame, incident.direction);
    const auto lit = l.z > PackReal(0.0) && here.view.z > PackReal(0.0);
    const PackReal light = select(lit, incident.irradiance, PackReal(0.0));
    const auto sent = [&](const Lobe& lobe) { return integrals::value_of(lobe, light * PackKernels().ltc_lobe(lobe.matrix, l)); };
    auto part = sent(here.lobe());
    if (here.any_fresnel()) part.y = sent(here.fresnel()).x;
    store(result.plain + i, part.x);
    store(result.fresnel + i, part.y);
  }
}

}  // namespace

void ltc_on_packs(const PackLight& light, const Points& points, const PackLobe& lobe, const LobeRadiance& result) {
  const LtcPackTables& tables = *lobe.tables;
  with_decoding(tables, [&](const auto& decode) {
    if (result.irradiance != nullptr)
      run<true>(light, points, tables, result, decode);
    else
      run<false>(light, points, tables, result, decode);
  });
}

void punctual_ltc_on_packs(const PackLight& light, const Points& points, const PackLobe& lobe, const LobeRadiance& result) {
  with_decoding(*lobe.tables, [&](const auto& decode) {
    run_punctual(*std::get_if<packed::Punctual>(&light.shape), points, *lobe.tables, result, decode);
  });
}

STERADIAN_END_ISA
