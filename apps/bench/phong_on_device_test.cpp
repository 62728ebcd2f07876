// Compares the device with the CPU's packs: every method on every light of the published comparison.
#include "bench/phong_on_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <set>

#include "bench/phong_methods.h"
#include "core/float_mode.h"
#include "device/vulkan/device.h"

namespace steradian::bench::phong_on_device_test {
namespace {

// Both are float. If a cosine is off by one rounding, its n-th power is off by n roundings in either. Edges and atan are off by 1e-5 in
// all.
TEST(VulkanPhong, HasEveryMethodOfTheComparison) {
  if (vulkan::list_devices().empty()) GTEST_SKIP() << "no Vulkan device";
  const moment::PhongPlane plane = moment::make_phong_plane(64, 36);
  for (const moment::NamedLight& light : moment::comparison_lights())
    for (const PhongVariant& method : phong_variants())
      for (const int n : {100, 500, 5000}) {
        PhongOnDevice work(plane, light, n, method.options, "");
        work.run();
        const std::vector<float> device = work.radiance();
        std::vector<float> packs(plane.x.size());
        {
          const FlushDenormals flush;
          lobe_packs_for(active_simd())[methods::Procedure::phong_lobe](prepare_light(light.light), plane.points(),
                                                                        {moment::phong(n), method.options}, {packs.data()});
        }
        double largest = 0, brightest = 0;
        for (std::size_t i = 0; i < plane.count; ++i) {
          largest = std::max(largest, std::fabs(static_cast<double>(device[i]) - static_cast<double>(packs[i])));
          brightest = std::max(brightest, static_cast<double>(packs[i]));
        }
        EXPECT_GT(brightest, 0.1);
        EXPECT_LE(largest, (n * 0x1p-23 + 1e-5) * brightest) << method.name << " " << light.name << " n=" << n;
        if (n == 5000)
          std::printf("%-12s %-9s n=%d: largest difference %.1e of the brightest\n", method.name.c_str(), light.name.c_str(), n,
                      largest / brightest);
      }
}

TEST(VulkanPhong, ListsThePipelinesOfEveryMethod) {
  if (vulkan::list_devices().empty()) GTEST_SKIP() << "no Vulkan device";
  std::set<std::vector<std::int32_t>> constants;
  for (const vulkan::PipelineReport& p : compile_phong("")) {
    EXPECT_EQ(p.shader, "phong.comp");
    constants.insert(p.constants);
  }
  EXPECT_EQ(constants.size(), phong_variants().size() * std::size(kPhongExponents));
}

}  // namespace
}  // namespace steradian::bench::phong_on_device_test
