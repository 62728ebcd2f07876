#include "exchange/obstacles/shadow_events.h"

#include <algorithm>
#include <cmath>

namespace steradian::exchange {
namespace {

// Faces are coplanar if their normals and offsets agree to the rounding of 32-bit corners. Their common edge is a silhouette only for
// points within this angle of both planes.
constexpr double kCoplanar = 1e-6;
// An edge is projected up to this fraction of the pivot's height: beyond, its shadow is too far away to matter.
constexpr double kFarAway = 1e-7;

class EventCollector {
 public:
  EventCollector(const ElementPlane& plane, double size, const PlaneElement& target, const shadow::EdgeMesh& mesh)
      : plane_(plane), size_(size), mesh_(mesh) {
    for (const Vec3d& v : mesh.vertices) vertices_.push_back(local(v));
    for (const auto& loop : target.contours)
      for (const Vec3d& v : loop) corners_.push_back(local(v));
    target_point_ = local(target.centroid);
    target_normal_ = plane.axes.to_local(target.normal);
    for (const Vec3d& c : corners_) reach_ = std::max(reach_, length(c - target_point_));
  }

  std::vector<EventSegment> collect() {
    add_face_planes();
    std::vector<const shadow::MeshEdge*> edges;
    std::vector<bool> used(vertices_.size(), false);
    for (const shadow::MeshEdge& e : mesh_.edges) {
      if (is_flat(e)) continue;
      edges.push_back(&e);
      used[e.v0] = used[e.v1] = true;
    }
    for (const shadow::MeshEdge* e : edges) {
      const Vec3d a = vertices_[e->v0], b = vertices_[e->v1];
      for (const Vec3d& corner : corners_) shadow_from(corner, a, b);
    }
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      if (!used[v]) continue;
      std::size_t first = 0;
      for (std::size_t i = 0; i < corners_.size(); ++i) {
        // The corners of all contours stand one after another; an edge too many between two contours is only one event more.
        const Vec3d& next = corners_[i + 1 < corners_.size() ? i + 1 : first];
        seen_through(vertices_[v], corners_[i], next);
      }
      for (const shadow::MeshEdge* e : edges) {
        if (e->v0 == v || e->v1 == v || share_a_face(*e, static_cast<std::uint32_t>(v))) continue;
        const Vec3d a = vertices_[e->v0], b = vertices_[e->v1];
        if (may_reach_target(vertices_[v], a, b)) {
          shadow_from(vertices_[v], a, b);
          seen_through(vertices_[v], a, b);
        }
      }
    }
    return std::move(events_);
  }

 private:
  Vec3d local(Vec3d p) const { return plane_.axes.to_local(p - plane_.origin); }

  bool is_flat(const shadow::MeshEdge& e) const {
    if (e.count != 2) return false;
    const auto& s = mesh_.edge_triangles[e.first];
    const auto& t = mesh_.edge_triangles[e.first + 1];
    const Vec3d n = normalized(mesh_.planes[s.triangle].normal), m = normalized(mesh_.planes[t.triangle].normal);
    return s.walks != t.walks && length(n - m) < kCoplanar;
  }
  bool share_a_face(const shadow::MeshEdge& e, std::uint32_t v) const {
    for (std::uint32_t i = e.first; i < e.first + e.count; ++i)
      for (const std::uint32_t c : mesh_.triangles[mesh_.edge_triangles[i].triangle])
        if (c == v) return true;
    return false;
  }

