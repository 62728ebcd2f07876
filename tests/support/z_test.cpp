#include "support/z_test.h"

#include <algorithm>
#include <cmath>

#include "steradian/error.h"

namespace steradian::image {
namespace {

// Threshold t with P(|z| > t) = p for a standard normal z, by bisection.
double two_sided_threshold(double p) {
  double low = 0, high = 40;
  for (int i = 0; i < 80; ++i) {
    const double middle = (low + high) / 2;
    (std::erfc(middle / std::sqrt(2.0)) > p ? low : high) = middle;
  }
  return high;
}

}  // namespace

ZTest z_test(const Picture& picture, const Picture& estimate, double rounding) {
  if (picture.width != estimate.width || picture.height != estimate.height) throw Error("", "the pictures differ in size");
  const auto found = estimate.layers.find("variance");
  if (found == estimate.layers.end()) throw Error("", "the estimate has no layer 'variance'");
  const auto channel = [](Vec3f v, int c) { return static_cast<double>(c == 0 ? v.x : c == 1 ? v.y : v.z); };
  ZTest test;
  const double count = 3.0 * static_cast<double>(picture.pixels.size());
  test.threshold = two_sided_threshold(-std::expm1(std::log1p(-0.01) / count));
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double a = channel(picture.pixels[i], c), b = channel(estimate.pixels[i], c);
      const double sigma = std::sqrt(channel(found->second[i], c)) + rounding * std::fabs(b);
      const double difference = std::fabs(a - b);
      if (difference == 0 && sigma == 0) continue;
      ++test.tested;
      const double z = difference / std::max(sigma, 1e-300);
      test.worst = std::max(test.worst, z);
      if (z <= test.threshold) ++test.accepted;
    }
  return test;
}

void add_variance_of_rare_samples(Picture& estimate, const Picture& open) {
  constexpr float kShare = 0.05f;
  std::vector<Vec3f>& variance = estimate.layers.at("variance");
  for (std::size_t i = 0; i < open.pixels.size(); ++i) {
    const Vec3f error = open.pixels[i] * (kShare / 3);
    const float share = estimate.pixels[i].x / std::max(open.pixels[i].x, 1e-9f);
    if (share < kShare || share > 1 - kShare) variance[i] += error * error;
  }
}

}  // namespace steradian::image
