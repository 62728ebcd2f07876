// Lights that shine by a profile, against sums over their area of points with that profile, which define the emission.
#include "integrals/textured/profiled_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "core/random.h"
#include "integrals/point_light.h"
#include "steradian/error.h"
#include "steradian/radiance.h"

namespace steradian::profiled_light_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

using Candela = std::function<double(double vertical, double horizontal)>;

std::shared_ptr<const LightProfile> profile_of(const Candela& candela, double last = 90, double step = 2.5) {
  LightProfile p;
  for (double v = 0; v <= last + 1e-9; v += step) p.vertical.push_back(v);
  for (double h = 0; h <= 360; h += 15) p.horizontal.push_back(h);
  for (const double h : p.horizontal)
    for (const double v : p.vertical) p.candela.push_back(candela(v, h));
  return std::make_shared<const LightProfile>(p);
}

double lambert(double v, double) { return std::max(100 * std::cos(v * kDegree), 0.0); }
// A profile that is bright to the sides, like street lamps, and more along one plane.
double batwing(double v, double h) {
  return std::cos(v * kDegree) * (40 + 200 * std::exp(-(v - 55) * (v - 55) / 300) * (1 + 0.6 * std::cos(2 * h * kDegree)));
}
double narrow(double v, double) { return std::cos(v * kDegree) * 1000 * std::exp(-v * v / 200); }  // half of the peak at 12 degrees
double up_and_down(double v, double) {
  return 30 + 70 * std::pow(std::cos(v * kDegree), 2) * (v > 90 ? 0.5 : 1) - 30 * std::sin(v * kDegree);
}

AreaLight rect(Vec3d center, Vec3d x, Vec3d y) {
  AreaLight light;
  light.shape = Polygon{{center - x - y, center + x - y, center + x + y, center - x + y}, {}};
  return light;
}
AreaLight disk(Vec3d center, Vec3d x, Vec3d y) {
  AreaLight light;
  light.shape = Ellipse{center, x, y};
  return light;
}
AreaLight shining(AreaLight light, const std::shared_ptr<const LightProfile>& profile, Vec3d towards_x = {1, 0, 0}) {
  set_emission(light, profile, towards_x, {1, 0.5, 0.25});
  return light;
}

// The definition: points uniform over the area, each with its fraction of the intensity.
Vec3d by_points(const AreaLight& light, const ShadingPoint& at, const Material& m, int n) {
  const LightEmission& e = *light.emission;
  const auto* round = std::get_if<Ellipse>(&light.shape);
  Vec3d center, x, y;
  if (round != nullptr) {
    center = round->center, x = round->x, y = round->y;
  } else {
    const auto& v = std::get<Polygon>(light.shape).vertices;
    center = (v[0] + v[2]) * 0.5, x = (v[1] - v[0]) * 0.5, y = (v[3] - v[0]) * 0.5;
  }
  Vec3d sum{};
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      double u = 2 * (i + 0.5) / n - 1, v = 2 * (k + 0.5) / n - 1;
      if (round != nullptr) {
        const double r = std::sqrt((i + 0.5) / n), phi = 2 * std::numbers::pi * (k + 0.5) / n;
        u = r * std::cos(phi), v = r * std::sin(phi);
      }
      const PointLight point = {center + x * u + y * v, e.intensity / (static_cast<double>(n) * n), e.profile, e.axes};
      sum += methods::point_light_radiance(point, at, m, methods::row_of(Method::reference));
    }
  return sum;
}

Material ggx(double roughness) {
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = m.alpha_y = roughness * roughness;
  return m;
}

const ShadingPoint kBelow = {{0.3, 0, 0.2}, {0, 1, 0}, normalized(Vec3d{0.5, 0.8, -0.2})};

