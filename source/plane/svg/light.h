// What elements inherit, and what a light made of one emits.
#pragma once

#include <limits>
#include <string>

#include "plane/svg/document.h"
#include "plane/svg/text.h"
#include "steradian/plane.h"

namespace steradian::plane::svg {

enum class Role { by_shape, light, occluder, ignore };

// What elements inherit.
struct Style {
  std::string fill = "black", stroke = "none", color = "black", cap = "butt", rule = "nonzero";
  double stroke_width = 1;
  Role role = Role::by_shape;
  double intensity = 1;
  double opacity = 1, fill_opacity = 1, stroke_opacity = 1;
  double range = std::numeric_limits<double>::infinity();
  PlaneProfile profile = PlaneProfile::uniform;
  Vec2d spot_axis;
  double spot_half_angle = 0;
  Transform transform;
};

// The emission of a body in a picture of the given size.
PlaneEmission emission_of(Document& document, pugi::xml_node n, const PlaneBody& body, const Style& style, bool filled, Vec2d size);

}  // namespace steradian::plane::svg
