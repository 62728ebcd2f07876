#include "render/surface/local_scene.h"

#include <cmath>

#include "scene/framing.h"
#include "shadow/edges/segments.h"

namespace steradian {
namespace {

// Extents that need no scale, and the extents to which others are brought. Powers of floats and their inverses stay in range from there.
constexpr int kSmallest = -6, kLargest = 12, kUsual = 3;  // powers of two

// Maps a point p to (p - origin) scale.
struct Move {
  Vec3d origin;
  double scale = 1;

  void point(Vec3d& p) const { p = (p - origin) * scale; }
  void vector(Vec3d& v) const { v *= scale; }
  void points(std::vector<Vec3d>& list) const {
    for (Vec3d& p : list) point(p);
  }

  void operator()(Polygon& p) const {
    points(p.vertices);
    for (std::vector<Vec3d>& hole : p.holes) points(hole);
  }
  void operator()(Ellipse& e) const {
    point(e.center);
    vector(e.x);
    vector(e.y);
  }
  void operator()(Ellipsoid& e) const {
    point(e.center);
    vector(e.x);
    vector(e.y);
    vector(e.z);
  }
  void operator()(Capsule& c) const {
    point(c.end_a);
    point(c.end_b);
    c.radius *= scale;
  }
  void operator()(Line& l) const {
    point(l.end_a);
    point(l.end_b);
  }

  void light(AreaLight& l) const {
    std::visit(*this, l.shape);
    if (std::holds_alternative<Line>(l.shape)) l.radiance *= scale;  // times the width
    l.power *= scale * scale;
    if (l.texture) {
      point(l.texture->origin);
      l.texture->du = l.texture->du / scale;
      l.texture->dv = l.texture->dv / scale;
    }
    if (l.emission) {
      l.emission->intensity *= scale * scale;
      l.emission->area *= scale * scale;
    }
  }
  void light(PunctualLight& l) const {
    if (l.kind == PunctualKind::directional) return;
    point(l.position);
    l.intensity *= scale * scale;
    l.range *= scale;
  }
  // Differences of neighbouring floats are exact, and so are those of a scene far from the origin.
  void mesh(Mesh& m) const {
    for (Vec3f& p : m.positions) {
      auto moved = static_cast<Vec3d>(p);
      point(moved);
      p = static_cast<Vec3f>(moved);
    }
  }
  void operator()(Scene& scene) const {
    for (Mesh& m : scene.meshes) mesh(m);
    for (AreaLight& l : scene.area_lights) light(l);
    for (PunctualLight& l : scene.punctual_lights) light(l);
    for (Camera& camera : scene.cameras) point(camera.position);
    point(scene.bounds_min);
    point(scene.bounds_max);
  }
};

// None for a scene that suits floats.
std::optional<Move> move_of(const Scene& scene) {
  const double extent = shadow::largest_coordinate(scene.bounds_max - scene.bounds_min);
  if (!(extent > 0)) return {};
  Move move = {scene::far_middle({scene.bounds_min, scene.bounds_max})};
  const int size = std::ilogb(extent);
  if (size < kSmallest) move.scale = std::ldexp(1.0, kUsual - size);
  if (size >= kLargest) move.scale = std::ldexp(1.0, kLargest - 1 - size);
  if (move.origin == Vec3d{} && move.scale == 1) return {};
  return move;
}

}  // namespace

LocalScene::LocalScene(const Scene& original) : original_(original) {
  const std::optional<Move> move = move_of(original);
  if (!move) return;
  moved_ = original;
  (*move)(*moved_);
}

}  // namespace steradian
