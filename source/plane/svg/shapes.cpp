#include "plane/svg/shapes.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "plane/svg/path.h"

namespace steradian::plane::svg {

void draw_shape(const Document& document, pugi::xml_node n, Vec2d whole, Pen& pen) {
  const std::string_view name = n.name();
  if (name == "rect") return draw_rect(document, n, whole, 0, pen);
  const auto point = [&](const char* x, const char* y) {
    return Vec2d{document.length_attribute(n, x, whole.x), document.length_attribute(n, y, whole.y)};
  };
  if (name == "line") {
    pen.move(point("x1", "y1"));
    pen.line(point("x2", "y2"));
    return;
  }
  try {
    if (name == "path") return draw_path(n.attribute("d").value(), pen);
    draw_points(n.attribute("points").value(), pen);
    if (name == "polygon") pen.close();
  } catch (const std::string& problem) {
    document.fail(n, problem, "compare it with the SVG path grammar");
  }
}

void draw_rect(const Document& document, pugi::xml_node n, Vec2d whole, double height, Pen& pen) {
  const auto length = [&](const char* key, double of, double otherwise = 0) { return document.length_attribute(n, key, of, otherwise); };
  const Vec2d corner{length("x", whole.x), length("y", whole.y)}, size{length("width", whole.x), length("height", whole.y, height)};
  if (size.x < 0 || size.y < 0) document.fail(n, "width and height must not be negative", "move x or y instead");
  if (size.x == 0 || size.y == 0) return;
  double rx = length("rx", whole.x, -1), ry = length("ry", whole.y, -1);
  if (rx < 0) rx = ry;
  if (ry < 0) ry = rx;
  rx = std::clamp(rx, 0.0, size.x / 2);
  ry = std::clamp(ry, 0.0, size.y / 2);
  const bool round = rx > 0 && ry > 0;
  if (!round) rx = ry = 0;
  const Vec2d far = corner + size;
  const auto turn = [&](Vec2d to) {
    if (round) pen.arc(rx, ry, 0, false, true, to);
  };
  pen.move({corner.x + rx, corner.y});
  pen.line({far.x - rx, corner.y});
  turn({far.x, corner.y + ry});
  pen.line({far.x, far.y - ry});
  turn({far.x - rx, far.y});
  pen.line({corner.x + rx, far.y});
  turn({corner.x, far.y - ry});
  pen.line({corner.x, corner.y + ry});
  turn({corner.x + rx, corner.y});
  pen.close();
}

}  // namespace steradian::plane::svg
