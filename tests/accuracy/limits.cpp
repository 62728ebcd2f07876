// "Lights at the limits": every method and lobe for lights that fill the hemisphere, touch the surface, are edge-on, or are round and near.
#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <vector>

#include "sections.h"
#include "steradian/radiance.h"
#include "support/random_configurations.h"

namespace steradian::accuracy {
namespace {

using reference::Random;
using reference::random_direction;

Vec3d upwards(Vec3d v) { return {v.x, v.y, std::fabs(v.z)}; }

AreaLight rectangle(Vec3d center, Vec3d x, Vec3d y) {
  AreaLight light;
  light.shape = Polygon{{center - x - y, center + x - y, center + x + y, center - x + y}, {}};
  light.two_sided = true;
  return light;
}
AreaLight shaped(const Shape& shape) {
  AreaLight light;
  light.shape = shape;
  light.two_sided = true;
  return light;
}

// Kinds of lights, viewed from the origin on a surface of normal z. `mirror` is the lobe's direction.
struct Kind {
  const char* name;
  AreaLight (*light)(Random&, Vec3d mirror);
};

// A direction about a tenth of a radian off the mirror direction.
Vec3d near(Random& random, Vec3d mirror) { return normalized(upwards(mirror + random_direction(random) * 0.1)); }

constexpr Kind kKinds[] = {
    {"fills the hemisphere",
     [](Random& random, Vec3d) {
       const double size = std::pow(10.0, random.uniform(1, 4));
       return rectangle({random.uniform(-0.8, 0.8) * size, random.uniform(-0.8, 0.8) * size, 1}, {0, size, 0}, {size, 0, 0});
     }},
    {"wall beside the point",
     [](Random& random, Vec3d) {
       const double turn = random.uniform(-M_PI, M_PI), gap = std::pow(10.0, random.uniform(-4, -0.5));
       const Vec3d normal{std::cos(turn), std::sin(turn), 0}, along{-normal.y, normal.x, 0};
       return rectangle(normal * -gap + along * random.uniform(-0.7, 0.7) + Vec3d{0, 0, random.uniform(-0.8, 0.8)}, along, {0, 0, 1});
     }},
    {"edge-on, to 1e-6",
     [](Random& random, Vec3d mirror) {
       const Vec3d to = near(random, mirror), across = normalized(cross(to, random_direction(random)));
       const Frame plane = Frame::from_normal(normalized(across - to * std::pow(10.0, random.uniform(-6, -1))));
       return rectangle(to, plane.x * 0.6, plane.y * 0.6);
     }},
    {"needle, to 1e-5",
     [](Random& random, Vec3d mirror) {
       const Vec3d to = near(random, mirror);
       const Frame plane = Frame::from_normal(normalized(random_direction(random) * 0.5 - to));
       return rectangle(to, plane.x * random.uniform(0.2, 2), plane.y * std::pow(10.0, random.uniform(-5, -2)));
     }},
    {"disk beside its rim",
     [](Random& random, Vec3d) {
       const Frame disk = Frame::from_normal(random_direction(random));
       const double gap = std::pow(10.0, random.uniform(-3, -0.3)), side = random.uniform() < 0.5 ? -1 : 1;
       return shaped(Ellipse{disk.x * -(1 + side * gap) - disk.z * (gap * random.uniform(0.03, 3)), disk.x, disk.y});
     }},
    {"disk, tilted, large",
     [](Random& random, Vec3d mirror) {
       const Vec3d to = near(random, mirror), across = normalized(cross(to, random_direction(random)));
       const Frame disk = Frame::from_normal(normalized(across - to * std::pow(10.0, random.uniform(-1.5, 0))));
       const double radius = std::pow(10.0, random.uniform(-0.7, 0.5));
       return shaped(Ellipse{to, disk.x * radius, disk.y * radius});
     }},
    {"ball on the surface",
     [](Random& random, Vec3d) {
       const double turn = random.uniform(-M_PI, M_PI), away = std::pow(10.0, random.uniform(-1.5, 0.3));
       return shaped(Ellipsoid{
           {away * std::cos(turn), away * std::sin(turn), 1 - random.uniform(0, 0.5)}, {0.999, 0, 0}, {0, 0.999, 0}, {0, 0, 0.999}});
     }},
    {"ellipsoid, to 1e-3",
     [](Random& random, Vec3d mirror) {
       const Frame f = Frame::from_normal(random_direction(random));
       const Vec3d to = near(random, mirror), x = f.x * random.uniform(0.1, 1), y = f.y * random.uniform(0.1, 1),
                   z = f.z * random.uniform(0.1, 1);
       const double reach = std::hypot(dot(x, to), dot(y, to), dot(z, to));
       return shaped(Ellipsoid{to * (reach * (1 + std::pow(10.0, random.uniform(-3, 0)))), x, y, z});
     }},
    {"tube, to 1e-3",
     [](Random& random, Vec3d mirror) {
       const Vec3d to = near(random, mirror), axis = normalized(cross(to, random_direction(random)));
       const double radius = std::pow(10.0, random.uniform(-2, -0.5));
       const Vec3d middle = to * (radius + std::pow(10.0, random.uniform(-3, 0))) + axis * random.uniform(-0.5, 0.5);
       return shaped(Capsule{middle - axis * random.uniform(0.1, 1), middle + axis * random.uniform(0.1, 1), radius});
     }},
};

struct Row {
  const char* name;
  Method method;
  Brdf brdf;
  bool shadowing;
  double f0;
};
constexpr Row kRows[] = {
    {"phong by `series`", Method::series, Brdf::phong, false, 1},
    {"ggx by `closed-form`", Method::closed_form, Brdf::ggx, true, 1},
    {"ggx, F0 0.04, by `closed-form`", Method::closed_form, Brdf::ggx, true, 0.04},
    {"ggx by `half-vector`", Method::half_vector, Brdf::ggx, true, 1},
    {"ggx, F0 0.04, by `half-vector`", Method::half_vector, Brdf::ggx, true, 0.04},
    {"ggx by `half-vector`, no shadowing", Method::half_vector, Brdf::ggx, false, 1},
    {"blinn-phong by `half-vector`", Method::half_vector, Brdf::blinn_phong, false, 1},
    {"beckmann by `half-vector`", Method::half_vector, Brdf::beckmann, false, 1},
    {"ggx by `ltc`", Method::ltc, Brdf::ggx, true, 1},
    {"ggx, F0 0.04, by `ltc`", Method::ltc, Brdf::ggx, true, 0.04},
    {"ggx by `ltc-compact`", Method::ltc_compact, Brdf::ggx, true, 1},
    {"charlie by `cubature`", Method::cubature, Brdf::charlie, true, 1},
};

// A random lobe of width 0.01 to 1, or of the matching exponent, with views up to 80 degrees.
Material random_lobe(Random& random, const Row& row) {
  Material m;
  m.brdf = row.brdf;
  m.alpha_x = m.alpha_y = std::pow(10.0, random.uniform(-2, 0));
  m.exponent = std::max(2 / (m.alpha_x * m.alpha_x) - 2, 0.1) / (row.brdf == Brdf::phong ? 4 : 1);
  m.shadowing = row.shadowing;
  m.f0 = {row.f0, row.f0, row.f0};
  if (row.brdf == Brdf::charlie) m.alpha_x = m.alpha_y = random.uniform(0.1, 1);
  return m;
}

}  // namespace

void write_limits(std::ostream& out) {
  constexpr int kCases = 24;
  out << "\n## Lights at the limits\n\nRelative RMSE / largest error in units of the full lobe (of the radiance, where that is above 1), "
         "over "
      << kCases
      << " lights of each kind, lobes of widths 0.01 to 1 (exponents to match), views 0 to 80 degrees; against `reference`, errors within "
         "its bound "
         "left out. In double; tests `LargeLight` and `SmallLight` hold float to the same.\n\n| lobe and method |";
  for (const Kind& kind : kKinds) out << " " << kind.name << " |";
  out << "\n|---|";
  for (std::size_t i = 0; i < std::size(kKinds); ++i) out << "---:|";
  out << "\n";
  for (const Row& row : kRows) {
    out << fmt::format("| {} |", row.name);
    for (const Kind& kind : kKinds) {
      Random random(41);
      double error = 0, signal = 0, largest = 0;
      for (int i = 0; i < kCases; ++i) {
        const double view = random.uniform(0, 80) * M_PI / 180, turn = random.uniform(-M_PI, M_PI);
        const ShadingPoint at = {{}, {0, 0, 1}, {std::sin(view) * std::cos(turn), std::sin(view) * std::sin(turn), std::cos(view)}};
        const AreaLight light = kind.light(random, {-at.view.x, -at.view.y, at.view.z});
        const Material m = random_lobe(random, row);
        const RadianceResult truth = radiance(light, at, m, {.method = Method::reference});
        const double d =
            std::max(std::fabs(radiance(light, at, m, {.method = row.method}).radiance.x - truth.radiance.x) - *truth.bound, 0.0);
        error += d * d;
        signal += truth.radiance.x * truth.radiance.x;
        largest = std::max(largest, d / std::max(truth.radiance.x, 1.0));
      }
      out << fmt::format(" {:.4f} / {:.4f} |", std::sqrt(error / signal), largest);
    }
    out << "\n";
  }
}

}  // namespace steradian::accuracy
