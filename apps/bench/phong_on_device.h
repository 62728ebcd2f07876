// A Phong plane under one light on a Vulkan device: shaders/lobes/phong.comp.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/phong_plane.h"

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

}  // namespace steradian::bench
