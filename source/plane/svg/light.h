// Light in a drawing: the emission of an element, and effects of extras.
#pragma once

#include <vector>

#include "plane/svg/style/style.h"
#include "steradian/plane.h"

namespace steradian::plane::svg {

// Glass, mirrors, translucent stones, and lines with colours along them.

// Reads the effects of an occluder on light besides blocking. Throws Error with the element's line if its shape does not support them.
void take_extras(const SvgDocument& document, pugi::xml_node n, const Style& style, PlaneBody& body);

// The colours of data-texture along a light: the radiance of the line, at least one. Throws Error with the element's line.
std::vector<Vec3d> texels_of(const SvgDocument& document, pugi::xml_node n, const Style& style, const PlaneBody& line);

// Emission of a light from an element.

// The emission of a body in a picture of the given size.
PlaneEmission emission_of(SvgDocument& document, pugi::xml_node n, const PlaneBody& body, const Style& style, bool filled, Vec2d size);

// The colour of a drawn occluder; black if it has none that is supported.
Vec3d color_of(const SvgDocument& document, const Style& style, bool filled);

}  // namespace steradian::plane::svg
