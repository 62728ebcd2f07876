// Crossings of two curves.
#pragma once

#include "plane/exact/outline.h"

namespace steradian::plane {

struct Crossings {
  int count = 0;
  Vec2d at[4];
};

// Crossings of the whole lines and ellipses that the curves lie on, at most four; some may lie beyond the curves' ends.
Crossings intersect(const Curve& a, const Curve& b);

// Real roots in [low, high] of the polynomial c[0] + c[1] x + ... + c[degree] x^degree, degree at most 4.
struct Roots {
  int count = 0;
  double at[4];
};
Roots real_roots(const double* c, int degree, double low, double high);

}  // namespace steradian::plane
