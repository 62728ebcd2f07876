#include "render/bounce/lighting.h"

#include "render/bounce/lobe_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using K = PackKernels;
using indirect::BlockLists;
using indirect::DiffuseLight;
using indirect::GgxLight;
using indirect::GlossyLight;
using indirect::LightSet;
using indirect::QuadLight;

STERADIAN_INLINE PackVec3 load_vector(const indirect::VectorArray& a, std::size_t i) {
  return {load(a.x.data() + i), load(a.y.data() + i), load(a.z.data() + i)};
}

// Sums a pair's light, for the receiver's diffuse and glossy lobes.
struct PairSums {
  PackVec3 diffuse{0.0, 0.0, 0.0}, glossy{0.0, 0.0, 0.0};
  STERADIAN_INLINE void add_diffuse(const PackVec3& light, std::size_t) { diffuse = diffuse + light; }
  STERADIAN_INLINE void add_glossy(const PackVec3& light, std::size_t) { glossy = glossy + light; }
};

// Chooses one light for each lobe, with a probability proportional to its light: the light at which the running sum passes a target.
struct Picks {
  PackReal diffuse_sum{0.0}, glossy_sum{0.0};
  PackReal diffuse_target, glossy_target;
  PackReal diffuse{-1.0}, glossy{-1.0};  // exact: below 2^24
  STERADIAN_INLINE static void advance(PackReal& sum, PackReal target, PackReal& pick, const PackVec3& light, std::size_t id) {
    const PackReal before = sum;
    sum += light.x + light.y + light.z;
    pick = select(before < target && sum >= target, PackReal(static_cast<double>(id)), pick);
  }
  STERADIAN_INLINE void add_diffuse(const PackVec3& light, std::size_t id) { advance(diffuse_sum, diffuse_target, diffuse, light, id); }
  STERADIAN_INLINE void add_glossy(const PackVec3& light, std::size_t id) { advance(glossy_sum, glossy_target, glossy, light, id); }
};

struct PackReceiver {
  PackVec3 position, normal;
  K::IndirectLobe lobe;
  K::mask sharp;
};

using Way = K::IndirectWay;
STERADIAN_INLINE Way way_to(const Vec3f& light, const PackVec3& p) { return K().indirect_way(broadcast(light), p); }

__attribute__((noinline, flatten)) PackReal quad_half(const PackReceiver& at, const K::IndirectQuad& quad, const Way& way, PackReal soft,
                                                      PackReal rarity) {
  return K().indirect_quad_half(at.lobe, quad, way, soft, rarity);
}

// Adds the light of a pair; `kept` is the light's half after culling, `bright` its colour.
template <bool glossy, bool quads, class Sink>
STERADIAN_INLINE void add_pair(const PackReceiver& at, const Way& way, PackReal kept, const PackVec3& bright, const Vec3f& light_normal,
                               const QuadLight* quad, PackReal soft, PackReal value, std::size_t id, Sink& sums) {
  K k;
  const PackReal cosine = max(dot(at.normal, way.v), PackReal(0.0));
  const PackReal diffuse = kept * cosine * (way.inverse * way.inverse);
  sums.add_diffuse(bright * diffuse, id);
  if constexpr (glossy) {
    PackReal half = k.indirect_glossy_half(at.lobe, way.v, way.d2, PackReal(0.0));
    if constexpr (quads) {
      const K::IndirectQuad wide = {broadcast(light_normal), broadcast(quad->edge_x), broadcast(quad->edge_y),
                                    broadcast(quad->inverse_area), broadcast(quad->size2)};
      const auto matters = at.sharp && k.indirect_quad_matters(at.lobe, wide, way, kept, value);
      if (any_lane(matters)) half = select(matters, quad_half(at, wide, way, soft, kept / max(value, PackReal(1.0e-30))), half);
    }
    sums.add_glossy(bright * select(cosine > PackReal(0.0), kept * half, PackReal(0.0)), id);
  }
}

template <bool glossy, bool quads, class Sink>
STERADIAN_INLINE void add_diffuse_lights(const LightSet& set, const BlockLists::List& list, const PackReceiver& at, Sink& sums) {
  K k;
  for (std::size_t j = 0; j < list.count; ++j) {
    const DiffuseLight& light = set.diffuse[list.begin[j]];
    const Way way = way_to(light.position, at.position);
    const PackReal soft = broadcast(light.soft);
    const PackReal value = k.indirect_diffuse_half(broadcast(light.normal), way.v, way.d2, soft);
    const PackReal kept = k.indirect_kept(value, broadcast(light.reach) * (way.d2 * way.inverse), broadcast(light.xi));
    if (!any_lane(kept > PackReal(0.0))) continue;
    add_pair<glossy, quads>(at, way, kept, broadcast(light.bright), light.normal, &set.diffuse_quads[list.begin[j]], soft, value,
                            list.begin[j], sums);
  }
}

