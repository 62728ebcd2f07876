#include "exchange/obstacles/obstacles.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "steradian/error.h"

namespace steradian::exchange {
namespace {

constexpr std::size_t kObstacleLeaf = 4;
// Corners of a merged obstacle lie this near to its plane, as a fraction of its size and its distance from the origin.
constexpr double kMergedPlane = 1e-14;
// Triangles no further in front of an element's plane than this fraction of its size lie in the plane.
constexpr double kInPlaneRounding = 1e-11;
// Outlines with more corners than this get no sides of the shaft: there are as many as the square of it.
constexpr std::size_t kMostShaftCorners = 24;

// Heights up to this lie in the plane of an element or a face: rounding, and what the corners of both are off their planes.
double in_plane(const PlaneElement& e, const ObstacleFace& face, double size) {
  return kInPlaneRounding * size + kInPlane * (e.off_plane + face.off_plane);
}

// Sides of a face's plane on which elements have corners.
struct Sides {
  bool front = false, back = false;

  void add(const PlaneElement& e, const ObstacleFace& face, double in_plane) {
    for (const auto& loop : e.contours)
      for (const Vec3d& v : loop) {
        const double h = dot(face.normal, v - face.point);
        front = front || h > in_plane;
        back = back || h < -in_plane;
      }
  }
};

// True if an element lies in the plane of a face, as every element lies in its own. Such a face does not hide it.
bool lies_in_face(const PlaneElement& e, const ObstacleFace& face, double size) {
  Sides sides;
  sides.add(e, face, in_plane(e, face, size));
  return !sides.front && !sides.back;
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
  bool may_meet(const ObstacleTriangle& t, const ObstacleFace& face) {
    if (has_both_beside(face)) return false;
    const auto lies_behind = [&](Vec3d normal, double offset) {
      return std::all_of(t.begin(), t.end(), [&](Vec3d v) { return dot(normal, v) <= offset; });
    };
    for (const PlaneElement* e : {&a_, &b_})
      if (lies_in_face(*e, face, size_) || lies_behind(e->normal, dot(e->normal, e->centroid) + in_plane(*e, face, size_))) return false;
    if (!has_sides_) add_sides();
    return std::none_of(sides_.begin(), sides_.end(), [&](const ShaftSide& side) { return lies_behind(side.normal, side.offset); });
  }

 private:
  struct ShaftSide {
    Vec3d normal;
    double offset;  // inside: dot(normal, x) > offset
  };

  // True if both elements lie on one side of the face's plane, as in any convex enclosure.
  bool has_both_beside(const ObstacleFace& face) const {
    Sides sides;
    for (const PlaneElement* e : {&a_, &b_}) sides.add(*e, face, in_plane(*e, face, size_));
    return !(sides.front && sides.back);
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
            if (sign != 0) sides_.push_back({n * (sign / l), dot(n, v) * (sign / l) + kInPlaneRounding * size_});
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

ObstacleFace plane_of_triangles(const std::vector<ObstacleTriangle>& triangles, const std::vector<std::size_t>& numbers) {
  ObstacleFace face;
  face.point = triangles[numbers[0]][0];
  Vec3d area{}, sum{};
  for (const std::size_t t : numbers) {
    const auto& [a, b, c] = triangles[t];
    area += cross(b - a, c - a);
    sum += (a - face.point) + (b - face.point) + (c - face.point);
  }
  face.normal = normalized(area);
  face.point += sum / (3.0 * static_cast<double>(numbers.size()));
  for (const std::size_t t : numbers)
    for (const Vec3d& v : triangles[t]) face.off_plane = std::max(face.off_plane, std::fabs(dot(v - face.point, face.normal)));
  return face;
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
  ObstacleFace& face = faces_.emplace_back(plane_of_triangles(triangles, polygon.triangles));
  if (parts && polygon.holes.empty()) {
    face.outline = polygon.outline;
  } else if (polygon.triangles.size() == 1) {
    const ObstacleTriangle& t = triangles[polygon.triangles[0]];
    face.outline = {t.begin(), t.end()};
  }
  if (parts) {
    for (const PlaneElement& part : *parts) add({part.contours[0][0], part.contours[0][1], part.contours[0][2]});
  } else {
    for (const std::size_t t : polygon.triangles) add(triangles[t]);
  }
}

void Obstacles::drop_outer(const std::vector<PlaneElement>& elements) {
  std::vector<bool> is_inner;
  for (const ObstacleFace& face : faces_) {
    Sides sides;
    for (std::size_t e = 0; e < elements.size() && !(sides.front && sides.back); ++e)
      sides.add(elements[e], face, in_plane(elements[e], face, elements[e].radius));
    is_inner.push_back(sides.front && sides.back);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (!is_inner[face_of_[i]]) continue;
    triangles_[kept] = triangles_[i];
    face_of_[kept++] = face_of_[i];
  }
  triangles_.resize(kept);
  face_of_.resize(kept);
}

bool Obstacles::covers(std::uint32_t triangle, const PlaneElement& a, const PlaneElement& b) const {
  const std::vector<Vec3d>& face = faces_[face_of_[triangle]].outline;
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
                   for (std::uint32_t i = first; i < last; ++i) {
                     const std::uint32_t t = tree_.order()[i];
                     if (shaft.may_meet(triangles_[t], faces_[face_of_[t]])) result.push_back(t);
                   }
                   return false;
                 });
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<std::uint32_t> Obstacles::between(const PlaneElement& a, const PlaneElement& b, const std::vector<std::uint32_t>& among) const {
  PairShaft shaft(a, b);
  std::vector<std::uint32_t> result;
  for (const std::uint32_t t : among)
    if (shaft.may_meet(triangles_[t], faces_[face_of_[t]])) result.push_back(t);
  return result;
}

std::vector<std::uint32_t> Obstacles::before(Vec3d point, Vec3d normal, const PlaneElement& element) const {
  Box3d box;
  box.add(point);
  for (const auto& loop : element.contours)
    for (const Vec3d& v : loop) box.add(v);
  const double size = element.radius + length(element.centroid - point);
  const auto lies_behind = [&](const ObstacleTriangle& t, Vec3d origin, Vec3d n, double in_plane) {
    return std::all_of(t.begin(), t.end(), [&](Vec3d v) { return dot(n, v - origin) <= in_plane; });
  };
  std::vector<std::uint32_t> result;
  for (const std::uint32_t t : near_box(tree_, box)) {
    const ObstacleFace& face = faces_[face_of_[t]];
    if (!lies_behind(triangles_[t], point, normal, kInPlaneRounding * size) && !lies_in_face(element, face, size) &&
        !lies_behind(triangles_[t], element.centroid, element.normal, in_plane(element, face, size)))
      result.push_back(t);
  }
  std::sort(result.begin(), result.end());
  return result;
}

shadow::EdgeMesh Obstacles::mesh_of(const std::vector<std::uint32_t>& numbers) const {
  std::vector<Vec3d> positions;
  std::vector<std::uint32_t> indices;
  for (const std::uint32_t t : numbers)
    for (const Vec3d& v : triangles_[t]) {
      indices.push_back(static_cast<std::uint32_t>(positions.size()));
      positions.push_back(v);
    }
  return shadow::build_edges(positions, indices);
}

}  // namespace steradian::exchange
