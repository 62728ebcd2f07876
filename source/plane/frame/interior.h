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
  // Where segments and circles reach into a round light, or anything into a polygon, shining or not: their parts inside.
  std::vector<Curve> parts;
  bool by_parts = false;    // a round light: nothing of its own outline hides them
  bool in_polygon = false;  // the light's own outline, [0, own) of `curves`, may
};

// Seen from within a light its own outline says nothing, since the light is the same in all directions: it matters only
// where it hides something else. Of the light's curves [0, own), those that may do so for a point of a circle; all others.
std::vector<const Curve*> curves_that_matter_within(const std::vector<const Curve*>& curves, std::size_t own, Vec2d center, double radius);

// The same for what reaches into a polygon: of its parts, those that no chain of the light's edges hides from all of the circle, and the
// edges that may hide something of them, which come first.
struct SeenWithin {
  std::vector<const Curve*> curves;
  std::size_t own = 0;
};
SeenWithin seen_within(const LightInterior& polygon, Vec2d center, double radius);
// Of those, what matters to a point of the circle: parts that face it, and edges within the triangle of one of them and the point.
void keep_seen_from(const SeenWithin& all, Vec2d p, SeenWithin& seen);

// The part of a segment inside a circle, if any.
std::optional<Curve> clipped_to_circle(const Curve& segment, const Ellipse& circle);

// The same of a full circle.
std::optional<Curve> circle_clipped_to_circle(const Curve& other, const Ellipse& circle);

// Share of the circle of directions that chords leave open, seen from a point among them.
double open_share(const std::vector<Curve>& chords, Vec2d p);
double open_share(const std::vector<const Curve*>& chords, Vec2d p);

}  // namespace steradian::plane
