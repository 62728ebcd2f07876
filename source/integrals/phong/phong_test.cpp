// The Phong methods against independent quadrature over the sphere, and against each other.
#include "steradian/kernels.h"
#include "steradian/phong.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "night.h"
#include "steradian/error.h"
#include "support/adversarial_quads.h"
#include "support/random_configurations.h"

namespace steradian::phong_test {
namespace {

using reference::Random;
using reference::random_configuration;

Material phong(double n) {
  Material material;
  material.brdf = Brdf::phong;
  material.exponent = n;
  return material;
}

PolygonLight polygon(std::vector<Vec3d> vertices) {
  PolygonLight light;
  light.vertices = std::move(vertices);
  return light;
}

constexpr double kExponents[] = {1, 2, 3, 4.5, 10, 11, 64, 100, 333.3, 1000, 5000, 10000};

double exact_of(const PreparedPolygon& light, const ShadingPoint& at, double n) {
  return phong_radiance(light, at, phong(n), {Method::exact}).x;
}

// Largest and root mean square error, and the exponent of the largest.
struct Errors {
  double largest = 0, squares = 0, at_n = 0;
  int count = 0;

  void add(double error, double n) {
    if (!(std::fabs(error) <= largest)) largest = std::fabs(error), at_n = n;  // catches NaN too
    squares += error * error;
    ++count;
  }
  double rms() const { return std::sqrt(squares / count); }
  void print(const char* name) const {
    std::printf("%-28s largest %.2e (n = %.4g), rms %.2e, %d lights\n", name, largest, at_n, rms(), count);
  }
};

}  // namespace

// Two-dimensional adaptive cubature is independent of boundary integrals. The full lobe's radiance is 1.
TEST(PhongExact, AgreesWithQuadratureOverTheSphere) {
  Random random(3);
  Errors errors;
  int lit = 0, judged = 0;
  for (int i = 0; i < 2000; ++i) {
    auto c = random_configuration(random);
    const PreparedPolygon light = prepare_polygon(c.light);
    const double n = i % 13 == 12 ? std::exp(random.uniform(0, std::log(10000.0))) : kExponents[i % 13];
    if (i % 4 != 0 && !light.vertices.empty()) {  // aims the lobe at the light
      const Vec3d to_light = normalized(light.vertices[random.bits() % light.vertices.size()] * 0.7 + light.centroid * 0.3 - c.at.position);
      if (dot(to_light, c.at.normal) > 1e-3) c.at.view = moment::view_mirrored_to(to_light, c.at.normal);
    }
    const double exact = exact_of(light, c.at, n);
    const ReferenceResult r = reference_radiance(light, c.at, phong(n), {1e-12, 1e-12, 1'000'000});
    EXPECT_LE(std::fabs(exact - r.radiance.x), 1e-10 + r.bound) << i << ": " << c.kind << ", n = " << n << ", exact " << exact;
    if (r.bound < 1e-10) errors.add(exact - r.radiance.x, n), ++judged;
    lit += exact > 1e-3;
  }
  EXPECT_LT(errors.largest, 1e-10);
  EXPECT_GT(lit, 700);
  EXPECT_GT(judged, 1900);
  errors.print("exact against cubature");
  std::printf("%d of 2000 judged, %d lit\n", judged, lit);
}

TEST(PhongExact, AgreesWithQuadratureOnQuadsAroundTheLobe) {
  Random random(4);
  Errors errors;
  for (int i = 0; i < 1000; ++i) {
    const auto c = moment::adversarial_quad(random);
    const PreparedPolygon light = prepare_polygon(c.light);
    const ReferenceResult r = reference_radiance(light, c.at, phong(c.n), {1e-12, 1e-12, 1'000'000});
    const double error = exact_of(light, c.at, c.n) - r.radiance.x;
    EXPECT_LE(std::fabs(error), 1e-10 + r.bound) << i << ": n = " << c.n;
    errors.add(error, c.n);
  }
  errors.print("exact against cubature");
}

// A light with the axis inside and wider than the lobe's hemisphere: the full lobe, cut only by the horizon.
TEST(PhongExact, GivesTheWholeLobeUnderAVeryLargeLight) {
  PolygonLight big;
  big.vertices = {{-1e6, 1e6, 1}, {1e6, 1e6, 1}, {1e6, -1e6, 1}, {-1e6, -1e6, 1}};  // shines down
  const PreparedPolygon light = prepare_polygon(big);
  // The light lacks a band of 1e-6 above the horizon, where the lobe is 0.
  for (double n : kExponents) EXPECT_NEAR(exact_of(light, {{0, 0, 0}, {0, 0, 1}, {0, 0, 1}}, n), 1, 1e-11) << "n = " << n;
}

TEST(PhongExact, IsAdditiveWhenAPolygonIsCut) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const auto c = moment::adversarial_quad(random);
    const auto& v = c.light.vertices;
    const double whole = exact_of(prepare_polygon(polygon(v)), c.at, c.n);
    // The cut starts at a vertex that is not on the quad's other diagonal: either triangle may run backwards.
    const Vec3d up = normalized(cross(v[1] - v[0], v[2] - v[0])), up2 = normalized(cross(v[2] - v[0], v[3] - v[0]));
    if (dot(up, up2) < 0) continue;
    const double parts = exact_of(prepare_polygon(polygon({v[0], v[1], v[2]})), c.at, c.n) +
                         exact_of(prepare_polygon(polygon({v[0], v[2], v[3]})), c.at, c.n);
    EXPECT_NEAR(whole, parts, 2e-12) << i << ": n = " << c.n;
  }
}

