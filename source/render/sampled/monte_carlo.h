// Direct light of one surface point by Monte Carlo, the ground truth of pictures. It samples every light by solid angle and every lobe by
// density, with the balance heuristic and optional shadow rays.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/random.h"
#include "render/environment/direction_grid.h"
#include "render/surface/clear_meshes.h"
#include "render/surface/ray_scene.h"
#include "render/surface/surface.h"
#include "steradian/render.h"

namespace steradian {

// Mean and variance of a sum of independent estimates, per channel.
struct Estimate {
  Vec3d mean{};
  Vec3d variance{};  // variance of the mean

  Estimate& operator+=(const Estimate& other) {
    mean += other.mean;
    variance += other.variance;
    return *this;
  }
};

// Light that arrives at a surface from one direction.
struct IncidentLight {
  Vec3f direction;
  Vec3f irradiance;     // on the surface
  float solid_angle;    // that it stands for; 0: a punctual light
  std::uint32_t light;  // number of the light
};

// Lobes to estimate; the others are computed elsewhere.
enum class LobeChoice { all, specular };

class DirectSampler {
 public:
  // shadows may be null (nothing occludes), and so may the environment. Keeps references to the scene, the rays, the environment and the
  // table (lobes_of).
  DirectSampler(const Scene& scene, const RayScene* shadows, const environment::EnvironmentSampler* around = nullptr,
                Terminator terminator = Terminator::strict, const ClassicTable* fitted = nullptr);
  ~DirectSampler();
  DirectSampler(const DirectSampler&) = delete;

  const ClassicTable* fitted() const { return fitted_; }
  const ClearMeshes& clear_meshes() const { return clear_; }

  // Light that the surface sends towards the viewer, without its emission. spp: sample pairs per light. Each thread needs its own object,
  // which keeps scratch memory.
  Estimate estimate(const Surface& surface, Vec3f view, LobeChoice choice, int spp, reference::Random& random);

  // Appends the light that arrives from `places` directions of each area light and the environment, and from each punctual light.
  void find_incident(const Surface& surface, int places, reference::Random& random, std::vector<IncidentLight>& found);
  std::size_t light_count() const;

 private:
  struct Light;
  struct Scratch;
  // A direction in a surface's frame, the density of a light there, and the radiance that arrives. Density 0: no light.
  struct Incident {
    Vec3d direction;
    double density = 0;
    Vec3d radiance{};
  };
  // Visits the lights above a surface: punctual(direction, irradiance) and area(sample, towards), two functions that return Incident, for a
  // place of the unit square and for a direction. Returns the point from which the surface sees them.
  template <class Punctual, class Area>
  Vec3d visit_lights(const Frame& frame, const Surface& surface, Punctual punctual, Area area);
  // Estimates the environment's light by scratch_->lobes, which share the frame's normal.
  Estimate estimate_environment(const Frame& frame, Vec3d position, Vec3d geometric, int spp, reference::Random& random) const;
  // A place outside of the scene.
  static Vec3d beyond(Vec3d from, Vec3d direction);
  // Fraction of light that comes from one place to another through clear meshes.
  Vec3d through(Vec3d from, Vec3d to) const { return shadows_ != nullptr ? clear_.passes_between(*shadows_, from, to) : Vec3d{1, 1, 1}; }
  // True if a direction lies above the triangle's horizon, or if that horizon occludes nothing (smooth terminator).
  bool above(Vec3d geometric, Vec3d direction) const { return terminator_ == Terminator::smooth || dot(direction, geometric) > 0; }
  Estimate estimate_in(const Frame& frame, const Surface& surface, int spp, reference::Random& random);
  const Scene& scene_;
  const RayScene* shadows_;
  const ClearMeshes clear_;
  const environment::EnvironmentSampler* around_;
  const Terminator terminator_;
  const ClassicTable* fitted_;
  std::vector<Light> lights_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace steradian
