#include "exchange/obstacles/obstructed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "exchange/pairs/gauss_rules.h"
#include "exchange/obstacles/flat_polygon.h"
#include "exchange/obstacles/hidden_part.h"
#include "exchange/obstacles/shadow_events.h"

namespace steradian::exchange {
namespace {

// An event shorter than this fraction of the element's size cuts off nothing that counts.
constexpr double kShortEvent = 1e-9;
// The visible rest of a factor that is rounding.
constexpr double kAllHidden = 1e-12;
// Below this error, parts from which all seems to be hidden are looked at in more places.
constexpr double kFineEps = 5e-5;
// A rule of two nodes errs by this fraction of the largest deviation at most where a function bends along a line: max(x - c, 0) with c at
// the second node has 0.106 of its largest value on [0, 1].
constexpr double kKink = 0.125;
// Places beside the corners of a piece are this fraction of the way to its middle.
constexpr double kBesideCorner = 1.0 / 64;
// Nodes a side of the rules that follow each other; the first one is the centroid.
constexpr int kPieceRules[] = {1, 2, 3, 5, 8, 12};
constexpr int kMostQuarterings = 14;
// Obstacles with more edges than this have more events than pieces are worth. The rules then start this many quarterings late.
constexpr std::size_t kMostEdges = 120;
// Without cuts, differences of rules miss narrow parts. In random scenes of two to six boxes the error was at most 2.2 times the
// difference.
constexpr double kUncutSafety = 4;
// A piece with at most this fraction of the obstacles before it is integrated with these alone.
constexpr double kFewer = 0.6;
constexpr std::size_t kMostConvexCorners = 8;
constexpr int kUncutQuarterings = kMostQuarterings - 6;
constexpr std::size_t kMostEvaluations = 4'000'000;
// A part of the smaller area that changes no factor: the rounding of 1.
constexpr double kNoFactor = 0x1p-53;
// After this many evaluations, unproven points that dominate the error end the refinement: it cannot reduce their part.
constexpr std::size_t kEnoughToJudge = 20'000;
// The finder's own error, as a fraction of the whole factor: 16 cells of 2^-40 along a boundary of some half sizes.
constexpr double kFinderError = 1e-10;

double length2(const EventSegment& s) {
  const Vec2d d = s.b - s.a;
  return d.x * d.x + d.y * d.y;
}

// The values at x of the polynomials that are 1 at one node of a rule and 0 at the others.
std::vector<double> polynomial_at(const GaussRule& rule, double x) {
  std::vector<double> values(rule.node.size(), 1.0);
  for (std::size_t j = 0; j < values.size(); ++j)
    for (std::size_t k = 0; k < values.size(); ++k)
      if (k != j) values[j] *= (x - rule.node[k]) / (rule.node[j] - rule.node[k]);
  return values;
}

// Obstacles between a piece of an element and the target, with what is made from them.
struct ObstaclesOfPiece {
  ObstaclesOfPiece(const ObstaclesOfPiece&) = delete;  // the finder refers to the mesh
  ObstaclesOfPiece(const Obstacles& obstacles, std::vector<std::uint32_t> between, const PlaneElement& target)
      : triangles(std::move(between)), mesh(obstacles.mesh_of(triangles)), finder(target, mesh) {
    // With many edges, sections would cost more than they save; then the rules adapt by themselves, and their error is an estimate.
    is_cut = mesh.edges.size() <= kMostEdges;
  }

  std::vector<std::uint32_t> triangles;
  shadow::EdgeMesh mesh;
  HiddenPart finder;
  bool is_cut;
};

// A piece of an element without events, and its integral by a rule.
struct RuledPiece {
  FlatPolygon corners;
  std::shared_ptr<ObstaclesOfPiece> obstacles;
  int quarterings = 0;
  std::size_t rule = 0;  // in kPieceRules
  double value = 0, error = 0;
  double difference = 0, last_difference = 0;  // to the rule before
  bool falls = true;                           // the differences fall
  // The boundary of the hidden part at the first place, and whether that of another one differs: then the factor is not smooth.
  std::uint64_t shape = 0;
  bool is_smooth = true;
  // Factors beside the corners, and the largest deviation from what the rule's nodes let expect there.
  std::vector<double> beside_corners = {};
  double deviation = 0;
};

// Integrates what is hidden of the target over an element.
class HiddenIntegral {
 public:
  HiddenIntegral(const PlaneElement& from, const PlaneElement& target, const Obstacles& obstacles,
                 const std::vector<std::uint32_t>& between, double eps, double tolerance)
      : from_(from),
        target_(target),
        obstacles_(obstacles),
        now_(std::make_shared<ObstaclesOfPiece>(obstacles, between, target)),
        eps_(eps),
        tolerance_(tolerance),
        plane_{from.centroid, Frame::from_normal(from.normal)} {}

