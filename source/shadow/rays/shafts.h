// Shafts between a group of points and lights: open shafts, and the shafts of round lights.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/box_tree.h"
#include "shadow/edges/edges.h"
#include "shadow/region/light_frame.h"
#include "steradian/area_light.h"

namespace steradian::shadow {

// Open shafts: a test whether anything at all can lie between a group of points and lights, as a whole. See section "Open shafts" of
// docs/theory/shadows.md.

// Half spaces that contain the hull of two boxes: its sides, or fewer.
class HullOfBoxes {
 public:
  HullOfBoxes(const Box3d& a, const Box3d& b);
  bool may_meet(const Box3d& box) const;
  bool may_meet(const Vec3d (&corners)[3]) const;

 private:
  // A side parallel to an axis of space, through an edge of each box. Inside: u x + v y <= offset, in the two other coordinates.
  struct Slant {
    double u, v, offset;
    int x, y;
  };
  Box3d all_;
  Slant slants_[12];
  int count_ = 0;
};

// A bounding volume hierarchy of triangles.
class TriangleTree {
 public:
  explicit TriangleTree(const EdgeMesh& mesh);

  // Points that look through shafts, one group after another. Caches what it finds about triangles.
  class Viewers {
   public:
    void take(const std::vector<Vec3d>& points);
    const Box3d& box() const { return box_; }

   private:
    friend class TriangleTree;
    // Distances of the points in front of a plane.
    Interval<double> over(const Plane& plane, std::uint32_t triangle);
    Box3d box_;
    std::vector<double> x_, y_, z_;
    std::vector<Interval<double>> ranges_;  // by triangle
    std::vector<std::uint32_t> stamps_;     // group for which the range is valid
    std::uint32_t stamp_ = 0;
  };

  // Returns false if some triangle may lie between a point and the light's box. True is certain, except for occluders less than `margin`
  // out of the light's box.
  bool is_open(Viewers& viewers, const Box3d& light, double margin) const;

  // The same for triangles that reach beyond the plane of a frame, except those marked in `but`. They have no margin.
  bool is_open_beyond(const LightFrame& frame, Viewers& viewers, const Box3d& light, const std::vector<bool>& but) const;

  // Triangles whose box meets a box, ascending.
  std::vector<std::uint32_t> near(const Box3d& box) const;
  // Triangles whose box meets the box of any polygon of a round light, ascending, except those inside the light.
  std::vector<std::uint32_t> near(const AreaLight& light, std::span<const std::uint32_t> inside) const;

 private:
  bool separates(std::uint32_t triangle, Viewers& viewers, const Box3d& light, double margin) const;

  const EdgeMesh& mesh_;
  BoxTree<Box3d> tree_;
};

// Round lights and groups of points: occluders that may lie between, found before each point uses its own polygon (round_light.h).

struct Ball {
  Vec3d center;
  double radius = 0;
};

// A ball that contains a sphere, ellipsoid or tube.
Ball ball_around(const AreaLight& light);

// Largest distance from the ball's centre that the box of a round light's polygon may reach (round_light.h), for any viewpoint. A sphere's
// polygon lies within the ball, except for its corners. A tube's polygon ends where lines of sight to its far end meet a plane between the
// axis and the point. Beside the tube, that is up to three times as far from the middle as that end.
double reach_of_polygon(const AreaLight& light);

// A frame whose shaft contains a sphere, ellipsoid or tube for all points of a group: a square behind its bounding ball. Returns none if
// the group is too near or too wide for one.
std::optional<LightFrame> frame_behind(const AreaLight& light, const std::vector<Vec3d>& points);

}  // namespace steradian::shadow
