// LightChoice: a few of many lights, in proportion to the light that each may send to some surfaces.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/box.h"
#include "render/lights/light_list.h"

namespace steradian {

class LightChoice {
 public:
  explicit LightChoice(const std::vector<PackLight>& lights);

  struct Chosen {
    const PackLight* light = nullptr;
    std::size_t times = 0;  // how often the light was met
    double weight = 0;      // over the light's share, so that sums over the chosen stand for sums over all
  };
  // Meets `count` of these area lights, at equal steps of the sum of what they may send. offset: of the first step, 0 to 1.
  std::vector<Chosen> choose(std::span<const PackLight* const> lights, const Box3f& positions, std::size_t count, double offset) const;

  // Number of the dimmest of these lights that together seem to send at most a fraction of what all send. A guess by their distances alone.
  std::size_t dim_count(std::span<const PackLight* const> lights, const Box3f& positions, double fraction) const;

 private:
  // Light that the light of this index seems to send to a place.
  double sent(std::size_t index, const Vec3d& to) const;

  struct Source {
    Vec3d center, normal;  // normal: of one-sided flat lights, else 0
    double area = 0, power = 0;
  };
  std::vector<Source> sources_;  // by PackLight::index
};

}  // namespace steradian
