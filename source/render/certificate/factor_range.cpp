#include "render/certificate/factor_range.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "steradian/kernels.h"

namespace steradian::certificate {
namespace {

constexpr double kRounding = 1e-12;  // of a form factor in double

// The convex hull of two triangles, with the planes of its sides.
class FactorShaft {
 public:
  FactorShaft(const OrientedTriangle& from, const OrientedTriangle& to, double tolerance) : from_(from), to_(to), tolerance_(tolerance) {
    for (const auto* triangle : {&from, &to})
      for (const Vec3d& p : triangle->corners) box_.add(p);
    box_.low = box_.low - Vec3d{tolerance, tolerance, tolerance};
    box_.high = box_.high + Vec3d{tolerance, tolerance, tolerance};
    add_sides(from, to);
    add_sides(to, from);
  }

  // True if an occluder may stand between two points.
  bool may_block(const ConvexOccluder& o) const {
    if (!o.box.meets(box_)) return false;
    const auto all = [&](auto is_outside) { return std::all_of(o.corners.begin(), o.corners.end(), is_outside); };
    if (all([&](const Vec3d& p) { return dot(p - from_.center, from_.normal) <= tolerance_; })) return false;
    if (all([&](const Vec3d& p) { return dot(p - to_.center, to_.normal) <= tolerance_; })) return false;
    for (std::size_t i = 0; i < count_; ++i)
      if (all([&](const Vec3d& p) { return dot(p - sides_[i].at, sides_[i].outwards) >= -tolerance_; })) return false;
    double least = 0, most = 0;
    for (const auto* triangle : {&from_, &to_})
      for (const Vec3d& p : triangle->corners) {
        const double height = dot(p - o.corners[0], o.normal);
        least = std::min(least, height);
        most = std::max(most, height);
      }
    return least < -tolerance_ && most > tolerance_;
  }

  // True if an occluder stands between all pairs of their points.
  bool is_covered_by(const ConvexOccluder& o) const {
    if (o.may_let_through) return false;
    std::array<double, 3> here, there;
    for (std::size_t i = 0; i < 3; ++i) {
      here[i] = dot(from_.corners[i] - o.corners[0], o.normal);
      there[i] = dot(to_.corners[i] - o.corners[0], o.normal);
    }
    const double side = here[0] + here[1] + here[2] > 0 ? 1 : -1;
    for (std::size_t i = 0; i < 3; ++i)
      if (!(side * here[i] > tolerance_ && side * there[i] < -tolerance_)) return false;
    // The segments between two convex sets cross a plane within the hull of those between their corners.
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double t = here[i] / (here[i] - there[j]);
        if (!holds(o, from_.corners[i] + (to_.corners[j] - from_.corners[i]) * t)) return false;
      }
    return true;
  }

 private:
  struct HullPlane {
    Vec3d at, outwards;  // unit
  };

  static bool holds(const ConvexOccluder& o, const Vec3d& p) {
    for (std::size_t k = 0; k < o.corners.size(); ++k) {
      const Vec3d& a = o.corners[k];
      const Vec3d along = o.corners[(k + 1) % o.corners.size()] - a;
      if (dot(cross(o.normal, along), p - a) < 0) return false;
    }
    return true;
  }

  // Adds the sides through an edge of one triangle and a corner of the other.
  void add_sides(const OrientedTriangle& edges, const OrientedTriangle& corners) {
    for (std::size_t e = 0; e < 3; ++e) {
      const Vec3d &a = edges.corners[e], &b = edges.corners[(e + 1) % 3], &third = edges.corners[(e + 2) % 3];
      for (const Vec3d& c : corners.corners) {
        Vec3d n = cross(b - a, c - a);
        const double size = length(n);
        if (!(size > 0)) continue;
        n = n / size;
        double least = dot(third - a, n), most = least;
        for (const Vec3d& p : corners.corners) {
          least = std::min(least, dot(p - a, n));
          most = std::max(most, dot(p - a, n));
        }
        if (most <= tolerance_)
          sides_[count_++] = {a, n};
        else if (least >= -tolerance_)
          sides_[count_++] = {a, -n};
        if (count_ == sides_.size()) return;
      }
    }
  }

