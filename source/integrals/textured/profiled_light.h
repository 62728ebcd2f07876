// ProfiledLight: the mean radiance, under a lobe, of a rect or disk that shines by a measured profile (LightEmission). Times the lobe's
// integral over a light of radiance 1, which every method has, it is the radiance. Approximate; the error is measured in docs/lights.md,
// "Profiles on area lights".
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "integrals/methods.h"
#include "integrals/textured/profile_table.h"
#include "lobes/lobe.h"
#include "shapes/plane_region.h"
#include "steradian/area_light.h"
#include "steradian/reference.h"

namespace steradian {

class ProfiledLight {
 public:
  // The light must have an emission. table: its profile's, for many points; null: every point by cells.
  explicit ProfiledLight(const AreaLight& light, std::shared_ptr<const ProfileTable> table = nullptr);

  // The mean over the light, weighted with the lobe, or the mean of all directions if the lobe covers nothing of the light.
  //
  //   integral  the lobe's over the light as one of radiance 1, in the channel where it is largest, as the method computed it
  //
  // It uses Gauss's rule of 3 x 3 points in cells of the light. A cell is halved if it subtends more than the lobe's width there or the
  // width of the profile's steepest part, while there are fewer than most_cells. The light of a point depends on the direction alone, so
  // this bounds the error.
  //
  //   visible  the part of the light that counts, in coordinates of outline()'s x and y; null: all of it. A cell counts by its visible area
  Vec3d seen_by(const Material& lobe, const ShadingPoint& at, double integral, int most_cells = 256,
                const PlaneRegion* visible = nullptr) const;

  // The same mean over the visible part, by strips across the direction in which the profile changes. Each strip has the profile's mean
  // over its width. Takes seen_by with 1024 cells where the lobe is too narrow for strips, or without a table that serves.
  Vec3d seen_in_part(const Material& lobe, const ShadingPoint& at, double integral, const PlaneRegion& visible) const;

  // The radiance of the whole light as the point sees it, if the table shows that it is even: within kEven of this, both ways.
  std::optional<Vec3d> even_radiance(Vec3d position) const;
  static constexpr float kEven = 5e-4f;

  // The table; null if there is none that serves.
  const ProfileTable* table() const { return table_ && table_->serves() ? table_.get() : nullptr; }

  // The radius about the centre that holds the light.
  double reach() const { return reach_; }

  // Radiance of the light for intensity over the cosine, in candela.
  Vec3d radiance_of(double candela) const { return emission_.intensity * (candela / emission_.area); }

  // The coordinates of a point of the light's plane for `visible`.
  Vec2d coordinates_of(Vec3d place) const;

  // Emission on which the means are based.
  const LightEmission& emission() const { return emission_; }
  struct Outline {
    bool round;
    Vec3d center, x, y;  // of a rect: half axes
    double widest;       // a cell's largest span [rad]: of the kernel 1 / r^2, and of the profile
  };
  Outline outline() const { return {round_, center_, x_, y_, widest_}; }

  // Radiance that the lobe sends to the view, by adaptive cubature over the light's area, with a bound on the error.
  ReferenceResult reference(const Material& lobe, const ShadingPoint& at, const ReferenceOptions& options) const;

 private:
  struct Cell {
    double u0, u1, v0, v1;
  };
  // Light of one of the light's points, times the area that it represents per du dv.
  struct Sent {
    double intensity, even;  // candela by the profile; by the cosine, as a light of radiance 1 has it
    lobes::LobeValue lobe;   // over distance squared, times the area
  };
  class Cells;
  // Sums of the lobe in the channel where it sends the most light, which is that of `integral`.
  struct InBrightestChannel {
    double seen, weight;
    InBrightestChannel(const lobes::Lobe& lobe, lobes::LobeValue s, lobes::LobeValue w) {
      const Vec3d light = lobe.radiance(s), all = lobe.radiance(w);
      const bool x = all.x >= all.y && all.x >= all.z, y = !x && all.y >= all.z;
      seen = x ? light.x : y ? light.y : light.z;
      weight = x ? all.x : y ? all.y : all.z;
    }
  };

  // Polar coordinates of a disk, else coordinates along x and y.
  enum class Grid { polar, along_axes };
  Grid grid() const { return round_ ? Grid::polar : Grid::along_axes; }
  Vec3d place(Grid grid, double u, double v) const;
  std::pair<float, float> extent(Vec3d position) const;
  static double visible_share(const PlaneRegion& visible, const Cell& cell);
  bool sees_peak(const LobeAxis& peak, Vec3d position, const PlaneRegion& visible) const;
  double radiance_of_peak(const LobeAxis& peak, Vec3d position) const;  // 0 if the peak misses the light
  Sent sent(Grid grid, double u, double v, const lobes::Lobe& lobe, const Frame& frame, Vec3d position) const;

  LightEmission emission_;
  Vec3d mean_;
  bool round_;
  Vec3d center_, x_, y_;  // of a rect: half axes
  double widest_;         // a cell's largest span [rad]: of the kernel 1 / r^2, and of the profile
  double reach_ = 0;
  std::shared_ptr<const ProfileTable> table_;
};

namespace methods {

// The emission of one channel of intensity 1, as a factor for `sampled`: the light's radiance is then the intensity of the channels.
EmissionFactor emission_factor(const LightEmission& emission);

// Radiance that one lobe sends to the view, by a method of the table: that method's integral times the mean. `reference` and `sampled` use
// the emission itself, as a factor on their integrand.
RadianceResult profiled_light_answer(const AreaLight& light, const ShadingPoint& at, const Material& material, const Row& entry,
                                     const RadianceOptions& options);

}  // namespace methods
}  // namespace steradian
