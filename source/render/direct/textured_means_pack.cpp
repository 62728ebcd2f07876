#include "integrals/textured/texture_mean.h"
#include "integrals/textured/textured_light.h"
#include "render/direct/seen_light_pack.h"
#include "render/direct/table_pack.h"
#include "render/direct/textured_means.h"

STERADIAN_BEGIN_ISA
namespace {

struct TexturedLobe {
  PackKernels::mat3 frame;
  PackKernels::LtcMatrix matrix;
  int by_ggx;
  PackKernels::GgxView half_vectors;
};

// lobe_at(i): the lobe for the points from i on.
template <class LobeAt>
STERADIAN_INLINE void run(const TexturedLight& light, const Points& points, const float* wanted, const TexturedMeans& means,
                          LobeAt lobe_at) {
  const FilteredTexture& texture = light.texture();
  const auto of = [](Vec3d v) { return broadcast(static_cast<Vec3f>(v)); };
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    TextureMean<Pack> mean = {PackVec3(0.0, 0.0, 0.0), load(wanted + i) > PackReal(0.0)};
    if (any_lane(mean.found)) {
      const TexturedLobe lobe = lobe_at(i);
      const auto turned = [&](const PackVec3& v) { return transform_transposed(lobe.frame, v); };
      const auto view = Kernels<Pack>().ltc_texture_cell_view(lobe.matrix, lobe.by_ggx, lobe.half_vectors,
                                                              turned(of(texture.origin()) - load(points.position, i)),
                                                              turned(of(texture.axis_x())), turned(of(texture.axis_y())));
      mean = TextureCells<Pack>(light.tree(), texture.finest(), view).mean(mean.found);
    }
    store(means.r + i, mean.radiance.x);
    store(means.g + i, mean.radiance.y);
    store(means.b + i, mean.radiance.z);
    store(means.found + i, select(mean.found, PackReal(1.0), PackReal(0.0)));
  }
}

void diffuse(const TexturedLight& light, const Points& points, const float* wanted, const TexturedMeans& means) {
  run(light, points, wanted, means, [&](std::size_t i) {
    PackKernels k;
    return TexturedLobe{k.frame_from_normal(load(points.normal, i)), k.ltc_texture_diffuse(), 0, {}};
  });
}

void ggx(const TexturedLight& light, const Points& points, const LtcPackTables& tables, const float* wanted, const TexturedMeans& means) {
  run(light, points, wanted, means, [&](std::size_t i) {
    PackKernels k;
    const PackVec3 n = load(points.normal, i), v = load(points.view, i);
    const PackReal width = max(sqrt(load(points.alpha_x + i) * load(points.alpha_y + i)), PackReal(kSmallestAlpha));
    const auto frame = k.frame_from_normal_and_view(n, v);
    const PackReal cosine = dot(n, v);
    const PackVec3 to_eye(dot(frame.c0, v), PackReal(0.0), cosine);
    const auto at = k.ltc_coordinates(sqrt(width), cosine);
    const auto entry = look_up(tables.matrix.nodes.data(), tables.matrix.size, at.x, at.y);
    if (!tables.compact) return TexturedLobe{frame, k.ltc_from_classic(entry), 0, {}};
    return TexturedLobe{frame, k.ltc_from_compact(entry, width, to_eye), 1, k.ggx_view(to_eye, width, width)};
  });
}

}  // namespace

const TexturedMeansTable& textured_means_table() {
  static constexpr TexturedMeansTable table = {diffuse, ggx};
  return table;
}

STERADIAN_END_ISA
