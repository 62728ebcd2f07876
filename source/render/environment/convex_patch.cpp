#include "render/environment/convex_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace steradian::environment {
namespace {

using Corner = ConvexPatch::Corner;

double turn(Corner a, Corner b, Corner c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// Counter-clockwise hull.
// Source: Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979.
std::vector<Corner> convex_hull(std::vector<Corner> points) {
  if (points.size() < 3) return {};
  std::sort(points.begin(), points.end(), [](Corner a, Corner b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Corner> hull;
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t start = hull.size();
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), *p) <= 0) hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

}  // namespace

std::optional<Corner> ConvexPatch::project(Vec3d d) const {
  const double towards = -dot(d, frame_.z);
  if (towards < 0.3) return {};
  return Corner{dot(d, frame_.x) / towards, dot(d, frame_.y) / towards};
}

std::optional<ConvexPatch> ConvexPatch::around(Vec3d middle, const std::vector<Vec3d>& directions) {
  ConvexPatch patch;
  patch.frame_ = Frame::from_normal(-middle);
  std::vector<Corner> corners;
  corners.reserve(directions.size());
  for (const Vec3d d : directions) {
    const auto corner = patch.project(d);
    if (!corner) return {};
    corners.push_back(*corner);
  }
  patch.corners_ = convex_hull(std::move(corners));
  if (!patch.has_area()) return {};
  return patch;
}

void ConvexPatch::cut(Vec3d normal) {
  std::vector<Corner> kept;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Corner a = corners_[i], b = corners_[(i + 1) % corners_.size()];
    const double from = dot(normal, lift(a)), to = dot(normal, lift(b));
    if (from >= 0) kept.push_back(a);
    if ((from > 0 && to < 0) || (from < 0 && to > 0)) {
      const double t = from / (from - to);
      kept.push_back({a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t});
    }
  }
  corners_ = kept.size() >= 3 ? std::move(kept) : std::vector<Corner>();
}

void ConvexPatch::simplify(std::size_t most) {
  while (corners_.size() > most) {
    const std::size_t n = corners_.size();
    const auto lost = [&](std::size_t i) { return turn(corners_[(i + n - 1) % n], corners_[i], corners_[(i + 1) % n]); };
    std::size_t least = 0;
    for (std::size_t i = 1; i < n; ++i)
      if (lost(i) < lost(least)) least = i;
    corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(least));
  }
}

bool ConvexPatch::contains(Vec3d direction) const {
  const auto p = project(direction);
  if (!p || !has_area()) return false;
  for (std::size_t i = 0; i < corners_.size(); ++i)
    if (turn(corners_[i], corners_[(i + 1) % corners_.size()], *p) < 0) return false;
  return true;
}

ConvexPatch::Coverage ConvexPatch::coverage_of(const std::array<Vec3d, 4>& quad) const {
  std::array<Corner, 4> places;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto place = project(quad[k]);
    if (!place) return Coverage::none;
    places[k] = *place;
  }
  bool all = true;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    int outside = 0;
    for (const Corner p : places) outside += turn(corners_[i], corners_[(i + 1) % corners_.size()], p) < 0 ? 1 : 0;
    if (outside == 4) return Coverage::none;
    all = all && outside == 0;
  }
  return all ? Coverage::all : Coverage::some;
}

// Sum over triangles of one corner.
// Source: van Oosterom, Strackee, "The solid angle of a plane triangle", 1983.
double ConvexPatch::solid_angle() const {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
    const Vec3d a = normalized(lift(corners_[0])), b = normalized(lift(corners_[i])), c = normalized(lift(corners_[i + 1]));
    sum += 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
  }
  return std::fabs(sum);
}

double ConvexPatch::reach() const {
  double farthest = 0;
  for (const Corner c : corners_) farthest = std::max(farthest, std::hypot(c.x, c.y));
  return std::atan(farthest);
}

std::vector<Vec3d> ConvexPatch::cuts() const {
  constexpr int kAngles = 8;
  struct Extent {
    double x, y, low, high;
  };
  std::vector<Extent> extents;
  for (int k = 0; k < kAngles; ++k) {
    const double angle = std::numbers::pi * k / kAngles;
    Extent e{std::cos(angle), std::sin(angle), INFINITY, -INFINITY};
    for (const Corner c : corners_) {
      e.low = std::min(e.low, c.x * e.x + c.y * e.y);
      e.high = std::max(e.high, c.x * e.x + c.y * e.y);
    }
    extents.push_back(e);
  }
  std::stable_sort(extents.begin(), extents.end(), [](const Extent& a, const Extent& b) { return a.high - a.low > b.high - b.low; });
  std::vector<Vec3d> normals;
  for (const Extent& e : extents)
    for (const double at : {0.5, 0.375, 0.625, 0.25, 0.75})
      normals.push_back(normalized(frame_.x * e.x + frame_.y * e.y + frame_.z * (e.low + (e.high - e.low) * at)));
  return normals;
}

PolygonLight ConvexPatch::light(Vec3d radiance) const {
  PolygonLight light;
  for (const Corner c : corners_) light.vertices.push_back(lift(c));
  light.radiance = radiance;
  return light;
}

double unevenness(const std::vector<MapSample>& samples) {
  double sum = 0, weight = 0, difference = 0;
  for (const MapSample& s : samples) {
    sum += s.value * s.solid_angle;
    weight += s.solid_angle;
  }
  const double mean = weight > 0 ? sum / weight : 0;
  for (const MapSample& s : samples) difference += std::fabs(s.value - mean) * s.solid_angle;
  return difference;
}

Vec3d best_cut(const ConvexPatch& patch, const std::vector<MapSample>& samples) {
  constexpr double kBetter = 0.98;  // a cut that is hardly better does not replace one across the longest extent
  const std::vector<Vec3d> normals = patch.cuts();
  Vec3d best = normals.front();
  double least = INFINITY;
  for (const Vec3d normal : normals) {
    double sum[2] = {}, weight[2] = {}, difference = 0;
    for (const MapSample& s : samples) {
      const int side = dot(normal, s.direction) >= 0 ? 1 : 0;
      sum[side] += s.value * s.solid_angle;
      weight[side] += s.solid_angle;
    }
    const double mean[2] = {weight[0] > 0 ? sum[0] / weight[0] : 0, weight[1] > 0 ? sum[1] / weight[1] : 0};
    for (const MapSample& s : samples) difference += std::fabs(s.value - mean[dot(normal, s.direction) >= 0 ? 1 : 0]) * s.solid_angle;
    if (!(difference < kBetter * least)) continue;
    least = difference;
    best = normal;
  }
  return best;
}

}  // namespace steradian::environment