template <bool glossy, bool quads, class Sink>
STERADIAN_INLINE void add_glossy_lights(const LightSet& set, const BlockLists::List& list, const PackReceiver& at, Sink& sums) {
  K k;
  for (std::size_t j = 0; j < list.count; ++j) {
    const GlossyLight& light = set.glossy[list.begin[j]];
    const Way way = way_to(light.position, at.position);
    const PackReal soft = broadcast(light.soft);
    K::IndirectLobe lobe;
    lobe.x = broadcast(light.row_x);
    lobe.y = broadcast(light.row_y);
    lobe.z = broadcast(light.row_z);
    const PackReal value =
        select(dot(broadcast(light.normal), way.v) > PackReal(0.0), k.indirect_glossy_half(lobe, way.v, way.d2, soft), PackReal(0.0));
    const PackReal kept = k.indirect_kept(value, broadcast(light.reach) * (way.d2 * way.inverse), broadcast(light.xi));
    if (!any_lane(kept > PackReal(0.0))) continue;
    PackVec3 bright = broadcast(light.bright);
    if (light.by_pair > 0) bright = bright + broadcast(light.grazing) * k.indirect_grazing(broadcast(light.incoming), way.v, way.d2);
    add_pair<glossy, quads>(at, way, kept, bright, light.normal, &set.glossy_quads[list.begin[j]], soft, value,
                            set.diffuse.size() + list.begin[j], sums);
  }
}

STERADIAN_INLINE void store_vector(indirect::VectorArray& a, std::size_t i, const PackVec3& v) {
  store(a.x.data() + i, v.x);
  store(a.y.data() + i, v.y);
  store(a.z.data() + i, v.z);
}

template <bool glossy, bool quads, class Sink>
__attribute__((flatten, noinline)) Sink add_lights(const LightSet& set, const BlockLists::List& diffuse, const BlockLists::List& shiny,
                                                   const PackReceiver& receiver, const Sink& start) {
  const PackReceiver at = receiver;
  Sink sink = start;
  add_diffuse_lights<glossy, quads>(set, diffuse, at, sink);
  add_glossy_lights<glossy, quads>(set, shiny, at, sink);
  return sink;
}

// The lobes of a pack of receivers; `glossy` marks those with a glossy lobe.
struct Prepared {
  PackReceiver at;
  K::mask glossy, facing;
};
STERADIAN_INLINE Prepared prepare(const indirect::Receivers& receivers, std::size_t i, const LtcPackTables& tables) {
  K k;
  Prepared p;
  p.at.position = load_vector(receivers.position, i);
  p.at.normal = load_vector(receivers.normal, i);
  p.glossy = load(receivers.glossy.data() + i) > PackReal(0.0);
  p.at.sharp = p.facing = p.at.position.x < p.at.position.x;  // no lane
  if (any_lane(p.glossy)) {
    const PackReal alpha = load(receivers.alpha.data() + i);
    const PackVec3 view = load_vector(receivers.view, i);
    const SeenLobe seen = look_up_lobe(tables, p.at.normal, view, alpha);
    p.at.lobe = k.indirect_lobe(seen.matrix, seen.frame);
    p.at.sharp = p.glossy && alpha < k.indirect_sharp();
    p.facing = p.glossy && dot(p.at.normal, view) > PackReal(0.0);
  }
  return p;
}

template <class Sink>
STERADIAN_INLINE Sink run(const LightSet& set, const BlockLists::List& diffuse, const BlockLists::List& shiny, const Prepared& p,
                          bool quads, const Sink& start) {
  if (!any_lane(p.glossy)) return add_lights<false, false>(set, diffuse, shiny, p.at, start);
  if (quads && any_lane(p.at.sharp)) return add_lights<true, true>(set, diffuse, shiny, p.at, start);
  return add_lights<true, false>(set, diffuse, shiny, p.at, start);
}

STERADIAN_INLINE void store_sums(const Prepared& p, const PairSums& sums, std::size_t i, indirect::IncomingLight& light) {
  store_vector(light.diffuse, i, sums.diffuse);
  // Receivers without a glossy lobe, or seen from below, get nothing.
  store_vector(light.glossy, i,
               any_lane(p.glossy) ? select(p.facing, sums.glossy * p.at.lobe.scale, PackVec3(0.0, 0.0, 0.0)) : PackVec3(0.0, 0.0, 0.0));
}

