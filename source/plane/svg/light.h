// Emission of a light from an element.
#pragma once

#include "plane/svg/style/style.h"
#include "steradian/plane.h"

namespace steradian::plane::svg {

// The emission of a body in a picture of the given size.
PlaneEmission emission_of(Document& document, pugi::xml_node n, const PlaneBody& body, const Style& style, bool filled, Vec2d size);

// The colour of a drawn occluder; black if it has none that is supported.
Vec3d color_of(const Document& document, const Style& style, bool filled);

}  // namespace steradian::plane::svg
