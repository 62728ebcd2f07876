// A page's WebAssembly sees no fonts: <text> is left out with a warning, as on a machine without any.
#include "plane/svg/text/fonts.h"

namespace steradian::plane::svg {

struct Face::Handle {
  std::string family;
};
Face::Face(std::unique_ptr<Handle> handle) : handle_(std::move(handle)) {}
Face::~Face() = default;
const std::string& Face::family() const { return handle_->family; }
unsigned Face::glyph_of(char32_t) const { return 0; }
double Face::advance(unsigned) const { return 0; }
double Face::kerning(unsigned, unsigned) const { return 0; }
void Face::draw(unsigned, Vec2d, double, Pen&) const {}

struct Fonts::Libraries {};
Fonts::Fonts() = default;
Fonts::~Fonts() = default;
const Face* Fonts::face(const std::string&, const std::string&, const std::string&) { return nullptr; }

}  // namespace steradian::plane::svg
