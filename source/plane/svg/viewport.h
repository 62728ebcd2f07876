// The box that an <svg> or a <symbol> shows, and how it is fitted into a given area.
#pragma once

#include <optional>

#include "plane/svg/document.h"
#include "plane/svg/text/text.h"
#include "steradian/plane.h"

namespace steradian::plane::svg {

struct ViewBox {
  Vec2d origin, size;
};

struct Viewport {
  std::optional<ViewBox> box;
  PlaneFit fit = PlaneFit::meet;
  Vec2d align{0.5, 0.5};

  // Maps the box to the area at a corner. A box without an area shows nothing.
  Transform into(Vec2d corner, Vec2d room) const;
};

// Reads viewBox and preserveAspectRatio.
Viewport viewport_of(const SvgDocument& document, pugi::xml_node n);

}  // namespace steradian::plane::svg