TEST(PhongArvo, IsExactForIntegerExponents) {
  Random random(6);
  Errors all, early;
  for (int i = 0; i < 1500; ++i) {
    auto c = moment::adversarial_quad(random);
    const double n = i < 200 ? 1 + i % 12 : std::round(std::pow(c.n, 0.8));
    const PreparedPolygon light = prepare_polygon(c.light);
    const double exact = exact_of(light, c.at, n);
    all.add(phong_radiance(light, c.at, phong(n), {Method::arvo}).x - exact, n);
    early.add(phong_radiance(light, c.at, phong(n), {Method::arvo, Quality::normal, 1e-4}).x - exact, n);
  }
  all.print("arvo");
  early.print("arvo, stopped at 1e-4");
  // The recurrence cancels in c^p for ends close together: a thousand roundings of its largest term.
  EXPECT_LT(all.largest, 1e-11);
  // 1e-4 of an edge's contribution, which is at most 2 pi; four edges.
  EXPECT_LT(early.largest, 4e-4);
  EXPECT_GT(early.largest, all.largest);
}

TEST(PhongArvo, RefusesOtherExponents) {
  Random random(6);
  const auto c = moment::adversarial_quad(random);
  const PreparedPolygon light = prepare_polygon(c.light);
  EXPECT_THROW(phong_radiance(light, c.at, phong(4.5), {Method::arvo}), Error);
  EXPECT_THROW(phong_radiance(light, c.at, phong(-1), {Method::series}), Error);
}

// The bounds are the specification of the method. The largest errors come from lights with an edge through the axis.
TEST(PhongSeries, HoldsItsErrorsInFloatOverAdversarialQuads) {
  Random random(8);
  Errors normal, high;
  for (int i = 0; i < test::by_day_or_night(10000, 100000); ++i) {
    const auto c = moment::adversarial_quad(random);
    const PreparedPolygon light = prepare_polygon(c.light);
    const double exact = exact_of(light, c.at, c.n);
    const PhongOptions high_quality{Method::series, Quality::high};
    normal.add(static_cast<double>(phong_radiance_float(light, c.at, phong(c.n), {Method::series}).x) - exact, c.n);
    high.add(static_cast<double>(phong_radiance_float(light, c.at, phong(c.n), high_quality).x) - exact, c.n);
  }
  normal.print("series, float");
  high.print("series, high quality, float");
  EXPECT_LE(normal.largest, 1.3e-3);
  EXPECT_LE(normal.rms(), 1.7e-4);
  EXPECT_LE(high.largest, 4.5e-4);
  EXPECT_LE(high.rms(), 5e-5);
}

TEST(PhongSeries, ServesExponentsBelowOne) {
  Random random(9);
  Errors normal, high;
  for (int i = 0; i < 4000; ++i) {
    auto c = random_configuration(random);
    const double n = i % 5 == 0 ? 0 : random.uniform();
    const PreparedPolygon light = prepare_polygon(c.light);
    const double exact = exact_of(light, c.at, n);
    normal.add(phong_radiance(light, c.at, phong(n), {Method::series}).x - exact, n);
    high.add(phong_radiance(light, c.at, phong(n), {Method::series, Quality::high}).x - exact, n);
  }
  normal.print("series, n < 1");
  high.print("series high, n < 1");
  EXPECT_LE(normal.largest, 1.3e-3);
  EXPECT_LE(high.largest, 4.5e-4);
}

