#include "lobes/charlie.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace steradian::lobes {
namespace {

// Lambda of the shadowing: a curve fitted by its authors, for the roughest and the smoothest cloth, blended.
double lambda(double cosine, double alpha) {
  const double cos_theta = std::clamp(cosine, 0.0, 1.0);  // of a unit vector up to rounding
  const double t = (1 - alpha) * (1 - alpha);
  const auto blend = [t](double smooth, double rough) { return t * smooth + (1 - t) * rough; };
  const double a = blend(25.3245, 21.5473), b = blend(3.32435, 3.82987), c = blend(0.16801, 0.19823);
  const double d = blend(-1.27393, -1.97760), e = blend(-4.85967, -4.32054);
  const auto curve = [&](double x) { return a / (1 + b * std::pow(x, c)) + d * x + e; };
  return cos_theta < 0.5 ? std::exp(curve(cos_theta)) : std::exp(2 * curve(0.5) - curve(1 - cos_theta));
}

}  // namespace

double charlie_lobe(double given_alpha, Vec3d v, Vec3d l) {
  if (!(l.z > 0) || !(v.z > 0)) return 0;
  const double alpha = std::max(given_alpha, kSmoothestCharlie);
  const Vec3d h = normalized(l + v);
  const double sine = std::sqrt(h.x * h.x + h.y * h.y);
  const double d = (2 + 1 / alpha) * std::pow(sine, 1 / alpha) / (2 * std::numbers::pi);
  return d / (4 * v.z * (1 + lambda(v.z, alpha) + lambda(l.z, alpha)));
}

}  // namespace steradian::lobes
