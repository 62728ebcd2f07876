#include "plane/bounce/outlook.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "plane/exact/gaps.h"
#include "plane/exact/outline.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

constexpr double kFarSlope = 1e12;   // a slope: beyond it lie 5e-25 of a half plane, weighted by the cosine
constexpr double kOnOwnLine = 1e-9;  // from the place's own line; the picture has 1024 to 2048 units a side

class Looker {
 public:
  Looker(const World& world, const Curve* own, Vec2d from, Vec2d normal)
      : world_(world), own_(own), from_(from), normal_(normal), along_{-normal.y, normal.x} {
    gaps_.assign(1, {-kFarSlope, kFarSlope, -1});
    taken_.clear();
  }

  bool done() const { return gaps_.empty(); }

  bool hides(const Box2d& box) const {
    const Vec2d middle = box.center() - from_, half = box.half();
    const double ahead_of = dot(middle, normal_), reach = std::fabs(half.x * normal_.x) + std::fabs(half.y * normal_.y);
    if (ahead_of + reach <= kOnOwnLine) return true;
    if (ahead_of - reach <= kOnOwnLine) return false;
    Interval<double> slopes{kFarSlope, -kFarSlope};
    for (const Vec2d corner : {box.low, box.high, Vec2d{box.low.x, box.high.y}, Vec2d{box.high.x, box.low.y}}) {
      const Vec2d to = corner - from_;
      slopes.add(dot(to, along_) / dot(to, normal_));
    }
    const auto gap = gap_after(gaps_, slopes.low);
    return gap == gaps_.end() || gap->begin >= slopes.high;
  }

  // Facets arrive nearest first: each covers the directions that are still free.
  void add(const Facet& facet) {
    Range range;
    if (facet.curve == own_ || !range_of(*facet.curve, facet.a, facet.b, range)) return;
    take_between(gaps_, range.begin, range.end, [&](const Gap& gap, double begin, double end) {
      const int index = static_cast<int>(taken_.size());
      taken_.push_back({{begin, end, facet.curve, range.back}, next_of(gap.previous)});
      next_of(gap.previous) = index;
      return Gap{end, gap.end, index};
    });
  }

  // Returns all parts that were added, by rising slope.
  void finish(std::vector<SeenPart>& parts) const {
    parts.clear();
    for (int k = first_; k >= 0; k = taken_[static_cast<std::size_t>(k)].next) append(taken_[static_cast<std::size_t>(k)].part, parts);
  }

  // A curve whose order among the others is unknown: it is cut where it crosses visible parts.
  void insert(const Curve& curve, std::vector<SeenPart>& parts) const {
    if (&curve == own_) return;
    if (curve.kind == Curve::Kind::segment) {
      Range range;
      if (range_of(curve, curve.a, curve.b, range)) insert({range.begin, range.end, &curve, range.back}, parts);
      return;
    }
    // The part that faces the place, between the ellipse's two tangents; if the arc is cut off, there may be two parts.
    const Vec2d p = curve.ellipse.to_unit(from_);
    const double d = length(p);
    if (d <= 1) return;
    const double half = std::acos(1 / d), first = angle_of(p) - half;
    if (curve.tau_span >= 2 * pi - 1e-12) return insert_arc(curve, first, 2 * half, parts);
    double shift = std::fmod(first - curve.tau0, 2 * pi);
    if (shift < 0) shift += 2 * pi;
    for (double begin : {shift, shift - 2 * pi}) {
      const double low = std::max(begin, 0.0), high = std::min(begin + 2 * half, curve.tau_span);
      if (high > low) insert_arc(curve, curve.tau0 + low, high - low, parts);
    }
  }

 private:
  struct Range {
    double begin, end;
    bool back;
  };
  struct Gap {
    double begin, end;
    int previous;  // the part before it, -1: none
  };
  struct Taken {
    SeenPart part;
    int next;
  };

  // The range by rising angle from a to b, less than half a turn.
  bool range_between(Vec2d a, Vec2d b, Range& range) const {
    const double ahead_a = dot(a, normal_), ahead_b = dot(b, normal_);
    if (ahead_a <= kOnOwnLine && ahead_b <= kOnOwnLine) return false;
    range.begin = ahead_a <= kOnOwnLine ? -kFarSlope : std::clamp(dot(a, along_) / ahead_a, -kFarSlope, kFarSlope);
    range.end = ahead_b <= kOnOwnLine ? kFarSlope : std::clamp(dot(b, along_) / ahead_b, -kFarSlope, kFarSlope);
    return range.begin < range.end;
  }

  bool range_of(const Curve& curve, Vec2d a, Vec2d b, Range& range) const {
    a = a - from_;
    b = b - from_;
    const double side = cross(a, b);
    range.back = side > 0;
    if (side == 0 || (range.back && !curve.two_sided)) return false;
    return range.back ? range_between(a, b, range) : range_between(b, a, range);
  }

  void insert_arc(const Curve& curve, double tau, double span, std::vector<SeenPart>& parts) const {
    Range range;
    // tau runs against the angle
    if (range_between(curve.ellipse.at(tau + span) - from_, curve.ellipse.at(tau) - from_, range))
      insert({range.begin, range.end, &curve, false}, parts);
  }

