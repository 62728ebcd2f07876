// Strokes with a width: the outline of what a pen draws along a line.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/svg/text/text.h"
#include "steradian/plane.h"

namespace steradian::plane::svg {

enum class Cap { butt, round, square };
enum class Join { miter, round, bevel };

struct Stroke {
  double radius = 0.5;  // half of the width
  Cap cap = Cap::butt;
  Join join = Join::miter;
  double miter_limit = 4;  // of a corner's length to the width: longer ones are cut off
};

// The stroke along a line without ends of its own if it is closed; empty if nothing is drawn. It is exact but for round corners and ends,
// which are off by `tolerance` at most: those of one segment make a capsule.
PlaneBody stroke_of(const std::vector<Vec2d>& line, bool closed, const Stroke& stroke, double tolerance);

// The same for a line after a transform, which also changes the pen: the stroke is that of the element's own coordinates. A transform that
// flattens the pen to less than a millionth of its width leaves nothing.
PlaneBody stroke_after(const Transform& transform, const std::vector<Vec2d>& line, bool closed, const Stroke& stroke, double tolerance);

// About the most points that it returns; a skewing transform may add some.
std::uint64_t most_points(const Transform& transform, const std::vector<Vec2d>& line, const Stroke& stroke, double tolerance);

}  // namespace steradian::plane::svg
