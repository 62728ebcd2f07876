// What a light made of an element emits.
#pragma once

#include "plane/svg/style.h"
#include "steradian/plane.h"

namespace steradian::plane::svg {

// The emission of a body in a picture of the given size.
PlaneEmission emission_of(Document& document, pugi::xml_node n, const PlaneBody& body, const Style& style, bool filled, Vec2d size);

// The colour to draw an occluder with; black where it has none that is understood.
Vec3d color_of(const Document& document, const Style& style, bool filled);

}  // namespace steradian::plane::svg
