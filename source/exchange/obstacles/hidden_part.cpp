#include "exchange/obstacles/hidden_part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "shadow/edges/segments.h"
#include "steradian/kernels.h"

namespace steradian::exchange {
namespace {

__extension__ typedef __int128 Wide;

constexpr double kFineCells = 0x1p40;
constexpr std::int32_t kOutside = 1 << 24;  // weight of the outline: more than any number of triangles on a ray
// Geometry nearer to the target's plane than this fraction of its size does not block; a triangle that touches the plane crosses it.
constexpr double kNearPlane = 1e-12;
// Numbers of lines that are no edges.
constexpr std::uint32_t kSectionLine = std::uint32_t{1} << 30, kOutlineLine = std::uint32_t{1} << 31;
constexpr double kBoxMargin = 1.0 / 64;  // the outline must not touch the sides of the box
// Below this size of a determinant, double is not sure of its sign: products of 2^42 by 2^42 cells, with a few roundings of 2^-53 each.
constexpr double kSureSign = 0x1p35;

// A sum of edges that is farther from 0 is no closed boundary; the point is then moved by this fraction of the target's size.
constexpr double kClosed = 1e-9, kDisplacement = 1e-11;

// Squares of clearances, in half boxes: with the first, no other trial is made; with the second, one ray is enough.
constexpr double kFarEnough = 1e-3, kClearEnough = 1e-4;

enum IdKind : std::uint64_t {
  kVertexId = 0,
  kCutId = std::uint64_t{1} << 60,
  kStartClip = std::uint64_t{2} << 60,
  kEndClip = std::uint64_t{3} << 60,
  kOutlineId = std::uint64_t{4} << 60
};

FineCell cell_at(double x, double y, std::uint64_t id) {
  // The displacement is that of the shadow's cells.
  const shadow::SnappedVertex tie = shadow::cell_of(id, 0, 0);
  const auto whole = [](double v) { return std::floor(std::clamp(v, -1.0, 1.0) * kFineCells + 0.5); };
  return {whole(x), whole(y), tie.dx, tie.dy, id};
}

// A vertex (scale 1) or twice a midpoint (scale 2).
struct ScaledPlace {
  double x, y;
  std::int64_t dx, dy;
};
ScaledPlace once(const FineCell& c) { return {c.x, c.y, c.dx, c.dy}; }
ScaledPlace twice_middle(const FineSegment& e) {
  return {e.a.x + e.b.x, e.a.y + e.b.y, std::int64_t{e.a.dx} + e.b.dx, std::int64_t{e.a.dy} + e.b.dy};
}

// Side of f's line on which a place lies: +1 left, -1 right, never 0. value: the determinant, in double; tie: its term of the first order
// in the displacement, where the determinant is 0.
struct SideOfLine {
  int sign;
  double value, tie;
};

SideOfLine close_side_of_line(const FineSegment& f, const ScaledPlace& p, int scale) {
  const auto wide = [](double whole) { return Wide{static_cast<std::int64_t>(whole)}; };
  const Wide fx = wide(f.b.x - f.a.x), fy = wide(f.b.y - f.a.y), px = wide(p.x - scale * f.a.x), py = wide(p.y - scale * f.a.y);
  const Wide d0 = fx * py - fy * px;
  if (d0 != 0) return {d0 < 0 ? -1 : 1, static_cast<double>(d0), 0.0};
  const std::int64_t gx = f.b.dx - f.a.dx, gy = f.b.dy - f.a.dy, qx = p.dx - std::int64_t{scale} * f.a.dx,
                     qy = p.dy - std::int64_t{scale} * f.a.dy;
  const Wide d1 = fx * qy - fy * qx + gx * py - gy * px;
  const Wide d2 = Wide{gx} * qy - Wide{gy} * qx;
  const Wide d = d1 != 0 ? d1 : d2;
  return {d < 0 ? -1 : 1, 0.0, static_cast<double>(d1)};
}

inline SideOfLine side_of_line(const FineSegment& f, const ScaledPlace& p, int scale) {
  const double quick = (f.b.x - f.a.x) * (p.y - scale * f.a.y) - (f.b.y - f.a.y) * (p.x - scale * f.a.x);
  if (std::fabs(quick) > kSureSign) return {quick < 0 ? -1 : 1, quick, 0.0};
  return close_side_of_line(f, p, scale);
}

std::uint64_t hash_of_piece(std::uint32_t line, std::uint32_t from, std::uint32_t to) {
  const std::uint64_t all = (std::uint64_t{line} << 32 | from) * 0x9e3779b97f4a7c15u + to;
  return (all ^ (all >> 29)) * 0xbf58476d1ce4e5b9u;
}

bool lies_above(const FineCell& c, const ScaledPlace& middle) {
  const double y = 2 * c.y;
  return y > middle.y || (y == middle.y && 2 * std::int64_t{c.dy} > middle.dy);
}

bool meet_at_an_end(const FineSegment& e, const FineSegment& f) {
  return e.a.id == f.a.id || e.a.id == f.b.id || e.b.id == f.a.id || e.b.id == f.b.id;
}

}  // namespace

HiddenPart::HiddenPart(const PlaneElement& target, const shadow::EdgeMesh& mesh) : mesh_(mesh) {
  // z runs away from the points, so that counter-clockwise is the order in which an irradiance is positive.
  const std::vector<Vec3d>& loop = target.contours[0];
  const Vec3d z = -target.normal, along = loop[1] - loop[0], x = normalized(along - z * dot(along, z));
  axes_ = {x, cross(z, x), z};
  Box2d bounds;
  for (const auto& contour : target.contours)
    for (const Vec3d& v : contour) {
      const Vec3d p = axes_.to_local(v - target.centroid);
      bounds.add(Vec2d{p.x, p.y});
    }
  origin_ = target.centroid + axes_.x * bounds.center().x + axes_.y * bounds.center().y;
  box_x_ = bounds.half().x * (1 + kBoxMargin);
  box_y_ = bounds.half().y * (1 + kBoxMargin);
  eta_ = kNearPlane * std::max(box_x_, box_y_);
  for (const auto& contour : target.contours) {
    std::vector<std::array<double, 2>>& flat = outline_.emplace_back();
    // Seen against z, the front runs counter-clockwise; along z, it runs the other way.
    for (auto v = contour.rbegin(); v != contour.rend(); ++v) {
      const Vec3d p = axes_.to_local(*v - origin_);
      flat.push_back({p.x, p.y});
    }
  }
  for (const Vec3d& v : mesh.vertices) vertices_.push_back(axes_.to_local(v - origin_));
  for (const auto& corners : mesh.triangles) area_near_plane_ += shadow_near_plane(corners);
  area_near_plane_ = std::min(area_near_plane_, target.area);
  for (const shadow::Plane& plane : mesh.planes)
    faces_.push_back({axes_.to_local(plane.normal), plane.offset - dot(plane.normal, origin_)});
}

// The area, projected to the target's plane within its box, of the part of a triangle that collect() takes to lie in the plane.
double HiddenPart::shadow_near_plane(const std::array<std::uint32_t, 3>& corners) const {
  const Vec3d a = vertices_[corners[0]], b = vertices_[corners[1]], c = vertices_[corners[2]];
  if (std::max({a.z, b.z, c.z}) < -eta_ || std::min({a.z, b.z, c.z}) >= 0) return 0;
  std::vector<Vec3d> part{a, b, c};
  // The side of the box on which offset + sign * coordinate is positive.
  const auto clip = [&](double Vec3d::*coordinate, double sign, double offset) {
    std::vector<Vec3d> inside;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Vec3d &v = part[i], &w = part[(i + 1) % part.size()];
      const double height = offset + sign * v.*coordinate, next = offset + sign * w.*coordinate;
      if (height >= 0) inside.push_back(v);
      if ((height > 0 && next < 0) || (height < 0 && next > 0)) inside.push_back(v + (w - v) * (height / (height - next)));
    }
    part = std::move(inside);
  };
  clip(&Vec3d::z, 1, eta_);
  clip(&Vec3d::z, -1, 0);
  for (const double sign : {1.0, -1.0}) clip(&Vec3d::x, sign, box_x_), clip(&Vec3d::y, sign, box_y_);
  double twice = 0;
  for (std::size_t i = 1; i + 1 < part.size(); ++i)
    twice += (part[i].x - part[0].x) * (part[i + 1].y - part[0].y) - (part[i].y - part[0].y) * (part[i + 1].x - part[0].x);
  return std::fabs(twice) / 2;
}

