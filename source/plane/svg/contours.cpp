#include "plane/svg/contours.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace steradian::plane::svg {
namespace {

using std::numbers::pi;

// One curve of a broken file may need billions of pieces.
constexpr double kMostPieces = 10'000;

// At least one piece, also if the estimate is not a number.
int pieces(double wanted) { return wanted > 1 ? static_cast<int>(std::ceil(std::min(wanted, kMostPieces))) : 1; }

}  // namespace

void Pen::move(Vec2d to) {
  end_contour(false);
  at_ = start_ = to;
  begun_ = true;
  points_.push_back(transform_.apply(at_));
}

// Prepares for `more` points of a line or curve.
void Pen::begin(int more) {
  if (before_) before_(static_cast<std::size_t>(more));
  if (points_.empty()) points_.push_back(transform_.apply(at_));  // after a close the pen continues from its start
}

void Pen::line(Vec2d to) {
  begin(1);
  points_.push_back(transform_.apply(to));
  at_ = to;
}

// A cubic is split into eighths, each with as many pieces as its own bend needs: most curves bend in few places.
void Pen::cubic(Vec2d first_control, Vec2d second_control, Vec2d to) {
  bezier(transform_.apply(at_), transform_.apply(first_control), transform_.apply(second_control), transform_.apply(to), 3);
  at_ = to;
}

// A parabola through n pieces is off by |second difference| / (8 n^2) at most. The cubic's bound uses the larger of its two second
// differences (Wang, "Some subdivision techniques", 1984).
void Pen::bezier(Vec2d a, Vec2d b, Vec2d c, Vec2d d, int halvings) {
  const double bend = 6 * std::max(length(a - b * 2 + c), length(b - c * 2 + d));
  const int n = pieces(std::sqrt(bend / (8 * tolerance_)));
  if (halvings > 0 && n > 1) {
    const Vec2d ab = (a + b) * 0.5, bc = (b + c) * 0.5, cd = (c + d) * 0.5, abc = (ab + bc) * 0.5, bcd = (bc + cd) * 0.5,
                middle = (abc + bcd) * 0.5;
    bezier(a, ab, abc, middle, halvings - 1);
    bezier(middle, bcd, cd, d, halvings - 1);
    return;
  }
  begin(n);
  for (int i = 1; i <= n; ++i) {
    const double t = static_cast<double>(i) / n, s = 1 - t;
    points_.push_back(a * (s * s * s) + b * (3 * s * s * t) + c * (3 * s * t * t) + d * (t * t * t));
  }
}

// SVG 1.1, appendix F.6, in the space where the ellipse is the unit circle: squares neither overflow nor vanish there.
void Pen::arc(double rx, double ry, double turn, bool large, bool sweep, Vec2d to) {
  const Vec2d from = at_;
  if (from == to) return;
  const double c = std::cos(turn), s = std::sin(turn);
  const Vec2d half = (from - to) * 0.5;
  double u = (c * half.x + s * half.y) / rx, v = (c * half.y - s * half.x) / ry, n2 = u * u + v * v;
  if (!(n2 > 0 && n2 < 1e300)) return line(to);  // one radius is zero, or both are infinite
  if (n2 > 1) {
    // Too small to reach: it is enlarged until it does.
    const double grow = std::sqrt(n2);
    rx *= grow;
    ry *= grow;
    u /= grow;
    v /= grow;
    n2 = 1;
  }
  const double k = (large == sweep ? -1 : 1) * std::sqrt((1 - n2) / n2);
  const Vec2d q{k * v * rx, -k * u * ry}, middle = (from + to) * 0.5;
  const Vec2d center{c * q.x - s * q.y + middle.x, s * q.x + c * q.y + middle.y};
  const double begin_angle = std::atan2(v + k * u, u - k * v);
  double span = std::atan2(k * u - v, -u - k * v) - begin_angle;
  if (sweep && span < 0) span += 2 * pi;
  if (!sweep && span > 0) span -= 2 * pi;
  // The sagitta of a piece is r (1 - cos(step / 2)) on the longest axis, which is below 1.5 times the longer column.
  const double r = 1.5 * std::max(rx, ry) * std::max(std::hypot(transform_.a, transform_.b), std::hypot(transform_.c, transform_.d));
  const double step = 4 * std::asin(std::sqrt(0.5 * std::min(tolerance_ / r, 1.0)));
  const int n = pieces(std::fabs(span) / step);
  begin(n);
  for (int i = 1; i < n; ++i) {
    const double t = begin_angle + span * i / n;
    const Vec2d e{rx * std::cos(t), ry * std::sin(t)};
    points_.push_back(transform_.apply({center.x + c * e.x - s * e.y, center.y + s * e.x + c * e.y}));
  }
  line(to);
}

void Pen::close() {
  end_contour(true);
  at_ = start_;
}

void Pen::end_contour(bool closed) {
  if (points_.size() > 1) {
    result_.points.push_back(points_);
    result_.closed.push_back(closed);
  }
  points_.clear();
}

Polylines Pen::finish() {
  end_contour(false);
  return std::move(result_);
}

}  // namespace steradian::plane::svg
