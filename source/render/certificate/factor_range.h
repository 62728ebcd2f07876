// Ranges of the form factor from any point of one triangle to another triangle, behind occluders. They are proofs, not estimates.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/box.h"
#include "steradian/scene.h"
#include "steradian/vector.h"

namespace steradian::certificate {

// A triangle, counter-clockwise as seen from the side that is meant. Three equal corners are a point, with the normal of its surface; its
// radius is the rounding of its position.
struct OrientedTriangle {
  std::array<Vec3d, 3> corners;
  Vec3d normal, center;
  double radius = 0, area = 0;  // radius: of the corners about the center

  static OrientedTriangle of(const std::array<Vec3d, 3>& corners);
  static OrientedTriangle point(Vec3d position, Vec3d normal, double rounding);
  OrientedTriangle reversed() const;
  std::array<OrientedTriangle, 4> quarters() const;
};

// A convex polygon that stands between surfaces.
struct ConvexOccluder {
  std::vector<Vec3d> corners;
  Vec3d normal;
  Box3d box;
  bool may_let_through = false;  // shapes of lamps, which some light passes
};

// All triangles of a scene as occluders. Pairs that make up one convex polygon are joined.
struct OccluderSet {
  explicit OccluderSet(const Scene& scene);
  std::vector<ConvexOccluder> polygons;
  double tolerance = 0;  // distance below which surfaces count as touching
};

struct FactorRange {
  double low = 0, high = 0;
  bool is_open = true;  // nothing stands between any two of their points
  double slack = 0;     // part of the width that splits can take away
};

// The range of the form factor over the points of `from`. While ranges are wider than `enough` by what splits can take away, triangles are
// split into four.
//
//   through_lamps  true if the shapes of lamps block nothing
FactorRange factor_range(const OrientedTriangle& from, const OrientedTriangle& to, const OccluderSet& occluders, bool through_lamps,
                         double enough);

// The same without occluders, unsplit.
FactorRange whole_range(const OrientedTriangle& from, const OrientedTriangle& to);

// The form factor from a point to a triangle without occluders.
double whole_factor(Vec3d position, Vec3d normal, const OrientedTriangle& to);

}  // namespace steradian::certificate
