// Means of a profiled light under the lobes of many points, on packs.
#pragma once

#include "core/simd.h"
#include "render/tile/tile.h"

namespace steradian {

class ProfiledLight;

// Arrays with one float per point, a multiple of 16.
struct ProfiledMeans {
  float* candela;  // the mean of the intensity over the cosine: ProfiledLight::radiance_of it is the radiance
  float* found;    // 1; 0 if the mean is not wanted, or the lobe is too narrow for strips (ProfiledLight computes those)
};

// The largest channel of a GGX lobe's factors, and its integral with these over the light at radiance 1; wanted where it is above 0.
struct ProfiledLobes {
  const float *f0, *f90, *integral;
};

struct ProfiledMeansTable {
  // wanted: above 0 where a mean is wanted.
  void (*diffuse)(const ProfiledLight& light, const Points& points, const float* wanted, const ProfiledMeans& means);
  void (*ggx)(const ProfiledLight& light, const Points& points, const ProfiledLobes& lobes, const ProfiledMeans& means);
};

STERADIAN_DECLARE_PACK_TABLE(ProfiledMeansTable, profiled_means_table)

}  // namespace steradian
