// Soft shadows of single points by several methods: how far off each is, and how long it takes.
#pragma once

#include <string>
#include <vector>

namespace steradian::studies {

// Of one method at the penumbra points of one scene.
struct ShadowRow {
  std::string method;
  double rms = 0;           // of the error over the unoccluded value, Lambert
  double rms_ltc = 0;       // likewise, a transformed cosine: GGX of alpha 0.3
  double off_by_1 = 0;      // share of the points that are off by more than a hundredth, Lambert
  double microseconds = 0;  // a point, both lobes
};

struct ShadowScene {
  std::string name;
  std::size_t triangles = 0;
  double segments = 0;          // that a point sees, in the mean
  double truth = 0;             // by how much the truth is off rays with refined cells, Lambert, rms over some of the points
  double ray_microseconds = 0;  // of a single shadow ray by Embree
  std::vector<ShadowRow> rows;
};

// Five scenes of the shadow tests, with so many points each that see a part of the light.
std::vector<ShadowScene> compare_shadows(int points);

// A sphere of about 1,000, 10,000 and 100,000 triangles: times alone.
std::vector<ShadowScene> grow_shadows(int points);

}  // namespace steradian::studies
