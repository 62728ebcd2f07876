// HatFit: the values of hat functions whose sum is nearest to given values, in least squares over an area.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "steradian/vector.h"

namespace steradian::bake {

// An unknown, and the value of its hat function at a place.
struct Hat {
  std::uint32_t unknown = 0;
  double value = 0;
};

class HatFit {
 public:
  explicit HatFit(std::size_t unknowns);
  ~HatFit();
  HatFit(HatFit&&) noexcept;

  // The sum of hats should be this value, over an area [m^2].
  void add_value(std::span<const Hat> hats, double area, Vec3d value);
  // The sum of hats should be zero: the difference between two neighbours, or between two sides of a seam.
  void add_zero(std::span<const Hat> hats, double area);

  // The values, none of them negative. Unknowns that no place determines are zero.
  std::vector<Vec3d> solve();

 private:
  struct Equations;
  std::unique_ptr<Equations> equations_;
};

}  // namespace steradian::bake
