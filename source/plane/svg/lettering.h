// <text> as outlines: where its letters stand, and in which fonts.
#pragma once

#include <functional>
#include <vector>

#include "plane/svg/fonts.h"
#include "plane/svg/style.h"

namespace steradian::plane::svg {

// Letters that stand in one element and share its style.
struct TextRun {
  struct Letter {
    const Face* face;
    unsigned glyph;
    Vec2d at;  // on the baseline
  };
  pugi::xml_node node;
  Style style;
  std::vector<Letter> letters;
};

// The runs of a <text> of the given style, letters from left to right by their advances and kerning pairs. x, y, dx and dy may
// be lists; text-anchor is by line. What is left out is named in the document's warnings. `spend` is told of every letter.
std::vector<TextRun> lay_out_text(Document& document, Styles& styles, Fonts& fonts, pugi::xml_node text, const Style& style, Vec2d whole,
                                  const std::function<void()>& spend);

}  // namespace steradian::plane::svg
