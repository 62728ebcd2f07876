// Glass, mirrors, stones that let light in, and lines with colours along them.
#pragma once

#include <vector>

#include "plane/svg/style.h"
#include "steradian/plane.h"

namespace steradian::plane::svg {

// What an occluder does with light other than to block it; throws Error with the element's line where its shape cannot.
void take_extras(const Document& document, pugi::xml_node n, const Style& style, PlaneBody& body);

// The colours of data-texture along a light: what the line sends out, at least one. Throws Error with the element's line.
std::vector<Vec3d> texels_of(const Document& document, pugi::xml_node n, const Style& style, const PlaneBody& line);

}  // namespace steradian::plane::svg
