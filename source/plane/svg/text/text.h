// The small languages inside SVG attributes: numbers, colours, transforms.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "steradian/vector.h"
#include "steradian/vector2.h"

namespace steradian::plane::svg {

std::string_view trimmed(std::string_view text);
std::vector<std::string> words(std::string_view text);  // separated by white space
// The names of CSS's font-family, without their quotes.
std::vector<std::string> family_names(const std::string& css);

// Reads a list of numbers, independently of the locale.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) { skip_separators(); }
  bool at_end() const { return at_ >= text_.size(); }
  char peek() const { return at_end() ? '\0' : text_[at_]; }
  char next() { return text_[at_++]; }
  bool accept(char c);
  void skip_separators();          // white space and commas
  std::optional<double> number();  // skips separators behind it; empty if there is no finite number
  std::optional<bool> flag();      // 0 or 1, as in arcs, where nothing needs to follow it

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

// #rgb, #rrggbb, rgb(), the keywords; sRGB converted to linear. Empty if it is none of these.
std::optional<Vec3d> parse_color(std::string_view text);
double srgb_from_linear(double x);

// x' = a x + c y + e, y' = b x + d y + f
struct Transform {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
  Vec2d apply(Vec2d p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
  Vec2d apply_vector(Vec2d v) const { return {a * v.x + c * v.y, b * v.x + d * v.y}; }
  double determinant() const { return a * d - b * c; }
  Transform operator*(const Transform& inner) const;
};
std::optional<Transform> parse_transform(std::string_view text);

}  // namespace steradian::plane::svg