// Properties that define the fits, whatever their error elsewhere: they have the integrand's value at its foot. The Lorentzian, which has
// no blending weight, has it also at the half width. The test differentiates an edge's integral up to an angle there by central
// differences.
TEST(PhongPeakFits, MeetTheIntegrandAtItsFootAndHalfWidth) {
  using K = Kernels<double>;
  K k;
  for (const double n : {20.0, 37.5, 100.0, 501.0, 5000.0})
    for (const double c : {0.3, 0.8, 0.99})
      for (const int f_is_x : {0, 1}) {
        const double s = std::sqrt(1 - c * c);
        const auto edge = [&](double from, double to) {
          const auto point = [&](double phi) { return K::vec3(s * std::cos(phi), std::sin(phi), c * std::cos(phi)); };
          return k.moment_edge(point(from), point(to), K::vec3(0.0, 0.0, 1.0));
        };
        const double half_width = k.moment_peak_prepare(edge(-0.1, 0.1), n, f_is_x).x_w.v;
        const double width = std::min(half_width, 1 / std::sqrt(n)), h = 1e-3 * width;
        for (const double phi : {0.0, half_width}) {
          const double x = c * std::cos(phi), integrand = (1 - std::pow(x, n + 1)) / (1 - x * x);
          const auto slope = [&](auto front) { return (front(edge(-0.1, phi + h)) - front(edge(-0.1, phi - h))).v / (2 * h * s); };
          // The difference's own error: h^2 / 6 times the third derivative, some width^-2 of the integrand.
          const double allowed = 1e-4 * integrand;
          EXPECT_NEAR(slope([&](const auto& e) { return k.moment_lorentzian_front(e, n, f_is_x); }), integrand, allowed)
              << n << " " << c << " " << phi;
          if (phi > 0) continue;
          EXPECT_NEAR(slope([&](const auto& e) { return k.moment_pearson_front(e, n, f_is_x); }), integrand, allowed)
              << n << " " << c << " " << phi;
          EXPECT_NEAR(slope([&](const auto& e) { return k.moment_ellipsoid_front(e, n, f_is_x); }), integrand, allowed)
              << n << " " << c << " " << phi;
        }
      }
}

// Every place and width of the fits by its equation in the paper (with what docs/theory/moments.md corrects), in the library's arithmetic.
TEST(PhongPeakFits, PlacesAndWidthsAreThePapers) {
  using K = Kernels<double>;
  K k;
  const double quarter = std::numbers::pi / 2;
  for (int i = 0; i <= 100; ++i) {
    const double x = quarter * i / 100;
    EXPECT_NEAR(k.moment_peak_cosine(x).v, std::cos(x), 1e-10) << x;
    EXPECT_NEAR(k.moment_peak_sine(x).v, std::sin(x), 1e-9) << x;
  }
  for (const double n : {2.05, 3.05, 20.0, 501.0})
    for (const double c : {0.1, 0.6, 0.95})
      for (const int f_is_x : {0, 1}) {
        const double s2 = 1 - c * c, s = std::sqrt(s2);
        const auto point = [&](double phi) { return K::vec3(s * std::cos(phi), std::sin(phi), c * std::cos(phi)); };
        const auto edge = k.moment_edge(point(-0.4), point(0.7), K::vec3(0.0, 0.0, 1.0));
        const auto p = k.moment_peak_prepare(edge, n, f_is_x);
        // Eq. 7, N = n - 1; eq. 14.
        const double order = n - 1, widest = f_is_x ? std::numbers::pi / 3 : std::numbers::pi / 4;
        const double reduced = std::max(c - c / order, 0.0), other = std::max(c - c / std::max(order - 1, 1.0), 0.0);
        const double ratio = f_is_x ? std::sqrt(1 - reduced * reduced) : std::pow(1 - std::pow(other, 2.5), 0.45);
        EXPECT_NEAR(p.x_w.v, widest * ratio, 1e-6) << n << " " << c;
        const double x_t = std::min(p.x_w.v + 0.3946 * widest * (1 - std::pow(1 - ratio, 12)), quarter);
        EXPECT_NEAR(p.x_t.v, x_t, 1e-6) << n << " " << c;
        // Eq. 11, 15 and the following ones: widths, and each scaled peak where the tail is requested.
        const auto height = [&](double phi) { return k.moment_peak_height(s2, c * c, n, f_is_x, std::cos(phi), std::sin(phi)).v; };
        const double y_w = height(p.x_w.v) / height(0);
        EXPECT_NEAR(p.y_w.v, std::clamp(y_w, 0.01, 0.99), 1e-7);
        EXPECT_NEAR(p.y_t.v, height(x_t) / height(0), 1e-6);
        const double y = p.y_w.v, x_w = p.x_w.v;
        const double lorentzian = std::max((1 - y - 4 * x_w * x_w / (std::numbers::pi * std::numbers::pi)) / (y * x_w * x_w), 1e-3);
        const auto scaled = [&](const K::MomentFit& fit, auto peak) {
          EXPECT_NEAR(fit.tail.v, (peak(x_t) - peak(quarter)) / (1 - peak(quarter)), 1e-5) << n << " " << c << " " << f_is_x;
        };
        scaled(k.moment_fit_lorentzian(p), [&](double phi) { return 1 / (1 + lorentzian * phi * phi); });
        scaled(k.moment_fit_pearson(p), [&](double phi) { return std::pow(1 + 0.5 * lorentzian * phi * phi, -2); });
        const double cosine2 = std::cos(x_w) * std::cos(x_w), a = y * (1 - cosine2) / (cosine2 * (1 - y)), b = a * (2.1 + 1.28 * ratio);
        const auto ellipsoid = [](double w, double phi) { return w / (1 + (w - 1) * std::cos(phi) * std::cos(phi)); };
        if (std::fabs(a - 1) > 0.01) scaled(k.moment_fit_ellipsoid(edge, p), [&](double phi) { return ellipsoid(a, phi); });
        if (std::fabs(b - 1) > 0.01)
          scaled(k.moment_fit_ellipsoid_squared(edge, p), [&](double phi) { return std::pow(ellipsoid(b, phi), 2); });
      }
}

