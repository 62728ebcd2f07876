#include "integrals/ggx/half_vector.h"

#include "render/direct/half_vector.h"
#include "render/direct/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace {

// A lobe, the width about which a round light's corners gather, and its tangent.
template <class Arcs>
struct LobeHere {
  Arcs arcs;
  PackReal width;
  PackVec3 tangent;
};

// lobe_at(i): the lobe for the points from i on.
template <class LobeAt>
__attribute__((flatten)) void radiance(const PackLight& light, const Points& points, const HalfVectorOptions& options, LobeAt lobe_at,
                                       float* plain, float* fresnel) {
  PackKernels k;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i), n = load(points.normal, i), v = load(points.view, i);
    const SeenLight seen(light, p, i);
    integrals::Part<Pack> r{PackReal(0.0), PackReal(0.0)};
    if (any_lane(seen.lit && dot(n, v) > PackReal(0.0))) {
      const auto lobe = lobe_at(i);
      const auto frame = k.frame_from_normal_and_view(n, lobe.tangent);
      const PackVec3 view = transform_transposed(frame, v);
      integrals::HalfVector<Pack, decltype(lobe.arcs)> integral(lobe.arcs, options);
      const AboutLobe about = {k.phong_mirror(view), lobe.width, options.arcs > 4 ? 16 : 12};
      r = integrate(AnyOutline{{seen, frame, p, about}}, seen.shading(view), integral);
    }
    store(plain + i, r.x);
    if (fresnel != nullptr) store(fresnel + i, r.y);
  }
}

void ggx(const PackLight& light, const Points& points, const HalfVectorOptions& options, float* plain, float* fresnel) {
  const auto lobe_at = [&](std::size_t i) {
    const PackReal ax = load(points.alpha_x + i), ay = load(points.alpha_y + i);
    return LobeHere<integrals::GgxHalfVectorArcs<Pack>>{{ax, ay, PackReal(1.0)}, PackReal(2.0) * max(ax, ay), load(points.tangent, i)};
  };
  radiance(light, points, options, lobe_at, plain, fresnel);
}

void lobe(const PackLight& light, const Points& points, const Material& m, const HalfVectorOptions& options, float* result) {
  const auto run = [&](const auto& arcs, double width) {
    const auto lobe_at = [&](std::size_t i) {
      return LobeHere<std::decay_t<decltype(arcs)>>{
          arcs, PackReal(width), m.tangent == Vec3d{} ? load(points.tangent, i) : broadcast(static_cast<Vec3f>(m.tangent))};
    };
    radiance(light, points, options, lobe_at, result, nullptr);
  };
  if (m.brdf == Brdf::beckmann)
    run(integrals::BeckmannArcs<Pack>{PackReal(m.alpha_x), PackReal(m.alpha_y)}, 2 * std::max(m.alpha_x, m.alpha_y));
  else
    run(integrals::BlinnPhongArcs<Pack>(m.exponent), 2 / std::sqrt(m.exponent + 1));
}

}  // namespace

const HalfVectorTable& half_vector_table() {
  static constexpr HalfVectorTable table = {ggx, lobe};
  return table;
}

STERADIAN_END_ISA
