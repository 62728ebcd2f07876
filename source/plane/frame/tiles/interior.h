// The inside of a light: it has the same radiance in all directions, except for other bodies inside.
#pragma once

#include <optional>
#include <vector>

#include "plane/exact/outline.h"

namespace steradian::plane {

struct LightInterior {
  // Curves of the light and of all bodies that may reach into it; empty: nothing does.
  std::vector<const Curve*> curves;
  std::size_t own = 0;  // the light's own curves come first
  // If only dark segments reach into a round light: their parts inside. All are nearer than the light's own outline, so that the directions
  // that they occlude need no depth.
  std::vector<Curve> chords;
  bool by_chords = false;
  // If segments and circles reach into a round light, or anything into a polygon, emitting or not: their parts inside.
  std::vector<Curve> parts;
  bool by_parts = false;    // a round light: nothing of its own outline occludes them
  bool in_polygon = false;  // the light's own outline, [0, own) of `curves`, may occlude them
};

// From within a light its own outline does not matter, since the light is the same in all directions, unless it occludes another body.
// Returns those of the light's curves [0, own) that may do so for a point of a circle, and all others.
std::vector<const Curve*> curves_that_matter_within(const std::vector<const Curve*>& curves, std::size_t own, Vec2d center, double radius);

// The same for bodies that reach into a polygon. The parts remain that no chain of the light's edges occludes from all of the circle, and
// the edges that may occlude some of them, which come first.
struct SeenWithin {
  std::vector<const Curve*> curves;
  std::size_t own = 0;
};
SeenWithin seen_within(const LightInterior& polygon, Vec2d center, double radius);
// Selects from those the curves that matter to a point of the circle: parts that face it, and edges within the triangle of a part and the
// point.
void keep_seen_from(const SeenWithin& all, Vec2d p, SeenWithin& seen);

// The part of a segment inside a circle, if any.
std::optional<Curve> clipped_to_circle(const Curve& segment, const PlaneEllipse& circle);

// The same for a full circle.
std::optional<Curve> circle_clipped_to_circle(const Curve& other, const PlaneEllipse& circle);

// Fraction of the circle of directions that chords leave open, from a point among them.
double open_share(const std::vector<Curve>& chords, Vec2d p);
double open_share(const std::vector<const Curve*>& chords, Vec2d p);

}  // namespace steradian::plane
