// The corners of a lamp that is a flat polygon: a mesh of its file, one primitive of one material.
#pragma once

#include <optional>
#include <vector>

#include "lamps.h"

namespace steradian::view {

struct Outline {
  Vec3d normal{0, 0, 1};                     // of the side from which the first contour runs counter-clockwise: its front
  std::vector<std::vector<Vec3d>> contours;  // in the frame of its node, holes after what is around them
};

// Nothing where the lamp is no such mesh: not flat, in several pieces, with a texture, or moved by a skin or morph targets.
std::optional<Outline> outline_of(const Document& document, const Lamp& lamp);

// Puts the outline in the place of the lamp's mesh, for all nodes that show it. False, and nothing changed, where it crosses itself.
bool set_outline(Document& document, const Lamp& lamp, const Outline& outline);

// A lamp of five corners, radiance 5, that shines along `direction`; its node.
int add_polygon_light(Document& document, Vec3d position, Vec3d direction, double size = 1);

}  // namespace steradian::view
