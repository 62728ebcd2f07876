#include "render/bounce/receivers/light_receivers.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <ctime>

#include "core/float_mode.h"
#include "core/random.h"

namespace steradian::indirect {
namespace {

// Working time of threads, independent of other load on the machine.
struct Nanoseconds {
  std::atomic<std::int64_t> total{0};
  static std::int64_t now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return t.tv_sec * std::int64_t{1'000'000'000} + t.tv_nsec;
  }
  template <class Work>
  void time(Work work) {
    const std::int64_t start = now();
    work();
    total += now() - start;
  }
  double ms() const { return static_cast<double>(total) * 1e-6; }
};

// Scales a receiver's light by its visible fraction, estimated by a few rays to lights picked by their light. This is the ratio estimator:
// the analytic light times visible over all light of the same samples. Lights are picked in proportion to their light, so all samples weigh
// the same and the ratio is the fraction of rays that arrive.
//
// Source: Heitz, Hill, McGuire, "Combining analytic direct illumination and stochastic shadows", 2018.
void shadow_block(const LightSet& set, const BlockLists& lists, std::size_t block, const Receivers& receivers, std::size_t first,
                  const LtcPackTables& tables, const LightingOptions& options, IncomingLight& light) {
  alignas(64) float shares[kBlockReceivers], diffuse[kBlockReceivers], glossy[kBlockReceivers];
  int diffuse_seen[kBlockReceivers] = {}, glossy_seen[kBlockReceivers] = {};
  const LightingTable& table = lighting_table_for(active_simd());
  for (int ray = 0; ray < options.shadow_rays; ++ray) {
    for (std::size_t i = 0; i < kBlockReceivers; ++i) {
      reference::Random random(options.seed, first + i);
      // A Latin hypercube over a receiver's rays: one stratum per ray.
      shares[i] = static_cast<float>((ray + random.uniform()) / options.shadow_rays);
    }
    table.pick(set, lists.diffuse(block), lists.glossy(block), receivers, first, tables, options.quads, shares, {diffuse, glossy});
    for (std::size_t i = 0; i < kBlockReceivers; ++i) {
      const auto seen = [&](float picked) {
        if (picked < 0) return 0;
        const auto j = static_cast<std::size_t>(picked);
        const Vec3f to = j < set.diffuse.size() ? set.diffuse[j].position : set.glossy[j - set.diffuse.size()].position;
        return options.shadows->occluded(receivers.position[first + i], to) ? 0 : 1;
      };
      diffuse_seen[i] += seen(diffuse[i]);
      glossy_seen[i] += seen(glossy[i]);
    }
  }
  for (std::size_t i = 0; i < kBlockReceivers; ++i) {
    const auto scale = [&](VectorArray& a, int seen) {
      a.put(first + i, a[first + i] * (static_cast<float>(seen) / static_cast<float>(options.shadow_rays)));
    };
    scale(light.diffuse, diffuse_seen[i]);
    scale(light.glossy, glossy_seen[i]);
  }
}

}  // namespace

LightingResult light_receivers(const std::vector<LightSet>& sets, const Receivers& receivers, const Layout& layout,
                               const LtcPackTables& tables, const LightingOptions& options) {
  LightingResult result;
  IncomingLight& light = result.light;
  light.diffuse.resize(layout.size());
  light.glossy.resize(layout.size());
  const LightCullTable& culling = cull_table_for(active_simd());
  const LightingTable& lighting = lighting_table_for(active_simd());
  const auto shade = options.mode == IndirectMode::ggx            ? lighting.ggx
                     : options.mode == IndirectMode::ltc_outgoing ? lighting.ltc_outgoing
                                                                  : lighting.ltc;
  Nanoseconds cull_time, light_time, shadow_time;
  std::atomic<std::int64_t> pairs{0};
  tbb::enumerable_thread_specific<BlockLists> all_lists;
  // Sets run one after another, so that a set's lights stay in the cache.
  tbb::parallel_for(0, layout.sets() * layout.tiles(), [&](int job) {
    const FlushDenormals flush;
    const LightSet& set = sets[static_cast<std::size_t>(job / layout.tiles())];
    const std::size_t first = layout.tile_begin(job / layout.tiles(), job % layout.tiles());
    BlockLists& lists = all_lists.local();
    cull_time.time([&] { lists.cull(culling, set, receivers, first); });
    std::int64_t count = 0;
    light_time.time([&] {
      for (std::size_t b = 0; b < kBlocks; ++b) {
        const auto diffuse = lists.diffuse(b), glossy = lists.glossy(b);
        if (diffuse.count + glossy.count == 0) continue;
        shade(set, diffuse, glossy, receivers, first + b * kBlockReceivers, tables, options.quads, light);
        count += static_cast<std::int64_t>((diffuse.count + glossy.count) * kBlockReceivers);
      }
    });
    pairs += count;
    if (options.shadow_rays > 0 && options.shadows != nullptr)
      shadow_time.time([&] {
        for (std::size_t b = 0; b < kBlocks; ++b)
          if (lists.diffuse(b).count + lists.glossy(b).count > 0)
            shadow_block(set, lists, b, receivers, first + b * kBlockReceivers, tables, options, light);
      });
  });
  result.work = {cull_time.ms(), light_time.ms(), shadow_time.ms(), static_cast<double>(pairs)};
  return result;
}

}  // namespace steradian::indirect
