// The surface of a light as half planes through one axis cut it: the intervals of angle in which it is lit, or hidden by a segment.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "steradian/area_light.h"

namespace steradian::reference {

// A half plane that begins at an axis through the point. Its directions are axis cos(theta) + across sin(theta), theta in [0, pi].
struct HalfPlane {
  Vec3d axis, across, normal;

  HalfPlane(const Frame& about, double azimuth)
      : axis(about.z), across(about.x * std::cos(azimuth) + about.y * std::sin(azimuth)), normal(cross(axis, across)) {}
  Vec3d direction(double theta) const { return axis * std::cos(theta) + across * std::sin(theta); }
};

// weight: 0 outside of the light. A contour that runs around a direction twice counts twice.
struct Angles {
  double begin, end, weight = 1;
};

// A segment in the plane of a half plane; x along the axis, y across it.
struct Section {
  struct Place {
    double x, y;
    double angle() const { return std::atan2(y, x); }
  };
  Place a, b;

  Place at(double t) const { return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t}; }
  Section part(double from, double to) const { return {at(from), at(to)}; }

  // Angles of the part on the half plane's side of the axis. None for a segment on the other side, and for one towards the point.
  std::optional<Angles> angles() const {
    if (a.y < 0 && b.y < 0) return {};
    const Place on_axis{at(a.y / (a.y - b.y)).x, 0};
    const double u = (a.y < 0 ? on_axis : a).angle(), v = (b.y < 0 ? on_axis : b).angle();
    if (u == v) return {};
    return Angles{std::min(u, v), std::max(u, v)};
  }
};

Section::Place place_in(const HalfPlane& h, Vec3d v);

// The place where an edge crosses the half plane's plane; none if both ends are on one side. turns: +1 from the back to the front.
struct HalfPlaneCrossing {
  Section::Place place;
  int turns;
};
std::optional<HalfPlaneCrossing> crossing(const HalfPlane& h, Vec3d p, Vec3d q);

// A light's surface, relative to the point.
class LitSurface {
 public:
  virtual ~LitSurface() = default;
  virtual bool shines() const = 0;  // towards the point
  virtual void add_angles(const HalfPlane& h, std::vector<Angles>& to) const = 0;
  // The angles of a segment that lie between the point and the surface.
  virtual void add_in_front(const HalfPlane& h, const Section& s, const std::vector<Angles>& lit, std::vector<Angles>& to) const = 0;
  // The light's direction that is nearest to another one. The outline of a body is smooth from there.
  virtual Vec3d nearest(Vec3d to) const = 0;
  // Corners at which the outline has kinks.
  virtual void add_corners(std::vector<Vec3d>&) const {}
  // Points whose convex hull contains the light.
  virtual void add_hull(std::vector<Vec3d>& to) const = 0;
};

// The surface of a light; null if it has none.
std::unique_ptr<LitSurface> surface_of(const AreaLight& light, Vec3d from);

}  // namespace steradian::reference
