// The methods for Phong lobes that the benches time, under the names of their benches.
#pragma once

#include <string>
#include <vector>

#include "steradian/phong.h"

namespace steradian::bench {

struct PhongVariant {
  std::string name;
  PhongOptions options;
};

inline const std::vector<PhongVariant>& phong_variants() {
  static const std::vector<PhongVariant> variants = {{"arvo", {Method::arvo}},       {"lorentzian", {Method::lorentzian}},
                                                     {"pearson", {Method::pearson}}, {"ellipsoid", {Method::ellipsoid}},
                                                     {"series", {Method::series}},   {"series-high", {Method::series, Quality::high}}};
  return variants;
}

inline constexpr int kPhongExponents[] = {100, 500, 5000};

}  // namespace steradian::bench