void HiddenPart::add_segment(Homogeneous a, Homogeneous b, std::uint64_t id_a, std::uint64_t id_b, std::uint32_t line,
                             std::int32_t weight) {
  double t0 = 0, t1 = 1;
  int side0 = 0, side1 = 0;
  const auto keep = [&](double da, double db, int side) {
    if (da >= 0 && db >= 0) return true;
    if (da < 0 && db < 0) return false;
    const double t = da / (da - db);
    if (da < 0 && t > t0) t0 = t, side0 = side;
    if (db < 0 && t < t1) t1 = t, side1 = side;
    return t0 < t1;
  };
  if (!keep(a.x + box_x_ * a.w, b.x + box_x_ * b.w, 1) || !keep(box_x_ * a.w - a.x, box_x_ * b.w - b.x, 2) ||
      !keep(a.y + box_y_ * a.w, b.y + box_y_ * b.w, 3) || !keep(box_y_ * a.w - a.y, box_y_ * b.w - b.y, 4))
    return;
  const auto cell = [&](double t, int side, std::uint64_t id) {
    const double x = a.x + t * (b.x - a.x), y = a.y + t * (b.y - a.y), w = a.w + t * (b.w - a.w);
    FineCell c = cell_at(side == 1 ? -1.0 : side == 2 ? 1.0 : x / (w * box_x_), side == 3 ? -1.0 : side == 4 ? 1.0 : y / (w * box_y_), id);
    return c;
  };
  const Homogeneous end = b;
  FineSegment s;
  s.a = cell(t0, side0, side0 != 0 ? kStartClip | line : id_a);
  s.b = t1 == 1 ? cell_at(end.x / (end.w * box_x_), end.y / (end.w * box_y_), id_b) : cell(t1, side1, kEndClip | line);
  s.weight = weight;
  s.line = line;
  if (side0 == 1) crossings_.push_back({s.a.y, s.a.dy, weight});
  if (side1 == 1) crossings_.push_back({s.b.y, s.b.dy, -weight});
  segments_.push_back(s);
}

