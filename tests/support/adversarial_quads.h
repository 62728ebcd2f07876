// Test support: quads of the lobe's size and near its axis, where every method has its largest errors.
#pragma once

#include <cmath>

#include "support/random_configurations.h"

namespace steradian::moment {

struct LobeAndLight {
  PolygonLight light;
  ShadingPoint at;
  double n;
};

// The view whose mirrored direction is r.
inline Vec3d view_mirrored_to(Vec3d r, Vec3d normal) { return normal * (2 * dot(normal, r)) - r; }

// Exponents log-uniform in [1, 10,000]; a plane through a place within four lobe widths of the axis, tilted by up to
// 80 degrees; vertices of a star-shaped quad from a fifth of the lobe's width to twenty widths away.
inline LobeAndLight adversarial_quad(reference::Random& random) {
  LobeAndLight c;
  c.n = std::exp(random.uniform(0, std::log(10000.0)));
  c.at.position = {0, 0, 0};
  c.at.normal = reference::random_direction(random);
  const Vec3d r = reference::random_view(random, c.at.normal);
  c.at.view = view_mirrored_to(r, c.at.normal);
  const double width = std::sqrt(2 / (c.n + 1));
  const Frame about_r = Frame::from_normal(r);
  const double away = 4 * width * random.uniform() * random.uniform(), azimuth = 2 * M_PI * random.uniform();
  const Vec3d towards = normalized(about_r.to_world({away * std::cos(azimuth), away * std::sin(azimuth), 1}));
  const double tilt = random.uniform(0, 80 * M_PI / 180), turn = 2 * M_PI * random.uniform();
  const Frame about_light = Frame::from_normal(towards);
  const Vec3d plane = about_light.to_world({std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), -std::cos(tilt)});
  const double size = std::fmin(width * std::pow(10.0, random.uniform(-0.7, 1.3)), 3.0);
  c.light.vertices = reference::random_star(random, Frame::from_normal(plane), towards, size, 4, 0.3);
  return c;
}

}  // namespace steradian::moment
