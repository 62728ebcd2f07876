// Every sampler against its density (chi-square), and the densities against their known integrals.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "lobes/lobe.h"
#include "lobes/samplers.h"
#include "reference/azimuth_sampler.h"
#include "reference/spherical_region.h"
#include "support/chi2.h"
#include "support/random_configurations.h"

namespace steradian::reference::samplers_test {

using namespace lobes;

namespace {

// All chi-square tests of this file together fail by chance once in 1,000 changes of a seed.
constexpr int kTests = 100;
const double kLevel = sidak_level(1e-3, kTests);

Vec3d view_at(double z) { return direction_at(z, std::sqrt(1 - z * z), 0.13); }

// Width of the rings for a lobe of a width. A wide lobe jumps to 0 at the horizon: an edge between two rings is placed there.
double width_for(double lobe_width) { return lobe_width < 0.1 ? 2 * lobe_width : 0.5 * std::numbers::pi; }

void expect_density_holds(const std::function<Vec3d(double, double)>& sample, const std::function<double(Vec3d)>& pdf,
                          const Chi2Options& options, const std::string& what) {
  const Chi2Result r = chi2_test(sample, pdf, options);
  EXPECT_GE(r.p_value, kLevel) << what << ": " << r.evidence;
}

}  // namespace

TEST(Chi2, UpperGammaHasItsKnownValues) {
  for (double x : {0.01, 0.5, 1.0, 3.0, 20.0, 200.0}) {
    EXPECT_NEAR(regularized_upper_gamma(1, x), std::exp(-x), 1e-14);
    EXPECT_NEAR(regularized_upper_gamma(0.5, x), std::erfc(std::sqrt(x)), 1e-14);
    EXPECT_NEAR(regularized_upper_gamma(3, x), std::exp(-x) * (1 + x + 0.5 * x * x), 1e-13);
  }
  // Half a degree of freedom more: Q(a + 1, x) = Q(a, x) + x^a e^-x / Gamma(a + 1).
  for (double a : {40.5, 150.0})
    for (double x : {20.0, 41.0, 150.0, 180.0})
      EXPECT_NEAR(regularized_upper_gamma(a + 1, x), regularized_upper_gamma(a, x) + std::exp(a * std::log(x) - x - std::lgamma(a + 1)),
                  1e-12);
}

TEST(Chi2, FindsAWrongDensity) {
  // The samples follow a cosine, but the density is of a slightly narrower lobe.
  const auto r =
      chi2_test([](double u, double v) { return sample_cosine_hemisphere(u, v); }, [](Vec3d l) { return pdf_cosine_power(1.1, l.z); }, {});
  EXPECT_LT(r.p_value, kLevel) << r.evidence;
}

TEST(Samplers, CosineAndItsPowersHoldTheirDensity) {
  expect_density_holds(sample_cosine_hemisphere, pdf_cosine_hemisphere, {}, "cosine");
  for (double n : {0.0, 1.0, 20.0, 10'000.0}) {
    Chi2Options options;
    options.width = width_for(1 / std::sqrt(n + 1));
    expect_density_holds([=](double u, double v) { return sample_cosine_power(n, u, v); },
                         [=](Vec3d l) { return pdf_cosine_power(n, l.z); }, options, "power " + std::to_string(n));
  }
}

TEST(Samplers, HalfVectorsHoldTheirDensity) {
  for (double n : {0.0, 20.0, 10'000.0}) {
    Chi2Options options;
    options.width = width_for(1 / std::sqrt(n + 1));
    expect_density_holds([=](double u, double v) { return sample_blinn_phong_half_vector(n, u, v); },
                         [=](Vec3d h) { return pdf_blinn_phong_half_vector(n, h); }, options, "blinn-phong " + std::to_string(n));
  }
  for (double ax : {0.01, 0.3, 1.0})
    for (double ratio : {1.0, 4.0}) {
      Chi2Options options;
      options.width = width_for(ax);
      expect_density_holds([=](double u, double v) { return sample_beckmann_half_vector(ax, ratio * ax, u, v); },
                           [=](Vec3d h) { return pdf_beckmann_half_vector(ax, ratio * ax, h); }, options, "beckmann " + std::to_string(ax));
      for (double vz : {1.0, 0.6, 0.05})
        expect_density_holds([=](double u, double v) { return sample_ggx_visible_normal(view_at(vz), ax, ratio * ax, u, v); },
                             [=](Vec3d h) { return pdf_ggx_visible_normal(view_at(vz), ax, ratio * ax, h); }, options,
                             "ggx " + std::to_string(ax) + " v_z " + std::to_string(vz));
    }
}

TEST(Samplers, LobesHoldTheirDensity) {
  for (const LobeRow& row : lobe_rows())
    for (double vz : {0.9, 0.3}) {
      Material m;
      m.brdf = row.brdf;
      m.exponent = 30;
      m.alpha_x = 0.2;
      m.alpha_y = 0.4;
      const Lobe lobe(m, view_at(vz));
      Chi2Options options;
      options.axis = lobe.shape().peak;
      options.width = 1;
      expect_density_holds([&](double u, double v) { return lobe.sample(u, v); }, [&](Vec3d l) { return lobe.pdf(l); }, options,
                           std::string(row.name) + " v_z " + std::to_string(vz));
    }
}

TEST(Samplers, PolygonsAreSampledEvenlyInBothMeasures) {
  Random random(5);
  for (int i = 0, tested = 0; tested < 10; ++i) {
    const auto c = random_configuration(random);
    SphericalRegion region;
    region.assign_above_horizon(prepare_polygon(c.light), c.at.position, Frame::from_normal(c.at.normal));
    AzimuthSampler sampler;
    const auto measure = tested % 2 == 0 ? SphericalMeasure::solid_angle : SphericalMeasure::projected_solid_angle;
    sampler.prepare(region, measure);
    // A light that nearly touches the point may have only slivers above the horizon, which cells cannot resolve.
    if (!(sampler.measure() > 0) || c.kind == "near") continue;
    ++tested;
    Chi2Options options;
    options.samples = 20'000;
    options.rings = 8;
    options.columns = 12;
    options.axis = sampler.sample(0.5, 0.5);
    options.width = std::sqrt(sampler.measure());
    expect_density_holds([&](double u, double v) { return sampler.sample(u, v); }, [&](Vec3d l) { return sampler.pdf(l); }, options,
                         c.kind + " light " + std::to_string(i));
  }
}

TEST(Samplers, PolygonMeasuresAreTheClosedForms) {
  Random random(6);
  AzimuthSampler sampler;
  SphericalRegion region;
  int lit = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto c = random_configuration(random);
    const PreparedPolygon light = prepare_polygon(c.light);
    region.assign_above_horizon(light, c.at.position, Frame::from_normal(c.at.normal));
    sampler.prepare(region, SphericalMeasure::projected_solid_angle);
    const double irradiance = polygon_irradiance(light, c.at.position, c.at.normal);
    // The error is that of some dozens of sums of angles of unit size.
    EXPECT_NEAR(sampler.measure(), irradiance, 1e-13) << i << " " << c.kind;
    lit += irradiance > 0;

    // Without a horizon, about the light's own normal, the measure is its whole solid angle.
    const int side = light.side_of(c.at.position);
    region.assign(light, c.at.position, Frame::from_normal(light.normal * (side < 0 ? 1.0 : -1.0)), nullptr, 0);
    sampler.prepare(region, SphericalMeasure::solid_angle);
    // A plane through nearly opposite directions has an error of a rounding over their sine. The closed form has planes through each arc
    // and from the first vertex to all others.
    double sine = 1;
    for (const Arc& arc : region.arcs) {
      const Vec3d first = side < 0 ? region.arcs[0].b : region.arcs[0].a;
      sine = std::min({sine, length(arc.a + arc.b), length(first + arc.a), length(first + arc.b)});
    }
    EXPECT_NEAR(sampler.measure(), polygon_solid_angle(light, c.at.position), 1e-13 / sine) << i << " " << c.kind;
  }
  EXPECT_GT(lit, 500);
}

TEST(Samplers, PolygonSamplesLieWithin) {
  Random random(7);
  AzimuthSampler sampler;
  SphericalRegion region;
  int samples = 0, outside = 0;
  for (int i = 0; i < 500; ++i) {
    const auto c = random_configuration(random);
    region.assign_above_horizon(prepare_polygon(c.light), c.at.position, Frame::from_normal(c.at.normal));
    sampler.prepare(region, i % 2 == 0 ? SphericalMeasure::solid_angle : SphericalMeasure::projected_solid_angle);
    for (int s = 0; s < 20 && sampler.measure() > 0; ++s, ++samples) {
      const Vec3d l = sampler.sample(random.uniform(), random.uniform());
      EXPECT_NEAR(length(l), 1, 1e-14);
      outside += !sampler.contains(l);
    }
  }
  EXPECT_GT(samples, 5000);
  // Rounding moves a sample by 1e-16: the chance to leave a light of 1e-5 is 1e-11.
  EXPECT_EQ(outside, 0) << "of " << samples;
}

TEST(Samplers, SphericalRectangleHoldsItsDensityAndSolidAngle) {
  Random random(8);
  for (int i = 0; i < 8; ++i) {
    const Frame frame = Frame::from_normal(random_direction(random));
    const Vec3d corner = frame.to_world({random.uniform(-2, 1), random.uniform(-2, 1), random.uniform(0.05, 1.5)});
    const Vec3d x = frame.x * random.uniform(0.1, 3), y = frame.y * random.uniform(0.1, 3);
    const SphericalRectangle rectangle(corner, x, y);
    PolygonLight light;
    light.vertices = {corner, corner + x, corner + x + y, corner + y};
    light.two_sided = true;
    // Four inverse cosines near 0 or pi lose half of the digits of their arguments.
    EXPECT_NEAR(rectangle.solid_angle(), polygon_solid_angle(prepare_polygon(light), {}), 4 * 1.5e-8);
    Chi2Options options;
    options.samples = 30'000;
    options.axis = normalized(corner + x * 0.5 + y * 0.5);
    options.width = std::sqrt(rectangle.solid_angle());
    expect_density_holds([&](double u, double v) { return rectangle.sample(u, v); }, [&](Vec3d l) { return rectangle.pdf(l); }, options,
                         "rectangle " + std::to_string(i));
  }
}

}  // namespace steradian::reference::samplers_test