void HiddenPart::collect() {
  segments_.clear();
  crossings_.clear();
  const Vec3d at{eye_.x, eye_.y, -eye_.z};
  facing_.resize(faces_.size());
  for (std::size_t t = 0; t < faces_.size(); ++t) facing_[t] = dot(faces_[t].normal, at) - faces_[t].offset > 0 ? 1 : -1;
  // Cut of an edge by the near plane; always from the lower to the higher number, for the same bits.
  const auto cut = [&](std::uint32_t v, std::uint32_t w) {
    const Vec3d a = vertices_[std::min(v, w)], b = vertices_[std::max(v, w)];
    const double t = std::clamp((-eta_ - a.z) / (b.z - a.z), 0.0, 1.0);
    return Vec3d{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), -eta_};
  };
  for (std::uint32_t number = 0; number < mesh_.edges.size(); ++number) {
    const shadow::MeshEdge& edge = mesh_.edges[number];
    const bool below0 = lies_below(edge.v0), below1 = lies_below(edge.v1);
    if (!below0 && !below1) continue;
    std::int32_t weight = 0;
    for (std::uint32_t i = edge.first; i < edge.first + edge.count; ++i)
      weight -= mesh_.edge_triangles[i].walks * facing_[mesh_.edge_triangles[i].triangle];
    if (weight == 0) continue;
    Vec3d a = vertices_[edge.v0], b = vertices_[edge.v1];
    std::uint64_t id_a = kVertexId | edge.v0, id_b = kVertexId | edge.v1;
    if (!below0) a = cut(edge.v0, edge.v1), id_a = kCutId | number;
    if (!below1) b = cut(edge.v0, edge.v1), id_b = kCutId | number;
    add_segment(seen(a), seen(b), id_a, id_b, number, weight);
  }
  // Sections of triangles by the near plane: from where a triangle's outline leaves the space below to where it comes back.
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    const auto& corners = mesh_.triangles[t];
    int leaving = -1, returning = -1;
    for (int c = 0; c < 3; ++c) {
      const bool here = lies_below(corners[static_cast<std::size_t>(c)]),
                 there = lies_below(corners[static_cast<std::size_t>((c + 1) % 3)]);
      if (here && !there) leaving = c;
      if (!here && there) returning = c;
    }
    if (leaving < 0 || returning < 0) continue;
    const auto end = [&](int c) { return cut(corners[static_cast<std::size_t>(c)], corners[static_cast<std::size_t>((c + 1) % 3)]); };
    const auto id = [&](int c) { return kCutId | mesh_.triangle_edges[t][static_cast<std::size_t>(c)]; };
    const std::uint64_t id_a = id(leaving), id_b = id(returning);
    const std::int32_t weight = -facing_[t];
    // Coincident triangles have the same section.
    const auto same = std::find_if(segments_.begin(), segments_.end(), [&](const FineSegment& s) {
      return (s.a.id == id_a && s.b.id == id_b) || (s.a.id == id_b && s.b.id == id_a);
    });
    if (same != segments_.end())
      same->weight += same->a.id == id_a ? weight : -weight;
    else
      add_segment(seen(end(leaving)), seen(end(returning)), id_a, id_b, kSectionLine | t, weight);
  }
  std::uint64_t number = 0;
  for (const auto& contour : outline_) {
    const std::uint64_t first = number;
    const auto corner = [&](std::size_t i) {
      const auto& [x, y] = contour[i % contour.size()];
      return cell_at(x / box_x_, y / box_y_, kOutlineId | (first + i % contour.size()));
    };
    for (std::size_t i = 0; i < contour.size(); ++i, ++number)
      segments_.push_back({corner(i), corner(i + 1), -kOutside, kOutlineLine | static_cast<std::uint32_t>(number)});
  }
}

