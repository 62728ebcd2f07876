// SVG path data to polylines.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/svg_text.h"

namespace steradian::svg {
namespace {

using std::numbers::pi;

class Flattener {
 public:
  Flattener(std::string_view data, const Transform& transform, double tolerance)
      : scan_(data), transform_(transform), tolerance_(tolerance) {}

  Contours run() {
    if (scan_.at_end()) return {};
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
      if (points_.empty() && !started_ && command != 'M' && command != 'm')
        throw std::string("path data must begin with M");
      step(command);
      // Further pairs after a move are lines.
      if (command == 'M') command = 'L';
      if (command == 'm') command = 'l';
    }
    finish(false);
    return std::move(result_);
  }

 private:
  double number() {
    const auto v = scan_.number();
    if (!v) throw std::string("a number is missing or malformed in the path data");
    scan_.skip_separators();
    return *v;
  }
  Vec2d pair(bool relative) {
    const double x = number(), y = number();
    return relative ? at_ + Vec2d{x, y} : Vec2d{x, y};
  }

  void step(char command) {
    const bool relative = command >= 'a';
    const char upper = static_cast<char>(relative ? command - 32 : command);
    Vec2d cubic_control = at_, quadratic_control = at_;
    switch (upper) {
      case 'M':
        finish(false);
        at_ = start_ = pair(relative);
        started_ = true;
        points_.push_back(transform_.apply(at_));
        break;
      case 'L': line(pair(relative)); break;
      case 'H': line({relative ? at_.x + number() : number(), at_.y}); break;
      case 'V': line({at_.x, relative ? at_.y + number() : number()}); break;
      case 'C': {
        const Vec2d p = pair(relative), q = pair(relative), r = pair(relative);
        cubic(p, q, r);
        cubic_control = q;
        break;
      }
      case 'S': {
        const Vec2d p = at_ * 2 - last_cubic_, q = pair(relative), r = pair(relative);
        cubic(p, q, r);
        cubic_control = q;
        break;
      }
      case 'Q':
      case 'T': {
        const Vec2d p = upper == 'Q' ? pair(relative) : at_ * 2 - last_quadratic_, r = pair(relative);
        cubic(at_ + (p - at_) * (2.0 / 3), r + (p - r) * (2.0 / 3), r);
        quadratic_control = p;
        break;
      }
      case 'A': {
        const double rx = number(), ry = number(), turn = number();
        const auto large = scan_.flag();
        const auto sweep = scan_.flag();
        scan_.skip_separators();
        if (!large || !sweep) throw std::string("an arc's flags must be 0 or 1");
        arc(std::fabs(rx), std::fabs(ry), turn * pi / 180, *large, *sweep, pair(relative));
        break;
      }
      case 'Z':
        finish(true);
        at_ = start_;
        break;
      default: throw std::string("unknown path command '") + command + "'";
    }
    last_cubic_ = upper == 'C' || upper == 'S' ? cubic_control : at_;
    last_quadratic_ = upper == 'Q' || upper == 'T' ? quadratic_control : at_;
  }

  void begin() {
    if (points_.empty()) points_.push_back(transform_.apply(at_));  // after Z a path goes on from its start
  }
  void line(Vec2d to) {
    begin();
    points_.push_back(transform_.apply(to));
    at_ = to;
  }

  // A parabola through n pieces is off by |second difference| / (8 n^2) at most; the cubic's bound takes the larger of
  // its two second differences (Wang, "Some subdivision techniques", 1984).
  void cubic(Vec2d p, Vec2d q, Vec2d r) {
    begin();
    const Vec2d a = transform_.apply(at_), b = transform_.apply(p), c = transform_.apply(q), d = transform_.apply(r);
    const double bend = 6 * std::max(length(a - b * 2 + c), length(b - c * 2 + d));
    const double wanted = std::ceil(std::sqrt(bend / (8 * tolerance_)));
    const int n = static_cast<int>(std::clamp(wanted, 1.0, kMostPieces));
    for (int i = 1; i <= n; ++i) {
      const double t = static_cast<double>(i) / n, s = 1 - t;
      points_.push_back(a * (s * s * s) + b * (3 * s * s * t) + c * (3 * s * t * t) + d * (t * t * t));
    }
    at_ = r;
  }

  // SVG 1.1, appendix F.6.
  void arc(double rx, double ry, double turn, bool large, bool sweep, Vec2d to) {
    const Vec2d from = at_;
    if (from == to) return;
    if (rx == 0 || ry == 0) return line(to);
    const double c = std::cos(turn), s = std::sin(turn);
    const Vec2d half = (from - to) * 0.5, p{c * half.x + s * half.y, -s * half.x + c * half.y};
    const double excess = p.x * p.x / (rx * rx) + p.y * p.y / (ry * ry);
    if (excess > 1) rx *= std::sqrt(excess), ry *= std::sqrt(excess);
    const double num = rx * rx * ry * ry - rx * rx * p.y * p.y - ry * ry * p.x * p.x;
    const double den = rx * rx * p.y * p.y + ry * ry * p.x * p.x;
    const double k = (large == sweep ? -1 : 1) * std::sqrt(std::max(num, 0.0) / den);
    const Vec2d q{k * rx * p.y / ry, -k * ry * p.x / rx}, middle = (from + to) * 0.5;
    const Vec2d center{c * q.x - s * q.y + middle.x, s * q.x + c * q.y + middle.y};
    const double begin_angle = std::atan2((p.y - q.y) / ry, (p.x - q.x) / rx);
    double span = std::atan2((-p.y - q.y) / ry, (-p.x - q.x) / rx) - begin_angle;
    if (sweep && span < 0) span += 2 * pi;
    if (!sweep && span > 0) span -= 2 * pi;
    begin();
    // The sagitta of a piece is r (1 - cos(step / 2)) on the longest axis.
    const double r = std::max(rx, ry) * std::max(std::hypot(transform_.a, transform_.b), std::hypot(transform_.c, transform_.d));
    const double step = 2 * std::acos(std::max(1 - tolerance_ / (1.5 * std::max(r, tolerance_)), 0.0));
    const int n = static_cast<int>(std::clamp(std::ceil(std::fabs(span) / step), 1.0, kMostPieces));
    for (int i = 1; i < n; ++i) {
      const double t = begin_angle + span * i / n;
      const Vec2d e{rx * std::cos(t), ry * std::sin(t)};
      points_.push_back(transform_.apply({center.x + c * e.x - s * e.y, center.y + s * e.x + c * e.y}));
    }
    line(to);
  }

  void finish(bool closed) {
    if (points_.size() > 1) {
      result_.points.push_back(points_);
      result_.closed.push_back(closed);
    }
    points_.clear();
  }

  // One curve of a broken file may ask for billions.
  static constexpr double kMostPieces = 10'000;

  Scanner scan_;
  Transform transform_;
  double tolerance_;
  Contours result_;
  std::vector<Vec2d> points_;
  Vec2d at_, start_, last_cubic_, last_quadratic_;
  bool started_ = false;
};

}  // namespace

Contours flatten_path(std::string_view data, const Transform& transform, double tolerance) {
  return Flattener(data, transform, tolerance).run();
}

}  // namespace steradian::svg
