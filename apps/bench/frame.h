// A whole picture as a bench. It is rendered repeatedly, and its passes are medians over the calls. A Vulkan device and its pipelines stay
// from call to call.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "benches.h"
#include "core/simd.h"
#include "steradian/render_cache.h"

namespace steradian::bench {

// A scene, its render options, and the passes of every call so far.
struct BenchFrame {
  Scene scene;
  RenderOptions options;
  std::vector<std::string> order;
  std::map<std::string, std::vector<double>> passes;
  RenderCache cache = {};  // holds the Vulkan device and its pipelines
  bool cached = false;     // also on the CPU

  Picture rendered(RenderStats& stats) {
    return cached || options.backend != Backend::cpu ? render(scene, options, cache, &stats) : render(scene, options, &stats);
  }
  void call() {
    RenderStats stats;
    const Picture picture = rendered(stats);
    keep(picture.pixels.front());
    order.clear();
    for (const PassTime& pass : stats.passes) {
      order.push_back(pass.name);
      passes[pass.name].push_back(pass.ms);
    }
  }
  std::vector<BenchPass> medians() const {
    std::vector<BenchPass> result;
    for (const std::string& name : order) {
      std::vector<double> times = passes.at(name);
      const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
      std::nth_element(times.begin(), middle, times.end());
      result.push_back({name, *middle});
    }
    return result;
  }
};

// A frame without a scene.
inline std::shared_ptr<BenchFrame> frame_on(const Where& where, int threads) {
  auto frame = std::make_shared<BenchFrame>();
  frame->options.backend = where.backend;
  frame->options.device = where.device;
  frame->options.threads = threads;
  return frame;
}

inline Bench bench_of(const std::string& name, std::shared_ptr<BenchFrame> frame) {
  const auto pixels = static_cast<std::size_t>(frame->options.width) * static_cast<std::size_t>(frame->options.height);
  // Not pinned, because it uses all cores.
  return {name, pixels, name_of(active_simd()), [frame] { frame->call(); }, false, [frame] { return frame->medians(); }};
}

}  // namespace steradian::bench