void ltc(const LightSet& set, BlockLists::List diffuse, BlockLists::List shiny, const indirect::Receivers& receivers, std::size_t first,
         const LtcPackTables& tables, bool quads, indirect::IncomingLight& light) {
  for (std::size_t i = first; i < first + indirect::kBlockReceivers; i += kLanes) {
    const Prepared p = prepare(receivers, i, tables);
    const PairSums sums = run(set, diffuse, shiny, p, quads, PairSums());
    store_sums(p, sums, i, light);
  }
}

template <bool glossy>
__attribute__((flatten, noinline)) PairSums add_outgoing_lights(const LightSet& set, const BlockLists::List& diffuse,
                                                                const BlockLists::List& shiny, const PackReceiver& receiver,
                                                                const LtcPackTables& tables) {
  K k;
  const PackReceiver at = receiver;
  PairSums sums;
  add_diffuse_lights<glossy, false>(set, diffuse, at, sums);
  for (std::size_t j = 0; j < shiny.count; ++j) {
    const GgxLight& light = set.ggx[shiny.begin[j]];
    const Way way = way_to(light.position, at.position);
    const K::mat3 frame(broadcast(light.frame_x), broadcast(light.frame_y), broadcast(light.normal));
    const PackVec3 out = transform_transposed(frame, way.v * -way.inverse);
    if (!any_lane(out.z > PackReal(0.0))) continue;
    const OutgoingLobe end = look_up_outgoing(tables, out, light.view_x, light.view_z, light.alpha);
    const PackReal value = end.lobe * way.inverse * way.d2 / (way.d2 + broadcast(light.soft));
    const PackReal kept = k.indirect_kept(value, broadcast(light.reach) * (way.d2 * way.inverse), broadcast(light.xi));
    if (!any_lane(kept > PackReal(0.0))) continue;
    add_pair<glossy, false>(at, way, kept, broadcast(light.bright) + broadcast(light.grazing) * end.grazing, light.normal, nullptr,
                            PackReal(0.0), value, set.diffuse.size() + shiny.begin[j], sums);
  }
  return sums;
}

void ltc_outgoing(const LightSet& set, BlockLists::List diffuse, BlockLists::List shiny, const indirect::Receivers& receivers,
                  std::size_t first, const LtcPackTables& tables, bool, indirect::IncomingLight& light) {
  for (std::size_t i = first; i < first + indirect::kBlockReceivers; i += kLanes) {
    const Prepared p = prepare(receivers, i, tables);
    const auto add = any_lane(p.glossy) ? add_outgoing_lights<true> : add_outgoing_lights<false>;
    store_sums(p, add(set, diffuse, shiny, p.at, tables), i, light);
  }
}

void pick(const LightSet& set, BlockLists::List diffuse, BlockLists::List shiny, const indirect::Receivers& receivers, std::size_t first,
          const LtcPackTables& tables, bool quads, const float* shares, const indirect::PickedLights& picked) {
  for (std::size_t i = first; i < first + indirect::kBlockReceivers; i += kLanes) {
    const Prepared p = prepare(receivers, i, tables);
    Picks all;
    all.diffuse_target = all.glossy_target = PackReal(1e30);
    all = run(set, diffuse, shiny, p, quads, all);
    Picks one;
    // Rounding must not carry a target past the last light.
    const PackReal share = load(shares + (i - first)) * PackReal(0.99999);
    one.diffuse_target = max(all.diffuse_sum * share, PackReal(1e-30));
    one.glossy_target = max(all.glossy_sum * share, PackReal(1e-30));
    one = run(set, diffuse, shiny, p, quads, one);
    store(picked.diffuse + (i - first), one.diffuse);
    store(picked.glossy + (i - first), one.glossy);
  }
}

// The baseline: GGX at both ends, with Schlick's Fresnel for every pair at both.
struct GgxReceiver {
  PackVec3 position, normal;
  K::mat3 frame;
  PackVec3 view;
  PackReal alpha;
  PackVec3 f0, grazing;
};

