// The corners of a lamp that is a flat polygon: a mesh of its file, with one primitive of one material.
#pragma once

#include <optional>
#include <vector>

#include "document/lamps.h"

namespace steradian::view {

struct Outline {
  Vec3d normal{0, 0, 1};                     // normal of the front, from which the first contour runs counter-clockwise
  std::vector<std::vector<Vec3d>> contours;  // in the frame of its node, holes after their outer contour
};

// Empty if the lamp's mesh is not flat, is in several pieces, has a texture, or is moved by a skin or morph targets.
std::optional<Outline> outline_of(const EditedDocument& document, const Lamp& lamp);

// Replaces the lamp's mesh by the outline, for all nodes that show it. Returns false and changes nothing if the outline crosses itself.
bool set_outline(EditedDocument& document, const Lamp& lamp, const Outline& outline);

// Adds a lamp of five corners with radiance 5 that shines along `direction`; returns its node.
int add_polygon_light(EditedDocument& document, Vec3d position, Vec3d direction, double size = 1);

}  // namespace steradian::view
