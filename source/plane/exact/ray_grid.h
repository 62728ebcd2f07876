// Rays against all curves of a scene, over a uniform grid of cells.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/exact/outline.h"

namespace steradian::plane {

struct RayHit {
  const Curve* curve = nullptr;  // null: no hit
  double distance = 0;
  bool back = false;
};

class RayGrid {
 public:
  RayGrid() = default;
  // Stores pointers into `curves`; about two cells per curve.
  RayGrid(const std::vector<Curve>& curves, const std::vector<PlaneBody>& bodies);

  // The first curve in direction u (unit); inner faces count for two-sided curves and those of body `inside`.
  RayHit first_hit(Vec2d from, Vec2d u, int inside) const;

  bool is_empty() const { return columns_ == 0; }

  // Bodies whose boxes may hold p.
  const std::vector<int>& bodies_near(Vec2d p) const;

 private:
  int column(double x) const;
  int row(double y) const;
  Vec2d low_, high_;
  double cell_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<const Curve*>> cells_;
  std::vector<std::vector<int>> cell_bodies_;
  const std::vector<PlaneBody>* bodies_ = nullptr;
};

// Hit of a ray on one curve: the nearest one on a face that counts.
RayHit hit_curve(const Curve& curve, Vec2d from, Vec2d u, int inside);

}  // namespace steradian::plane
