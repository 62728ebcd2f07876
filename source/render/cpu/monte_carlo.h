// Direct light of one surface point by Monte Carlo: every light by its solid angle and every lobe by its density,
// balance heuristic, shadow rays if asked for. The ground truth of pictures.
#pragma once

#include <memory>
#include <vector>

#include "core/random.h"
#include "render/cpu/ray_scene.h"
#include "render/cpu/surface.h"
#include "render/environment/environment_sampler.h"
#include "steradian/render.h"

namespace steradian {

// Mean and variance of a sum of independent estimates, per channel.
struct Estimate {
  Vec3d mean{};
  Vec3d variance{};  // of the mean

  Estimate& operator+=(const Estimate& other) {
    mean += other.mean;
    variance += other.variance;
    return *this;
  }
};

// Which lobes are estimated; the others count as done elsewhere.
enum class LobeChoice { all, specular };

class DirectSampler {
 public:
  // shadows may be null: nothing occludes; so may the environment. Keeps references to the scene, the rays and the environment.
  DirectSampler(const Scene& scene, const RayScene* shadows, const environment::EnvironmentSampler* around = nullptr,
                Terminator terminator = Terminator::strict);
  ~DirectSampler();
  DirectSampler(const DirectSampler&) = delete;

  // Light that the surface sends towards the viewer, without its emission. spp: sample pairs per light.
  // One object per thread: it keeps scratch memory.
  Estimate estimate(const Surface& surface, Vec3f view, LobeChoice choice, int spp, reference::Random& random);

 private:
  struct Light;
  struct Scratch;
  // Of scratch_->lobes, which share the frame's normal.
  Estimate estimate_environment(const Frame& frame, Vec3d position, Vec3d geometric, int spp, reference::Random& random) const;
  // Whether a direction lies above the horizon of the triangle, where that hides what lies below.
  bool above(Vec3d geometric, Vec3d direction) const { return terminator_ == Terminator::smooth || dot(direction, geometric) > 0; }
  Estimate estimate_in(const Frame& frame, const Surface& surface, int spp, reference::Random& random);
  const Scene& scene_;
  const RayScene* shadows_;
  const environment::EnvironmentSampler* around_;
  const Terminator terminator_;
  std::vector<Light> lights_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace steradian
