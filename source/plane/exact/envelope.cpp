#include "plane/exact/envelope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plane/exact/outline.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

// Narrower pieces are below the rounding of an angle.
constexpr double kNarrowest = 1e-15;

class Builder {
 public:
  Builder(Vec2d from, const std::vector<PlaneBody>& bodies, const EnvelopeRules& rules) : from_(from), bodies_(bodies), rules_(rules) {}

  void add(const Curve& curve) {
    if (curve.kind == Curve::Kind::segment)
      add_segment(curve);
    else
      add_arc(curve);
  }

  std::vector<Visible> finish() {
    if (pieces_.empty()) return {};
    return build();
  }

 private:
  // One buffer for each thread, reused: an envelope for each pixel allocates only its result.
  static std::vector<Visible>& empty_buffer() {
    thread_local std::vector<Visible> buffer;
    buffer.clear();
    return buffer;
  }

  bool seen_inside(const Curve& c) const { return c.two_sided || c.body == rules_.inside; }

  void add_range(double begin, double end, const Curve& curve, bool back) {
    // Moves the range into [-pi, pi], and cuts it where it wraps.
    while (begin < -pi) begin += 2 * pi, end += 2 * pi;
    while (begin >= pi) begin -= 2 * pi, end -= 2 * pi;
    if (end - begin <= kNarrowest) return;
    pieces_.push_back({begin, std::min(end, pi), &curve, back});
    if (end > pi) pieces_.push_back({-pi, end - 2 * pi, &curve, back});
  }

  void add_segment(const Curve& c) {
    const Vec2d a = c.a - from_, b = c.b - from_;
    const double side = cross(a, b);
    if (side == 0) return;  // edge on, or the point lies on it
    const bool back = side > 0;
    if (back && !seen_inside(c)) return;
    const double width = std::atan2(std::fabs(side), dot(a, b)), begin = angle_of(back ? a : b);
    add_range(begin, begin + width, c, back);
  }

  // At the end of an arc, the next curve of its outline begins, to the last bit.
  static Vec2d place_at(const Curve& c, double tau) {
    if (c.tau_span >= 2 * pi - 1e-12) return c.ellipse.at(tau);
    if (tau - c.tau0 < 1e-14) return c.a;
    return c.tau0 + c.tau_span - tau < 1e-14 ? c.b : c.ellipse.at(tau);
  }

  // Adds the part of the arc on which tau runs from t0 over `span`, all on one face.
  void add_arc_part(const Curve& c, double t0, double span, bool back) {
    if (span <= 0) return;
    // The part is cut so that no piece spans more than half a turn: its width is then the angle between its ends.
    const int parts = back ? 4 : 1;
    for (int i = 0; i < parts; ++i) {
      const Vec2d p = place_at(c, t0 + span * i / parts) - from_, q = place_at(c, t0 + span * (i + 1) / parts) - from_;
      const double width = std::atan2(cross(p, q), dot(p, q));  // negative: tau runs against the angle
      if (back) {
        // A quarter near the point may span more than half a turn; one that rounding reverses is empty.
        const double turn = width < -1e-9 ? width + 2 * pi : width, begin = angle_of(p);
        add_range(begin, begin + turn, c, true);
      } else if (width < 0) {
        const double begin = angle_of(q);
        add_range(begin, begin - width, c, false);
      }
    }
  }

  // Adds the part of [t0, t0 + span] within the arc's own range.
  void add_clipped(const Curve& c, double t0, double span, bool back) {
    if (c.tau_span >= 2 * pi - 1e-12) {
      add_arc_part(c, t0, span, back);
      return;
    }
    double shift = std::fmod(t0 - c.tau0, 2 * pi);
    if (shift < 0) shift += 2 * pi;
    for (double begin : {shift, shift - 2 * pi}) {
      const double low = std::max(begin, 0.0), high = std::min(begin + span, c.tau_span);
      if (high > low) add_arc_part(c, c.tau0 + low, high - low, back);
    }
  }