// The published choice of f by the parity of n jumps from one exponent to the next. Either form by itself does not, and a method's default
// form is the closer one.
TEST(PhongPeakFits, OneFormForEveryExponentIsContinuousAndTheDefaultTheCloser) {
  for (Method method : {Method::lorentzian, Method::pearson, Method::ellipsoid}) {
    Random random(10);
    Errors by_form[2], by_default;
    double jump[3] = {};
    for (int i = 0; i < 1500; ++i) {
      const auto c = moment::adversarial_quad(random);
      const PreparedPolygon light = prepare_polygon(c.light);
      const double n = 10 + 2 * std::round(c.n / 2), exact = exact_of(light, c.at, n), exact_next = exact_of(light, c.at, n + 1);
      const auto error = [&](PeakForm form, double exponent, double truth) {
        return phong_radiance(light, c.at, phong(exponent), {.method = method, .form = form}).x - truth;
      };
      const PeakForm forms[] = {PeakForm::one, PeakForm::x, PeakForm::by_parity};
      for (int f = 0; f < 3; ++f) jump[f] = std::max(jump[f], std::fabs(error(forms[f], n + 1, exact_next) - error(forms[f], n, exact)));
      for (int f = 0; f < 2; ++f) by_form[f].add(error(forms[f], n, exact), n);
      by_default.add(error(PeakForm::best, n, exact), n);
    }
    by_form[0].print((std::string(name_of(method)) + ", f = 1").c_str());
    by_form[1].print((std::string(name_of(method)) + ", f = x").c_str());
    std::printf("largest change from n to n + 1: f = 1 %.1e, f = x %.1e, by parity %.1e\n", jump[0], jump[1], jump[2]);
    EXPECT_LE(by_default.rms(), 1.05 * std::min(by_form[0].rms(), by_form[1].rms())) << name_of(method);
    EXPECT_GT(jump[2], 3 * std::max(jump[0], jump[1])) << name_of(method);
  }
}

TEST(PhongQuadrature, IsCloseInFloat) {
  Random random(11);
  Errors in_double;
  for (int i = 0; i < 3000; ++i) {
    const auto c = moment::adversarial_quad(random);
    const PreparedPolygon light = prepare_polygon(c.light);
    const double exact = exact_of(light, c.at, c.n);
    const double f = static_cast<double>(phong_radiance_float(light, c.at, phong(c.n), {Method::exact}).x);
    in_double.add(f - exact, c.n);
  }
  in_double.print("quadrature, 14 nodes, float");
  // Directions in float have an error of 1.2e-7; the lobe's slope is at most sqrt(n/e) = 61 over the outline's 4 lobe widths.
  EXPECT_LT(in_double.largest, 2e-4);
}

}  // namespace steradian::phong_test
