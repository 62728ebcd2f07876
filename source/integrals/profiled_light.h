// ProfiledLight: the mean radiance that a lobe sees of a rect or disk that shines by a measured profile (LightEmission). Times the lobe's
// integral over a light of radiance 1, which every method has, it is what the light sends. Approximate; the error is measured in
// docs/lights.md, "Profiles on area lights".
#pragma once

#include "integrals/methods.h"
#include "lobes/lobe.h"
#include "steradian/area_light.h"
#include "steradian/reference.h"

namespace steradian {

class ProfiledLight {
 public:
  // The light must have an emission.
  explicit ProfiledLight(const AreaLight& light);

  // The mean over the light, weighted with the lobe; that of all directions where the lobe sees nothing of it.
  //
  //   integral  the lobe's over the light as one of radiance 1, in the channel where it is largest: what the method found
  //
  // By Gauss's rule of 3 x 3 points in cells of the light. Cells are halved that span more, as seen from the point, than the lobe there or
  // the profile's steepest part is wide, as long as there are fewer than most_cells. What a point of the light sends depends on the
  // direction alone, so that this is what bounds the error.
  Vec3d seen_by(const Material& lobe, const ShadingPoint& at, double integral, int most_cells = 256) const;

  // What the means go by.
  const LightEmission& emission() const { return emission_; }
  struct Outline {
    bool round;
    Vec3d center, x, y;  // of a rect: half axes
    double widest;       // a cell's largest span [rad]: of the kernel 1 / r^2, and of the profile
  };
  Outline outline() const { return {round_, center_, x_, y_, widest_}; }

  // What the lobe sends to the view, by adaptive cubature over the light's area, with a bound on the error.
  ReferenceResult reference(const Material& lobe, const ShadingPoint& at, const ReferenceOptions& options) const;

 private:
  struct Cell {
    double u0, u1, v0, v1;
  };
  // What one of the light's points sends, times the area that it stands for per du dv.
  struct Sent {
    double intensity, even;  // candela by the profile; by the cosine, as a light of radiance 1 has it
    lobes::LobeValue lobe;   // over distance squared, times the area
  };
  class Cells;

  Vec3d place(double u, double v) const;
  double radiance_of_peak(const LobeAxis& peak, Vec3d position) const;  // 0 where the peak misses the light
  Sent sent(double u, double v, const lobes::Lobe& lobe, const Frame& frame, Vec3d position) const;

  LightEmission emission_;
  Vec3d mean_;
  bool round_;
  Vec3d center_, x_, y_;  // of a rect: half axes
  double widest_;         // a cell's largest span [rad]: of the kernel 1 / r^2, and of the profile
};

namespace methods {

// What one lobe sends to the view, by a method of the table: that method's integral times the mean. `reference` and `sampled` take the
// emission itself, as a factor on their integrand.
RadianceResult profiled_light_answer(const AreaLight& light, const ShadingPoint& at, const Material& material, const Row& entry,
                                     const RadianceOptions& options);

}  // namespace methods
}  // namespace steradian