// Bounds of all segments, apart from them, so that few are looked at closely.
void HiddenPart::bound_segments() {
  const std::size_t count = segments_.size();
  for (std::vector<double>* bounds : {&low_, &high_, &left_, &right_}) bounds->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const FineSegment& s = segments_[i];
    low_[i] = std::min(s.a.y, s.b.y);
    high_[i] = std::max(s.a.y, s.b.y);
    left_[i] = std::min(s.a.x, s.b.x);
    right_[i] = std::max(s.a.x, s.b.x);
  }
}

// The crossings of all segments, each pair once: both must know the same.
void HiddenPart::find_crossings() {
  if (crossed_.size() < segments_.size()) crossed_.resize(segments_.size());
  for (std::size_t i = 0; i < segments_.size(); ++i) crossed_[i].clear();
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const double low = low_[i], high = high_[i], left = left_[i], right = right_[i];
    for (std::size_t j = i + 1; j < segments_.size(); ++j)
      if ((low_[j] <= high) & (high_[j] >= low) & (left_[j] <= right) & (right_[j] >= left)) add_crossings(i, j);
  }
}

void HiddenPart::add_crossings(std::size_t i, std::size_t j) {
  const FineSegment &e = segments_[i], &f = segments_[j];
  if (e.weight == 0 || f.weight == 0 || meet_at_an_end(e, f)) return;
  const SideOfLine start_e = side_of_line(f, once(e.a), 1), end_e = side_of_line(f, once(e.b), 1);
  if (start_e.sign == end_e.sign) return;
  const SideOfLine start_f = side_of_line(e, once(f.a), 1), end_f = side_of_line(e, once(f.b), 1);
  if (start_f.sign == end_f.sign) return;
  const auto crossing = [](const FineSegment& own, const FineSegment& other, const SideOfLine& start, const SideOfLine& end) {
    const auto between = [](double from, double to) { return std::clamp(from / (from - to), 0.0, 1.0); };
    const double t = start.value != end.value ? between(start.value, end.value) : start.tie != end.tie ? between(start.tie, end.tie) : 0.5;
    return CrossedAt{side_of_line(other, twice_middle(own), 2).sign != end.sign, t, end.sign > 0 ? other.weight : -other.weight,
                     other.line};
  };
  crossed_[i].push_back(crossing(e, f, start_e, end_e));
  crossed_[j].push_back(crossing(f, e, start_f, end_f));
}

