#include "exchange/obstacles/obstructed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "exchange/pairs/gauss_rules.h"
#include "exchange/obstacles/hidden_part.h"
#include "exchange/obstacles/shadow_events.h"

namespace steradian::exchange {
namespace {

// An event shorter than this fraction of the element's size cuts off nothing that counts.
constexpr double kShortEvent = 1e-9;
// The visible rest of a factor that is rounding.
constexpr double kAllHidden = 1e-12;
// A piece may err by its part of the area, and the smallest ones by this part of the whole.
constexpr double kLeastPart = 1e-3;
constexpr int kMostQuarterings = 14;
// Obstacles with more edges than this have more events than pieces are worth. The rules then start this many quarterings late.
constexpr std::size_t kMostEdges = 60, kMostEdgesFine = 120;
constexpr double kFineEps = 5e-5;
// Without cuts, differences of rules miss narrow parts. In random scenes of two to six boxes the error was at most 2.2 times the
// difference.
constexpr double kUncutSafety = 4;
constexpr std::size_t kMostConvexCorners = 8;
constexpr int kUncutQuarterings = kMostQuarterings - 6;
constexpr std::size_t kMostEvaluations = 4'000'000;
// A part of the smaller area that changes no factor: the rounding of 1.
constexpr double kNoFactor = 0x1p-53;
// After this many evaluations, unproven points that dominate the error end the refinement: it cannot reduce their part.
constexpr std::size_t kEnoughToJudge = 20'000;
// The finder's own error, as a fraction of the whole factor: 16 cells of 2^-40 along a boundary of some half sizes.
constexpr double kFinderError = 1e-10;

using FlatPolygon = std::vector<Vec2d>;

double cross2(Vec2d a, Vec2d b) { return a.x * b.y - a.y * b.x; }

double area_of(const FlatPolygon& p) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) sum += cross2(p[i] - p[0], p[i + 1] - p[0]);
  return 0.5 * sum;
}

Vec2d middle_of_polygon(const FlatPolygon& p) {
  Vec2d sum{};
  for (const Vec2d& v : p) sum = sum + v * (1.0 / static_cast<double>(p.size()));
  return sum;
}

// The part of a convex polygon on the left of a line (side 1), or on its right (side -1).
FlatPolygon part_beside(const FlatPolygon& p, Vec2d from, Vec2d along, double side, double near) {
  FlatPolygon result;
  std::vector<double> height(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    height[i] = side * cross2(along, p[i] - from);
    if (std::fabs(height[i]) <= near) height[i] = 0;
  }
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::size_t j = (i + 1) % p.size();
    if (height[i] >= 0) result.push_back(p[i]);
    if (height[i] > 0 && height[j] < 0) result.push_back(p[i] + (p[j] - p[i]) * (height[i] / (height[i] - height[j])));
    if (height[i] < 0 && height[j] > 0) result.push_back(p[j] + (p[i] - p[j]) * (height[j] / (height[j] - height[i])));
  }
  return result;
}

// The part of a segment inside a convex polygon; false if there is none.
bool clip_to_polygon(EventSegment& s, const FlatPolygon& p, double near) {
  double t0 = 0, t1 = 1;
  const Vec2d way = s.b - s.a;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2d edge = p[(i + 1) % p.size()] - p[i];
    const double l = std::hypot(edge.x, edge.y);
    if (!(l > 0)) continue;
    // Events along an edge of the piece cut nothing.
    const double a = cross2(edge, s.a - p[i]) / l - near, b = cross2(edge, s.b - p[i]) / l - near;
    if (a < 0 && b < 0) return false;
    if (a < 0) t0 = std::max(t0, a / (a - b));
    if (b < 0) t1 = std::min(t1, a / (a - b));
  }
  if (!(t0 < t1)) return false;
  s = {s.a + way * t0, s.a + way * t1};
  return true;
}

double length2(const EventSegment& s) {
  const Vec2d d = s.b - s.a;
  return d.x * d.x + d.y * d.y;
}

