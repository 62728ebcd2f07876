// Phong lobes times the cosine of the light: every method against quadrature.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "steradian/error.h"
#include "steradian/phong.h"
#include "support/random_configurations.h"

namespace steradian::foreshortened_test {
namespace {

Material foreshortened(double n) {
  Material m;
  m.brdf = Brdf::phong;
  m.exponent = n;
  m.foreshortening = true;
  return m;
}

struct Allowed {
  PhongOptions options;
  // exact: converged quadrature, to 1e-10. arvo: the fixed quadrature of the cosines, and its recurrence; docs/measured/accuracy.md has the
  // former at 1e-6. series: an edge's 2e-4 and 5.5e-5 of the full lobe (docs/theory/moments.md), and the cosines' 9e-5 of a half circle
  // over 2 pi an edge. Edges' errors partly cancel, and four of them count.
  double in_double, in_float;
};

}  // namespace

TEST(Foreshortened, EveryMethodAgreesWithQuadrature) {
  const Allowed all[] = {{{Method::exact}, 1e-10, 2e-5},
                         {{Method::arvo}, 2e-6, 2e-5},
                         {{Method::series}, 1.3e-3, 1.3e-3},
                         {{Method::series, Quality::high}, 4.5e-4, 4.5e-4}};
  for (const Allowed& allowed : all) {
    reference::Random random(71);
    double worst = 0, worst_float = 0;
    int lit = 0;
    for (int i = 0; i < 400; ++i) {
      const auto c = reference::random_configuration(random);
      if (c.kind == "near") continue;  // edges that nearly pass through the point have rounded directions
      double n = i % 7 == 0 ? 0.0 : std::pow(10.0, random.uniform(-1, 3));
      if (allowed.options.method == Method::arvo) n = std::floor(n);
      const PreparedPolygon light = prepare_polygon(c.light);
      const ReferenceResult truth = reference_radiance(light, c.at, foreshortened(n), {1e-9, 1e-12, 1'000'000});
      const double value = phong_radiance(light, c.at, foreshortened(n), allowed.options).x;
      const double value_float = static_cast<double>(phong_radiance_float(light, c.at, foreshortened(n), allowed.options).x);
      EXPECT_LE(std::fabs(value - truth.radiance.x), allowed.in_double + truth.bound)
          << name_of(allowed.options.method) << " n " << n << " " << c.kind << " " << truth.radiance.x;
      EXPECT_LE(std::fabs(value_float - truth.radiance.x), allowed.in_float + truth.bound)
          << name_of(allowed.options.method) << " in float, n " << n << " " << c.kind << " " << truth.radiance.x;
      worst = std::max(worst, std::fabs(value - truth.radiance.x));
      worst_float = std::max(worst_float, std::fabs(value_float - truth.radiance.x));
      lit += truth.radiance.x > 1e-6;
    }
    EXPECT_GT(lit, 100);
    std::printf("%s: at most %.1e, in float %.1e, of %d\n", name_of(allowed.options.method), worst, worst_float, lit);
  }
}

// From straight above, (n + 1)/(2 pi) times cos^(n + 1) over the hemisphere is (n + 1)/(n + 2).
TEST(Foreshortened, UnderASkyTheFactorIsThePhongLobes) {
  PolygonLight sky;
  sky.vertices = {{-1e4, -1e4, 1}, {-1e4, 1e4, 1}, {1e4, 1e4, 1}, {1e4, -1e4, 1}};
  const ShadingPoint at = {{}, {0, 0, 1}, {0, 0, 1}};
  for (const double n : {0.0, 1.0, 5.0, 200.0}) {
    const double whole = (n + 1) / (n + 2);
    EXPECT_NEAR(phong_radiance(prepare_polygon(sky), at, foreshortened(n), {Method::exact}).x, whole, 1e-7) << n;  // below its rim
  }
}

TEST(Foreshortened, PeakFitsHaveNone) {
  PolygonLight panel;
  panel.vertices = {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}};
  EXPECT_THROW(phong_radiance(prepare_polygon(panel), {{}, {0, 0, 1}, {0, 0, 1}}, foreshortened(5), {Method::pearson}), Error);
}

}  // namespace steradian::foreshortened_test
