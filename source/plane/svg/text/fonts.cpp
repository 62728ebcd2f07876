#include "plane/svg/text/fonts.h"

#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <cstdlib>

#include "plane/svg/text/text.h"

namespace steradian::plane::svg {

struct Face::Handle {
  FT_Face face = nullptr;
  std::string family;
  ~Handle() { FT_Done_Face(face); }
};

Face::Face(std::unique_ptr<Handle> handle) : handle_(std::move(handle)) {}
Face::~Face() = default;

const std::string& Face::family() const { return handle_->family; }

unsigned Face::glyph_of(char32_t character) const { return FT_Get_Char_Index(handle_->face, character); }

double Face::advance(unsigned glyph) const {
  if (FT_Load_Glyph(handle_->face, glyph, FT_LOAD_NO_SCALE) != 0) return 0;
  return static_cast<double>(handle_->face->glyph->metrics.horiAdvance) / handle_->face->units_per_EM;
}

double Face::kerning(unsigned before, unsigned glyph) const {
  FT_Vector move{0, 0};
  if (!FT_HAS_KERNING(handle_->face) || FT_Get_Kerning(handle_->face, before, glyph, FT_KERNING_UNSCALED, &move) != 0) return 0;
  return static_cast<double>(move.x) / handle_->face->units_per_EM;
}

namespace {

// State of a walk along an outline in the font's units, y upwards.
struct FontWalk {
  Pen* pen;
  Vec2d at;
  double scale;
  bool open = false;
  Vec2d place(const FT_Vector* p) const { return {at.x + scale * static_cast<double>(p->x), at.y - scale * static_cast<double>(p->y)}; }
};

int move_to(const FT_Vector* to, void* user) {
  FontWalk& walk = *static_cast<FontWalk*>(user);
  if (walk.open) walk.pen->close();
  walk.open = true;
  walk.pen->move(walk.place(to));
  return 0;
}
int line_to(const FT_Vector* to, void* user) {
  const FontWalk& walk = *static_cast<FontWalk*>(user);
  walk.pen->line(walk.place(to));
  return 0;
}
int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
  const FontWalk& walk = *static_cast<FontWalk*>(user);
  const Vec2d from = walk.pen->at(), c = walk.place(control), end = walk.place(to);
  walk.pen->cubic(from + (c - from) * (2.0 / 3), end + (c - end) * (2.0 / 3), end);
  return 0;
}
int cubic_to(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* user) {
  const FontWalk& walk = *static_cast<FontWalk*>(user);
  walk.pen->cubic(walk.place(first), walk.place(second), walk.place(to));
  return 0;
}

}  // namespace

void Face::draw(unsigned glyph, Vec2d at, double size, Pen& pen) const {
  FT_Face face = handle_->face;
  if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE) != 0 || face->glyph->format != FT_GLYPH_FORMAT_OUTLINE) return;
  static const FT_Outline_Funcs steps = {move_to, line_to, conic_to, cubic_to, 0, 0};
  // The pen may throw if there is too much, and FreeType's own frames lie between: it must not see exceptions.
  FontWalk walk{&pen, at, size / face->units_per_EM};
  FT_Outline_Decompose(&face->glyph->outline, &steps, &walk);
  if (walk.open) pen.close();
}

struct Fonts::Libraries {
  FT_Library freetype = nullptr;
  FcConfig* fontconfig = nullptr;
  Libraries() {
    if (FT_Init_FreeType(&freetype) != 0) freetype = nullptr;
    fontconfig = FcInitLoadConfigAndFonts();
  }
  ~Libraries() {
    if (fontconfig != nullptr) FcConfigDestroy(fontconfig);
    if (freetype != nullptr) FT_Done_FreeType(freetype);
  }
};

Fonts::Fonts() : libraries_(std::make_unique<Libraries>()) {}
Fonts::~Fonts() { faces_.clear(); }  // before the library that they belong to

namespace {

int weight_of(const std::string& css) {
  if (css == "bold" || css == "bolder") return FC_WEIGHT_BOLD;
  const int number = std::atoi(css.c_str());
  return number > 0 ? FcWeightFromOpenType(number) : FC_WEIGHT_NORMAL;
}

int slant_of(const std::string& css) {
  if (css == "italic") return FC_SLANT_ITALIC;
  return css.starts_with("oblique") ? FC_SLANT_OBLIQUE : FC_SLANT_ROMAN;
}

struct Pattern {
  FcPattern* p;
  explicit Pattern(FcPattern* pattern) : p(pattern) {}
  Pattern(const Pattern&) = delete;
  Pattern& operator=(const Pattern&) = delete;
  ~Pattern() {
    if (p != nullptr) FcPatternDestroy(p);
  }
};

}  // namespace

const Face* Fonts::face(const std::string& families, const std::string& weight, const std::string& slant) {
  const auto [found, is_new] = faces_.try_emplace(families + "|" + weight + "|" + slant);
  if (!is_new || libraries_->freetype == nullptr || libraries_->fontconfig == nullptr) return found->second.get();
  const Pattern wanted(FcPatternCreate());
  for (const std::string& name : family_names(families))
    FcPatternAddString(wanted.p, FC_FAMILY, reinterpret_cast<const FcChar8*>(name.c_str()));
  FcPatternAddInteger(wanted.p, FC_WEIGHT, weight_of(weight));
  FcPatternAddInteger(wanted.p, FC_SLANT, slant_of(slant));
  FcPatternAddBool(wanted.p, FC_OUTLINE, FcTrue);
  FcConfigSubstitute(libraries_->fontconfig, wanted.p, FcMatchPattern);
  FcDefaultSubstitute(wanted.p);
  FcResult result = FcResultNoMatch;
  const Pattern match(FcFontMatch(libraries_->fontconfig, wanted.p, &result));
  FcChar8 *file = nullptr, *family = nullptr;
  int index = 0;
  if (match.p == nullptr || FcPatternGetString(match.p, FC_FILE, 0, &file) != FcResultMatch) return nullptr;
  FcPatternGetInteger(match.p, FC_INDEX, 0, &index);
  auto handle = std::make_unique<Face::Handle>();
  if (FT_New_Face(libraries_->freetype, reinterpret_cast<const char*>(file), index, &handle->face) != 0) {
    handle->face = nullptr;
    return nullptr;
  }
  if (!FT_IS_SCALABLE(handle->face) || handle->face->units_per_EM == 0) return nullptr;
  if (FcPatternGetString(match.p, FC_FAMILY, 0, &family) == FcResultMatch) handle->family = reinterpret_cast<const char*>(family);
  found->second = std::make_unique<Face>(std::move(handle));
  return found->second.get();
}

}  // namespace steradian::plane::svg