  const OrientedTriangle &from_, &to_;
  const double tolerance_;
  Box3d box_;
  std::array<HullPlane, 18> sides_;
  std::size_t count_ = 0;
};

// A bound from below of the distance between two triangles.
double least_distance(const OrientedTriangle& a, const OrientedTriangle& b) {
  const auto height = [](const OrientedTriangle& of, const OrientedTriangle& above) {
    double least = dot(of.corners[0] - above.center, above.normal);
    for (const Vec3d& p : of.corners) least = std::min(least, dot(p - above.center, above.normal));
    return least;
  };
  return std::max({length(a.center - b.center) - a.radius - b.radius, height(a, b), height(b, a), 0.0});
}

bool is_behind(const OrientedTriangle& some, const OrientedTriangle& plane, double tolerance) {
  return std::all_of(some.corners.begin(), some.corners.end(),
                     [&](const Vec3d& p) { return dot(p - plane.center, plane.normal) <= tolerance; });
}

// Numbers of splits, at most: of pairs with an occluder between, and of pairs that are near each other.
struct Splits {
  int behind = 3, near = 4;
};

FactorRange range_behind(const OrientedTriangle& from, const OrientedTriangle& to, std::span<const ConvexOccluder* const> occluders,
                         double tolerance, Splits splits, double enough) {
  if (is_behind(to, from, tolerance) || is_behind(from, to, tolerance)) return {};
  std::vector<const ConvexOccluder*> between;
  if (!occluders.empty()) {
    const FactorShaft shaft(from, to, tolerance);
    for (const ConvexOccluder* o : occluders) {
      if (!shaft.may_block(*o)) continue;
      if (shaft.is_covered_by(*o)) return {0, 0, false};
      between.push_back(o);
    }
  }
  FactorRange range = whole_range(from, to);
  if (!between.empty()) {
    range.is_open = false;
    range.low = 0;
    range.slack = range.high;
  }
  int& left = between.empty() ? splits.near : splits.behind;
  if (left == 0 || range.slack <= enough) return range;
  --left;
  FactorRange of_parts;
  if (to.radius >= from.radius) {
    for (const OrientedTriangle& part : to.quarters()) {
      const FactorRange r = range_behind(from, part, between, tolerance, splits, enough / 4);
      of_parts.low += r.low;
      of_parts.high += r.high;
    }
  } else {
    of_parts = {1, 0};
    for (const OrientedTriangle& part : from.quarters()) {
      const FactorRange r = range_behind(part, to, between, tolerance, splits, enough);
      of_parts.low = std::min(of_parts.low, r.low);
      of_parts.high = std::max(of_parts.high, r.high);
    }
  }
  range.low = std::max(range.low, of_parts.low);
  range.high = std::min(range.high, of_parts.high);
  return range;
}

// The convex quadrangle of two triangles that share an edge and a plane; empty if there is none.
std::vector<Vec3d> joined(const std::array<Vec3d, 3>& a, const std::array<Vec3d, 3>& b, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (!(a[i] == b[(j + 1) % 3] && a[(i + 1) % 3] == b[j])) continue;
      const Vec3d normal = normalized(cross(a[1] - a[0], a[2] - a[0]));
      std::vector<Vec3d> all = {a[i], b[(j + 2) % 3], a[(i + 1) % 3], a[(i + 2) % 3]};
      if (std::fabs(dot(all[1] - a[0], normal)) > tolerance) return {};
      for (std::size_t k = 0; k < 4; ++k)
        if (!(dot(cross(all[(k + 1) % 4] - all[k], all[(k + 2) % 4] - all[(k + 1) % 4]), normal) > 0)) return {};
      return all;
    }
  return {};
}

}  // namespace

OrientedTriangle OrientedTriangle::of(const std::array<Vec3d, 3>& corners) {
  OrientedTriangle t{corners, {}, (corners[0] + corners[1] + corners[2]) / 3};
  const Vec3d n = cross(corners[1] - corners[0], corners[2] - corners[0]);
  t.area = 0.5 * length(n);
  t.normal = t.area > 0 ? normalized(n) : Vec3d{};
  for (const Vec3d& p : corners) t.radius = std::max(t.radius, length(p - t.center));
  return t;
}

OrientedTriangle OrientedTriangle::point(Vec3d position, Vec3d normal, double rounding) {
  return {{position, position, position}, normal, position, rounding};
}

OrientedTriangle OrientedTriangle::reversed() const {
  OrientedTriangle t = *this;
  std::swap(t.corners[1], t.corners[2]);
  t.normal = -normal;
  return t;
}

std::array<OrientedTriangle, 4> OrientedTriangle::quarters() const {
  const auto& [a, b, c] = corners;
  const Vec3d ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
  return {of({a, ab, ca}), of({ab, b, bc}), of({ca, bc, c}), of({ab, bc, ca})};
}