  int& next_of(int part) { return part < 0 ? first_ : taken_[static_cast<std::size_t>(part)].next; }

  static void append(const SeenPart& part, std::vector<SeenPart>& parts) {
    if (!(part.end > part.begin)) return;
    if (!parts.empty() && parts.back().curve == part.curve && parts.back().back == part.back && parts.back().end == part.begin)
      parts.back().end = part.end;
    else
      parts.push_back(part);
  }

  void insert(SeenPart part, std::vector<SeenPart>& parts) const {
    thread_local std::vector<SeenPart> among;
    among.clear();
    const auto first = std::partition_point(parts.begin(), parts.end(), [&](const SeenPart& p) { return p.end <= part.begin; });
    auto last = first;
    double at = part.begin;
    for (; last != parts.end() && last->begin < part.end; ++last) {
      const SeenPart& other = *last;
      append({other.begin, std::min(other.end, at), other.curve, other.back}, among);
      append({at, other.begin, part.curve, part.back}, among);
      at = std::max(at, other.begin);
      const double end = std::min(other.end, part.end);
      append_nearer(other, part, at, end, among);
      at = end;
      append({std::max(at, other.begin), other.end, other.curve, other.back}, among);
    }
    append({at, part.end, part.curve, part.back}, among);
    const auto place = parts.erase(first, last);
    parts.insert(place, among.begin(), among.end());
  }

  void append_nearer(const SeenPart& a, const SeenPart& b, double begin, double end, std::vector<SeenPart>& out) const {
    std::array<double, 6> cuts;
    std::size_t count = 0;
    cuts[count++] = begin;
    const Crossings crossings = intersect(*a.curve, *b.curve);
    for (int k = 0; k < crossings.count; ++k) {
      const Vec2d to = crossings.at[k] - from_;
      const double ahead = dot(to, normal_), slope = dot(to, along_) / ahead;
      if (!(ahead > kOnOwnLine && slope > begin && slope < end)) continue;
      std::size_t place = count++;
      for (; cuts[place - 1] > slope; --place) cuts[place] = cuts[place - 1];
      cuts[place] = slope;
    }
    cuts[count++] = end;
    for (std::size_t k = 0; k + 1 < count; ++k) {
      // Half way by angle.
      const double s = std::hypot(1, cuts[k]), t = std::hypot(1, cuts[k + 1]);
      const bool first = is_nearer(a, b, direction_of((cuts[k] * t + cuts[k + 1] * s) / (s + t), normal_));
      append({cuts[k], cuts[k + 1], (first ? a : b).curve, (first ? a : b).back}, out);
    }
  }

  // The same rule as in the lower envelope for curves that coincide within rounding.
  bool is_nearer(const SeenPart& a, const SeenPart& b, Vec2d u) const {
    const double ra = distance_along(*a.curve, a.back, from_, u), rb = distance_along(*b.curve, b.back, from_, u);
    const double slack = 1e-10 * (ra + rb) + 1e-13 * (std::fabs(from_.x) + std::fabs(from_.y));
    if (std::fabs(ra - rb) > slack) return ra < rb;
    const auto shines = [&](const SeenPart& p) { return world_.scene.bodies[static_cast<std::size_t>(p.curve->body)].light.has_value(); };
    if (shines(a) != shines(b)) return shines(a);
    return a.curve->body >= b.curve->body;
  }

  template <class T>
  static std::vector<T>& kept() {
    thread_local std::vector<T> buffer;
    return buffer;
  }

  const World& world_;
  const Curve* own_;
  Vec2d from_, normal_, along_;
  std::vector<Gap>& gaps_ = kept<Gap>();
  std::vector<Taken>& taken_ = kept<Taken>();
  int first_ = -1;
};

}  // namespace

Outlook::Outlook(const World& world) : world_(world), order_(world) {
  for (const Curve& c : world.curves)
    if (c.kind == Curve::Kind::arc || !order_.has_segments()) others_.push_back(&c);
}

void Outlook::look(const Curve* own, Vec2d from, Vec2d normal, std::vector<SeenPart>& parts) const {
  Looker looker(world_, own, from, normal);
  order_.walk(
      from, [&](const Facet& facet) { looker.add(facet); }, [&](const Box2d& box) { return looker.hides(box); },
      [&] { return looker.done(); });
  looker.finish(parts);
  for (const Curve* c : others_) looker.insert(*c, parts);
}

SeenAngles angles_of(const SeenPart& part, Vec2d normal) {
  const Vec2d low = direction_of(part.begin, normal), high = direction_of(part.end, normal);
  const double begin = angle_of(low), end = begin + std::atan2(cross(low, high), dot(low, high));
  SeenAngles angles;
  angles.count = 0;
  angles.parts[angles.count++] = {begin, std::min(end, pi), part.curve, part.back};
  if (end > pi) angles.parts[angles.count++] = {-pi, end - 2 * pi, part.curve, part.back};
  return angles;
}

}  // namespace steradian::plane