// Integrates what is hidden of the target over an element.
class HiddenIntegral {
 public:
  HiddenIntegral(const PlaneElement& from, const PlaneElement& target, const shadow::EdgeMesh& mesh, double eps, double tolerance)
      : from_(from),
        target_(target),
        finder_(target, mesh),
        eps_(eps),
        tolerance_(tolerance),
        plane_{from.centroid, Frame::from_normal(from.normal)} {
    // With many edges, sections would cost more than they save; then the rules adapt by themselves, and their error is an estimate.
    if (mesh.edges.size() > (eps < kFineEps ? kMostEdgesFine : kMostEdges)) return;
    is_cut_ = true;
    events_ = shadow_events(plane_, std::max(from.radius, 1e-300), target, mesh);
  }

  // parts: convex, and together the element.
  ExchangeArea over_parts(const std::vector<PlaneElement>& parts) {
    for (const PlaneElement& part : parts) {
      FlatPolygon piece;
      for (const Vec3d& v : part.contours[0]) piece.push_back(plane_.to_plane(v));
      std::vector<EventSegment> inside;
      for (EventSegment e : events_)
        if (clip_to_polygon(e, piece, near())) inside.push_back(e);
      if (is_cut_)
        integrate(piece, std::move(inside), 0);
      else
        quarter(piece, kUncutQuarterings);
    }
    error_ += unproven_error() + finder_.area_near_plane();
    return {sum_, error_, static_cast<int>(std::min<std::size_t>(evaluations_, std::numeric_limits<int>::max()))};
  }

 private:
  double near() const { return kShortEvent * from_.radius; }

  // Points whose hidden part is not known may be wrong by all that the target sends.
  double unproven_error() const {
    return unproven_ == 0 ? 0.0 : static_cast<double>(unproven_) / static_cast<double>(evaluations_) * from_.area;
  }
  bool has_enough() const {
    return evaluations_ > kMostEvaluations || (evaluations_ > kEnoughToJudge && unproven_error() > 10 * tolerance_);
  }

  double hidden_at(Vec2d p) {
    ++evaluations_;
    const double hidden = finder_.hidden_factor(plane_.to_world(p), from_.normal);
    if (!finder_.is_proven()) ++unproven_;
    return hidden;
  }

  double rule_over(const FlatPolygon& p, int n) {
    double sum = 0;
    for_each_node(p, n, [&](Vec2d at, double weight) {
      sum += weight * hidden_at(at);
      return true;
    });
    return sum;
  }

  bool is_all_hidden(const FlatPolygon& piece) {
    return for_each_node(piece, 4, [&](Vec2d at, double) {
      const double hidden = hidden_at(at), whole = finder_.whole_factor(plane_.to_world(at), from_.normal);
      return whole - hidden < kAllHidden * whole;
    });
  }

  // A rule with n nodes a side over a convex polygon, cut into quadrangles and one triangle about its first corner.
  // Calls use(place, weight) for the nodes, until it returns false. Returns true if it never did.
  template <class Use>
  bool for_each_node(const FlatPolygon& p, int n, Use use) {
    const GaussRule& rule = gauss_rule(n);
    for (std::size_t i = 1; i + 1 < p.size(); i += 2) {
      const bool is_quad = i + 2 < p.size();
      const Vec2d a = p[0], b = p[i], c = p[i + 1], d = is_quad ? p[i + 2] : p[0];
      for (std::size_t j = 0; j < rule.node.size(); ++j)
        for (std::size_t k = 0; k < rule.node.size(); ++k) {
          const double s = rule.node[j], t = rule.node[k];
          // Bilinear; a triangle is a quadrangle with d = a.
          const Vec2d at = (a * (1 - s) + b * s) * (1 - t) + (d * (1 - s) + c * s) * t;
          const Vec2d along_s = (b - a) * (1 - t) + (c - d) * t, along_t = (d - a) * (1 - s) + (c - b) * s;
          if (!use(at, rule.weight[j] * rule.weight[k] * cross2(along_s, along_t))) return false;
        }
    }
    return true;
  }

