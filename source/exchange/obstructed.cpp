#include "exchange/obstructed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "exchange/gauss_rules.h"
#include "exchange/hidden_part.h"
#include "exchange/shadow_events.h"
#include "steradian/error.h"

namespace steradian::exchange {
namespace {

constexpr std::size_t kObstacleLeaf = 4;
// Corners of a merged obstacle lie this near to its plane, as a fraction of its size and its distance from the origin.
constexpr double kMergedPlane = 1e-14;
// Triangles no further in front of an element's plane than this fraction of its size lie in the plane.
constexpr double kInPlane = 1e-11;
// An event shorter than this fraction of the element's size cuts off nothing that counts.
constexpr double kShortEvent = 1e-9;
// A piece may err by its part of the area, and the smallest ones by this part of the whole.
constexpr double kLeastPart = 1e-3;
// Outlines with more corners than this get no sides of the shaft: there are as many as the square of it.
constexpr std::size_t kMostShaftCorners = 24;
constexpr int kMostQuarterings = 14;
constexpr std::size_t kMostEvaluations = 4'000'000;
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
    events_ = shadow_events(plane_, std::max(from.radius, 1e-300), target, mesh);
  }

  ExchangeArea over_element() {
    for (const PlaneElement& part : convex_parts()) {
      FlatPolygon piece;
      for (const Vec3d& v : part.contours[0]) piece.push_back(plane_.to_plane(v));
      std::vector<EventSegment> inside;
      for (EventSegment e : events_)
        if (clip_to_polygon(e, piece, near())) inside.push_back(e);
      integrate(piece, std::move(inside), 0);
    }
    // Points whose hidden part is not known may be wrong by all that the target sends.
    if (unproven_ > 0) error_ += static_cast<double>(unproven_) / static_cast<double>(evaluations_) * from_.area;
    return {sum_, error_, static_cast<int>(std::min<std::size_t>(evaluations_, std::numeric_limits<int>::max()))};
  }

 private:
  std::vector<PlaneElement> convex_parts() const {
    if (from_.contours.size() == 1) {
      const std::vector<Vec3d>& v = from_.contours[0];
      bool convex = true;
      for (std::size_t i = 0; i < v.size(); ++i)
        convex = convex && dot(cross(v[(i + 1) % v.size()] - v[i], v[(i + 2) % v.size()] - v[(i + 1) % v.size()]), from_.normal) >= 0;
      if (convex && v.size() <= 8) return {from_};
    }
    return triangles_of_element(from_, "element");
  }

  double near() const { return kShortEvent * from_.radius; }

  double hidden_at(Vec2d p) {
    ++evaluations_;
    const double hidden = finder_.hidden_factor(plane_.to_world(p), from_.normal);
    if (!finder_.is_proven()) ++unproven_;
    return hidden;
  }

  // A rule with n nodes a side over a convex polygon, cut into quadrangles and one triangle about its first corner.
  double rule_over(const FlatPolygon& p, int n) {
    const GaussRule& rule = gauss_rule(n);
    double sum = 0;
    for (std::size_t i = 1; i + 1 < p.size(); i += 2) {
      const bool is_quad = i + 2 < p.size();
      const Vec2d a = p[0], b = p[i], c = p[i + 1], d = is_quad ? p[i + 2] : p[0];
      for (std::size_t j = 0; j < rule.node.size(); ++j)
        for (std::size_t k = 0; k < rule.node.size(); ++k) {
          const double s = rule.node[j], t = rule.node[k];
          // Bilinear; a triangle is a quadrangle with d = a.
          const Vec2d at = (a * (1 - s) + b * s) * (1 - t) + (d * (1 - s) + c * s) * t;
          const Vec2d along_s = (b - a) * (1 - t) + (c - d) * t, along_t = (d - a) * (1 - s) + (c - b) * s;
          sum += rule.weight[j] * rule.weight[k] * cross2(along_s, along_t) * hidden_at(at);
        }
    }
    return sum;
  }