  void add_arc(const Curve& c) {
    const Vec2d p = c.ellipse.to_unit(from_);
    const double d = length(p);
    const double middle = angle_of(p);
    if (d <= 1) {
      // The place nearest to the point is in the middle of a quarter: rounding of the ends of quarters beside the point would turn them.
      if (seen_inside(c)) add_clipped(c, middle + 0.25 * pi, 2 * pi, true);
      return;
    }
    const double half = std::acos(1 / d);
    add_clipped(c, middle - half, 2 * half, false);
    if (seen_inside(c)) add_clipped(c, middle + half, 2 * pi - 2 * half, true);
  }

  // Pieces are merged two by two, then the results: two buffers alternate.
  std::vector<Visible> build() {
    thread_local std::vector<Visible> from, to;
    thread_local std::vector<std::size_t> first;  // start of each envelope in `from`, and one more
    from.swap(pieces_);
    first.resize(from.size() + 1);
    for (std::size_t i = 0; i < first.size(); ++i) first[i] = i;
    while (first.size() > 2) {
      to.clear();
      std::size_t count = 0;
      for (std::size_t i = 0; i + 1 < first.size(); i += 2) {
        const std::size_t begin = to.size();
        const Visible *a = from.data() + first[i], *b = from.data() + first[i + 1];
        merge(a, b, b, i + 2 < first.size() ? from.data() + first[i + 2] : b, to);
        first[count++] = begin;
      }
      first[count++] = to.size();
      first.resize(count);
      from.swap(to);
    }
    return from;
  }

  void merge(const Visible* a, const Visible* a_last, const Visible* b, const Visible* b_last, std::vector<Visible>& out) const {
    const std::size_t first = out.size();
    double at = -pi;
    while (a != a_last || b != b_last) {
      const double a_begin = a != a_last ? std::max(a->begin, at) : 4.0;
      const double b_begin = b != b_last ? std::max(b->begin, at) : 4.0;
      const double begin = std::min(a_begin, b_begin);
      double end = 4.0;
      const bool in_a = a_begin <= begin, in_b = b_begin <= begin;
      end = std::min(end, in_a ? a->end : a_begin);
      end = std::min(end, in_b ? b->end : b_begin);
      if (in_a && in_b)
        append_nearer(*a, *b, begin, end, first, out);
      else
        append(in_a ? *a : *b, begin, end, first, out);
      at = end;
      if (a != a_last && a->end <= at) ++a;
      if (b != b_last && b->end <= at) ++b;
    }
  }

  static void append(const Visible& v, double begin, double end, std::size_t first, std::vector<Visible>& out) {
    if (end - begin <= kNarrowest) return;
    if (out.size() > first && out.back().curve == v.curve && out.back().back == v.back && out.back().end == begin)
      out.back().end = end;
    else
      out.push_back({begin, end, v.curve, v.back});
  }

  // Two candidates over one interval: they are cut at their crossings, and in each part the nearer at the middle wins.
  void append_nearer(const Visible& a, const Visible& b, double begin, double end, std::size_t first, std::vector<Visible>& out) const {
    if (const Visible* hit = nearer_everywhere(a, b)) return append(*hit, begin, end, first, out);
    std::array<double, 6> cuts;
    std::size_t count = 0;
    cuts[count++] = begin;
    if (a.curve != b.curve) {
      const Crossings crossings = intersect(*a.curve, *b.curve);
      for (int k = 0; k < crossings.count; ++k) {
        const double angle = angle_of(crossings.at[k] - from_);
        if (!(angle > begin && angle < end)) continue;
        std::size_t place = count++;
        for (; cuts[place - 1] > angle; --place) cuts[place] = cuts[place - 1];
        cuts[place] = angle;
      }
    }
    cuts[count++] = end;
    for (std::size_t k = 0; k + 1 < count; ++k) append(nearer(a, b, cuts[k], cuts[k + 1]), cuts[k], cuts[k + 1], first, out);
  }

