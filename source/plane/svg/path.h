// Outlines of SVG's shapes, and the d attribute of a path.
#pragma once

#include <string_view>

#include "plane/svg/contours.h"
#include "plane/svg/document.h"

namespace steradian::plane::svg {

// The d attribute of a path.

// Draws path data. Throws std::string with a description of the error.
void draw_path(std::string_view data, Pen& pen);

// Draws lines from point to point, as in the points attribute.
void draw_points(std::string_view points, Pen& pen);

// The outlines of lines, rects, polygons, polylines and paths.

// Draws the element, which is one of them; percentages refer to +whole+, the picture's size in user units. Throws Error with its line if it
// is malformed.
void draw_shape(const SvgDocument& document, pugi::xml_node n, Vec2d whole, Pen& pen);

// Draws the box of x, y, width and height, with its round corners; nothing if it is empty. +height+ is the default height.
void draw_rect(const SvgDocument& document, pugi::xml_node n, Vec2d whole, double height, Pen& pen);

}  // namespace steradian::plane::svg