OccluderSet::OccluderSet(const Scene& scene) {
  constexpr double kTouching = 1e-7;  // of the scene's size
  double reach = 0;
  for (const Mesh& mesh : scene.meshes)
    for (const Vec3f& p : mesh.positions) reach = std::max({reach, std::fabs(double{p.x}), std::fabs(double{p.y}), std::fabs(double{p.z})});
  tolerance = kTouching * reach;
  for (const Mesh& mesh : scene.meshes) {
    if (!mesh.casts_shadow && !mesh.is_light_shape) continue;
    std::vector<std::array<Vec3d, 3>> triangles;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      std::array<Vec3d, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) corners[k] = static_cast<Vec3d>(mesh.positions[mesh.indices[3 * t + k]]);
      if (OrientedTriangle::of(corners).area > 0) triangles.push_back(corners);
    }
    const auto add = [&](std::vector<Vec3d> corners) {
      ConvexOccluder o;
      o.normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
      for (const Vec3d& p : corners) o.box.add(p);
      o.corners = std::move(corners);
      o.may_let_through = mesh.is_light_shape;
      polygons.push_back(std::move(o));
    };
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      // Files store the two halves of a quadrangle one after the other.
      std::vector<Vec3d> quad;
      if (t + 1 < triangles.size()) quad = joined(triangles[t], triangles[t + 1], tolerance);
      if (quad.empty()) {
        add({triangles[t].begin(), triangles[t].end()});
      } else {
        add(std::move(quad));
        ++t;
      }
    }
  }
}

double whole_factor(Vec3d position, Vec3d normal, const OrientedTriangle& to) {
  if (!(dot(position - to.center, to.normal) > 0)) return 0;
  const Frame frame = Frame::from_normal(normal);
  Kernels<double> k;
  std::array<Kernels<double>::vec3, 3> d;
  for (std::size_t i = 0; i < 3; ++i) {  // in walk order, the reverse of the stored one
    const Vec3d v = frame.to_local(to.corners[2 - i] - position);
    d[i] = k.polygon_direction({v.x, v.y, v.z});
  }
  auto walk = k.polygon_begin();
  for (std::size_t i = 0; i < 3; ++i) walk = k.polygon_add_edge(walk, d[i], d[(i + 1) % 3]);
  return std::clamp(k.polygon_irradiance(walk, k.mask_none()).v / std::numbers::pi, 0.0, 1.0);
}

// The kernel r (n.r) / r^4 has derivatives of at most (k + 1)! / R^(k + 2). In front of the plane of `to`, the form factor is thus within
// half of 6 / R^4 times the radius' square of a linear function of its values at the corners. The horizon cuts `to` the same everywhere.
// All directions that meet the front of a plane and leave the front of another send (1 - cosine of the normals) / 2.
FactorRange whole_range(const OrientedTriangle& from, const OrientedTriangle& to) {
  const double distance = least_distance(from, to), most = std::min((1 - dot(from.normal, to.normal)) / 2 + kRounding, 1.0);
  if (!(distance > 0)) return {0, most, true, most};
  const double over = to.area / (std::numbers::pi * distance * distance), far = from.radius / distance;
  FactorRange range{1, 0};
  bool in_front = true;
  for (const Vec3d& p : from.corners) {
    const double f = whole_factor(p, from.normal, to);
    range.low = std::min(range.low, f);
    range.high = std::max(range.high, f);
    in_front = in_front && dot(p - to.center, to.normal) > 0;
  }
  double more = 3 * over * far * far;
  const double middle = in_front ? 0 : whole_factor(from.center, from.normal, to), change = 2 * over * far;
  if (!in_front) more = std::max(middle + change - range.high, range.low - middle + change);
  range.slack = more;
  range.low = std::max(range.low - more - kRounding, 0.0);
  range.high = std::min({range.high + more + kRounding, over, most});
  return range;
}

FactorRange factor_range(const OrientedTriangle& from, const OrientedTriangle& to, const OccluderSet& occluders, bool through_lamps,
                         double enough) {
  std::vector<const ConvexOccluder*> all;
  for (const ConvexOccluder& o : occluders.polygons)
    if (!(through_lamps && o.may_let_through)) all.push_back(&o);
  return range_behind(from, to, all, occluders.tolerance, {}, enough);
}

}  // namespace steradian::certificate
