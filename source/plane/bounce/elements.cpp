#include "plane/bounce/elements.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/exact/outline.h"

namespace steradian::plane {
namespace {

constexpr double kThinnest = 60;                    // thinner ellipses are not on packs
constexpr double kMostTurn = std::numbers::pi / 4;  // for an arc's element, in the ellipse's own parameter

Vec2d point_on(const Curve& c, double share) {
  return c.kind == Curve::Kind::segment ? c.a + (c.b - c.a) * share : c.ellipse.at(c.tau0 + share * c.tau_span);
}

// The normal away from the body.
Vec2d normal_on(const Curve& c, double share) {
  if (c.kind == Curve::Kind::segment) {
    const Vec2d e = c.b - c.a;
    return Vec2d{e.y, -e.x} / length(e);
  }
  const double tau = c.tau0 + share * c.tau_span;
  const Vec2d e = c.ellipse.y * std::cos(tau) - c.ellipse.x * std::sin(tau);
  return Vec2d{e.y, -e.x} / length(e);
}

bool is_thin(const PlaneEllipse& e) {
  const double sum = dot(e.x, e.x) + dot(e.y, e.y), det = std::fabs(cross(e.x, e.y));
  return sum > (kThinnest + 1 / kThinnest) * det;
}

double length_of(const Curve& c) {
  if (c.kind == Curve::Kind::segment) return length(c.b - c.a);
  return c.tau_span * std::sqrt(0.5 * (dot(c.ellipse.x, c.ellipse.x) + dot(c.ellipse.y, c.ellipse.y)));
}

void lay(const World& world, BoundaryElement& e) {
  const Curve& c = world.curves[e.curve];
  const Vec2d a = point_on(c, e.from), b = point_on(c, e.to);
  e.middle = (a + b) * 0.5;
  e.half = 0.5 * length(b - a);
  e.along = (b - a) / (2 * e.half);
  e.normal = Vec2d{e.along.y, -e.along.x} * (e.back ? -1.0 : 1.0);
}

double share_of(const Curve& c, Vec2d p) {
  if (c.kind == Curve::Kind::segment) return dot(p - c.a, c.b - c.a) / dot(c.b - c.a, c.b - c.a);
  const Vec2d unit = c.ellipse.to_unit(p);
  double tau = std::atan2(unit.y, unit.x);
  while (tau < c.tau0) tau += 2 * std::numbers::pi;
  return (tau - c.tau0) / c.tau_span;
}

// Places, as fractions of the curve, at which outlines of other bodies cross it, with 0 and 1. Between two of them the wall lies entirely
// within the same bodies.
std::vector<double> crossings_on(const World& world, std::size_t index) {
  const Curve& curve = world.curves[index];
  const auto body = static_cast<std::size_t>(curve.body);
  std::vector<double> shares{0, 1};
  for (std::size_t other = 0; other < world.boxes.size(); ++other) {
    if (other == body || !world.boxes[body].meets(world.boxes[other])) continue;
    for (std::size_t c = world.first_curve[other]; c < world.first_curve[other + 1]; ++c) {
      const Crossings crossings = intersect(curve, world.curves[c]);
      for (int k = 0; k < crossings.count; ++k) {
        const double share = share_of(curve, crossings.at[k]), theirs = share_of(world.curves[c], crossings.at[k]);
        if (share > 1e-6 && share < 1 - 1e-6 && theirs > -1e-9 && theirs < 1 + 1e-9) shares.push_back(share);
      }
    }
  }
  std::sort(shares.begin(), shares.end());
  return shares;
}

constexpr double kOffWall = 1e-6;  // in a picture of 1024 to 2048 units a side: far enough to decide which body a wall's point lies in

}  // namespace

bool is_open(const World& world, const ElementPlace& place) {
  const World::Inside inside = world.inside(place.at + place.normal * kOffWall);
  return !inside.dark && inside.body < 0;
}

std::pair<Vec2d, Vec2d> ends_of(const World& world, const BoundaryElement& element) {
  const Curve& c = world.curves[element.curve];
  return {point_on(c, element.from), point_on(c, element.to)};
}

ElementPlace place_on(const World& world, const BoundaryElement& element, double share) {
  const Curve& c = world.curves[element.curve];
  const double s = element.from + (element.to - element.from) * share;
  const Vec2d at = point_on(c, s);
  return {at, normal_on(c, s) * (element.back ? -1.0 : 1.0), dot(at - element.middle, element.along) / element.half};
}

std::optional<Vec3d> albedo_of(const PlaneBody& body, double most) {
  if (!body.albedo && body.light) return {};
  Vec3d a = body.albedo.value_or(body.color);
  a = {std::clamp(a.x, 0.0, most), std::clamp(a.y, 0.0, most), std::clamp(a.z, 0.0, most)};
  if (a.x == 0 && a.y == 0 && a.z == 0) return {};
  return a;
}

BoundaryElements::BoundaryElements(const World& world, double size, double most_albedo) {
  for (std::size_t c = 0; c < world.curves.size(); ++c) {
    const Curve& curve = world.curves[c];
    const auto albedo = albedo_of(world.scene.bodies[static_cast<std::size_t>(curve.body)], most_albedo);
    const bool arc = curve.kind == Curve::Kind::arc;
    if (!albedo || (arc && is_thin(curve.ellipse)) || (!arc && curve.a == curve.b)) continue;
    const std::vector<double> cuts = crossings_on(world, c);
    for (int side = 0; side < (curve.two_sided ? 2 : 1); ++side)
      for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        const double share = cuts[k + 1] - cuts[k];
        if (share < 1e-9) continue;
        BoundaryElement whole;
        whole.curve = c;
        whole.back = side == 1;
        whole.albedo = *albedo;
        whole.from = cuts[k];
        whole.to = cuts[k + 1];
        // A part within another body sends nothing that is visible from outside.
        if (!is_open(world, place_on(world, whole, 0.5))) continue;
        const double parts = share * std::max(length_of(curve) / size, arc ? curve.tau_span / kMostTurn : 1.0);
        const int count = std::max(1, static_cast<int>(std::ceil(parts - 1e-9)));
        for (int i = 0; i < count; ++i) {
          BoundaryElement e = whole;
          e.from = cuts[k] + share * i / count;
          e.to = cuts[k] + share * (i + 1) / count;
          lay(world, e);
          all_.push_back(e);
        }
      }
  }
  index(world);
}

void BoundaryElements::halve(const World& world, const std::vector<char>& marked) {
  std::vector<BoundaryElement> next;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (marked[i] == 0) {
      next.push_back(all_[i]);
      continue;
    }
    const double middle = 0.5 * (all_[i].from + all_[i].to);
    for (int half = 0; half < 2; ++half) {
      BoundaryElement e = all_[i];
      (half == 0 ? e.to : e.from) = middle;
      // A straight element keeps the same radiance.
      e.constant += e.slope * (half == 0 ? -0.5 : 0.5);
      e.slope = e.slope * 0.5;
      lay(world, e);
      next.push_back(e);
    }
  }
  all_ = std::move(next);
  index(world);
}

void BoundaryElements::index(const World& world) {
  first_.assign(2 * world.curves.size() + 1, 0);
  for (const BoundaryElement& e : all_) ++first_[2 * e.curve + (e.back ? 1 : 0) + 1];
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  spans_.clear();
  for (const BoundaryElement& e : all_) spans_.push_back({e.from, e.to, 1 / (e.to - e.from)});
}

}  // namespace steradian::plane
