// Contours: outlines of points, from lines, Bezier curves and arcs.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "plane/svg/text/text.h"

namespace steradian::plane::svg {

struct Polylines {
  std::vector<std::vector<Vec2d>> points;
  std::vector<bool> closed;
};

// A pen that draws in the coordinates of an element. Its polylines are in the scene's coordinates, after the transform, and no further than
// `tolerance` from the curves there.
class Pen {
 public:
  // `before` receives the number of points before they are added; it may throw.
  using Before = std::function<void(std::size_t points)>;
  Pen(const Transform& transform, double tolerance, Before before)
      : transform_(transform), tolerance_(tolerance), before_(std::move(before)) {}

  Vec2d at() const { return at_; }
  bool has_begun() const { return begun_; }
  void move(Vec2d to);
  void line(Vec2d to);
  void cubic(Vec2d first_control, Vec2d second_control, Vec2d to);
  // An arc of an ellipse with half axes rx and ry, the first turned by `turn` radians; `large` and `sweep` as in SVG.
  void arc(double rx, double ry, double turn, bool large, bool sweep, Vec2d to);
  void close();
  Polylines finish();

 private:
  void begin(int more);
  void bezier(Vec2d a, Vec2d b, Vec2d c, Vec2d d, int halvings);
  void end_contour(bool closed);

  Transform transform_;
  double tolerance_;
  Before before_;
  Polylines result_;
  std::vector<Vec2d> points_;
  Vec2d at_, start_;
  bool begun_ = false;
};

}  // namespace steradian::plane::svg
