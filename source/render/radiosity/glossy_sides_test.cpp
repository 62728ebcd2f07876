// Kept lobes of sides: what they send by direction.
#include "render/radiosity/glossy_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/lattices.h"
#include "steradian/scene.h"

namespace steradian {

// Lobes that are widened for few rays send as much light as before, at any angle of the light.
TEST(GlossySides, WidenedLobesSendAsMuchLight) {
  const SurfaceMaterial plain;
  for (const float alpha : {0.06f, 0.1f})
    for (const float cosine : {0.1f, 0.3f, 0.9f}) {
      Surface surface;
      surface.normal = surface.geometric_normal = surface.coat_normal = {0, 0, 1};
      surface.tangent = {1, 0, 0};
      surface.f0 = {0.04f, 0.04f, 0.04f};
      surface.f90 = {1, 1, 1};
      surface.alpha_x = surface.alpha_y = alpha;
      surface.material = &plain;
      radiosity::GlossySides sides;
      const Vec3f light{1, 1, 1}, direction{std::sqrt(1 - cosine * cosine), 0, cosine};
      const std::uint32_t lobe = sides.keep(surface, {{direction, light, 1e-4f, 0}}, light, 0);
      constexpr std::size_t kViews = 200'000;
      double own = 0, widened = 0;
      for (std::size_t i = 0; i < kViews; ++i) {
        const auto view = static_cast<Vec3f>(fibonacci_direction(i, kViews, 0));
        const double weight = std::max(static_cast<double>(view.z), 0.0);
        own += weight * static_cast<double>(sides.radiance(lobe, view, 0).x);
        widened += weight * static_cast<double>(sides.radiance_for_few_rays(lobe, view).x);
      }
      std::printf("alpha %.2f, cosine %.1f: %.4f of the light of the lobe itself\n", static_cast<double>(alpha),
                  static_cast<double>(cosine), widened / own);
      // Two entries of a table that is within 2e-3 of quadrature over the light, for each of two energies.
      EXPECT_NEAR(widened / own, 1, 8e-3);
    }
}

}  // namespace steradian
