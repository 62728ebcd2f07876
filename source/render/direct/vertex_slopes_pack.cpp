#include "render/direct/vertex_slopes.h"

#include "integrals/phong/phong.h"
#include "render/direct/ltc_lobes_pack.h"
#include "render/direct/vertex_slopes_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using slopes::FrameSlopes;
using slopes::PolygonHere;

// Stores a derivative by a vertex in the world's frame.
struct VertexPlanes {
  float* to;
  std::size_t count, first;

  STERADIAN_INLINE float* at(std::size_t vertex, std::size_t axis) const { return to + (3 * vertex + axis) * count + first; }
  STERADIAN_INLINE void put(std::size_t vertex, const PackKernels::mat3& frame, const PackVec3& d) const {
    const PackVec3 world = transform(frame, d);
    store(at(vertex, 0), world.x);
    store(at(vertex, 1), world.y);
    store(at(vertex, 2), world.z);
  }
  STERADIAN_INLINE void multiply(std::size_t vertices, PackReal by) const {
    for (std::size_t i = 0; i < 3 * vertices; ++i) store(at(0, i), load(at(0, i)) * by);
  }
};

// A function for each case: without a boundary above the lobe, the irradiance's other components are not computed.
template <bool with_boundary>
__attribute__((flatten, noinline)) void run_diffuse(const PackLight& light, const Points& points, const VertexSlopes& result) {
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i);
    const SeenLight seen(light, p, i);
    const auto frame = PackKernels().frame_from_normal(load(points.normal, i));
    const VertexPlanes planes = {result.plain, points.count, i};
    const PolygonHere here(seen, frame, p);
    const PackVec3 e = slopes::walk_irradiance(here, seen.reversed, [&](std::size_t v, const PackVec3& d) { planes.put(v, frame, d); });
    PackReal below(1.0);
    if constexpr (with_boundary) {
      const PackVec3 view = transform_transposed(frame, load(points.view, i));
      below = PackReal(1.0) - fresnel_loss(points, i) * PackKernels().lambert_grazing_of_light(e, view);
      planes.multiply(here.polygon.vertices.size(), below);
    }
    store(result.value.plain + i, select(seen.lit, e.z * below, PackReal(0.0)));
  }
}

void diffuse(const PackLight& light, const Points& points, const PackLobe&, const VertexSlopes& result) {
  if (points.fresnel_loss != nullptr)
    run_diffuse<true>(light, points, result);
  else
    run_diffuse<false>(light, points, result);
}

template <class Decode>
__attribute__((flatten, noinline)) void run_ltc(const PackLight& light, const Points& points, const LtcPackTables& tables,
                                                const VertexSlopes& result, const Decode& decode) {
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i);
    const SeenLight seen(light, p, i);
    const LobesHere here(points, i, tables, decode);
    const auto lobe = here.lobe();
    const VertexPlanes plain = {result.plain, points.count, i}, fresnel = {result.fresnel, points.count, i};
    auto shows = seen;
    shows.lit = seen.lit && here.view.z > PackReal(0.0);
    const PackReal value =
        slopes::walk_ltc(PolygonHere(shows, here.frame, p), seen.reversed, lobe.matrix, [&](std::size_t v, const PackVec3& d) {
          plain.put(v, here.frame, d * lobe.n_a);
          if (result.fresnel != nullptr) fresnel.put(v, here.frame, d * lobe.f_a);
        });
    const auto both = integrals::value_of(lobe, select(shows.lit, value, PackReal(0.0)));
    store(result.value.plain + i, both.x);
    store(result.value.fresnel + i, both.y);
  }
}

void ltc(const PackLight& light, const Points& points, const PackLobe& lobe, const VertexSlopes& result) {
  with_decoding(*lobe.tables, [&](const auto& decode) { run_ltc(light, points, *lobe.tables, result, decode); });
}

template <class Share>
__attribute__((flatten, noinline)) void run_phong(const Share& share, const PackLight& light, const Points& points, const PackLobe& lobe,
                                                  const VertexSlopes& result) {
  integrals::PhongIntegral<Pack, Share> integral(share, lobe.lobe.exponent, lobe.options);
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i);
    SeenLight seen(light, p, i);
    const auto frame = PackKernels().frame_from_normal(load(points.normal, i));
    const PackVec3 view = transform_transposed(frame, load(points.view, i));
    seen.lit = seen.lit && view.z > PackReal(0.0);
    const auto shading = seen.shading(view);
    integral.begin(shading);
    const auto value = integrals::integrate_edges(PolygonEdges{seen, frame, p}, shading, integral);
    store(result.value.plain + i, select(seen.lit, value.x, PackReal(0.0)));
    const VertexPlanes plain = {result.plain, points.count, i};
    slopes::walk_phong_slopes(PolygonHere(seen, frame, p), PackKernels().phong_mirror(view), lobe.lobe.exponent,
                              [&](std::size_t v, const PackVec3& d) { plain.put(v, frame, d); });
  }
}

void phong(const PackLight& light, const Points& points, const PackLobe& lobe, const VertexSlopes& result) {
  const integrals::PhongLobe<Pack> of(lobe.lobe.exponent, lobe.options);
  const auto by = [&]<Quality quality>() {
    run_phong([&](const auto& a, const auto& b, const auto& axis) { return of.template share<Method::series, quality>(a, b, axis); }, light,
              points, lobe, result);
  };
  if (lobe.options.quality == Quality::high)
    by.template operator()<Quality::high>();
  else
    by.template operator()<Quality::normal>();
}

__attribute__((flatten)) void closed_form(const PackLight& light, const Points& points, const PackLobe& lobe, const VertexSlopes& result) {
  integrals::GgxIntegral<Pack> integral;  // one for all points: it keeps its memory
  integral.quality = lobe.options.quality;
  std::vector<const PackKernels::ConicArc*> arcs;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i);
    SeenLight seen(light, p, i);
    const auto frame = PackKernels().frame_from_normal_and_view(load(points.normal, i), load(points.tangent, i));
    const PackVec3 view = transform_transposed(frame, load(points.view, i));
    seen.lit = seen.lit && view.z > PackReal(0.0);
    integral.alpha_x = load(points.alpha_x + i);
    integral.alpha_y = load(points.alpha_y + i);
    const auto shading = seen.shading(view);
    integral.begin(shading);
    const auto value = integrals::integrate_edges(PolygonEdges{seen, frame, p}, shading, integral);
    store(result.value.plain + i, select(seen.lit, value.x, PackReal(0.0)));
    store(result.value.fresnel + i, select(seen.lit, value.y, PackReal(0.0)));
    arcs.clear();
    integral.each_edge([&](const PackKernels::ConicArc& arc) { arcs.push_back(&arc); });
    const VertexPlanes plain = {result.plain, points.count, i}, fresnel = {result.fresnel, points.count, i};
    std::size_t edge = 0;
    slopes::walk_ggx_slopes(
        PolygonHere(seen, frame, p), integral.view(), integral.smith, [&](const auto&) { return *arcs[edge++]; },
        [&](std::size_t v, const FrameSlopes& d) {
          plain.put(v, frame, d.plain);
          fresnel.put(v, frame, d.fresnel);
        });
  }
}

}  // namespace

const VertexSlopePacks& vertex_slope_packs() {
  static constexpr VertexSlopePacks table = {diffuse, ltc, phong, closed_form};
  return table;
}

STERADIAN_END_ISA
