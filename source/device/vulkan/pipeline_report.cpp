#include "device/vulkan/pipeline_report.h"

#include "device/vulkan/handles.h"

namespace steradian::vulkan {
namespace {

std::uint64_t number_of(const vk::PipelineExecutableStatisticKHR& statistic) {
  switch (statistic.format) {
    case vk::PipelineExecutableStatisticFormatKHR::eBool32: return statistic.value.b32;
    case vk::PipelineExecutableStatisticFormatKHR::eFloat64: return static_cast<std::uint64_t>(statistic.value.f64);
    default: return statistic.value.u64;
  }
}

}  // namespace

void report(const Device::Handles& d, const vk::raii::Pipeline& pipeline, std::vector<PipelineReport> shaders) {
  if (d.has_statistics) {
    const auto count = d.device.getPipelineExecutablePropertiesKHR({*pipeline}).size();
    for (std::uint32_t i = 0; i < std::min(count, shaders.size()); ++i)
      for (const auto& statistic : d.device.getPipelineExecutableStatisticsKHR({*pipeline, i}))
        shaders[i].statistics.emplace_back(statistic.name.data(), number_of(statistic));
  }
  d.reports.insert(d.reports.end(), shaders.begin(), shaders.end());
}

}  // namespace steradian::vulkan
