// Test support: random lights, points and materials of every kind that the ground truth must handle.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "core/random.h"
#include "lobes/samplers.h"
#include "steradian/reference.h"

namespace steradian::reference {

using lobes::direction_at;

struct Configuration {
  PolygonLight light;
  ShadingPoint at;
  std::string kind;
};

inline Vec3d random_direction(Random& random) {
  const double z = random.uniform(-1, 1);
  return direction_at(z, std::sqrt(1 - z * z), random.uniform());
}

// A view of uniformly random height above the surface: grazing views are common.
inline Vec3d random_view(Random& random, Vec3d normal) {
  const double z = 1 - random.uniform();
  return Frame::from_normal(normal).to_world(direction_at(z, std::sqrt(1 - z * z), random.uniform()));
}

// A star-shaped outline about (0, 0) in a frame: jagged where the radius varies, nearly convex where it does not.
inline std::vector<Vec3d> random_star(Random& random, const Frame& frame, Vec3d centre, double size, int vertices, double smallest_radius) {
  std::vector<Vec3d> outline;
  for (int i = 0; i < vertices; ++i) {
    const double phi = 2 * std::numbers::pi * (i + 0.8 * random.uniform()) / vertices;
    const double radius = size * random.uniform(smallest_radius, 1);
    outline.push_back(centre + frame.to_world({radius * std::cos(phi), radius * std::sin(phi), 0}));
  }
  return outline;
}

// Lights that mostly cross the horizon, one in six each: convex, non-convex, with holes, tiny, huge, very near. One in
// five is placed behind the surface or turned away, unless it is two-sided.
inline Configuration random_configuration(Random& random) {
  static const char* const kKinds[] = {"convex", "non-convex", "holes", "tiny", "huge", "near"};
  Configuration c;
  const auto kind = random.bits() % 6;
  c.kind = kKinds[kind];
  c.at.position = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
  c.at.normal = random_direction(random);
  c.at.view = random_view(random, c.at.normal);
  const double size = kind == 3 ? std::pow(10.0, random.uniform(-5, -2)) : kind == 4 ? random.uniform(10, 1000) : 1;
  const Frame frame = Frame::from_normal(random_direction(random));
  const double height = kind == 5 ? std::pow(10.0, random.uniform(-6, -1)) : random.uniform(0.1, 2);
  const bool away = random.uniform() < 0.1;
  c.light.two_sided = random.uniform() < 0.3;
  const Vec3d aside{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), away ? height : -height};
  const Vec3d centre = c.at.position + frame.to_world(aside);
  const int vertices = 3 + static_cast<int>(random.bits() % 8);
  const double smallest = kind == 1 ? 0.2 : 0.8;
  c.light.vertices = random_star(random, frame, centre, size, vertices, smallest);
  if (kind == 2) {
    // The apothem of a triangle of radius 0.8 may be near 0: the hole stays within the part that any such outline contains.
    c.light.vertices = random_star(random, frame, centre, size, 8, 0.8);
    c.light.holes.push_back(random_star(random, frame, centre, 0.3 * size, 5, 0.3));
  }
  return c;
}

inline Material random_material(Random& random) {
  Material m;
  m.brdf = static_cast<Brdf>(random.bits() % 5);
  m.exponent = std::pow(10.0, random.uniform(0, 4));
  m.alpha_x = std::pow(10.0, random.uniform(-4, 0));
  m.alpha_y = random.uniform() < 0.5 ? m.alpha_x : std::pow(10.0, random.uniform(-4, 0));
  m.tangent = random_direction(random);
  m.shadowing = random.uniform() < 0.5;
  if (random.uniform() < 0.5) m.f0 = {random.uniform(), random.uniform(), random.uniform()};
  return m;
}

inline std::string describe(const Configuration& c, const Material& m) {
  return c.kind + (c.light.two_sided ? " two-sided " : " ") + name_of(m.brdf) + " n=" + std::to_string(m.exponent) +
         " alpha=" + std::to_string(m.alpha_x) + "," + std::to_string(m.alpha_y) + " v_z=" + std::to_string(dot(c.at.view, c.at.normal)) +
         (m.shadowing ? " smith" : " unshadowed");
}

}  // namespace steradian::reference
