// Test support: squares around a surface point, and relative errors over them.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "steradian/polygon_light.h"
#include "steradian/reference.h"

namespace steradian::reference {

// A square at distance 1 from the origin in all directions above -3 degrees, turned at random and tilted by at most 64 degrees.
inline PreparedPolygon random_square(Random& random, double side) {
  const double z = random.uniform(-0.05, 1), phi = random.uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
  const Vec3d centre = {r * std::cos(phi), r * std::sin(phi), z};
  const Vec3d tilt = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
  const Frame frame = Frame::from_normal(normalized(tilt - centre));
  const double turn = random.uniform(0, 2 * std::numbers::pi), h = 0.5 * side;
  const Vec3d x = frame.to_world({h * std::cos(turn), h * std::sin(turn), 0}), y = cross(frame.z, x);
  PolygonLight square;
  square.two_sided = true;
  square.vertices = {centre - x - y, centre + x - y, centre + x + y, centre - x + y};
  return prepare_polygon(square);
}

// A point at the origin with normal z; the view is so many degrees from it.
inline ShadingPoint seen_from(double degrees) {
  const double theta = degrees * std::numbers::pi / 180;
  return {{}, {0, 0, 1}, {std::sin(theta), 0, std::cos(theta)}};
}

// Root mean square of an error over that of the truth.
class RelativeRms {
 public:
  void add(double value, double truth) {
    error_ += (value - truth) * (value - truth);
    signal_ += truth * truth;
  }
  void add(const RelativeRms& other) {
    error_ += other.error_;
    signal_ += other.signal_;
  }
  double value() const { return signal_ > 0 ? std::sqrt(error_ / signal_) : 0; }

 private:
  double error_ = 0, signal_ = 0;
};

}  // namespace steradian::reference