TEST(ProfiledLight, TheReferenceIsASumOfPoints) {
  const AreaLight lights[] = {shining(rect({0, 1.2, 0}, {0.7, 0, 0}, {0, 0, 0.4}), profile_of(batwing)),
                              shining(disk({0, 1.2, 0}, {0.6, 0, 0.1}, {-0.1, 0, 0.5}), profile_of(batwing), {0, 0, 1}),
                              shining(rect({0.5, 1, 0.1}, {0.4, 0.1, 0}, {0, 0, 0.4}), profile_of(narrow))};
  for (const AreaLight& light : lights)
    for (const Material& m : {Material{}, ggx(0.6)}) {
      const RadianceResult r = radiance(light, kBelow, m, {.method = Method::reference});
      // Midpoints of a smooth function with kinks: halving the step divides their error by four. A third of the difference between the two
      // sums is then the error of the finer one.
      const Vec3d fine = by_points(light, kBelow, m, 240), coarse = by_points(light, kBelow, m, 120);
      const double left = std::fabs(fine.x - coarse.x) + 1e-6 * fine.x;
      EXPECT_NEAR(r.radiance.x, fine.x, left + *r.bound);
      EXPECT_NEAR(r.radiance.y, r.radiance.x / 2, 1e-12);
      EXPECT_LT(*r.bound, 1e-4 * r.radiance.x);
      const RadianceResult s = radiance(light, kBelow, m, {.method = Method::sampled, .spp = 4096, .seed = 7});
      EXPECT_NEAR(s.radiance.x, r.radiance.x, 5 * *s.standard_error);
    }
}

TEST(ProfiledLight, ACosineIsAnEvenLight) {
  const auto cosine = profile_of(lambert, 90, 0.25);
  for (const AreaLight& plain : {rect({0, 1, 0}, {0.7, 0, 0}, {0, 0, 0.5}), disk({0, 1, 0}, {0.7, 0, 0}, {0, 0, 0.7})}) {
    const AreaLight lamp = shining(plain, cosine);
    AreaLight even = plain;
    even.radiance = Vec3d{1, 0.5, 0.25} * (100 / lamp.emission->area);
    EXPECT_NEAR(lamp.radiance.x, even.radiance.x, 1e-5 * even.radiance.x);
    for (const Material& m : {Material{}, ggx(0.2), ggx(0.7)}) {
      const double a = radiance(lamp, kBelow, m).radiance.x, b = radiance(even, kBelow, m).radiance.x;
      EXPECT_NEAR(a, b, 1e-5 * b);  // chords of a cosine over a quarter of a degree: 2.4e-6
    }
  }
}

TEST(ProfiledLight, FromAfarItIsThePointThatWasMeasured) {
  const auto profile = profile_of(batwing);
  const AreaLight lamp = shining(rect({0, 300, 200}, {0.1, 0, 0}, {0, 0, 0.1}), profile);
  const PointLight point = {{0, 300, 200}, {1, 0.5, 0.25}, profile, lamp.emission->axes};
  for (const Material& m : {Material{}, ggx(0.5)}) {
    const double a = radiance(lamp, kBelow, m).radiance.x,
                 b = methods::point_light_radiance(point, kBelow, m, methods::row_of(Method::reference)).x;
    EXPECT_NEAR(a, b, 1e-5 * b);  // second order in a size of 3e-4 of the distance, and the lobe's single precision
  }
}

TEST(ProfiledLight, ShinesToTheSidesThatTheProfileHas) {
  const AreaLight down = shining(rect({0, 1, 0}, {0.5, 0, 0}, {0, 0, 0.5}), profile_of(batwing));
  const AreaLight both = shining(rect({0, 1, 0}, {0.5, 0, 0}, {0, 0, 0.5}), profile_of(up_and_down, 180));
  EXPECT_FALSE(down.two_sided);
  EXPECT_TRUE(both.two_sided);
  const ShadingPoint above = {{0.2, 2, 0}, {0, -1, 0}, {0, -1, 0}};
  EXPECT_EQ(radiance(down, above, {}).radiance.x, 0);
  const double want = by_points(both, above, {}, 400).x;
  EXPECT_NEAR(radiance(both, above, {}).radiance.x, want, 2e-3 * want);
  EXPECT_NEAR(radiance(both, above, {}, {.method = Method::reference}).radiance.x, want, 1e-4 * want);
}

