// The inside of a light: the same radiance in all directions, but for what else is in there.
#pragma once

#include <optional>
#include <vector>

#include "plane/exact/outline.h"

namespace steradian::plane {

struct LightInterior {
  // Of the light and of all that may reach into it; empty: nothing does.
  std::vector<const Curve*> curves;
  std::size_t own = 0;  // the light's own stand first
  // Where only dark segments reach into a round light: their parts inside. All that is nearer than the light's own
  // outline, so that the directions they take need no depth.
  std::vector<Curve> chords;
  bool by_chords = false;
  // Where segments and circles reach into a round light, shining or not: their parts inside.
  std::vector<Curve> parts;
  bool by_parts = false;
};

// Seen from within a light its own outline says nothing, since the light is the same in all directions: it matters only
// where it hides something else. Of the light's curves [0, own), those that may do so for a point of a circle; all others.
std::vector<const Curve*> curves_that_matter_within(const std::vector<const Curve*>& curves, std::size_t own, Vec2d center, double radius);

// The part of a segment inside a circle, if any.
std::optional<Curve> clipped_to_circle(const Curve& segment, const Ellipse& circle);

// The same of a full circle.
std::optional<Curve> circle_clipped_to_circle(const Curve& other, const Ellipse& circle);

// Share of the circle of directions that chords leave open, seen from a point among them.
double open_share(const std::vector<Curve>& chords, Vec2d p);

}  // namespace steradian::plane
