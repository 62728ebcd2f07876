// What a radiance is asked with and answered by, whatever the method.
#pragma once

#include <cstdint>
#include <optional>

#include "steradian/method.h"
#include "steradian/vector.h"

namespace steradian {

struct RadianceOptions {
  Method method = Method::automatic;
  Quality quality = Quality::normal;
  Precision precision = Precision::double_;  // of the arithmetic; reference and sampled have double only
  int spp = 256;                             // of sampled: pairs of a light sample and a lobe sample
  std::uint64_t seed = 1;                    // of sampled
};

struct RadianceResult {
  Vec3d radiance;                        // towards the view [the light's radiance]
  std::optional<double> bound;           // of reference: on the absolute error of the largest channel
  std::optional<double> standard_error;  // of sampled: of the largest channel
  Method method = Method::automatic;     // the one that answered
};

}  // namespace steradian
