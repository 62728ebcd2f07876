// A Phong plane under one light on a Vulkan device: shaders/lobes/phong.comp.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/phong_plane.h"
#include "device/vulkan/pipeline_report.h"

namespace steradian::bench {

class PhongOnDevice {
 public:
  // Throws Error if there is no such device.
  PhongOnDevice(const moment::PhongPlane& plane, const moment::NamedLight& light, int exponent, const PhongOptions& options,
                const std::string& device);
  ~PhongOnDevice();

  // Radiance at every point. The buffers stay from call to call.
  void run();
  std::vector<float> radiance() const;
  double device_ms() const;  // time of the last run by the device's clock; 0 if it has none

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The pipelines of vulkan/kernel/*/quad, on a device whose hardware may be absent.
std::vector<vulkan::PipelineReport> compile_phong(const std::string& device);

}  // namespace steradian::bench
