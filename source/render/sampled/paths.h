// Path tracing: light that other surfaces send, for the reference. It shares nothing with the closed forms.
#pragma once

#include "core/random.h"
#include "render/sampled/monte_carlo.h"
#include "render/surface/ray_scene.h"
#include "render/surface/surface.h"
#include "steradian/bounces.h"

namespace steradian {

struct PathScene {
  const Scene& scene;
  const RayScene& rays;
  DirectSampler& sampler;  // of the direct light at each surface on the way, with shadows
};

// The mean of the radiance of `paths` paths, each by a call of next(), and its variance.
template <class Next>
Estimate mean_of_paths(int paths, const Next& next) {
  Estimate result;
  Vec3d squares{};
  for (int k = 0; k < paths; ++k) {
    const Vec3d x = next(), delta = x - result.mean;
    result.mean += delta / static_cast<double>(k + 1);
    squares += delta * (x - result.mean);
  }
  if (paths > 1) result.variance = squares / (static_cast<double>(paths) * (paths - 1));
  return result;
}

// Radiance that a surface sends towards the view after 1 to `bounces` bounces at other surfaces, or after any number (kAllBounces). Each
// path takes directions by the lobes of its surfaces, and the direct light of each surface that it meets. Emission does not count: the
// direct light samples the lights. Russian roulette ends long paths without bias.
Estimate trace_paths(const PathScene& scene, const Surface& receiver, Vec3f view, int bounces, int paths, reference::Random& random);

}  // namespace steradian
