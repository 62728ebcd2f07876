// Gradients with stops up to 1e8 times brighter than others, against quadrature.
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <tuple>

#include "night.h"
#include "plane/exact/emission.h"
#include "plane/exact/outline.h"
#include "plane/exact/random.h"
#include "plane/exact/world.h"

namespace steradian::plane::emission_test {
namespace {

using std::numbers::pi;

PlaneGradient stops(SceneRandom& random, Vec2d from, Vec2d to) {
  PlaneGradient gradient{from, to, {}};
  const int count = 2 + static_cast<int>(random.uniform(0, 5));
  for (int i = 0; i < count; ++i) {
    const auto radiance = [&] { return std::pow(10, random.uniform(-4, 4)); };
    gradient.stops.push_back({i / (count - 1.0), {radiance(), radiance(), i % 2 == 0 ? 0 : radiance()}});
  }
  return gradient;
}

// Seven-point Gauss-Legendre on pieces of a twentieth in asinh of the slope, which are far from any singularity.
Vec3d by_quadrature(const PlaneEmission& e, Vec2d a, Vec2d b, Vec2d from) {
  static constexpr double kNode[4] = {0.0, 0.4058451513773972, 0.7415311855993945, 0.9491079123427585};
  static constexpr double kWeight[4] = {0.4179591836734694, 0.3818300505051189, 0.2797053914892766, 0.1294849661688697};
  const Vec2d along = (b - a) / length(b - a), normal{-along.y, along.x};
  const double d = std::fabs(dot(a - from, normal)), low = std::asinh(dot(a - from, along) / d),
               high = std::asinh(dot(b - from, along) / d);
  const Vec2d foot = a - along * dot(a - from, along);
  const int pieces = 1 + static_cast<int>((high - low) / 0.05);
  Vec3d sum;
  for (int i = 0; i < pieces; ++i)
    for (int n = -3; n <= 3; ++n) {
      const double half = 0.5 * (high - low) / pieces, x = low + half * (2 * i + 1 + std::copysign(kNode[std::abs(n)], n));
      const double t = std::sinh(x), sec = std::cosh(x), r = d * sec;
      double weight = half * kWeight[std::abs(n)] / sec;
      if (e.profile == PlaneProfile::lambert) weight /= sec;
      if (e.profile == PlaneProfile::inverse) weight /= r;
      const double window = std::max(1 - r * r / (e.range * e.range), 0.0);
      sum += radiance_at(e, foot + along * (t * d)) * (weight * window * window);
    }
  return sum / (2 * pi);
}

}  // namespace

// Each edge of the gradient on its own. A blocker hides all beyond a random place.
TEST(PlaneGradients, AreNotNegativeBesideMuchBrighterStops) {
  SceneRandom random(10);
  int tried = 0, beyond = 0, negative = 0;
  double worst = 0;
  for (int s = 0; s < test::by_day_or_night(2000, 50'000); ++s) {
    PlaneScene scene;
    scene.width = scene.height = 1024;
    const Vec2d a{random.uniform(300, 700), random.uniform(300, 700)};
    const Vec2d b = a + direction_at(random.uniform(-pi, pi)) * std::pow(10, random.uniform(-1, 2.5)), along = (b - a) / length(b - a);
    // From all around, also at a grazing angle.
    const Vec2d p = a + (b - a) * random.uniform(-2, 3) + Vec2d{-along.y, along.x} * std::pow(10, random.uniform(-3, 2.5));
    PlaneBody line;
    line.shape = PlaneBody::Shape::polyline;
    line.contours = {{a, b}};
    PlaneEmission& e = line.light.emplace();
    e.gradient = stops(random, a, b);
    e.profile = static_cast<PlaneProfile>(s % 3);
    const double visible = random.uniform(0.02, 1);
    PlaneBody blocker = line;
    blocker.light.reset();
    blocker.contours = {{p + (a + (b - a) * visible - p) * 0.5, p + (b + (b - a) * 0.1 - p) * 0.5}};
    scene.bodies = {line, blocker};
    const auto up_to = [&](double share) {
      Vec3d sum;
      const auto& all = e.gradient->stops;
      for (std::size_t i = 0; i + 1 < all.size() && all[i].offset < share; ++i)
        sum += by_quadrature(e, a + (b - a) * all[i].offset, a + (b - a) * std::min(all[i + 1].offset, share), p);
      return sum;
    };
    const Vec3d truth = up_to(visible);
    // Coordinates up to 3000 are rounded by 2e-13, a few times, and angles by 4e-16. So are the distance, the stops' places, and the
    // visible ends, which move by as much more as the line is seen at a sharper angle. Half of the space between two stops is a tenth of
    // the line.
    constexpr double kRounding = 1e-12, kAngle = 1e-15;
    const double distance = std::fabs(cross(along, p - a));
    const auto shift_at = [&](double share) {
      const double slope = std::fabs(dot(along, a + (b - a) * share - p)) / distance;
      return (kRounding * (1 + slope) + kAngle * distance * (1 + slope * slope)) / length(b - a);
    };
    const Vec3d moved = up_to(visible + shift_at(visible)) - up_to(visible - shift_at(visible)) + up_to(shift_at(0));
    const Vec3d light = PlaneWorld(scene).query(p).radiance;
    for (const auto& [x, y, of_ends] : {std::tuple{light.x, truth.x, moved.x}, {light.y, truth.y, moved.y}, {light.z, truth.z, moved.z}}) {
      ++tried;
      if (x < 0) ++negative;
      const double off = std::fabs(x - y), bound = kRounding * (1 / distance + 10 / length(b - a)) * y + std::fabs(of_ends);
      if (y > 0) worst = std::max(worst, off / y);
      if (!(off <= bound) && ++beyond <= 3) ADD_FAILURE() << "line " << s << ": " << x << ", not " << y << ", by " << off / bound;
    }
  }
  EXPECT_EQ(negative, 0) << "of " << tried;
  EXPECT_EQ(beyond, 0) << "of " << tried;
  std::printf("gradients: %d of %d negative, %d beyond rounding, the worst by %.1e\n", negative, tried, beyond, worst);
}

TEST(PlaneGradients, AreNotNegativeUnderARange) {
  SceneRandom random(11);
  int tried = 0, negative = 0;
  double worst = 0;
  for (int s = 0; s < 1000; ++s) {
    const Vec2d a{random.uniform(-1, 1), 0}, b = a + Vec2d{std::pow(10, random.uniform(-2, 1)), 0};
    PlaneEmission e;
    e.gradient = stops(random, a, b);
    e.profile = static_cast<PlaneProfile>(s % 3);
    const double d = std::pow(10, random.uniform(-2, 0));
    e.range = d * random.uniform(1, 3);
    Curve curve;
    curve.a = a;
    curve.b = b;
    const Vec2d p{random.uniform(-2, 2), d};
    const double begin = angle_of(a - p), end = angle_of(b - p);
    PlaneLight sum;
    add_emission({std::min(begin, end), std::max(begin, end), &curve, false}, e, p, EmissionParts::radiance, sum);
    Vec3d truth;
    const double reach = std::sqrt(e.range * e.range - d * d);
    for (std::size_t i = 0; i + 1 < e.gradient->stops.size(); ++i) {
      const double low = std::max(a.x + (b.x - a.x) * e.gradient->stops[i].offset, p.x - reach),
                   high = std::min(a.x + (b.x - a.x) * e.gradient->stops[i + 1].offset, p.x + reach);
      if (low < high) truth += by_quadrature(e, {low, 0}, {high, 0}, p);
    }
    for (const auto& [x, y] : {std::pair{sum.radiance.x, truth.x}, {sum.radiance.y, truth.y}, {sum.radiance.z, truth.z}}) {
      ++tried;
      negative += x < 0;
      if (y > 1e-9) worst = std::max(worst, std::fabs(x / (2 * pi) - y) / y);
    }
  }
  EXPECT_EQ(negative, 0) << "of " << tried;
  EXPECT_LT(worst, 1e-8);
  std::printf("gradients under a range: %d of %d negative, the worst off by %.1e\n", negative, tried, worst);
}

TEST(PlaneGradients, AreDarkFromTheirOwnLine) {
  PlaneEmission e;
  e.gradient = PlaneGradient{{3, 0}, {5, 0}, {{0, {1, 1, 1}}, {1, {2, 2, 2}}}};
  Curve curve;
  curve.a = {3, 0};
  curve.b = {5, 0};
  for (PlaneProfile profile : {PlaneProfile::uniform, PlaneProfile::lambert, PlaneProfile::inverse}) {
    e.profile = profile;
    PlaneLight sum;
    add_emission({-1e-14, 1e-14, &curve, false}, e, {1, 0}, EmissionParts::radiance_and_moments, sum);
    EXPECT_NEAR(sum.radiance.x, 0, 1e-12) << static_cast<int>(profile);
    EXPECT_NEAR(sum.moment_x.x, 0, 1e-12) << static_cast<int>(profile);
  }
}

}  // namespace steradian::plane::emission_test
