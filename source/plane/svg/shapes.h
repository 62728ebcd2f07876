// The outlines of lines, rects, polygons, polylines and paths.
#pragma once

#include "plane/svg/contours.h"
#include "plane/svg/document.h"

namespace steradian::plane::svg {

// Draws the element, which is one of them; percentages refer to +whole+, the picture's size in user units. Throws Error with its line if it
// is malformed.
void draw_shape(const Document& document, pugi::xml_node n, Vec2d whole, Pen& pen);

// Draws the box of x, y, width and height, with its round corners; nothing if it is empty. +height+ is the default height.
void draw_rect(const Document& document, pugi::xml_node n, Vec2d whole, double height, Pen& pen);

}  // namespace steradian::plane::svg