  // Lines through the pivot and the edge: true if some may meet the target.
  bool may_reach_target(Vec3d pivot, Vec3d a, Vec3d b) const {
    // By the extent, on the target's plane, of the lines through the ends, if both ways lead there.
    const auto hit = [&](Vec3d p, Vec3d& at) {
      Vec3d way = p - pivot;
      if (way.z < 0) way = -way;
      const double down = dot(way, target_normal_), height = dot(target_point_ - pivot, target_normal_);
      if (std::fabs(down) < 1e-9 * length(way)) return false;
      at = pivot + way * (height / down);
      return true;
    };
    Vec3d on_a, on_b;
    if (!hit(a, on_a) || !hit(b, on_b) || (a.z - pivot.z) * (b.z - pivot.z) < 0) return true;
    const Vec3d along = on_b - on_a;
    const double l2 = dot(along, along);
    const double t = l2 > 0 ? std::clamp(dot(target_point_ - on_a, along) / l2, 0.0, 1.0) : 0.0;
    return length(on_a + along * t - target_point_) <= reach_ * (1 + 1e-9);
  }

  void add(Vec2d a, Vec2d b) {
    if (std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(b.x) && std::isfinite(b.y)) events_.push_back({a, b});
  }

  // The shadow of the part of an edge below a pivot.
  void shadow_from(Vec3d pivot, Vec3d a, Vec3d b) {
    const double top = pivot.z * (1 - kFarAway), bottom = -1e-9 * size_;
    if (!(pivot.z > 0) || !clip_heights(a, b, bottom, top)) return;
    const auto project = [&](Vec3d v) {
      const double t = pivot.z / (pivot.z - v.z);
      return Vec2d{pivot.x + (v.x - pivot.x) * t, pivot.y + (v.y - pivot.y) * t};
    };
    add(project(a), project(b));
  }
  // The places that see the part of an edge above a pivot through the pivot.
  void seen_through(Vec3d pivot, Vec3d a, Vec3d b) {
    if (pivot.z < -1e-9 * size_ || !clip_heights(a, b, pivot.z + kFarAway * std::max(pivot.z, size_ * 1e-3), 1e300)) return;
    const auto project = [&](Vec3d q) {
      const double t = q.z / (q.z - pivot.z);
      return Vec2d{q.x + (pivot.x - q.x) * t, q.y + (pivot.y - q.y) * t};
    };
    add(project(a), project(b));
  }
  static bool clip_heights(Vec3d& a, Vec3d& b, double low, double high) {
    if (a.z > b.z) std::swap(a, b);
    if (b.z < low || a.z > high) return false;
    const Vec3d from = a, way = b - a;
    if (a.z < low) a = from + way * ((low - from.z) / way.z);
    if (b.z > high) b = from + way * ((high - from.z) / way.z);
    return true;
  }

  // Lines in which planes of obstacles cut that of the element.
  void add_face_planes() {
    std::vector<std::pair<Vec3d, double>> known;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Vec3d n = plane_.axes.to_local(normalized(mesh_.planes[t].normal));
      const double offset = dot(n, vertices_[mesh_.triangles[t][0]]), level = std::hypot(n.x, n.y);
      if (level < 1e-9) continue;
      const bool is_known = std::any_of(known.begin(), known.end(), [&](const auto& k) {
        const double sign = dot(k.first, n) < 0 ? -1 : 1;
        return length(k.first - n * sign) < kCoplanar && std::fabs(k.second - sign * offset) < kCoplanar * size_;
      });
      if (is_known) continue;
      known.push_back({n, offset});
      const Vec2d foot{n.x * offset / (level * level), n.y * offset / (level * level)}, along{-n.y / level, n.x / level};
      const double middle = -(foot.x * along.x + foot.y * along.y), far = 2 * size_;
      add({foot.x + along.x * (middle - far), foot.y + along.y * (middle - far)},
          {foot.x + along.x * (middle + far), foot.y + along.y * (middle + far)});
    }
  }

  const ElementPlane& plane_;
  double size_, reach_ = 0;
  const shadow::EdgeMesh& mesh_;
  std::vector<Vec3d> vertices_, corners_;
  Vec3d target_point_, target_normal_;
  std::vector<EventSegment> events_;
};

}  // namespace

std::vector<EventSegment> shadow_events(const ElementPlane& plane, double size, const PlaneElement& target,
                                        const shadow::EdgeMesh& obstacles) {
  return EventCollector(plane, size, target, obstacles).collect();
}

}  // namespace steradian::exchange
