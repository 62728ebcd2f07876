// Large lights: every method at sizes up to a billion times the distance, in double and in float, against quadrature.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "integrals/methods.h"
#include "night.h"
#include "steradian/reference.h"
#include "support/random_configurations.h"

namespace steradian::large_light_test {
namespace {

using reference::Random;

Material material(Brdf brdf, double width) {
  Material m;
  m.brdf = brdf;
  m.exponent = width;
  m.alpha_x = m.alpha_y = width;
  return m;
}

// Largest error of a method, as a fraction of the full lobe. It is the largest error of docs/measured/accuracy.md for lights of ordinary
// size, plus a rounding. That is the rounding of vertices that lie `size` times as far away as the visible part of the light.
double stated(Method method, const Material& m, Precision precision, double size) {
  const double rounding = precision == Precision::float_ ? 2e-5 : 1e-10 + 1e-15 * size;
  switch (method) {
    case Method::exact:
    case Method::arvo: return rounding;
    case Method::series: return 1.3e-3;
    case Method::half_vector: return m.brdf == Brdf::ggx && m.shadowing ? 0.015 : 2e-3;
    case Method::closed_form: return 0.015;
    case Method::cubature: return 0.01;
    default: return 0.05;  // the tables, and the published fits
  }
}

// A square at distance 1 in a plane of any tilt. The point faces its middle, a place beside an edge, or one beside a corner, inside or
// outside.
PreparedPolygon large_light(Random& random, double size, bool standing) {
  const auto turn = random.uniform(-3.14, 3.14);
  const Vec3d normal = normalized(standing ? Vec3d{std::cos(turn), std::sin(turn), random.uniform(-0.2, 0.2)}
                                           : Vec3d{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), -1});
  const Frame frame = Frame::from_normal(normal);
  const auto aside = [&] {
    const double places[] = {0, random.uniform(-0.9, 0.9) * size, size - random.uniform(-3, 3), random.uniform(-3, 3) - size};
    return places[static_cast<std::size_t>(random.uniform(0, 3.999))];
  };
  const Vec3d center = -normal + frame.x * aside() + frame.y * aside(), x = frame.x * size, y = frame.y * size;
  PolygonLight light;
  light.vertices = {center - x - y, center + x - y, center + x + y, center - x + y};
  light.two_sided = true;
  return prepare_polygon(light);
}

}  // namespace

TEST(LargeLight, EveryMethodAtEverySize) {
  Random random(29);
  std::map<std::string, double> worst;
  Material unshadowed = material(Brdf::ggx, 0.3);
  unshadowed.shadowing = false;
  const Material materials[] = {material(Brdf::lambert, 1),      material(Brdf::phong, 20),     material(Brdf::ggx, 0.3),
                                material(Brdf::blinn_phong, 50), material(Brdf::beckmann, 0.3), unshadowed,
                                material(Brdf::charlie, 0.5)};
  for (const double size : {1e1, 1e2, 1e3, 1e4, 1e6, 1e7, 1e8, 1e9})
    for (int i = 0; i < test::by_day_or_night(4, 12); ++i) {
      const PreparedPolygon light = large_light(random, size, i % 2 == 0);
      const double view = random.uniform(0, 1.4), turn = random.uniform(-3.14, 3.14);
      const ShadingPoint at = {{}, {0, 0, 1}, {std::sin(view) * std::cos(turn), std::sin(view) * std::sin(turn), std::cos(view)}};
      for (const Material& m : materials) {
        const ReferenceResult truth = reference_radiance(light, at, m);
        for (const methods::Row& entry : methods::all()) {
          if (!entry.serves(m) || entry.method == Method::sampled || entry.method == Method::reference) continue;
          if (entry.method == Method::ltc_clipless || entry.method == Method::representative_point) continue;  // inaccurate here
          for (const Precision precision : {Precision::double_, Precision::float_}) {
            RadianceOptions options;
            options.precision = precision;
            const double error = std::fabs(entry.polygon(light, at, m, options).radiance.x - truth.radiance.x);
            EXPECT_LE(error, stated(entry.method, m, precision, size) * std::max(1.0, truth.radiance.x) + truth.bound)
                << entry.name << " " << name_of(m.brdf) << " size " << size << " i " << i << " truth " << truth.radiance.x
                << (precision == Precision::float_ ? " float" : " double");
            double& w = worst[std::string(entry.name) + " " + name_of(m.brdf) + (precision == Precision::float_ ? " float" : "")];
            w = std::max(w, error);
          }
        }
      }
    }
  for (const auto& [name, error] : worst) std::printf("%-32s largest error %.1e\n", name.c_str(), error);
}

}  // namespace steradian::large_light_test