template <bool glossy>
STERADIAN_INLINE void add_ggx_pair(const GgxReceiver& at, const Way& way, PackReal kept, const PackVec3& bright, PairSums& sums) {
  K k;
  const PackReal cosine = max(dot(at.normal, way.v), PackReal(0.0));
  sums.diffuse = sums.diffuse + bright * (kept * cosine * (way.inverse * way.inverse));
  if constexpr (glossy) {
    const auto end = k.indirect_ggx(at.frame, at.view, at.alpha, way.v * way.inverse);
    const PackReal half = kept * (end.lobe * way.inverse);
    const PackVec3 f = at.f0 + at.grazing * end.grazing;
    sums.glossy = sums.glossy + PackVec3(bright.x * f.x, bright.y * f.y, bright.z * f.z) * half;
  }
}

template <bool glossy>
__attribute__((flatten, noinline)) void add_ggx_lights(const LightSet& set, const BlockLists::List& diffuse, const BlockLists::List& shiny,
                                                       const GgxReceiver& receiver, PairSums& sums) {
  K k;
  const GgxReceiver at = receiver;
  for (std::size_t j = 0; j < diffuse.count; ++j) {
    const DiffuseLight& light = set.diffuse[diffuse.begin[j]];
    const Way way = way_to(light.position, at.position);
    const PackReal value = k.indirect_diffuse_half(broadcast(light.normal), way.v, way.d2, broadcast(light.soft));
    const PackReal kept = k.indirect_kept(value, broadcast(light.reach) * (way.d2 * way.inverse), broadcast(light.xi));
    if (!any_lane(kept > PackReal(0.0))) continue;
    add_ggx_pair<glossy>(at, way, kept, broadcast(light.bright), sums);
  }
  for (std::size_t j = 0; j < shiny.count; ++j) {
    const GgxLight& light = set.ggx[shiny.begin[j]];
    const Way way = way_to(light.position, at.position);
    const K::mat3 frame(broadcast(light.frame_x), broadcast(light.frame_y), broadcast(light.normal));
    const PackVec3 view(broadcast(light.view_x), PackReal(0.0), broadcast(light.view_z));
    const auto end = k.indirect_ggx(frame, view, broadcast(light.alpha), way.v * -way.inverse);
    const PackReal value = end.lobe * way.inverse * way.d2 / (way.d2 + broadcast(light.soft));
    const PackReal kept = k.indirect_kept(value, broadcast(light.reach) * (way.d2 * way.inverse), broadcast(light.xi));
    if (!any_lane(kept > PackReal(0.0))) continue;
    add_ggx_pair<glossy>(at, way, kept, broadcast(light.bright) + broadcast(light.grazing) * end.grazing, sums);
  }
}

void ggx(const LightSet& set, BlockLists::List diffuse, BlockLists::List shiny, const indirect::Receivers& receivers, std::size_t first,
         const LtcPackTables& tables, bool, indirect::IncomingLight& light) {
  K k;
  for (std::size_t i = first; i < first + indirect::kBlockReceivers; i += kLanes) {
    GgxReceiver at;
    at.position = load_vector(receivers.position, i);
    at.normal = load_vector(receivers.normal, i);
    PairSums sums;
    const auto glossy = load(receivers.glossy.data() + i) > PackReal(0.0);
    if (any_lane(glossy)) {
      const PackVec3 v = load_vector(receivers.view, i);
      at.alpha = load(receivers.alpha.data() + i);
      at.f0 = load_vector(receivers.f0, i);
      at.grazing = load_vector(receivers.f90, i) - at.f0;
      at.frame = k.frame_from_normal_and_view(at.normal, v);
      at.view = transform_transposed(at.frame, v);
      add_ggx_lights<true>(set, diffuse, shiny, at, sums);
      // Demodulated by the same mean reflectance as the other mode, so that both filter the same kind of signal.
      const auto magnitude = look_up_magnitude(tables, sqrt(at.alpha), at.view.z);
      const PackVec3 mean = at.f0 * magnitude.x + at.grazing * magnitude.y;
      const auto divide = [&](PackReal a, PackReal b) {
        return select(glossy && b > PackReal(1.0e-12), a / max(b, PackReal(1.0e-12)), PackReal(0.0));
      };
      sums.glossy = {divide(sums.glossy.x, mean.x), divide(sums.glossy.y, mean.y), divide(sums.glossy.z, mean.z)};
    } else {
      add_ggx_lights<false>(set, diffuse, shiny, at, sums);
    }
    store_vector(light.diffuse, i, sums.diffuse);
    store_vector(light.glossy, i, sums.glossy);
  }
}

}  // namespace

const indirect::LightingTable& lighting_table() {
  static constexpr indirect::LightingTable table = {ltc, ltc_outgoing, ggx, pick};
  return table;
}

STERADIAN_END_ISA
