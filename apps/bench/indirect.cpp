// indirect/pair/{ltc,ltc-schlick,ltc-outgoing,ggx}: one pair of a receiver and a virtual light, with a diffuse and a glossy lobe at each
// end and without culling; 1024 receivers times 512 lights, GGX by kernels/lobe/microfacet.glsl. indirect/frame/{ltc,ltc-outgoing,ggx}/N:
// 1080p of scenes/ring.glb with N virtual lights, all on the same lists; all threads, with the time of every pass. Virtual lights are
// points in all (no quads), so that only the pair differs. On a Vulkan device the benches are under vulkan/indirect/frame/..., without
// shadows.
#include <cmath>
#include <filesystem>
#include <memory>

#include "benches.h"
#include "core/random.h"
#include "core/words.h"
#include "frame.h"
#include "render/bounce/pairs.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"

namespace steradian::bench {
namespace {

using namespace indirect;

// Surfaces on the lower half of a box, viewed from its middle, and virtual lights on its upper half.
struct Pairs {
  static constexpr std::size_t kReceivers = 1024, kLights = 512;
  Receivers receivers;
  std::vector<PairLight> lights;
  std::vector<GgxPairLight> ggx_lights;
  LtcPackTables tables = ltc_pack_tables(Method::ltc_compact);
  IncomingLight light;

  Pairs() {
    reference::Random random(11);
    const auto direction = [&](Vec3f about) {
      for (;;) {
        const Vec3f d = static_cast<Vec3f>(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
        if (dot(d, d) < 1 && dot(normalized(d), about) > 0.2f) return normalized(d);
      }
    };
    const auto number = [&](double low, double high) { return static_cast<float>(random.uniform(low, high)); };
    Receivers& r = receivers;
    for (VectorArray* a : {&r.position, &r.normal, &r.view, &r.f0, &r.f90}) a->resize(kReceivers);
    r.alpha.resize(kReceivers);
    r.glossy.resize(kReceivers);
    for (std::size_t i = 0; i < kReceivers; ++i) {
      r.position.put(i, {number(-2, 2), number(-0.2, 0), number(-2, 2)});
      r.normal.put(i, direction({0, 1, 0}));
      r.view.put(i, direction(r.normal[i]));
      r.alpha[i] = number(0.1, 0.8);
      r.glossy[i] = 1;
      r.f0.put(i, {0.5f, 0.4f, 0.3f});
      r.f90.put(i, {1, 1, 1});
    }
    ShadowMap map;
    map.resize(kLights);
    for (std::size_t i = 0; i < kLights; ++i) {
      map.normal.put(i, direction({0, -1, 0}));
      map.incoming.put(i, direction(map.normal[i]));
      map.alpha[i] = number(0.1, 0.8);
    }
    LobeArrays lobes(kLights);
    virtual_light_table_for(active_simd()).prepare(map, tables, lobes);
    for (std::size_t i = 0; i < kLights; ++i) {
      const Vec3f n = map.normal[i], w = map.incoming[i], p{number(-2, 2), number(1, 1.5), number(-2, 2)};
      lights.push_back({p, lobes.x[i], lobes.y[i], lobes.z[i], -n, {0.1f, 0.2f, 0.3f}, {0.5f, 0.4f, 0.3f}, {0.1f, 0.1f, 0.1f}, w});
      const Vec3f x = normalized(w - n * dot(n, w));
      ggx_lights.push_back(
          {p, x, cross(n, x), n, dot(x, w), dot(n, w), map.alpha[i], {0.1f, 0.2f, 0.3f}, {0.5f, 0.4f, 0.3f}, {0.1f, 0.1f, 0.1f}});
    }
    light.diffuse.resize(kReceivers);
    light.glossy.resize(kReceivers);
  }
};

enum class Pair { ltc, ltc_schlick, ltc_outgoing, ggx };

void add_pair(BenchList& list, const std::string& name, Pair pair) {
  list.add(name, [=](const BenchOptions& options) -> Bench {
    auto data = std::make_shared<Pairs>();
    const PairTable& table = pair_table_for(options.simd);
    return {name, Pairs::kReceivers * Pairs::kLights, name_of(options.simd), [=, &table] {
              Pairs& d = *data;
              if (pair == Pair::ggx)
                table.ggx(d.ggx_lights.data(), Pairs::kLights, d.receivers, d.light);
              else if (pair == Pair::ltc_outgoing)
                table.ltc_outgoing(d.ggx_lights.data(), Pairs::kLights, d.receivers, d.tables, d.light);
              else
                (pair == Pair::ltc ? table.ltc : table.ltc_schlick)(d.lights.data(), Pairs::kLights, d.receivers, d.tables, d.light);
              keep(d.light.glossy.x.front());
            }};
  });
}

std::string ring() { return std::string(STERADIAN_SCENES) + "/ring.glb"; }

void add_frame_of(BenchList& list, const Where& where, const std::string& name, IndirectMode mode, int lights) {
  list.add(name, [=](const BenchOptions&) -> Bench {
    auto frame = std::make_shared<BenchFrame>();
    frame->scene = load_scene(ring()).scene;
    RenderOptions& o = frame->options;
    o.backend = where.backend;
    o.device = where.device;
    if (where.backend == Backend::vulkan) o.shadows = Shadows::off;
    o.width = 1920;
    o.height = 1080;
    o.method = "ltc-compact";
    o.indirect.mode = mode;
    o.indirect.virtual_lights = lights;
    o.indirect.quads = false;
    return bench_of(name, frame);
  });
}

}  // namespace

void add_indirect(BenchList& list) {
  add_pair(list, "indirect/pair/ltc", Pair::ltc);
  add_pair(list, "indirect/pair/ltc-schlick", Pair::ltc_schlick);
  add_pair(list, "indirect/pair/ltc-outgoing", Pair::ltc_outgoing);
  add_pair(list, "indirect/pair/ggx", Pair::ggx);
}

void add_indirect_frames(BenchList& list, const Where& where) {
  const std::string prefix = where.backend == Backend::cpu ? "indirect/frame/" : "vulkan/indirect/frame/";
  if (!std::filesystem::exists(ring())) return;
  for (int bits = 12; bits <= 18; bits += 2)
    for (const IndirectMode mode : {IndirectMode::ltc, IndirectMode::ltc_outgoing, IndirectMode::ggx}) {
      if (mode == IndirectMode::ltc_outgoing && where.backend != Backend::cpu) continue;
      add_frame_of(list, where, prefix + words::name_of(mode) + "/" + std::to_string(1 << bits), mode, 1 << bits);
    }
}

}  // namespace steradian::bench
