#include "solve/quarter_turns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "solve/moved_shape.h"

namespace steradian::solving {
namespace {

constexpr double kSquare = 1e-5;  // cosine between the sides of a rectangle, at most
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

// The unknowns of a rectangle that a quarter turn changes.
struct TurningRectangle {
  std::array<std::size_t, 3> rotation{kNone, kNone, kNone};
  std::array<std::size_t, 2> size{kNone, kNone};
  Vec3d normal{};    // at the start
  double ratio = 0;  // logarithm of height over width, at the start
};

std::optional<TurningRectangle> rectangle_of(const FittedLights& lights, std::size_t number, const FittedLight& start) {
  if (start.is_punctual || start.area.texture || start.area.emission) return {};
  const auto* polygon = std::get_if<Polygon>(&start.area.shape);
  if (polygon == nullptr) return {};
  const std::optional<Ellipse> axes = half_axes_of(*polygon);
  if (!axes) return {};
  const double width = length(axes->x), height = length(axes->y);
  if (!(std::fabs(dot(axes->x, axes->y)) <= kSquare * width * height)) return {};
  TurningRectangle r;
  r.normal = normalized(cross(axes->x, axes->y));
  r.ratio = std::log(height / width);
  for (std::size_t u = 0; u < lights.unknowns().size(); ++u) {
    const Unknown& unknown = lights.unknowns()[u];
    if (!lights.drives(u, number)) continue;
    if (unknown.fit != number || unknown.keep > 0) return {};
    for (std::size_t i = 0; i < lights.light_count(); ++i)
      if (i != number && lights.drives(u, i)) return {};
    switch (unknown.kind) {
      case UnknownKind::rotation_x: r.rotation[0] = u; break;
      case UnknownKind::rotation_y: r.rotation[1] = u; break;
      case UnknownKind::rotation_z: r.rotation[2] = u; break;
      case UnknownKind::size_1: r.size[0] = u; break;
      case UnknownKind::size_2: r.size[1] = u; break;
      default: break;
    }
  }
  const auto is_there = [](std::size_t u) { return u != kNone; };
  if (!std::all_of(r.rotation.begin(), r.rotation.end(), is_there) || !std::all_of(r.size.begin(), r.size.end(), is_there)) return {};
  return r;
}

// The rotation vector of a turn about `normal` by an angle, followed by the rotation of `first`. By the product of their quaternions.
Vec3d turned_before(Vec3d first, Vec3d normal, double angle) {
  const double whole = length(first), sine = std::sin(angle / 2);
  const Vec3d a = whole > 0 ? first * (std::sin(whole / 2) / whole) : Vec3d{}, b = normal * sine;
  const double wa = std::cos(whole / 2), wb = std::cos(angle / 2);
  Vec3d v = b * wa + a * wb + cross(a, b);
  double w = wa * wb - dot(a, b);
  if (w < 0) v = v * -1.0, w = -w;
  const double size = length(v);
  return size > 0 ? v * (2 * std::atan2(size, w) / size) : v;
}

}  // namespace

std::vector<double> with_quarter_turns(const FittedLights& lights, std::vector<double> x) {
  const std::vector<Unknown>& unknowns = lights.unknowns();
  const std::vector<FittedLight> start = lights.at(lights.start());
  for (std::size_t number = 0; number < start.size(); ++number) {
    const std::optional<TurningRectangle> r = rectangle_of(lights, number, start[number]);
    if (!r) continue;
    const auto inside = [&](std::size_t u, double value) { return value > unknowns[u].low && value < unknowns[u].high; };
    if (std::all_of(r->rotation.begin(), r->rotation.end(), [&](std::size_t u) { return inside(u, x[u]); })) continue;
    for (const double side : {1.0, -1.0}) {
      const Vec3d v = turned_before({x[r->rotation[0]], x[r->rotation[1]], x[r->rotation[2]]}, r->normal, side * std::numbers::pi / 2);
      std::vector<double> there = x;
      there[r->rotation[0]] = v.x;
      there[r->rotation[1]] = v.y;
      there[r->rotation[2]] = v.z;
      there[r->size[0]] = x[r->size[1]] + r->ratio;
      there[r->size[1]] = x[r->size[0]] - r->ratio;
      const bool turns_on = std::all_of(r->rotation.begin(), r->rotation.end(), [&](std::size_t u) { return inside(u, there[u]); });
      const bool fits = std::all_of(r->size.begin(), r->size.end(),
                                    [&](std::size_t u) { return there[u] >= unknowns[u].low && there[u] <= unknowns[u].high; });
      if (!turns_on || !fits) continue;
      x = there;
      break;
    }
  }
  return x;
}

}  // namespace steradian::solving
