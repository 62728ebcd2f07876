// <text> as outlines: positions of its letters, and their fonts.
#pragma once

#include <functional>
#include <vector>

#include "plane/svg/style/style.h"
#include "plane/svg/text/fonts.h"

namespace steradian::plane::svg {

// Letters in one element that share its style.
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

// The runs of a <text> of the given style, letters from left to right by their advances and kerning pairs. x, y, dx and dy may be lists;
// text-anchor applies to each line. The document's warnings name unsupported features. `spend` is called for every letter.
std::vector<TextRun> lay_out_text(SvgDocument& document, Styles& styles, Fonts& fonts, pugi::xml_node text, const Style& style, Vec2d whole,
                                  const std::function<void()>& spend);

}  // namespace steradian::plane::svg