  // parts: convex, and together the element.
  ExchangeArea over_parts(const std::vector<PlaneElement>& parts) {
    const std::vector<EventSegment> events = now_->is_cut ? events_of_obstacles() : std::vector<EventSegment>{};
    for (const PlaneElement& part : parts) {
      FlatPolygon piece;
      for (const Vec3d& v : part.contours[0]) piece.push_back(plane_.to_plane(v));
      start(piece, events);
    }
    error_ += now_->finder.area_near_plane();
    refine_pieces();
    error_ += unproven_error();
    return {sum_, error_, static_cast<int>(std::min<std::size_t>(evaluations_, std::numeric_limits<int>::max()))};
  }

 private:
  double near() const { return kShortEvent * from_.radius; }

  std::vector<EventSegment> events_of_obstacles() const {
    return shadow_events(plane_, std::max(from_.radius, 1e-300), target_, now_->mesh);
  }

  void start(const FlatPolygon& piece, const std::vector<EventSegment>& events) {
    if (!now_->is_cut) return quarter(piece, kUncutQuarterings);
    std::vector<EventSegment> inside;
    for (EventSegment e : events)
      if (clip_to_polygon(e, piece, near())) inside.push_back(e);
    integrate(piece, std::move(inside), 0);
  }

  // The closed form of a piece from which all of the target is hidden has no trouble at edges in contact.
  void add_all(const PlaneElement& piece) {
    const ExchangeArea all = exchange_area(piece, target_, std::max(0.1 * eps_, 1e-14));
    sum_ += all.value;
    error_ += all.error;
  }

  // Asks which obstacles lie between a piece and the target. True if this was enough, or if the piece was integrated with fewer obstacles.
  bool is_done_with_fewer(const FlatPolygon& piece, double area, bool has_events) {
    const PlaneElement part = part_of_element(piece, area);
    std::vector<std::uint32_t> between = obstacles_.between(part, target_, now_->triangles);
    if (between.empty()) return true;
    if (std::any_of(between.begin(), between.end(), [&](std::uint32_t t) { return obstacles_.covers(t, part, target_); })) {
      add_all(part);
      return true;
    }
    if (static_cast<double>(between.size()) > kFewer * static_cast<double>(now_->triangles.size())) return false;
    const auto before = std::exchange(now_, std::make_shared<ObstaclesOfPiece>(obstacles_, std::move(between), target_));
    start(piece, has_events ? events_of_obstacles() : std::vector<EventSegment>{});
    now_ = before;
    return true;
  }

  // Points whose hidden part is not known may be wrong by all that the target sends.
  double unproven_error() const {
    return unproven_ == 0 ? 0.0 : static_cast<double>(unproven_) / static_cast<double>(evaluations_) * from_.area;
  }
  bool has_enough() const {
    return evaluations_ > kMostEvaluations || (evaluations_ > kEnoughToJudge && unproven_error() > 10 * tolerance_);
  }

  double hidden_at(Vec2d p) {
    ++evaluations_;
    const double hidden = now_->finder.hidden_factor(plane_.to_world(p), from_.normal);
    if (!now_->finder.is_proven()) ++unproven_;
    return hidden;
  }

  double look(RuledPiece& piece, Vec2d at) {
    const double hidden = hidden_at(at);
    if (piece.shape == 0) piece.shape = now_->finder.shape();
    piece.is_smooth = piece.is_smooth && now_->finder.shape() == piece.shape;
    return hidden;
  }

