#include "render/many/far_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace steradian::lights {
namespace {

// A point light is a ball so small that its fraction of the sky does not count.
constexpr float kPointArea = 1e-8f;

// Returns true for points that emit the same everywhere.
bool is_plain_point(const PackLight& light) {
  const auto* p = std::get_if<packed::Punctual>(&light.shape);
  return p != nullptr && p->kind == PunctualKind::point && p->inverse_range2 == 0 && p->profile == nullptr;
}

struct One {
  Vec3f center, normal, reach_a, reach_b;
  float area = 0, radius = 0, spread = 0, deviation2 = 0, third = 0, fourth = 0, outline = 0;
  bool symmetric = false, two_sided = false, is_flat = false;
};

// Bounds the shape by a ball, about the middle of the points whose hull contains it.
void bound(const auto& shape, One& one) {
  Vec3f sum{};
  float count = 0;
  shape.any_bound([&](Vec3f p, float) {
    sum = sum + p;
    count += 1;
    return false;
  });
  if (count > 0) one.center = sum / count;
  shape.any_bound([&](Vec3f p, float r) {
    one.radius = std::max(one.radius, length(p - one.center) + r);
    return false;
  });
}

float power4(Vec3f v) { return dot(v, v) * dot(v, v); }

// Mean powers of distances follow from the mean square, for points no further than the radius. fourth: mean fourth power of a light that
// is its own mirror image about its centre.
void take_flat(Vec3f center, Vec3f normal, Vec3f reach_a, Vec3f reach_b, float area, float radius, std::optional<float> fourth, One& one) {
  const float a2 = dot(reach_a, reach_a), b2 = dot(reach_b, reach_b);
  if (!(area > 0) || !std::isfinite(a2 + b2)) return;
  one.center = center;
  one.normal = normal;
  one.reach_a = reach_a;
  one.reach_b = reach_b;
  one.area = area;
  one.radius = radius;
  one.spread = std::max(radius, std::sqrt(std::max(a2, b2)));
  one.deviation2 = (a2 + b2) / 2;
  one.third = one.deviation2 * radius + (a2 * std::sqrt(a2) + b2 * std::sqrt(b2)) / 2;
  one.fourth = fourth.value_or(0) + (power4(reach_a) + power4(reach_b)) / 2;
  one.symmetric = fourth.has_value();
  one.is_flat = true;
}

// Mean fourth power of the length of x s + y t, from the means of s^4 and s^2 t^2.
float mean_fourth(Vec3f x, Vec3f y, float s4, float s2t2) {
  const float xx = dot(x, x), yy = dot(y, y), xy = dot(x, y);
  return (xx * xx + yy * yy) * s4 + (2 * xx * yy + 4 * xy * xy) * s2t2;
}

std::optional<float> fourth_of_parallelogram(const packed::FloatPolygon& p) {
  if (p.vertices.size() != 4 || p.contours.size() != 2) return std::nullopt;
  const Vec3f off = p.vertices[0] + p.vertices[2] - p.vertices[1] - p.vertices[3];
  if (dot(off, off) > 1e-8f * p.deviation2) return std::nullopt;
  return mean_fourth((p.vertices[1] - p.vertices[0]) / 2, (p.vertices[3] - p.vertices[0]) / 2, 1.0f / 5, 1.0f / 9);
}

// Convex outlines inside a ball are at most as long as its great circle.
float of_round(const One& one) { return 2 * std::numbers::pi_v<float> * one.radius; }

struct Prepare {
  One& one;

  void operator()(const packed::FloatPolygon& p) const {
    bound(p, one);
    one.two_sided = p.two_sided;
    float radius = 0;
    for (const Vec3f& v : p.vertices) radius = std::max(radius, length(v - p.middle));
    for (std::size_t c = 0; c + 1 < p.contours.size(); ++c)
      for (std::size_t i = p.contours[c]; i < p.contours[c + 1]; ++i)
        one.outline += length(p.vertices[i + 1 < p.contours[c + 1] ? i + 1 : p.contours[c]] - p.vertices[i]);
    take_flat(p.middle, p.normal, p.reach_a, p.reach_b, length(p.area), radius, fourth_of_parallelogram(p), one);
  }
  void operator()(const packed::FloatDisk& d) const {
    bound(d, one);
    one.two_sided = d.two_sided;
    one.outline = of_round(one);
    const float to_reach = std::numbers::sqrt2_v<float> / 2;
    // x and y are conjugate half axes: no point of the ellipse lies further out than the root of the sum of their squares.
    take_flat(d.point, d.normal, d.x * to_reach, d.y * to_reach, std::numbers::pi_v<float> * length(cross(d.x, d.y)),
              std::sqrt(dot(d.x, d.x) + dot(d.y, d.y)), mean_fourth(d.x, d.y, 1.0f / 8, 1.0f / 24), one);
  }
  void operator()(const packed::FloatEllipsoid& e) const {
    bound(e, one);
    one.outline = of_round(one);
    if (!(e.ball.radius > 0)) return;
    one.center = e.center;
    one.radius = e.ball.radius;
    one.area = std::numbers::pi_v<float> * e.ball.radius * e.ball.radius;
  }
  void operator()(const packed::FloatCapsule& c) const {
    bound(c, one);
    one.outline = of_round(one);
  }
  void operator()(const packed::Punctual& p) const {
    one.center = static_cast<Vec3f>(p.position);
    one.area = kPointArea;
  }
  void operator()(const packed::Pieces&) const {}
};

}  // namespace

FarLights prepare_far_lights(const std::vector<PackLight>& lights) {
  FarLights far;
  const auto add = [](Planes& planes, Vec3f v) {
    planes.x.push_back(v.x);
    planes.y.push_back(v.y);
    planes.z.push_back(v.z);
  };
  const auto push = [&](const One& one, Vec3f radiance) {
    add(far.center, one.center);
    add(far.normal, one.normal);
    add(far.reach_a, one.reach_a);
    add(far.reach_b, one.reach_b);
    add(far.radiance, radiance);
    const Vec3f area = one.is_flat ? one.normal * one.area : Vec3f{one.area, 0, 0};
    far.elements.push_back({one.center, area, radiance});
    far.fours.push_back({one.center, one.reach_a, one.reach_b, area * 0.25f, radiance});
    far.area.push_back(one.area);
    // The margin covers single-precision rounding in comparisons.
    far.radius.push_back(one.radius * (1 + 1e-6f));
    far.spread.push_back(one.spread * (1 + 1e-6f));
    far.deviation2.push_back(one.deviation2);
    far.third.push_back(one.third);
    far.fourth.push_back(one.fourth);
    far.symmetric.push_back(one.symmetric ? 1.0f : 0.0f);
    far.two_sided.push_back(one.two_sided ? 1.0f : 0.0f);
    far.is_flat.push_back(one.is_flat ? 1.0f : 0.0f);
    far.outline.push_back(one.outline);
  };
  for (const PackLight& light : lights) {
    if (!(light.is_area() || is_plain_point(light)) || light.is_pieces() || !light.is_even()) {
      far.number_of.push_back(-1);
      continue;
    }
    One one;
    std::visit(Prepare{one}, light.shape);
    push(one, light.is_area() ? light.radiance : light.radiance / kPointArea);
    far.number_of.push_back(static_cast<std::int32_t>(far.lights.size()));
    far.lights.push_back(&light);
  }
  far.count = far.lights.size();
  while (far.area.size() % 16 != 0) push({}, {});
  return far;
}

}  // namespace steradian::lights
