// Compares soft shadows of single points by several methods: the error and the time of each.
#pragma once

#include <string>
#include <vector>

namespace steradian::studies {

// The results of one method at the penumbra points of one scene.
struct ShadowRow {
  std::string method;
  double rms = 0;           // rms error over the unoccluded value, Lambert
  double rms_ltc = 0;       // the same for a transformed cosine: GGX of alpha 0.3
  double off_by_1 = 0;      // fraction of the points with an error above a hundredth, Lambert
  double microseconds = 0;  // per point, both lobes
};

struct ShadowScene {
  std::string name;
  std::size_t triangles = 0;
  double segments = 0;          // mean number of segments that a point sees
  double truth = 0;             // rms difference between the truth and rays with refined cells, Lambert, over some of the points
  double ray_microseconds = 0;  // time of a single shadow ray by Embree
  std::vector<ShadowRow> rows;
};

// Five scenes of the shadow tests, with that many points each that see a part of the light.
std::vector<ShadowScene> compare_shadows(int points);

// A sphere of about 1,000, 10,000 and 100,000 triangles: times only.
std::vector<ShadowScene> grow_shadows(int points);

}  // namespace steradian::studies
