#include "support/plane_families.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "plane/exact/random.h"
#include "plane/exact/world.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

constexpr double kSmall = 0.05, kLarge = 0.06;  // radius of a convex body

std::vector<Vec2d> convex(SceneRandom& random, Vec2d center, int vertices, double radius) {
  // Sorted random angles around the circle always give a convex polygon.
  std::vector<double> angles;
  for (int i = 0; i < vertices; ++i) angles.push_back(2 * pi * (i + 0.8 * random.uniform()) / vertices);
  std::vector<Vec2d> result;
  for (double a : angles) result.push_back(center + Vec2d{std::cos(a), std::sin(a)} * radius);
  return result;
}

std::vector<Vec2d> star(SceneRandom& random, Vec2d center, int vertices, double radius) {
  const double turn = random.uniform(0, 2 * pi);
  std::vector<Vec2d> result;
  for (int i = 0; i < vertices; ++i) {
    const double a = turn + 2 * pi * i / vertices, r = i % 2 == 0 ? radius : 0.85 * radius;
    result.push_back(center + Vec2d{std::cos(a), std::sin(a)} * r);
  }
  return result;
}

// A box by its centre, half sides and rotation.
std::vector<Vec2d> box(Vec2d center, double half_x, double half_y, double turn) {
  const Vec2d x = Vec2d{std::cos(turn), std::sin(turn)} * half_x, y = Vec2d{-std::sin(turn), std::cos(turn)} * half_y;
  return {center - x - y, center + x - y, center + x + y, center - x + y};
}

class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(seed) { scene_.width = scene_.height = 1; }

  // A centre whose disc of this radius keeps clear of all earlier ones.
  Vec2d free_place(double radius) {
    for (int attempt = 0;; ++attempt) {
      const Vec2d p{random_.uniform(radius, 1 - radius), random_.uniform(radius, 1 - radius)};
      bool clear = true;
      for (const auto& [center, r] : taken_) clear = clear && length(p - center) > (r + radius) * 1.001;
      if (clear || attempt > 2000) {
        taken_.push_back({p, radius});
        return p;
      }
    }
  }
  void take(Vec2d p, double radius) { taken_.push_back({p, radius}); }
  Vec2d any_place() { return {random_.uniform(0.1, 0.9), random_.uniform(0.1, 0.9)}; }

  void occluder(std::vector<Vec2d> vertices) { scene_.bodies.push_back(plane_polygon(std::move(vertices))); }
  void light(std::vector<Vec2d> vertices) {
    scene_.bodies.push_back(plane_polygon(std::move(vertices)));
    scene_.bodies.back().light.emplace();
  }
  void hexagons(int count) {
    for (int i = 0; i < count; ++i) {
      const double r = random_.uniform(kSmall, kLarge);
      occluder(convex(random_, free_place(r), 6, r));
    }
  }
  SceneRandom& random() { return random_; }
  PlaneScene finish() { return std::move(scene_); }

 private:
  SceneRandom random_;
  PlaneScene scene_;
  std::vector<std::pair<Vec2d, double>> taken_;
};

void light_hexagon(Maker& m) {
  const double r = m.random().uniform(kSmall, kLarge);
  m.light(convex(m.random(), m.free_place(r), 6, r));
}

void interpenetrating(Maker& m) {
  m.light(convex(m.random(), m.any_place(), 6, m.random().uniform(kSmall, kLarge)));
  for (int i = 0; i < 12; ++i) m.occluder(convex(m.random(), m.any_place(), 6, m.random().uniform(kSmall, kLarge)));
}

void thin(Maker& m) {
  light_hexagon(m);
  for (int i = 0; i < 12; ++i) {
    const double r = m.random().uniform(kSmall, kLarge);
    m.occluder(box(m.free_place(r), r * 0.999, r / 40, m.random().uniform(0, pi)));
  }
}

void half_embedded(Maker& m) {
  const Vec2d center{m.random().uniform(0.3, 0.7), m.random().uniform(0.3, 0.7)};
  const double turn = m.random().uniform(0, 2 * pi);
  const Vec2d along{std::cos(turn), std::sin(turn)}, up{-along.y, along.x};
  m.take(center, 0.28);
  m.light(convex(m.random(), center + up * 0.04 + along * m.random().uniform(-0.15, 0.15), 8, 0.04));
  m.occluder(box(center, 0.25, 0.04, turn));
  m.hexagons(8);
}

void inside_a_box(Maker& m) {
  const Vec2d center = m.free_place(0.15);
  m.light(convex(m.random(), center, 6, m.random().uniform(kSmall, kLarge)));
  m.occluder(box(center, 0.1, 0.09, m.random().uniform(0, pi)));
  m.hexagons(8);
}

void stars(Maker& m) {
  light_hexagon(m);
  for (int i = 0; i < 12; ++i) {
    const double r = m.random().uniform(kSmall, kLarge);
    m.occluder(star(m.random(), m.free_place(r), 18, r));
  }
}

