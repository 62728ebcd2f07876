#include "core/pack.h"
#include "render/radiosity/glossy_places.h"

STERADIAN_BEGIN_ISA
namespace {

using radiosity::GlossyPlaces;
using radiosity::GlossyTable;

float sum_of(PackReal x) { return xsimd::hadd(x.v); }

enum class LobeWidth { own, wider, wider_with_its_energy };

template <LobeWidth lobe_width>
__attribute__((flatten)) GlossyTable::Sent sent_by(const GlossyPlaces& places, std::size_t first, std::size_t count, Vec3f view_of,
                                                   float wider) {
  PackKernels k;
  const PackVec3 view(broadcast(view_of.x), broadcast(view_of.y), broadcast(view_of.z));
  const PackReal wider2 = broadcast(wider * wider), zero(0.0);
  PackVec3 all(0.0, 0.0, 0.0), grazing(0.0, 0.0, 0.0);
  for (std::size_t i = first; i < first + count; i += kLanes) {
    const PackVec3 l(load(&places.x[i]), load(&places.y[i]), load(&places.z[i]));
    const PackVec3 h = k.microfacet_half_vector(l, view);
    const auto widened = [&](const float* alpha) {
      const PackReal own = load(alpha);
      return lobe_width == LobeWidth::own ? own : sqrt(own * own + wider2);
    };
    const PackReal shape = k.ggx_lobe(l, view, widened(&places.alpha_x[i]), widened(&places.alpha_y[i]));
    const PackReal power = k.fresnel_schlick(zero, PackReal(1.0), dot(view, h));
    const PackVec3 light = PackVec3(load(&places.red[i]), load(&places.green[i]), load(&places.blue[i])) * shape;
    if constexpr (lobe_width == LobeWidth::wider_with_its_energy) {
      all = all + light * load(&places.energy[i]);
      grazing = grazing + light * (power * load(&places.grazing_energy[i]));
    } else {
      all = all + light;
      grazing = grazing + light * power;
    }
  }
  return {{sum_of(all.x), sum_of(all.y), sum_of(all.z)}, {sum_of(grazing.x), sum_of(grazing.y), sum_of(grazing.z)}};
}

GlossyTable::Sent sent(const GlossyPlaces& places, std::size_t first, std::size_t count, Vec3f view, float wider, bool keeps_energy) {
  if (wider == 0) return sent_by<LobeWidth::own>(places, first, count, view, wider);
  return keeps_energy ? sent_by<LobeWidth::wider_with_its_energy>(places, first, count, view, wider)
                      : sent_by<LobeWidth::wider>(places, first, count, view, wider);
}

}  // namespace

const radiosity::GlossyTable& glossy_table() {
  static constexpr radiosity::GlossyTable table = {sent};
  return table;
}

STERADIAN_END_ISA
