// The benches of `steradian bench`: one file per topic, one line here.
#pragma once

#include "bench/run.h"
#include "steradian/render.h"

namespace steradian::bench {

// The back end that renders frames; device: as RenderOptions::device.
struct Where {
  Backend backend = Backend::cpu;
  std::string device;
};

void add_lambert(BenchList& list);
void add_ltc(BenchList& list);
void add_eval(BenchList& list);
void add_derivatives(BenchList& list);
void add_phong(BenchList& list);
void add_phong_on_device(BenchList& list, const std::string& device);
void add_ggx(BenchList& list);
void add_plane(BenchList& list);
void add_plane_on_device(BenchList& list, const std::string& device);
void add_frame(BenchList& list, const Where& where);
void add_many_lights(BenchList& list, const Where& where);
void add_scaling(BenchList& list);
void add_indirect(BenchList& list);
void add_indirect_frames(BenchList& list, const Where& where);
void add_shadow(BenchList& list);
void add_view_factors(BenchList& list);

// All benches. For a Vulkan device only frames, under the CPU's names with the prefix vulkan/.
inline BenchList all_benches(const Where& where = {}) {
  BenchList list;
  if (where.backend == Backend::vulkan) {
    add_frame(list, where);
    add_many_lights(list, where);
    add_indirect_frames(list, where);
    add_plane_on_device(list, where.device);
    add_phong_on_device(list, where.device);
    return list;
  }
  add_lambert(list);
  add_ltc(list);
  add_eval(list);
  add_derivatives(list);
  add_phong(list);
  add_ggx(list);
  add_plane(list);
  add_frame(list, where);
  add_many_lights(list, where);
  add_scaling(list);
  add_indirect(list);
  add_indirect_frames(list, where);
  add_shadow(list);
  add_view_factors(list);
  return list;
}

}  // namespace steradian::bench