  void integrate(const FlatPolygon& piece, std::vector<EventSegment> events, int quarterings) {
    const double area = area_of(piece);
    if (piece.size() < 3 || !(area > kShortEvent * kShortEvent * from_.radius * from_.radius)) return;
    const double enough = tolerance_ * std::max(area / from_.area, kLeastPart);
    if (is_cut_ && events.empty()) {
      // Nothing changes within: the piece is open, hidden or partly hidden as a whole.
      const Vec2d middle = middle_of_polygon(piece);
      const double hidden = hidden_at(middle);
      if (hidden == 0) return;
      const double whole = finder_.whole_factor(plane_.to_world(middle), from_.normal);
      // All hidden: the closed form has no trouble at edges in contact. A gap between obstacles may still open within the piece, on a curve
      // that is no event, so that the nodes of a rule are asked as well.
      if (whole - hidden < kAllHidden * whole && is_all_hidden(piece)) {
        std::vector<Vec3d> corners;
        for (const Vec2d& v : piece) corners.push_back(plane_.to_world(v));
        const ExchangeArea all = exchange_area(part_of_element(std::move(corners), area), target_, std::max(0.1 * eps_, 1e-14));
        sum_ += all.value;
        error_ += all.error;
        return;
      }
    }
    if (!is_cut_ && quarterings < kUncutQuarterings + 2) return quarter(piece, quarterings);
    if (events.empty() && try_rules(piece, enough)) return;
    if (has_enough() || quarterings > kMostQuarterings) {
      const double value = rule_over(piece, 3);
      sum_ += value;
      error_ += std::max(std::fabs(value - rule_over(piece, 2)), enough);
      return;
    }
    if (events.empty()) {
      quarter(piece, quarterings);
      return;
    }
    const auto longest = std::max_element(events.begin(), events.end(),
                                          [](const EventSegment& a, const EventSegment& b) { return length2(a) < length2(b); });
    const Vec2d start = longest->a, way = longest->b - longest->a, along = way * (1 / std::hypot(way.x, way.y));
    events.erase(longest);
    for (const double side : {1.0, -1.0}) {
      const FlatPolygon part = part_beside(piece, start, along, side, 0.1 * near());
      if (part.size() < 3) continue;
      std::vector<EventSegment> inside;
      for (EventSegment e : events)
        if (clip_to_polygon(e, part, near()) && length2(e) > near() * near()) inside.push_back(e);
      integrate(part, std::move(inside), quarterings);
    }
  }

  // A piece in the plane of the element, however thin.
  PlaneElement part_of_element(std::vector<Vec3d> corners, double area) const {
    PlaneElement part;
    part.normal = from_.normal;
    part.area = area;
    for (const Vec3d& v : corners) part.centroid += v / static_cast<double>(corners.size());
    for (const Vec3d& v : corners) part.radius = std::max(part.radius, length(v - part.centroid));
    part.contours.push_back(std::move(corners));
    return part;
  }

  // Rules with more and more nodes, while their differences fall. True if they are near enough.
  bool try_rules(const FlatPolygon& piece, double enough) {
    double before = rule_over(piece, 2), last = std::numeric_limits<double>::infinity();
    for (const int n : {3, 5, 8, 12}) {
      const double value = rule_over(piece, n), difference = std::fabs(value - before);
      // One agreement may be chance: the first counts five times, the second with a part of the difference before. From the third on, the
      // differences have fallen tenfold twice.
      const double chance = n == 3 ? 5 * difference : n == 5 ? std::max(difference, 0.1 * last) : difference;
      const double error = chance * (is_cut_ ? 1 : kUncutSafety);
      if (error <= enough) {
        sum_ += value;
        error_ += error;
        return true;
      }
      if (difference > 0.1 * last) return false;
      last = difference;
      before = value;
    }
    return false;
  }

