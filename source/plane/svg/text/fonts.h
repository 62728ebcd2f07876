// Fonts of the system: found by fontconfig, read by FreeType.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "plane/svg/contours.h"

namespace steradian::plane::svg {

class Face {
 public:
  struct Handle;
  explicit Face(std::unique_ptr<Handle> handle);
  ~Face();

  const std::string& family() const;
  unsigned glyph_of(char32_t character) const;  // 0: the font's sign for a missing glyph
  // In units of the font's size.
  double advance(unsigned glyph) const;
  double kerning(unsigned before, unsigned glyph) const;
  // The glyph's outline with its origin on the baseline at `at`.
  void draw(unsigned glyph, Vec2d at, double size, Pen& pen) const;

 private:
  std::unique_ptr<Handle> handle_;
};

class Fonts {
 public:
  Fonts();
  ~Fonts();
  // The face that fontconfig finds nearest to the CSS request; null if the system has no font.
  const Face* face(const std::string& families, const std::string& weight, const std::string& slant);

 private:
  struct Libraries;
  std::unique_ptr<Libraries> libraries_;
  std::map<std::string, std::unique_ptr<Face>> faces_;
};

}  // namespace steradian::plane::svg