  // Returns the one of two segments that every ray hits first, if one lies clearly to one side of the other's line; else null.
  const Visible* nearer_everywhere(const Visible& a, const Visible& b) const {
    if (a.curve->kind != Curve::Kind::segment || b.curve->kind != Curve::Kind::segment) return nullptr;
    const Vec2d p = a.curve->a - from_, q = a.curve->b - from_, r = b.curve->a - from_, s = b.curve->b - from_;
    const auto size = [](Vec2d v) { return std::fabs(v.x) + std::fabs(v.y); };
    // More than the distance that `nearer` treats as coincident.
    const double clear = 4e-10 * (size(p) + size(q) + size(r) + size(s)) + 1e-13 * size(from_);
    // Position of v, w relative to the line through l, m. On the point's side: 1; on the other: -1; neither: 0.
    const auto side_of = [&](Vec2d v, Vec2d w, Vec2d l, Vec2d m) {
      const Vec2d along = m - l;
      const double here = -cross(along, l), sign = here < 0 ? -1.0 : 1.0, least = clear * size(along);
      const double at_v = cross(along, v - l) * sign, at_w = cross(along, w - l) * sign;
      return at_v > least && at_w > least ? 1 : at_v < -least && at_w < -least ? -1 : 0;
    };
    const int first = side_of(p, q, r, s);
    if (first != 0) return first > 0 ? &a : &b;
    const int second = side_of(r, s, p, q);
    return second == 0 ? nullptr : second > 0 ? &b : &a;
  }

  const Visible& nearer(const Visible& a, const Visible& b, double begin, double end) const {
    // In the middle two curves may touch: coincident ones are so everywhere.
    for (double share : {0.5, 0.32, 0.83}) {
      const Vec2d u = direction_at(begin + share * (end - begin));
      const double ra = distance_along(*a.curve, a.back, from_, u), rb = distance_along(*b.curve, b.back, from_, u);
      // The tolerance depends on the size of coordinates, since edges that were meant to coincide do so only up to their rounding.
      const double slack = 1e-10 * (ra + rb) + 1e-13 * (std::fabs(from_.x) + std::fabs(from_.y));
      if (!(std::fabs(ra - rb) <= slack)) return ra < rb ? a : b;
    }
    // The emitter wins, or the later one of two.
    const bool a_shines = shines(a), b_shines = shines(b);
    if (a_shines != b_shines) return a_shines ? a : b;
    return a.curve->body >= b.curve->body ? a : b;
  }

  bool shines(const Visible& v) const { return bodies_[static_cast<std::size_t>(v.curve->body)].light.has_value(); }

  Vec2d from_;
  const std::vector<PlaneBody>& bodies_;
  EnvelopeRules rules_;
  std::vector<Visible>& pieces_ = empty_buffer();
};

}  // namespace

double distance_along(const Curve& curve, bool back, Vec2d from, Vec2d u) {
  if (curve.kind == Curve::Kind::segment) {
    const Vec2d e = curve.b - curve.a;
    return cross(curve.a - from, e) / cross(u, e);
  }
  // p + r v| = 1 in the circle's space, with the root that does not cancel.
  const Vec2d p = curve.ellipse.to_unit(from), v = curve.ellipse.to_unit(curve.ellipse.center + u);
  const double a = dot(v, v), b = dot(p, v), c = dot(p, p) - 1;
  const double root = std::sqrt(std::max(b * b - a * c, 0.0));
  return back ? (b > 0 ? -c / (b + root) : (root - b) / a) : c / (root - b);
}

std::vector<Visible> lower_envelope(const std::vector<const Curve*>& curves, Vec2d from, const std::vector<PlaneBody>& bodies,
                                    const EnvelopeRules& rules) {
  Builder builder(from, bodies, rules);
  for (const Curve* c : curves) builder.add(*c);
  return builder.finish();
}

}  // namespace steradian::plane