// The count on the side of -x of a segment's middle, from all that a ray to the left crosses.
std::int32_t HiddenPart::count_left_of(const FineSegment& e, std::size_t own) const {
  const ScaledPlace m = twice_middle(e);
  std::int32_t count = kOutside;
  for (const LeftCrossing& c : crossings_) {
    const double y = 2 * c.y;
    if (y < m.y || (y == m.y && 2 * std::int64_t{c.dy} < m.dy)) count += c.weight;
  }
  const double middle_x = m.x / 2, middle_y = m.y / 2;
  for (std::size_t j = 0; j < segments_.size(); ++j) {
    if (!((low_[j] <= middle_y) & (high_[j] >= middle_y) & (left_[j] <= middle_x)) || j == own) continue;
    const FineSegment& f = segments_[j];
    const bool start_above = lies_above(f.a, m), end_above = lies_above(f.b, m);
    if (start_above == end_above) continue;
    const int side = side_of_line(f, m, 2).sign;
    if (end_above && side < 0) count -= f.weight;
    if (start_above && side > 0) count += f.weight;
  }
  return count;
}

// The number of triangles between the point and a place of the plane, in fractions of the box.
std::int32_t HiddenPart::hits_towards(double x, double y) const {
  const Vec3d at{eye_.x, eye_.y, -eye_.z}, way = Vec3d{x * box_x_, y * box_y_, 0} - at;
  const double last = (eye_.z - eta_) / eye_.z;
  std::int32_t hits = 0;
  for (const auto& t : mesh_.triangles) {
    // Moeller, Trumbore, "Fast, minimum storage ray-triangle intersection", 1997.
    const Vec3d a = vertices_[t[0]], ab = vertices_[t[1]] - a, ac = vertices_[t[2]] - a, p = cross(way, ac);
    const double det = dot(ab, p);
    if (det == 0) continue;
    const Vec3d s = at - a, q = cross(s, ab);
    const double u = dot(s, p) / det, v = dot(way, q) / det, where = dot(ac, q) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && where >= 0 && where < last) ++hits;
  }
  return hits;
}

// The count that means that nothing is in the way. The counts are right but for a constant, which one ray finds.
std::int32_t HiddenPart::level_of_visible() {
  // A trial far from all segments, or the farthest one, among places of Roberts' sequence (core/lattices.h).
  struct Trial {
    double x = 0, y = 0, clearance = -1;
  } best, second;
  for (int i = 1; i <= 12 && best.clearance < kFarEnough; ++i) {
    const auto part = [i](double step) {
      const double v = 0.5 + step * i;
      return 2 * (v - std::floor(v)) - 1;
    };
    const double x = 0.98 * part(0.7548776662466927), y = 0.98 * part(0.5698402909980532);
    double least = std::numeric_limits<double>::infinity();
    for (const FineSegment& s : segments_) {
      const double scale = 1.0 / kFineCells, ax = s.a.x * scale, ay = s.a.y * scale;
      const double fx = s.b.x * scale - ax, fy = s.b.y * scale - ay, l2 = fx * fx + fy * fy;
      const double t = l2 > 0 ? std::clamp(((x - ax) * fx + (y - ay) * fy) / l2, 0.0, 1.0) : 0.0;
      const double dx = x - ax - t * fx, dy = y - ay - t * fy;
      least = std::min(least, dx * dx + dy * dy);
    }
    if (least > best.clearance) {
      second = best;
      best = {x, y, least};
    } else if (least > second.clearance) {
      second = {x, y, least};
    }
  }
  const auto level_by = [&](const Trial& trial) {
    // A short upward segment of no weight stands for the place.
    FineSegment place;
    place.a = cell_at(trial.x, trial.y, std::numeric_limits<std::uint64_t>::max());
    place.b = place.a;
    std::int32_t count = count_left_of(place, segments_.size());
    if (count > kOutside / 2) count -= kOutside;
    return count - hits_towards(trial.x, trial.y);
  };
  const std::int32_t first = level_by(best);
  if (best.clearance > kClearEnough || second.clearance < 0) return first;
  // Near a silhouette a ray may miss; two must agree, or the lower one counts as in the shadow's finder.
  return std::min(first, level_by(second));
}