  double rule_over(RuledPiece& piece, int n) {
    const GaussRule& rule = gauss_rule(n);
    const std::vector<double> start = polynomial_at(rule, kBesideCorner), end = polynomial_at(rule, 1 - kBesideCorner);
    double sum = 0;
    piece.deviation = 0;
    std::size_t corner = 0;
    for_each_quad(piece.corners, [&](const FlatQuad& quad) {
      double expected[4] = {};
      for (std::size_t j = 0; j < rule.node.size(); ++j)
        for (std::size_t k = 0; k < rule.node.size(); ++k) {
          const FlatQuad::PlaceOnQuad place = quad.at(rule.node[j], rule.node[k]);
          const double hidden = look(piece, place.at);
          sum += rule.weight[j] * rule.weight[k] * place.area * hidden;
          expected[0] += start[j] * start[k] * hidden;
          expected[1] += end[j] * start[k] * hidden;
          expected[2] += end[j] * end[k] * hidden;
          expected[3] += start[j] * end[k] * hidden;
        }
      for (std::size_t i = 0; i < 4 && !piece.beside_corners.empty(); ++i)
        piece.deviation = std::max(piece.deviation, std::fabs(piece.beside_corners[corner++] - expected[i]));
      return true;
    });
    return sum;
  }

  // Curves that are no events may cut off a corner beyond all nodes.
  void look_at_corners(RuledPiece& piece) {
    constexpr double kStart = kBesideCorner, kEnd = 1 - kBesideCorner;
    for_each_quad(piece.corners, [&](const FlatQuad& quad) {
      for (const auto& [s, t] : {std::array{kStart, kStart}, std::array{kEnd, kStart}, std::array{kEnd, kEnd}, std::array{kStart, kEnd}})
        piece.beside_corners.push_back(look(piece, quad.at(s, t).at));
      return true;
    });
  }

  bool is_all_hidden(const FlatPolygon& piece) {
    const int n = eps_ < kFineEps ? 4 : 2;
    std::vector<double> places = gauss_rule(n).node;
    for (const double end : {kBesideCorner, 1 - kBesideCorner}) places.push_back(end);
    return for_each_quad(piece, [&](const FlatQuad& quad) {
      for (std::size_t j = 0; j < places.size(); ++j)
        for (std::size_t k = 0; k < places.size(); ++k) {
          if ((j < static_cast<std::size_t>(n)) != (k < static_cast<std::size_t>(n))) continue;  // nodes and corners
          const Vec2d at = quad.at(places[j], places[k]).at;
          const double hidden = hidden_at(at), whole = now_->finder.whole_factor(plane_.to_world(at), from_.normal);
          if (!(whole - hidden < kAllHidden * whole)) return false;
        }
      return true;
    });
  }