  void integrate(const FlatPolygon& piece, std::vector<EventSegment> events, int quarterings) {
    const double area = area_of(piece);
    if (piece.size() < 3 || !(area > kShortEvent * kShortEvent * from_.radius * from_.radius)) return;
    const double enough = tolerance_ * std::max(area / from_.area, kLeastPart);
    if (events.empty()) {
      // Nothing changes within: the piece is open, hidden or partly hidden as a whole.
      const Vec2d middle = middle_of_polygon(piece);
      const double hidden = hidden_at(middle);
      if (hidden == 0) return;
      const double whole = finder_.whole_factor(plane_.to_world(middle), from_.normal);
      if (whole - hidden < 1e-13 * whole) {
        std::vector<Vec3d> corners;
        for (const Vec2d& v : piece) corners.push_back(plane_.to_world(v));
        const ExchangeArea all = exchange_area(part_of_element(std::move(corners), area), target_, std::max(0.1 * eps_, 1e-14));
        sum_ += all.value;
        error_ += all.error;
        return;
      }
    }
    if (events.empty() && try_rules(piece, enough)) return;
    if (evaluations_ > kMostEvaluations || quarterings > kMostQuarterings) {
      const double value = rule_over(piece, 3);
      sum_ += value;
      error_ += std::max(std::fabs(value), area * 1e-3 * tolerance_ / from_.area);
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
      if (difference <= enough) {
        sum_ += value;
        error_ += difference;
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
  std::vector<EventSegment> events_;
  double sum_ = 0, error_ = 0;
  std::size_t evaluations_ = 0, unproven_ = 0;
};

shadow::EdgeMesh mesh_of(const Obstacles& obstacles, const std::vector<std::uint32_t>& numbers) {
  std::vector<Vec3d> positions;
  std::vector<std::uint32_t> indices;
  for (const std::uint32_t t : numbers)
    for (const Vec3d& v : obstacles.triangle(t)) {
      indices.push_back(static_cast<std::uint32_t>(positions.size()));
      positions.push_back(v);
    }
  return shadow::build_edges(positions, indices);
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
  const shadow::EdgeMesh mesh = mesh_of(obstacles, between);
  const double all = result.unobstructed.value;
  const ExchangeArea hidden = HiddenIntegral(a, b, mesh, eps, 0.5 * eps * all).over_element();
  result.visible.value = std::clamp(all - hidden.value, 0.0, all);
  result.visible.error = std::min(result.unobstructed.error + hidden.error + kFinderError * hidden.value, all);
  result.visible.evaluations += hidden.evaluations;
  return result;
}

// Half spaces that contain the hull of two elements: in front of both, and through an edge of one and a corner of the other.
class PairShaft {
 public:
  PairShaft(const PlaneElement& a, const PlaneElement& b) : a_(a), b_(b) {
    size_ = a.radius + b.radius + length(a.centroid - b.centroid);
    for (const PlaneElement* e : {&a, &b})
      for (const auto& loop : e->contours)
        for (const Vec3d& v : loop) box_.add(v);
  }

  const Box3d& box() const { return box_; }
  // False if no inner point of the triangle lies between the elements.
  bool may_meet(const ObstacleTriangle& t) {
    if (has_both_beside(t)) return false;
    const auto lies_behind = [&](Vec3d normal, double offset) {
      return std::all_of(t.begin(), t.end(), [&](Vec3d v) { return dot(normal, v) <= offset; });
    };
    for (const PlaneElement* e : {&a_, &b_})
      if (lies_behind(e->normal, dot(e->normal, e->centroid) + kInPlane * size_)) return false;
    if (!has_sides_) add_sides();
    return std::none_of(sides_.begin(), sides_.end(), [&](const ShaftSide& side) { return lies_behind(side.normal, side.offset); });
  }

 private:
  struct ShaftSide {
    Vec3d normal;
    double offset;  // inside: dot(normal, x) > offset
  };

  // True if both elements lie on one side of the triangle's plane, as in any convex enclosure.
  bool has_both_beside(const ObstacleTriangle& t) const {
    const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
    const double in_plane = kInPlane * size_ * length(n);
    double low = 0, high = 0;
    for (const PlaneElement* e : {&a_, &b_}) {
      for (const auto& loop : e->contours)
        for (const Vec3d& v : loop) {
          const double h = dot(n, v - t[0]);
          low = std::min(low, h);
          high = std::max(high, h);
        }
      if (low < -in_plane && high > in_plane) return false;
    }
    return true;
  }

  void add_sides() {
    has_sides_ = true;
    std::vector<Vec3d> corners;
    for (const PlaneElement* e : {&a_, &b_})
      for (const auto& loop : e->contours) corners.insert(corners.end(), loop.begin(), loop.end());
    if (corners.size() > kMostShaftCorners) return;
    add_sides_through(a_, b_, corners);
    add_sides_through(b_, a_, corners);
  }

  void add_sides_through(const PlaneElement& edges, const PlaneElement& points, const std::vector<Vec3d>& corners) {
    for (const auto& loop : edges.contours)
      for (std::size_t i = 0; i < loop.size(); ++i)
        for (const auto& other : points.contours)
          for (const Vec3d& q : other) {
            const Vec3d v = loop[i], w = loop[(i + 1) % loop.size()], n = cross(w - v, q - v);
            const double l = length(n);
            if (!(l > 1e-9 * size_ * length(w - v))) continue;
            double low = 0, high = 0;
            for (const Vec3d& c : corners) {
              const double h = dot(n, c - v) / l;
              low = std::min(low, h);
              high = std::max(high, h);
            }
            const double near = 1e-12 * size_, sign = low >= -near ? 1 : high <= near ? -1 : 0;
            if (sign != 0) sides_.push_back({n * (sign / l), dot(n, v) * (sign / l) + kInPlane * size_});
          }
  }

  const PlaneElement &a_, &b_;
  double size_ = 0;
  Box3d box_;
  bool has_sides_ = false;
  std::vector<ShaftSide> sides_;
};

Box3d box_around(const ObstacleTriangle& t) {
  Box3d box;
  for (const Vec3d& v : t) box.add(v);
  return box;
}

}  // namespace

Obstacles::Obstacles(const std::vector<ObstacleTriangle>& triangles, const std::vector<PlaneElement>& between) {
  const scene::MergedPolygons merged = scene::merge_coplanar(triangles, [](std::size_t, std::size_t) { return true; });
  for (const scene::MergedPolygon& polygon : merged.polygons) add_face(polygon, triangles);
  if (!between.empty()) drop_outer(between);
  tree_ = BoxTree<Box3d>(
      triangles_.size(), [this](std::uint32_t i) { return box_around(triangles_[i]); }, Halving{kObstacleLeaf});
}

void Obstacles::add_face(const scene::MergedPolygon& polygon, const std::vector<ObstacleTriangle>& triangles) {
  const auto number = static_cast<std::uint32_t>(faces_.size());
  const auto add = [&](const ObstacleTriangle& t) {
    triangles_.push_back(t);
    face_of_.push_back(number);
  };
  std::optional<std::vector<PlaneElement>> parts;
  if (polygon.triangles.size() > 1) {
    // The merger is made for lights, and takes triangles that are a little off the plane.
    try {
      const PlaneElement face = make_element(polygon.outline, polygon.holes, "obstacle");
      const bool is_plane = std::all_of(polygon.triangles.begin(), polygon.triangles.end(), [&](std::size_t t) {
        return std::all_of(triangles[t].begin(), triangles[t].end(), [&](Vec3d v) {
          return std::fabs(dot(v - face.centroid, face.normal)) <= kMergedPlane * (face.radius + length(v));
        });
      });
      if (is_plane) parts = triangles_of_element(face, "obstacle");
    } catch (const Error&) {  // the triangles serve as they are
    }
  }
  if (parts && polygon.holes.empty()) {
    faces_.push_back(polygon.outline);
  } else if (polygon.triangles.size() == 1) {
    const ObstacleTriangle& t = triangles[polygon.triangles[0]];
    faces_.push_back({t.begin(), t.end()});
  } else {
    faces_.emplace_back();
  }
  if (parts) {
    for (const PlaneElement& part : *parts) add({part.contours[0][0], part.contours[0][1], part.contours[0][2]});
  } else {
    for (const std::size_t t : polygon.triangles) add(triangles[t]);
  }
}

void Obstacles::drop_outer(const std::vector<PlaneElement>& elements) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    bool front = false, back = false;
    for (std::size_t e = 0; e < elements.size() && !(front && back); ++e) {
      const double in_plane = kInPlane * elements[e].radius;
      const Vec3d n = normalized(cross(triangles_[i][1] - triangles_[i][0], triangles_[i][2] - triangles_[i][0]));
      for (const auto& loop : elements[e].contours)
        for (const Vec3d& v : loop) {
          const double h = dot(n, v - triangles_[i][0]);
          front = front || h > in_plane;
          back = back || h < -in_plane;
        }
    }
    if (!front || !back) continue;
    triangles_[kept] = triangles_[i];
    face_of_[kept++] = face_of_[i];
  }
  triangles_.resize(kept);
  face_of_.resize(kept);
}

