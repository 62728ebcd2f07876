// ConvexPatch: a convex part of the sphere of directions, between great circles. It is a polygon of a plane that touches the sphere.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "steradian/polygon_light.h"
#include "steradian/vector.h"

namespace steradian::environment {

class ConvexPatch {
 public:
  struct Corner {
    double x, y;
  };

  // The smallest patch that holds the directions, about a unit direction. Empty if one is more than 72 degrees off, or without area.
  static std::optional<ConvexPatch> around(Vec3d middle, const std::vector<Vec3d>& directions);

  // Keeps the side of a great circle with dot(normal, d) >= 0.
  void cut(Vec3d normal);
  // Removes the corners that cost the least area, down to `most`.
  void simplify(std::size_t most);

  bool has_area() const { return corners_.size() >= 3; }
  bool contains(Vec3d direction) const;
  // The part of a small quadrilateral that the patch covers, by the quadrilateral's corners.
  enum class Coverage { none, some, all };
  Coverage coverage_of(const std::array<Vec3d, 4>& quad) const;
  double solid_angle() const;
  Vec3d middle() const { return -frame_.z; }
  double reach() const;  // largest angle between the middle and a corner [rad]

  // Great circles that may cut the patch, by their normals: across its longest extent first.
  std::vector<Vec3d> cuts() const;

  // The polygon of the tangent plane, lit towards the sphere's centre.
  PolygonLight light(Vec3d radiance) const;

 private:
  std::optional<Corner> project(Vec3d direction) const;
  Vec3d lift(Corner c) const { return frame_.x * c.x + frame_.y * c.y - frame_.z; }

  Frame frame_;                  // z points from the patch to the sphere's centre
  std::vector<Corner> corners_;  // counter-clockwise about z
};

// A direction of a map with its solid angle and its luminance.
struct MapSample {
  Vec3d direction;
  double solid_angle = 0, value = 0;
};

// Integral of |value - mean| over the samples.
double unevenness(const std::vector<MapSample>& samples);

// The cut of a patch that leaves its two sides the most even.
Vec3d best_cut(const ConvexPatch& patch, const std::vector<MapSample>& samples);

}  // namespace steradian::environment
