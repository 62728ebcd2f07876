// Test support: random rectangles over a surface, most of them near the lobe, and the quantities that tests compute from them.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "lobes/samplers.h"
#include "steradian/reference.h"

namespace steradian::ggx {

using reference::Random;

struct Setup {
  PolygonLight light;
  ShadingPoint at;
  Material material;
};

inline constexpr double kRadians = std::numbers::pi / 180;

// A rectangle facing the origin, tilted by up to 60 degrees, of half sizes 0.05 to 1.5 (log-uniform) at distance 1 from it,
// whose centre is within 3 widths of the lobe of the mirror direction, over a surface with normal z. May cross the horizon.
inline Setup random_rectangle(Random& random, double roughness, double view_degrees) {
  Setup s;
  const double alpha = roughness * roughness;
  const double theta = view_degrees * kRadians, phi = random.uniform(-std::numbers::pi, std::numbers::pi);
  s.at.normal = {0, 0, 1};
  s.at.view = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  s.material.brdf = Brdf::ggx;
  s.material.alpha_x = s.material.alpha_y = alpha;
  const Vec3d mirror{-s.at.view.x, -s.at.view.y, s.at.view.z};
  const double spread = std::min(3 * alpha, 1.0), turn = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double aside = spread * std::sqrt(random.uniform());
  const Vec3d direction = normalized(Frame::from_normal(mirror).to_world({2 * aside * std::cos(turn), 2 * aside * std::sin(turn), 1}));
  const double tilt = 60 * kRadians * random.uniform(), around = random.uniform(-std::numbers::pi, std::numbers::pi);
  const Vec3d normal =
      Frame::from_normal(-direction).to_world({std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), std::cos(tilt)});
  const Frame frame = Frame::from_normal(normal);
  const double spin = random.uniform(-std::numbers::pi, std::numbers::pi);
  const Vec3d x = frame.to_world({std::cos(spin), std::sin(spin), 0}) * std::exp(random.uniform(std::log(0.05), std::log(1.5)));
  const Vec3d y = frame.to_world({-std::sin(spin), std::cos(spin), 0}) * std::exp(random.uniform(std::log(0.05), std::log(1.5)));
  s.light.vertices = {direction - x - y, direction + x - y, direction + x + y, direction - x + y};
  return s;
}

}  // namespace steradian::ggx