void niche(Maker& m) {
  const Vec2d center = m.free_place(0.17);
  const double turn = m.random().uniform(0, 2 * pi);
  const Vec2d x{std::cos(turn), std::sin(turn)}, y{-x.y, x.x};
  const auto at = [&](double u, double v) { return center + x * u + y * v; };
  m.light(convex(m.random(), at(0, -0.02), 6, 0.05));
  m.occluder(
      {at(-0.12, -0.12), at(0.12, -0.12), at(0.12, 0.1), at(0.08, 0.1), at(0.08, -0.08), at(-0.08, -0.08), at(-0.08, 0.1), at(-0.12, 0.1)});
  m.hexagons(8);
}

void flush(Maker& m) {
  const Vec2d center{m.random().uniform(0.3, 0.7), m.random().uniform(0.3, 0.7)};
  const double turn = m.random().uniform(0, 2 * pi);
  const Vec2d x{std::cos(turn), std::sin(turn)}, y{-x.y, x.x};
  const auto at = [&](double u, double v) { return center + x * u + y * v; };
  m.take(center, 0.28);
  // The lamp's lower edge is a part of the wall's upper one, with vertices of the wall at its ends.
  const double middle = m.random().uniform(-0.15, 0.15);
  const Vec2d p = at(middle - 0.05, 0.04), q = at(middle + 0.05, 0.04);
  m.light({p, q, at(middle + 0.05, 0.09), at(middle - 0.05, 0.09)});
  m.occluder({at(-0.25, -0.04), at(0.25, -0.04), at(0.25, 0.04), q, p, at(-0.25, 0.04)});
  m.hexagons(8);
}

}  // namespace

const char* plane_family_name(int family) {
  static constexpr const char* kNames[kPlaneFamilies] = {"disjoint convex, 1 light, 12 occluders",
                                                         "disjoint thin (40:1) occluders, 1 light, 12",
                                                         "light and occluders interpenetrate freely",
                                                         "lamp half embedded in a wall, 8 more occluders",
                                                         "light wholly inside an occluder (true value 0)",
                                                         "concave star occluders, disjoint",
                                                         "light in a U-shaped niche",
                                                         "8 lights and 12 occluders that block each other",
                                                         "lamp flush on a wall (shared edge), 8 more occluders",
                                                         "concave star light, 10 occluders"};
  return kNames[family - 1];
}

PlaneScene make_plane_family(int family, std::uint64_t seed) {
  Maker m(seed * 1000003 + static_cast<std::uint64_t>(family));
  switch (family) {
    case 1:
      light_hexagon(m);
      m.hexagons(12);
      break;
    case 2: thin(m); break;
    case 3: interpenetrating(m); break;
    case 4: half_embedded(m); break;
    case 5: inside_a_box(m); break;
    case 6: stars(m); break;
    case 7: niche(m); break;
    case 8:
      for (int i = 0; i < 8; ++i) light_hexagon(m);
      m.hexagons(12);
      break;
    case 9: flush(m); break;
    default: {
      const double r = m.random().uniform(kSmall, kLarge);
      m.light(star(m.random(), m.free_place(r), 18, r));
      m.hexagons(10);
    }
  }
  return m.finish();
}

std::vector<Vec2d> points_outside(const PlaneWorld& world, int count, std::uint64_t seed) {
  SceneRandom random(seed);
  std::vector<Vec2d> result;
  for (int i = 0; i < count; ++i) {
    const Vec2d p{random.uniform(), random.uniform()};
    if (world.impl().inside(p * world.impl().scale).body < 0) result.push_back(p);
  }
  return result;
}

FamilyError measure_family(int family, PlaneMethod method, int scenes, int points_per_scene, const PlaneSampling& sampling) {
  FamilyError result;
  double error = 0, total = 0, wrong = 0;
  int off = 0;
  for (int s = 0; s < scenes; ++s) {
    const PlaneWorld world(make_plane_family(family, static_cast<std::uint64_t>(s)));
    for (Vec2d p : points_outside(world, points_per_scene, static_cast<std::uint64_t>(s) + 77)) {
      const double truth = world.query(p).radiance.x, value = world.query(p, method, sampling).radiance.x;
      error += std::fabs(value - truth);
      total += truth;
      wrong += value;
      if (std::fabs(value - truth) > 0.01 * truth + 1e-9) ++off;
      ++result.points;
    }
  }
  const double base = total > 0 ? total : wrong;
  result.mean_percent = base > 0 ? 100 * error / base : 0;
  result.off_percent = 100.0 * off / std::max(result.points, 1);
  return result;
}

std::string plane_error_table(int scenes, int points_per_scene) {
  std::string text =
      "| # | family | `par`: mean error, % | `par`: points > 1 % off | `sampled`, 64 rays: mean error, % |\n|---|---|---|---|---|\n";
  for (int family = 1; family <= kPlaneFamilies; ++family) {
    const FamilyError par = measure_family(family, PlaneMethod::par, scenes, points_per_scene);
    const FamilyError rays = measure_family(family, PlaneMethod::sampled, scenes, points_per_scene);
    char line[256];
    std::snprintf(line, sizeof line, "| %d | %s | %.3g | %.3g %% | %.3g |\n", family, plane_family_name(family), par.mean_percent,
                  par.off_percent, rays.mean_percent);
    text += line;
  }
  return text;
}

}  // namespace steradian::plane
