#include "plane/svg/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

namespace steradian::plane::svg {
namespace {

double number(Scanner& scan) {
  const auto v = scan.number();
  if (!v) throw std::string("a number is missing or malformed in the path data");
  scan.skip_separators();
  return *v;
}

class PathReader {
 public:
  PathReader(std::string_view data, Pen& pen) : scan_(data), pen_(pen) {}

  void run() {
    char command = 0;
    while (!scan_.at_end()) {
      const char c = scan_.peek();
      const bool is_letter = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
      if (is_letter) {
        command = scan_.next();
        scan_.skip_separators();
      } else if (command == 0 || command == 'Z' || command == 'z') {
        throw std::string("path data must begin with a command letter, here is '") + c + "'";
      }
      if (!pen_.has_begun() && command != 'M' && command != 'm') throw std::string("path data must begin with M");
      step(command);
      // Further pairs after a move are lines.
      if (command == 'M') command = 'L';
      if (command == 'm') command = 'l';
    }
  }

 private:
  Vec2d pair(bool relative) {
    const double x = number(scan_), y = number(scan_);
    return relative ? pen_.at() + Vec2d{x, y} : Vec2d{x, y};
  }

  void step(char command) {
    const bool relative = command >= 'a';
    const char upper = static_cast<char>(relative ? command - 32 : command);
    const Vec2d at = pen_.at();
    Vec2d cubic_control = at, quadratic_control = at;
    switch (upper) {
      case 'M': pen_.move(pair(relative)); break;
      case 'L': pen_.line(pair(relative)); break;
      case 'H': pen_.line({(relative ? at.x : 0) + number(scan_), at.y}); break;
      case 'V': pen_.line({at.x, (relative ? at.y : 0) + number(scan_)}); break;
      case 'C':
      case 'S': {
        const Vec2d p = upper == 'C' ? pair(relative) : at * 2 - last_cubic_, q = pair(relative), r = pair(relative);
        pen_.cubic(p, q, r);
        cubic_control = q;
        break;
      }
      case 'Q':
      case 'T': {
        const Vec2d p = upper == 'Q' ? pair(relative) : at * 2 - last_quadratic_, r = pair(relative);
        pen_.cubic(at + (p - at) * (2.0 / 3), r + (p - r) * (2.0 / 3), r);
        quadratic_control = p;
        break;
      }
      case 'A': {
        const double rx = number(scan_), ry = number(scan_), turn = number(scan_);
        const auto large = scan_.flag();
        const auto sweep = scan_.flag();
        scan_.skip_separators();
        if (!large || !sweep) throw std::string("an arc's flags must be 0 or 1");
        pen_.arc(std::fabs(rx), std::fabs(ry), turn * std::numbers::pi / 180, *large, *sweep, pair(relative));
        break;
      }
      case 'Z': pen_.close(); break;
      default: throw std::string("unknown path command '") + command + "'";
    }
    last_cubic_ = upper == 'C' || upper == 'S' ? cubic_control : pen_.at();
    last_quadratic_ = upper == 'Q' || upper == 'T' ? quadratic_control : pen_.at();
  }

  Scanner scan_;
  Pen& pen_;
  Vec2d last_cubic_, last_quadratic_;
};

}  // namespace

void draw_path(std::string_view data, Pen& pen) { PathReader(data, pen).run(); }

void draw_points(std::string_view points, Pen& pen) {
  Scanner scan(points);
  while (!scan.at_end()) {
    const double x = number(scan), y = number(scan);
    if (pen.has_begun())
      pen.line({x, y});
    else
      pen.move({x, y});
  }
}

void draw_shape(const SvgDocument& document, pugi::xml_node n, Vec2d whole, Pen& pen) {
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

void draw_rect(const SvgDocument& document, pugi::xml_node n, Vec2d whole, double height, Pen& pen) {
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