bool Obstacles::covers(std::uint32_t triangle, const PlaneElement& a, const PlaneElement& b) const {
  const std::vector<Vec3d>& face = faces_[face_of_[triangle]];
  if (face.size() < 3) return false;
  const ObstacleTriangle& t = triangles_[triangle];
  const Vec3d n = normalized(cross(t[1] - t[0], t[2] - t[0]));
  const double side = dot(a.centroid - t[0], n) > 0 ? 1 : -1;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vec3d turn = cross(face[(i + 1) % face.size()] - face[i], face[(i + 2) % face.size()] - face[(i + 1) % face.size()]);
    if (dot(turn, n) < 0) return false;  // not convex
  }
  for (const auto& loop_a : a.contours)
    for (const Vec3d& p : loop_a) {
      const double above = side * dot(p - t[0], n);
      if (!(above > 0)) return false;
      for (const auto& loop_b : b.contours)
        for (const Vec3d& q : loop_b) {
          const double below = -side * dot(q - t[0], n);
          if (!(below > 0)) return false;
          const Vec3d x = p + (q - p) * (above / (above + below));
          for (std::size_t i = 0; i < face.size(); ++i)
            if (dot(cross(face[(i + 1) % face.size()] - face[i], x - face[i]), n) < 0) return false;
        }
    }
  return true;
}

std::vector<std::uint32_t> Obstacles::between(const PlaneElement& a, const PlaneElement& b) const {
  PairShaft shaft(a, b);
  std::vector<std::uint32_t> result;
  tree_.any_leaf([&](const auto& node) { return node.volume.meets(shaft.box()); },
                 [&](std::uint32_t first, std::uint32_t last) {
                   for (std::uint32_t i = first; i < last; ++i)
                     if (shaft.may_meet(triangles_[tree_.order()[i]])) result.push_back(tree_.order()[i]);
                   return false;
                 });
  std::sort(result.begin(), result.end());
  return result;
}

VisibleExchange visible_exchange(const PlaneElement& a, const PlaneElement& b, const Obstacles& obstacles, double eps) {
  return visible_from(a, b, obstacles, eps, exchange_area(a, b, eps));
}

VisibleExchange visible_exchange(const PlaneElement& a, const PlaneElement& b, const Obstacles& obstacles, double eps,
                                 const ExchangeArea& unobstructed) {
  return visible_from(a, b, obstacles, eps, unobstructed);
}

}  // namespace steradian::exchange
