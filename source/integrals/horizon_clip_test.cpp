// The clip returns edges whose boundary integrals are those of the clipped light.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "steradian/kernels.h"

namespace steradian::horizon_clip_test {
namespace {

using K = Kernels<double>;

// Irradiance from the sum of edge vectors over all edges that the clip returns.
double irradiance_by_segments(const std::vector<K::vec3>& v) {
  K k;
  double sum = 0;
  auto clip = k.horizon_clip_begin();
  for (std::size_t i = 0; i < v.size(); ++i) {
    clip = k.horizon_clip_edge(clip, v[i], v[(i + 1) % v.size()]);
    EXPECT_GE(clip.start.z.v, 0.0);
    EXPECT_GE(clip.end.z.v, 0.0);
    sum += k.polygon_edge(clip.start, clip.end).z.v;
    if (any_lane(clip.closes)) sum += k.polygon_edge(clip.arc_start, clip.arc_end).z.v;
  }
  clip = k.horizon_clip_finish(clip);
  if (any_lane(clip.closes)) sum += k.polygon_edge(clip.arc_start, clip.arc_end).z.v;
  return sum;
}

// A star with `spikes` points and a hole of its shape, in a random plane that the horizon cuts, in walk order.
struct Star {
  std::vector<K::vec3> outline, hole;
};

Star random_star(std::mt19937_64& random, int spikes) {
  K k;
  std::uniform_real_distribution<double> u(-1, 1);
  const K::vec3 centre(2 * u(random), 2 * u(random), 0.7 * u(random));
  K::vec3 normal = k.polygon_direction(K::vec3(u(random), u(random), u(random)));
  if (dot(normal, centre).v > 0) normal = -normal;  // towards the origin
  const auto frame = k.frame_from_normal(normal);
  Star star;
  for (int i = 2 * spikes; i-- > 0;) {  // clockwise as seen from the lit side: walk order
    const double angle = M_PI * (i + 0.3 * u(random)) / spikes, radius = i % 2 ? 0.4 : 1.5;
    const K::vec3 spoke = transform(frame, K::vec3(radius * std::cos(angle), radius * std::sin(angle), 0.0));
    star.outline.push_back(k.polygon_direction(centre + spoke));
    star.hole.insert(star.hole.begin(), k.polygon_direction(centre + spoke * 0.6));
  }
  return star;
}

}  // namespace

TEST(HorizonClip, SegmentsGiveTheIrradianceOfTheClippedOutline) {
  K k;
  std::mt19937_64 random(1);
  double worst = 0;
  int clipped = 0, with_many_arcs = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<K::vec3> v = random_star(random, 2 + trial % 6).outline;
    auto walk = k.polygon_begin();
    int crossings = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      walk = k.polygon_add_edge(walk, v[i], v[(i + 1) % v.size()]);
      crossings += (v[i].z.v < 0) != (v[(i + 1) % v.size()].z.v < 0);
    }
    clipped += crossings > 0;
    with_many_arcs += crossings > 2;
    // The start of the walk must not matter.
    const double expected = walk.edges.z.v + 0.5 * k.trig_atan2_unwrapped(walk.horizon.y, walk.horizon.x).v;
    for (int turn = 0; turn < 3; ++turn) {
      worst = std::max(worst, std::fabs(irradiance_by_segments(v) - expected));
      std::rotate(v.begin(), v.begin() + 1, v.end());
    }
  }
  // The error is that of a dozen edges of a few roundings each.
  EXPECT_LT(worst, 1e-13) << "seed 1";
  EXPECT_GT(clipped, 5000);
  EXPECT_GT(with_many_arcs, 500);
}

TEST(HorizonClip, OneClipServesContoursOneAfterTheOther) {
  K k;
  std::mt19937_64 random(2);
  double worst = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Star star = random_star(random, 2 + trial % 6);
    double sum = 0;
    auto clip = k.horizon_clip_begin();
    for (const auto& v : {star.outline, star.hole})
      for (std::size_t i = 0; i < v.size(); ++i) {
        clip = k.horizon_clip_edge(clip, v[i], v[(i + 1) % v.size()]);
        sum += k.polygon_edge(clip.start, clip.end).z.v;
        if (any_lane(clip.closes)) sum += k.polygon_edge(clip.arc_start, clip.arc_end).z.v;
      }
    clip = k.horizon_clip_finish(clip);
    if (any_lane(clip.closes)) sum += k.polygon_edge(clip.arc_start, clip.arc_end).z.v;
    const double apart = irradiance_by_segments(star.outline) + irradiance_by_segments(star.hole);
    worst = std::max(worst, std::fabs(sum - apart));
  }
  EXPECT_LT(worst, 1e-13) << "seed 2";
}

}  // namespace steradian::horizon_clip_test
