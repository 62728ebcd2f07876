#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "steradian/compare.h"
#include "steradian/error.h"

namespace steradian {
namespace {

void check_finite(const Picture& picture, const char* which) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (!is_finite(picture.at(x, y))) throw Error(which, "pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") is not finite");
}

// Ratio of two numbers: 0/0 is no difference, x/0 an infinite one.
double ratio(double a, double b, double both_zero) {
  if (b != 0) return a / b;
  return a == 0 ? both_zero : std::numeric_limits<double>::infinity();
}

void check_alike(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height)
    throw Error("", "the pictures differ in size: " + std::to_string(a.width) + " x " + std::to_string(a.height) + " and " +
                        std::to_string(b.width) + " x " + std::to_string(b.height));
  check_finite(a, "first picture");
  check_finite(b, "second picture");
}

}  // namespace

Difference difference(const Picture& a, const Picture& b) {
  check_alike(a, b);
  Difference d;
  double square = 0, square_b = 0, sum_a = 0, sum_b = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const auto pa = static_cast<Vec3d>(a.at(x, y)), pb = static_cast<Vec3d>(b.at(x, y));
      const Vec3d e = pa - pb;
      square += dot(e, e);
      square_b += dot(pb, pb);
      sum_a += pa.x + pa.y + pa.z;
      sum_b += pb.x + pb.y + pb.z;
      const double largest = std::max({std::fabs(e.x), std::fabs(e.y), std::fabs(e.z)});
      if (largest > d.max) {
        d.max = largest;
        d.max_x = x;
        d.max_y = y;
      }
    }
  const double n = 3.0 * static_cast<double>(a.pixels.size());
  d.rmse = n > 0 ? std::sqrt(square / n) : 0;
  d.relative_l2 = std::sqrt(ratio(square, square_b, 0));
  d.mean_ratio = ratio(sum_a, sum_b, 1);
  return d;
}

Coverage coverage(const Picture& a, const Picture& b, const std::vector<std::string>& layers) {
  check_alike(a, b);
  constexpr double kDeviations = 4;
  constexpr double kRounding = 16 * static_cast<double>(std::numeric_limits<float>::epsilon());  // of a value
  for (const std::string& layer : layers)
    if (!a.layers.contains(layer)) throw Error("first picture", "has no layer '" + layer + "'", "render it with the option that makes it");
  const auto variance = b.layers.find("variance");
  const auto channels = [](Vec3f v) { return std::array{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; };
  Coverage result;
  std::size_t covered = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const auto of_a = channels(a.pixels[i]), of_b = channels(b.pixels[i]);
    const auto spread = variance == b.layers.end() ? std::array<double, 3>{} : channels(variance->second[i]);
    bool all = true;
    for (std::size_t c = 0; c < 3; ++c) {
      double allowed = kDeviations * std::sqrt(std::max(spread[c], 0.0)) + kRounding * std::fabs(of_b[c]);
      for (const std::string& layer : layers) allowed += channels(a.layers.at(layer)[i])[c];
      const double part = ratio(std::fabs(of_a[c] - of_b[c]), allowed, 0);
      all = all && part <= 1;
      if (part <= result.worst) continue;
      result.worst = part;
      result.worst_x = static_cast<int>(i % static_cast<std::size_t>(a.width));
      result.worst_y = static_cast<int>(i / static_cast<std::size_t>(a.width));
    }
    covered += all ? 1 : 0;
  }
  if (!a.pixels.empty()) result.fraction = static_cast<double>(covered) / static_cast<double>(a.pixels.size());
  return result;
}

double white_of(const Picture& picture) {
  std::vector<float> values;
  values.reserve(3 * picture.pixels.size());
  for (const Vec3f& c : picture.pixels) values.insert(values.end(), {c.x, c.y, c.z});
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(values.size() - 1) * 0.999);
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

}  // namespace steradian
