#include "steradian/light_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shapes/punctual.h"

namespace steradian {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// The two of the rising angles between which a value lies, and the fraction of the way; both are the same if there is only one.
// Precondition: the value is within them.
struct AnglePair {
  std::size_t low, high;
  double share;
};
AnglePair find(const std::vector<double>& angles, double at) {
  if (angles.size() == 1) return {0, 0, 0};
  const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, at);
  const auto high = static_cast<std::size_t>(above - angles.begin());
  return {high - 1, high, std::clamp((at - angles[high - 1]) / (angles[high] - angles[high - 1]), 0.0, 1.0)};
}

// Angles carry rounding: a value on the first or last one counts as within.
bool is_within(const std::vector<double>& angles, double at) {
  constexpr double kRounding = 1e-9;
  return angles.size() == 1 || (at >= angles.front() - kRounding && at <= angles.back() + kRounding);
}

}  // namespace

double intensity(const LightProfile& profile, Vec3d d) {
  if (profile.candela.empty() || d == Vec3d{}) return 0;
  // At the poles, where all half planes meet, rounding would choose the half plane; not all files have one value there.
  constexpr double kPole = 1e-6;
  double vertical, horizontal;
  if (profile.type == LightProfile::Type::c) {
    const double across = std::hypot(d.x, d.y);
    vertical = std::atan2(across, d.z) / kDegree;
    horizontal = across > kPole * std::fabs(d.z) ? std::atan2(d.y, d.x) / kDegree : 0;
    if (horizontal < 0) horizontal += 360;
  } else {
    const double across = std::hypot(d.x, d.z);
    vertical = across > kPole * std::fabs(d.y) ? std::atan2(d.x, d.z) / kDegree : 0;
    horizontal = std::atan2(-d.y, across) / kDegree;
  }
  if (!is_within(profile.vertical, vertical) || !is_within(profile.horizontal, horizontal)) return 0;
  const AnglePair v = find(profile.vertical, vertical), h = find(profile.horizontal, horizontal);
  const auto along = [&](std::size_t plane) {
    const double* of = &profile.candela[plane * profile.vertical.size()];
    return of[v.low] + v.share * (of[v.high] - of[v.low]);
  };
  return along(h.low) + h.share * (along(h.high) - along(h.low));
}

namespace {

// Integral of the weight sin(t) times the function that is linear from (a, value_a) to (b, value_b); a, b in radians.
double times_sine(double a, double b, double value_a, double value_b) {
  if (b - a < 1e-4) return (b - a) * std::sin((a + b) / 2) * (value_a + value_b) / 2;  // the differences below cancel
  const double slope = (value_b - value_a) / (b - a);
  return value_a * std::cos(a) - value_b * std::cos(b) + slope * (std::sin(b) - std::sin(a));
}

}  // namespace

double luminous_flux(const LightProfile& profile) {
  if (profile.candela.empty()) return 0;
  const std::vector<double>&v = profile.vertical, &h = profile.horizontal;
  const auto value = [&](std::size_t plane, std::size_t angle) { return profile.candela[plane * v.size() + angle]; };
  double sum = 0;
  if (profile.type == LightProfile::Type::c) {
    // The solid angle has the sine of the vertical angle as weight. Over a horizontal step the mean of both planes is exact.
    for (std::size_t i = 0; i + 1 < v.size(); ++i) {
      const auto band = [&](std::size_t plane) {
        return times_sine(v[i] * kDegree, v[i + 1] * kDegree, value(plane, i), value(plane, i + 1));
      };
      if (h.size() == 1) sum += 2 * std::numbers::pi * band(0);
      for (std::size_t k = 0; k + 1 < h.size(); ++k) sum += (h[k + 1] - h[k]) * kDegree * (band(k) + band(k + 1)) / 2;
    }
    return sum;
  }
  // Type b: the weight is the cosine of the horizontal angle, which is the sine of 90 degrees minus the angle.
  for (std::size_t k = 0; k + 1 < h.size(); ++k)
    for (std::size_t i = 0; i + 1 < v.size(); ++i) {
      const auto mean = [&](std::size_t plane) { return (value(plane, i) + value(plane, i + 1)) / 2; };
      sum += (v[i + 1] - v[i]) * kDegree * times_sine((90 - h[k + 1]) * kDegree, (90 - h[k]) * kDegree, mean(k + 1), mean(k));
    }
  return sum;
}

double packed::profile_intensity(const Punctual& light, double x, double y, double z) {
  const Vec3d d{x, y, z};
  return intensity(*light.profile, {dot(d, light.axes.x), dot(d, light.axes.y), dot(d, light.axes.aim)});
}

ProfileAxes profile_axes(Vec3d aim, Vec3d towards_x) {
  aim = normalized(aim);
  const Frame frame = Frame::from_normal_and_tangent(aim, towards_x);
  // The order is counter-clockwise as seen from behind, where aim points away.
  return {frame.x, cross(frame.x, aim), aim};
}

}  // namespace steradian
