#include "render/bounce/pairs.h"

#include "render/bounce/lobe_pack.h"
#include "render/bounce/receivers/arrays_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using K = PackKernels;
using indirect::GgxPairLight;
using indirect::IncomingLight;
using indirect::PairLight;
using indirect::Receivers;

template <bool schlick>
STERADIAN_INLINE void sum_ltc(const PairLight* lights, std::size_t count, const Receivers& receivers, const LtcPackTables& tables,
                              IncomingLight& light) {
  K k;
  for (std::size_t i = 0; i < receivers.alpha.size(); i += kLanes) {
    const PackVec3 p = load_at(receivers.position, i), n = load_at(receivers.normal, i);
    const SeenLobe seen = look_up_lobe(tables, n, load_at(receivers.view, i), load(receivers.alpha.data() + i));
    const auto lobe = k.indirect_lobe(seen.matrix, seen.frame);
    PackVec3 diffuse(0.0, 0.0, 0.0), glossy(0.0, 0.0, 0.0);
    for (std::size_t j = 0; j < count; ++j) {
      const PairLight& l = lights[j];
      const PackVec3 v = broadcast(l.position) - p;
      K::IndirectLobe from;
      from.x = broadcast(l.row_x);
      from.y = broadcast(l.row_y);
      from.z = broadcast(l.row_z);
      const auto pair = k.indirect_pair(v, n, lobe, broadcast(l.normal), from);
      PackVec3 shine = broadcast(l.glossy);
      if constexpr (schlick) shine = shine + broadcast(l.grazing) * k.indirect_grazing(broadcast(l.incoming), v, dot(v, v));
      const PackVec3 out = broadcast(l.diffuse) * pair.from_diffuse + shine * pair.from_glossy;
      diffuse = diffuse + out * pair.to_diffuse;
      glossy = glossy + out * pair.to_glossy;
    }
    store_at(light.diffuse, i, diffuse);
    store_at(light.glossy, i, glossy * lobe.scale);
  }
}

__attribute__((flatten)) void ltc(const PairLight* lights, std::size_t count, const Receivers& receivers, const LtcPackTables& tables,
                                  IncomingLight& light) {
  sum_ltc<false>(lights, count, receivers, tables, light);
}
__attribute__((flatten)) void ltc_schlick(const PairLight* lights, std::size_t count, const Receivers& receivers,
                                          const LtcPackTables& tables, IncomingLight& light) {
  sum_ltc<true>(lights, count, receivers, tables, light);
}

__attribute__((flatten)) void ltc_outgoing(const GgxPairLight* lights, std::size_t count, const Receivers& receivers,
                                           const LtcPackTables& tables, IncomingLight& light) {
  K k;
  for (std::size_t i = 0; i < receivers.alpha.size(); i += kLanes) {
    const PackVec3 p = load_at(receivers.position, i), n = load_at(receivers.normal, i);
    const SeenLobe seen = look_up_lobe(tables, n, load_at(receivers.view, i), load(receivers.alpha.data() + i));
    const auto lobe = k.indirect_lobe(seen.matrix, seen.frame);
    PackVec3 diffuse(0.0, 0.0, 0.0), glossy(0.0, 0.0, 0.0);
    for (std::size_t j = 0; j < count; ++j) {
      const GgxPairLight& l = lights[j];
      const K::IndirectWay way = k.indirect_way(broadcast(l.position), p);
      const K::mat3 from(broadcast(l.frame_x), broadcast(l.frame_y), broadcast(l.normal));
      const PackVec3 away = transform_transposed(from, way.v * -way.inverse);
      const auto end = look_up_outgoing(tables, away, l.view_x, l.view_z, l.alpha);
      const PackReal cosine = max(dot(n, way.v), PackReal(0.0)) * way.inverse;
      const PackVec3 out =
          (broadcast(l.diffuse) * max(away.z, PackReal(0.0)) + (broadcast(l.glossy) + broadcast(l.grazing) * end.grazing) * end.lobe) *
          (way.inverse * way.inverse);
      diffuse = diffuse + out * cosine;
      const PackReal half = k.indirect_glossy_half(lobe, way.v, way.d2, PackReal(0.0)) * (way.d2 * way.inverse);
      glossy = glossy + out * select(cosine > PackReal(0.0), half, PackReal(0.0));
    }
    store_at(light.diffuse, i, diffuse);
    store_at(light.glossy, i, glossy * lobe.scale);
  }
}

__attribute__((flatten)) void ggx(const GgxPairLight* lights, std::size_t count, const Receivers& receivers, IncomingLight& light) {
  K k;
  for (std::size_t i = 0; i < receivers.alpha.size(); i += kLanes) {
    const PackVec3 p = load_at(receivers.position, i), n = load_at(receivers.normal, i), view = load_at(receivers.view, i);
    const PackReal alpha = load(receivers.alpha.data() + i);
    const PackVec3 f0 = load_at(receivers.f0, i), rest = load_at(receivers.f90, i) - f0;
    const auto frame = k.frame_from_normal_and_view(n, view);
    const PackVec3 seen = transform_transposed(frame, view);
    PackVec3 diffuse(0.0, 0.0, 0.0), glossy(0.0, 0.0, 0.0);
    for (std::size_t j = 0; j < count; ++j) {
      const GgxPairLight& l = lights[j];
      const PackVec3 v = broadcast(l.position) - p;
      const PackReal inverse = inversesqrt(max(dot(v, v), PackReal(1.0e-20)));
      const PackVec3 u = v * inverse;
      const K::mat3 from(broadcast(l.frame_x), broadcast(l.frame_y), broadcast(l.normal));
      const auto out_end = k.indirect_ggx(from, PackVec3(broadcast(l.view_x), PackReal(0.0), broadcast(l.view_z)), broadcast(l.alpha), -u);
      const auto in_end = k.indirect_ggx(frame, seen, alpha, u);
      const PackReal cosine = max(-dot(from.c2, u), PackReal(0.0));
      const PackVec3 out = (broadcast(l.diffuse) * cosine + (broadcast(l.glossy) + broadcast(l.grazing) * out_end.grazing) * out_end.lobe) *
                           (inverse * inverse);
      diffuse = diffuse + out * max(dot(n, u), PackReal(0.0));
      const PackVec3 f = (f0 + rest * in_end.grazing) * in_end.lobe;
      glossy = glossy + PackVec3(out.x * f.x, out.y * f.y, out.z * f.z);
    }
    store_at(light.diffuse, i, diffuse);
    store_at(light.glossy, i, glossy);
  }
}

}  // namespace

const indirect::PairTable& pair_table() {
  static constexpr indirect::PairTable table = {ltc, ltc_schlick, ltc_outgoing, ggx};
  return table;
}

STERADIAN_END_ISA
