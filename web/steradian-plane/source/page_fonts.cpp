// Fonts of the page: src/letters.js draws their letters on a canvas and traces them. Without a canvas, as in node, there is no font, and
// <text> is left out with a warning.
#include <cstdlib>

#include "plane/svg/text/fonts.h"
#include "plane/svg/text/text.h"

// Functions of src/letters.js. A letter is a character.
extern "C" {
int page_font(const char* families, const char* weight, const char* slant);  // 0: none
double page_advance(int font, unsigned letter);                              // in units of the font's size, as all that follows
double page_kerning(int font, unsigned before, unsigned letter);
// Its outlines, from the left end of the baseline, y downwards: of each the number of its points and their coordinates; 0 ends the list.
// The caller frees it.
double* page_outlines(int font, unsigned letter);
}

namespace steradian::plane::svg {

struct Face::Handle {
  int font;
  std::string family;
};
Face::Face(std::unique_ptr<Handle> handle) : handle_(std::move(handle)) {}
Face::~Face() = default;
const std::string& Face::family() const { return handle_->family; }
unsigned Face::glyph_of(char32_t character) const { return character; }
double Face::advance(unsigned glyph) const { return page_advance(handle_->font, glyph); }
double Face::kerning(unsigned before, unsigned glyph) const { return page_kerning(handle_->font, before, glyph); }

void Face::draw(unsigned glyph, Vec2d at, double size, Pen& pen) const {
  const std::unique_ptr<double, void (*)(void*)> outlines(page_outlines(handle_->font, glyph), std::free);
  for (const double* next = outlines.get(); *next > 0;) {
    const int count = static_cast<int>(*next++);
    for (int k = 0; k < count; ++k, next += 2) {
      const Vec2d p{at.x + size * next[0], at.y + size * next[1]};
      if (k == 0)
        pen.move(p);
      else
        pen.line(p);
    }
    pen.close();
  }
}

struct Fonts::Libraries {};
Fonts::Fonts() = default;
Fonts::~Fonts() = default;

const Face* Fonts::face(const std::string& families, const std::string& weight, const std::string& slant) {
  const auto [found, is_new] = faces_.try_emplace(families + "|" + weight + "|" + slant);
  if (!is_new) return found->second.get();
  const int font = page_font(families.c_str(), weight.c_str(), slant.c_str());
  if (font == 0) return nullptr;
  // A page does not tell which of the names it has taken.
  const std::vector<std::string> names = family_names(families);
  found->second = std::make_unique<Face>(std::make_unique<Face::Handle>(Face::Handle{font, names.empty() ? "sans-serif" : names.front()}));
  return found->second.get();
}

}  // namespace steradian::plane::svg