double HiddenPart::edge_factor(double ax, double ay, double bx, double by, Vec3d normal) const {
  const auto direction = [&](double x, double y) { return Kernels<double>().polygon_direction({x - eye_.x, y - eye_.y, eye_.z}); };
  const auto e = Kernels<double>().polygon_edge(direction(ax, ay), direction(bx, by));
  return (e.x.v * normal.x + e.y.v * normal.y + e.z.v * normal.z) / std::numbers::pi;
}

void HiddenPart::arrange(Vec3d normal) {
  bound_segments();
  const std::int32_t visible = level_of_visible();
  const auto is_hidden = [visible](std::int32_t count) { return count > visible && count < kOutside / 2; };
  sum_ = 0;
  shape_ = 0;
  double end_x = 0, end_y = 0;
  find_crossings();
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const FineSegment& e = segments_[i];
    if (e.weight == 0 || (e.a.x == e.b.x && e.a.y == e.b.y)) continue;
    std::vector<CrossedAt>& crossed = crossed_[i];
    std::sort(crossed.begin(), crossed.end(),
              [](const CrossedAt& a, const CrossedAt& b) { return a.after_middle != b.after_middle ? b.after_middle : a.t < b.t; });
    const std::int32_t count = count_left_of(e, i);
    const bool up = e.b.y > e.a.y || (e.b.y == e.a.y && e.b.dy > e.a.dy);
    std::int32_t left = up ? count : count + e.weight;
    for (const CrossedAt& c : crossed)
      if (!c.after_middle) left -= c.change;
    const double sx = box_x_ / kFineCells, sy = box_y_ / kFineCells, ax = e.a.x * sx, ay = e.a.y * sy;
    const double fx = e.b.x * sx - ax, fy = e.b.y * sy - ay;
    double t = 0;
    std::uint32_t from = e.line;
    const auto piece_to = [&](double next, std::uint32_t to) {
      const std::uint32_t start = std::exchange(from, to);
      if (!(next > t)) return;
      const bool on_left = is_hidden(left), on_right = is_hidden(left - e.weight);
      if (on_left != on_right) {
        const double sign = on_left ? 1 : -1;
        sum_ += sign * edge_factor(ax + t * fx, ay + t * fy, ax + next * fx, ay + next * fy, normal);
        end_x += sign * (next - t) * fx;
        end_y += sign * (next - t) * fy;
        shape_ += hash_of_piece(e.line, start, to);
      }
      t = next;
    };
    for (const CrossedAt& c : crossed) {
      piece_to(c.t, c.line);
      left += c.change;
    }
    piece_to(1, e.line);
  }
  closure_ = std::hypot(end_x / box_x_, end_y / box_y_);
}

double HiddenPart::hidden_factor(Vec3d point, Vec3d normal) {
  const Vec3d n = axes_.to_local(normal), p = axes_.to_local(point - origin_);
  // Boundaries close unless a decision was wrong; a point next to it then decides otherwise.
  for (int attempt = 0;; ++attempt) {
    const double step = kDisplacement * attempt * std::max(box_x_, box_y_);
    eye_ = {p.x + step, p.y + 0.618 * step, -p.z};
    if (!(eye_.z > eta_)) return 0;
    collect();
    arrange(n);
    if (closure_ <= kClosed || attempt == 3) return std::max(sum_, 0.0);
  }
}

bool HiddenPart::is_proven() const { return closure_ <= kClosed; }

double HiddenPart::whole_factor(Vec3d point, Vec3d normal) {
  const Vec3d p = axes_.to_local(point - origin_), n = axes_.to_local(normal);
  eye_ = {p.x, p.y, -p.z};
  double sum = 0;
  for (const auto& contour : outline_)
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const auto &a = contour[i], &b = contour[(i + 1) % contour.size()];
      sum += edge_factor(a[0], a[1], b[0], b[1], n);
    }
  return std::max(sum, 0.0);
}

}  // namespace steradian::exchange