  void quarter(const FlatPolygon& piece, int quarterings) {
    for (std::size_t i = 1; i + 1 < piece.size(); i += 2) {
      const Vec2d a = piece[0], b = piece[i], c = piece[i + 1];
      if (i + 2 < piece.size()) {
        const Vec2d d = piece[i + 2], ab = (a + b) * 0.5, bc = (b + c) * 0.5, cd = (c + d) * 0.5, da = (d + a) * 0.5, m = (ab + cd) * 0.5;
        for (const FlatPolygon& part :
             {FlatPolygon{a, ab, m, da}, FlatPolygon{ab, b, bc, m}, FlatPolygon{m, bc, c, cd}, FlatPolygon{da, m, cd, d}})
          integrate(part, {}, quarterings + 1);
      } else {
        const Vec2d ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
        for (const FlatPolygon& part : {FlatPolygon{a, ab, ca}, FlatPolygon{ab, b, bc}, FlatPolygon{ca, bc, c}, FlatPolygon{bc, ca, ab}})
          integrate(part, {}, quarterings + 1);
      }
    }
  }

  const PlaneElement &from_, &target_;
  HiddenPart finder_;
  double eps_, tolerance_;
  ElementPlane plane_;
  bool is_cut_ = false;
  std::vector<EventSegment> events_;
  double sum_ = 0, error_ = 0;
  std::size_t evaluations_ = 0, unproven_ = 0;
};

bool is_convex(const PlaneElement& e) {
  if (e.contours.size() != 1 || e.contours[0].size() > kMostConvexCorners) return false;
  const std::vector<Vec3d>& v = e.contours[0];
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec3d a = v[(i + 1) % v.size()] - v[i], b = v[(i + 2) % v.size()] - v[(i + 1) % v.size()];
    if (dot(cross(a, b), e.normal) < 0) return false;
  }
  return true;
}

// Convex parts of an element in front of a plane. It is cut into triangles first: the part of a concave outline may touch itself.
std::vector<PlaneElement> convex_parts_in_front(const PlaneElement& element, const PlaneElement& plane) {
  std::vector<PlaneElement> parts;
  for (const PlaneElement& part : is_convex(element) ? std::vector{element} : triangles_of_element(element, "element")) {
    PlaneElement front = in_front_of(part, plane);
    if (!front.is_empty()) parts.push_back(std::move(front));
  }
  return parts;
}

VisibleExchange visible_from(const PlaneElement& first, const PlaneElement& second, const Obstacles& obstacles, double eps,
                             const ExchangeArea& unobstructed) {
  VisibleExchange result;
  result.unobstructed = unobstructed;
  result.visible = unobstructed;
  if (!(result.unobstructed.value > 0) || obstacles.is_empty() || obstacles.between(first, second).empty()) return result;
  const PlaneElement a = in_front_of(first, second), b = in_front_of(second, first);
  const std::vector<std::uint32_t> between = obstacles.between(a, b);
  if (between.empty()) return result;
  result.is_obstructed = true;
  if (std::any_of(between.begin(), between.end(), [&](std::uint32_t t) { return obstacles.covers(t, a, b); })) {
    result.visible.value = result.visible.error = 0;
    return result;
  }
  const shadow::EdgeMesh mesh = obstacles.mesh_of(between);
  const double all = result.unobstructed.value;
  const double tolerance = std::max(0.5 * eps * all, kNoFactor * std::min(first.area, second.area));
  const ExchangeArea hidden = HiddenIntegral(a, b, mesh, eps, tolerance).over_parts(convex_parts_in_front(first, second));
  result.visible.value = std::clamp(all - hidden.value, 0.0, all);
  result.visible.error = std::min(result.unobstructed.error + hidden.error + kFinderError * hidden.value, all);
  result.visible.evaluations += hidden.evaluations;
  return result;
}

}  // namespace

VisibleExchange visible_exchange(const PlaneElement& a, const PlaneElement& b, const Obstacles& obstacles, double eps) {
  return visible_from(a, b, obstacles, eps, exchange_area(a, b, eps));
}

VisibleExchange visible_exchange(const PlaneElement& a, const PlaneElement& b, const Obstacles& obstacles, double eps,
                                 const ExchangeArea& unobstructed) {
  return visible_from(a, b, obstacles, eps, unobstructed);
}

}  // namespace steradian::exchange
