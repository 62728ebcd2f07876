#include "render/bounce/virtual_lights.h"

#include "render/bounce/lobe_pack.h"

STERADIAN_BEGIN_ISA
namespace {

__attribute__((flatten)) void prepare(const indirect::ShadowMap& map, const LtcPackTables& tables, indirect::LobeArrays& out) {
  PackKernels k;
  for (std::size_t i = 0; i < map.alpha.size(); i += kLanes) {
    const PackVec3 n(load(map.normal.x.data() + i), load(map.normal.y.data() + i), load(map.normal.z.data() + i));
    const PackVec3 v(load(map.incoming.x.data() + i), load(map.incoming.y.data() + i), load(map.incoming.z.data() + i));
    const SeenLobe seen = look_up_lobe(tables, n, v, load(map.alpha.data() + i));
    const auto lobe = k.indirect_turned(k.indirect_lobe(seen.matrix, seen.frame));
    const auto put = [i](indirect::VectorArray& to, const PackVec3& row) {
      store(to.x.data() + i, row.x);
      store(to.y.data() + i, row.y);
      store(to.z.data() + i, row.z);
    };
    put(out.x, lobe.x);
    put(out.y, lobe.y);
    put(out.z, lobe.z);
    store(out.scale.data() + i, lobe.scale);
    store(out.n_a.data() + i, seen.n_a);
    store(out.f_a.data() + i, seen.f_a);
    store(out.stretch.data() + i, k.indirect_largest_stretch(seen.matrix));
  }
}

}  // namespace

const indirect::VirtualLightTable& virtual_light_table() {
  static constexpr indirect::VirtualLightTable table = {prepare};
  return table;
}

STERADIAN_END_ISA
