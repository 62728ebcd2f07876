#include "plane/svg/path.h"

#include <cmath>
#include <numbers>
#include <string>

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

}  // namespace steradian::plane::svg