  void integrate(const FlatPolygon& piece, std::vector<EventSegment> events, int quarterings) {
    const double area = area_of(piece);
    if (piece.size() < 3 || !(area > kShortEvent * kShortEvent * from_.radius * from_.radius)) return;
    if (is_done_with_fewer(piece, area, !events.empty())) return;
    if (now_->is_cut && events.empty()) {
      // Nothing changes within: the piece is open, hidden or partly hidden as a whole.
      const Vec2d middle = centroid_of(piece, area);
      const double hidden = hidden_at(middle);
      if (hidden == 0) return;
      const std::uint64_t shape = now_->finder.shape();
      const double whole = now_->finder.whole_factor(plane_.to_world(middle), from_.normal);
      // All hidden. A gap between obstacles may still open within the piece, on a curve that is no event, so that the corners and the nodes
      // of a rule are asked as well.
      if (whole - hidden < kAllHidden * whole && is_all_hidden(piece)) return add_all(part_of_element(piece, area));
      RuledPiece ruled{piece, now_, quarterings, 0, hidden * area};
      ruled.shape = shape;
      return add_piece(std::move(ruled));
    }
    if (!now_->is_cut && quarterings < kUncutQuarterings + 2) return quarter(piece, quarterings);
    // Without cuts, the centroid says nothing about narrow parts.
    if (events.empty() || has_enough()) {
      RuledPiece ruled{piece, now_, quarterings, 1};
      ruled.value = rule_over(ruled, kPieceRules[1]);
      return add_piece(std::move(ruled));
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
  PlaneElement part_of_element(const FlatPolygon& piece, double area) const {
    PlaneElement part;
    part.normal = from_.normal;
    part.area = area;
    part.off_plane = from_.off_plane;
    std::vector<Vec3d> corners;
    for (const Vec2d& v : piece) corners.push_back(plane_.to_world(v));
    for (const Vec3d& v : corners) part.centroid += v / static_cast<double>(corners.size());
    for (const Vec3d& v : corners) part.radius = std::max(part.radius, length(v - part.centroid));
    part.contours.push_back(std::move(corners));
    return part;
  }

  void add_piece(RuledPiece piece) {
    if (piece.obstacles->is_cut && piece.value > tolerance_) look_at_corners(piece);
    use_next_rule(piece);
    keep(std::move(piece));
  }

  void use_next_rule(RuledPiece& piece) {
    const double before = piece.value;
    piece.value = rule_over(piece, kPieceRules[++piece.rule]);
    piece.last_difference = piece.difference;
    piece.difference = std::fabs(piece.value - before);
    judge(piece);
  }

  // One agreement may be chance: that of one and four nodes counts ten times, the next one five times, the third with a part of the
  // difference before. From then on, the differences have fallen tenfold twice. Where the piece has a kink, errors fall by about 0.4 a
  // rule, so that the difference before counts as well. What deviates beside the corners may be all of a part beyond the nodes,
  // and it tells of shapes that one and four nodes do not.
  static void judge(RuledPiece& piece) {
    const double difference = piece.difference, last = piece.last_difference;
    double chance = piece.rule == 1    ? 10 * difference
                    : !piece.is_smooth ? (piece.rule == 2 ? 5 : 2) * std::max(difference, 0.4 * last)
                    : piece.rule == 2  ? 5 * difference
                    : piece.rule == 3  ? std::max(difference, 0.1 * last)
                                       : difference;
    if (!piece.is_smooth || piece.rule == 1) chance += kKink * piece.deviation * area_of(piece.corners);
    piece.error = chance * (piece.obstacles->is_cut ? 1 : kUncutSafety);
    piece.falls = piece.rule < 3 || !(difference > 0.1 * last);
  }

  static bool has_less_error(const RuledPiece& a, const RuledPiece& b) { return a.error < b.error; }
  void keep(RuledPiece piece) {
    pieces_error_ += piece.error;
    pieces_.push_back(std::move(piece));
    std::push_heap(pieces_.begin(), pieces_.end(), has_less_error);
  }

  // Refines the piece with the largest error until the sum is small enough: by rules with more and more nodes while their differences
  // fall, else in four.
  void refine_pieces() {
    while (pieces_error_ > tolerance_ && !pieces_.empty() && !has_enough()) {
      std::pop_heap(pieces_.begin(), pieces_.end(), has_less_error);
      RuledPiece piece = std::move(pieces_.back());
      pieces_.pop_back();
      pieces_error_ -= piece.error;
      now_ = piece.obstacles;
      if (piece.falls && piece.rule + 1 < std::size(kPieceRules)) {
        use_next_rule(piece);
        keep(std::move(piece));
      } else if (piece.quarterings <= kMostQuarterings) {
        quarter(piece.corners, piece.quarterings);
      } else {
        sum_ += piece.value;
        error_ += piece.error;
      }
    }
    for (const RuledPiece& piece : pieces_) {
      sum_ += piece.value;
      error_ += piece.error;
    }
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
  const Obstacles& obstacles_;
  std::shared_ptr<ObstaclesOfPiece> now_;  // of the current piece
  std::vector<RuledPiece> pieces_;         // a heap by error
  double eps_, tolerance_;
  ElementPlane plane_;
  double sum_ = 0, error_ = 0, pieces_error_ = 0;
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
  const double all = result.unobstructed.value;
  const double tolerance = std::max(0.5 * eps * all, kNoFactor * std::min(first.area, second.area));
  const ExchangeArea hidden = HiddenIntegral(a, b, obstacles, between, eps, tolerance).over_parts(convex_parts_in_front(first, second));
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