TEST(ProfiledLight, OnlyRectsAndDisksShineByAProfile) {
  AreaLight light;
  light.shape = Ellipsoid{{0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_THROW(set_emission(light, profile_of(lambert), {1, 0, 0}), Error);
  light = rect({0, 1, 0}, {0, 0, 0}, {0, 0, 1});  // without area
  set_emission(light, profile_of(lambert), {1, 0, 0});
  EXPECT_EQ(light.power, 0);
  EXPECT_EQ(radiance(light, kBelow, {}).radiance.x, 0);
}

// The error that docs/theory/ltc.md states: random places of a light of a metre or so, from 0.1 to 4 m, each quality.
TEST(ProfiledLight, ErrorsAreMeasured) {
  struct Kind {
    const char* name;
    std::shared_ptr<const LightProfile> profile;
  };
  const Kind kinds[] = {{"batwing", profile_of(batwing)}, {"narrow", profile_of(narrow)}, {"up and down", profile_of(up_and_down, 180)}};
  struct Lobe {
    const char* name;
    Material m;
  };
  const Lobe lobes[] = {{"lambert", Material{}}, {"ggx 0.7", ggx(0.7)}, {"ggx 0.3", ggx(0.3)}, {"ggx 0.1", ggx(0.1)}};
  const auto cosine = profile_of(lambert, 90, 0.25);
  for (const Kind& kind : kinds)
    for (const Lobe& lobe : lobes) {
      reference::Random random(11);
      double squares = 0, worst = 0, of_method = 0;
      int count = 0;
      while (count < 24) {
        const auto uniform = [&](double a, double b) { return a + (b - a) * random.uniform(); };
        const Vec3d center = {uniform(-1, 1), uniform(0.1, 4), uniform(-1, 1)};
        const Frame f = Frame::from_normal(normalized(Vec3d{uniform(-0.5, 0.5), -1, uniform(-0.5, 0.5)}));
        // Compilers for different processors evaluate arguments in different orders.
        const double half_y = uniform(0.1, 0.8), half_x = uniform(0.1, 0.8);
        const AreaLight light = count % 2 == 0 ? rect(center, f.x * half_x, f.y * half_y) : disk(center, f.x * half_x, f.y * half_y);
        const AreaLight lamp = shining(light, kind.profile, f.x);
        const ShadingPoint at = {{0, 0, 0}, {0, 1, 0}, normalized(Vec3d{uniform(-1, 1), uniform(0.2, 1), uniform(-1, 1)})};
        const double got = radiance(lamp, at, lobe.m).radiance.x;
        // The lobe must cover some of the light, and be at least a hundredth as bright as straight in front of it.
        AreaLight brightest = lamp;
        brightest.emission.reset();
        brightest.radiance = emitted_radiance(*lamp.emission, lamp.emission->axes.aim);
        const double most = radiance(brightest, at, lobe.m).radiance.x;
        if (!(most > 1e-3 * brightest.radiance.x) || !(got > 0.01 * most)) continue;
        const double truth = ProfiledLight(lamp).reference(lobe.m, at, {1e-5, 0, 60'000}).radiance.x;
        AreaLight even = lamp;
        even.emission.reset();
        // The error of the same light with a uniform profile; a disk is the polygon that lobes walk.
        const double judged = ProfiledLight(shining(even, cosine, f.x)).reference(lobe.m, at, {1e-5, 0, 60'000}).radiance.x;
        const double plain = radiance(even, at, lobe.m).radiance.x * (100 / lamp.emission->area) / even.radiance.x;
        const double error = got / truth - 1, own = plain / judged - 1;  // own: error of the method under uniform light
        squares += (error - own) * (error - own);
        worst = std::max(worst, std::fabs(error - own));
        of_method = std::max(of_method, std::fabs(own));
        ++count;
      }
      const double rms = std::sqrt(squares / count);
      std::printf("%-12s %-8s rms %.2e worst %.2e (method itself: worst %.2e)\n", kind.name, lobe.name, rms, worst, of_method);
      EXPECT_LT(rms, 2e-3) << kind.name << " " << lobe.name;
      EXPECT_LT(worst, 1e-2) << kind.name << " " << lobe.name;
    }
}

}  // namespace
}  // namespace steradian::profiled_light_test
