// Compiled if STERADIAN_FONTS is OFF: text has no outlines.
#include "plane/svg/text/fonts.h"
#include "steradian/error.h"

namespace steradian::plane::svg {

struct Face::Handle {
  std::string family;
};
struct Fonts::Libraries {};

Face::Face(std::unique_ptr<Handle> handle) : handle_(std::move(handle)) {}
Face::~Face() = default;
const std::string& Face::family() const { return handle_->family; }
unsigned Face::glyph_of(char32_t) const { return 0; }
double Face::advance(unsigned) const { return 0; }
double Face::kerning(unsigned, unsigned) const { return 0; }
void Face::draw(unsigned, Vec2d, double, Pen&) const {}

Fonts::Fonts() = default;
Fonts::~Fonts() = default;
const Face* Fonts::face(const std::string&, const std::string&, const std::string&) {
  throw Error("<text>", "this program was built without fonts",
              "make the text's letters paths, or build with -DSTERADIAN_FONTS=ON, as ./dev build does");
}

}  // namespace steradian::plane::svg
