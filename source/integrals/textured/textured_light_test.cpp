#include "integrals/textured/textured_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "fit/textured_error.h"
#include "integrals/tables/ggx_tables.h"
#include "steradian/kernels.h"

namespace steradian::textured_light_test {
namespace {

using namespace fit;

using K = Kernels<double>;
using reference::Random;

K::LtcMatrix some_matrix(Random& random) {
  K k;
  const double cosine = random.uniform(0.1, 1), roughness = random.uniform(0.1, 1);
  const LtcShape s = ggx_compact_table().entry(roughness, cosine).shape;
  K::vec4 e;
  e.x = s.e00, e.y = s.e11, e.z = s.e02, e.w = s.e20;
  return k.ltc_from_compact(e, roughness * roughness, {std::sqrt(1 - cosine * cosine), 0.0, cosine});
}

K::vec3 direction(Random& random) {
  const Vec3d v = normalized(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 1)});
  return {v.x, v.y, v.z};
}

double distance(K::vec3 a, K::vec3 b) { return std::sqrt(dot(a - b, a - b).v); }

// Intersection of M w t with the plane.
K::vec3 hit(const K::LtcMatrix& m, K::vec3 w, K::vec3 normal, double height) {
  const K::vec3 l = K{}.ltc_texture_transform_back(m, w);
  return l * (K::real(height) / dot(normal, l));
}

// A square light of side 2 in the plane z = 1 that shines downwards, with a texture of n x n texels over it.
AreaLight square_light(int n, const std::vector<std::uint8_t>& grey, std::vector<Image>& images) {
  AreaLight light;
  light.shape = Polygon{{{-1, 1, 1}, {1, 1, 1}, {1, -1, 1}, {-1, -1, 1}}, {}};
  Image image{"texture", n, n, {}};
  for (const std::uint8_t g : grey) image.rgba.insert(image.rgba.end(), {g, g, g, 255});
  images = {image};
  LightTexture t;
  t.use.image = 0;
  t.origin = {-1, 1, 1};
  t.du = {0.5, 0, 0};
  t.dv = {0, -0.5, 0};
  t.use.wrap_u = t.use.wrap_v = Wrap::clamp_to_edge;
  light.texture = t;
  return light;
}

}  // namespace

TEST(TexturedLight, BackTransformUndoesTheTransform) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const auto m = some_matrix(random);
    const auto v = direction(random), w = K{}.ltc_texture_transform_back(m, K{}.ltc_transform(m, v));
    EXPECT_LT(distance(w * inversesqrt(dot(w, w)), v), 1e-12);
  }
}

// The footprint's radii are the derivative of the point at which a turned direction meets the plane. The test uses central differences of
// step h. Their error is of the order of h^2 = 1e-8 and of the rounding over h, 1e-12.
TEST(TexturedLight, FootprintIsTheDerivativeOfTheHit) {
  Random random(2);
  int tested = 0;
  for (int i = 0; i < 200; ++i) {
    K k;
    const auto m = some_matrix(random);
    const auto w = direction(random), normal = direction(random);
    const auto l = k.ltc_texture_transform_back(m, w);
    if (std::fabs((dot(normal, l) * inversesqrt(dot(l, l))).v) < 0.2) continue;
    const double height = dot(normal, l).v > 0 ? 1 : -1;
    const auto f = k.ltc_texture_footprint(m, w * K::real(0.3), normal, height);
    ASSERT_TRUE(any_lane(f.valid));
    EXPECT_LT(distance(f.center, hit(m, w, normal, height)), 1e-9);
    const auto across = k.frame_from_normal(w);
    const double h = 1e-4;
    const auto slope = [&](K::vec3 e) {
      return (hit(m, w + e * K::real(h), normal, height) - hit(m, w - e * K::real(h), normal, height)) * K::real(0.5 / h);
    };
    const double size = std::sqrt((dot(f.axis_a, f.axis_a) + dot(f.axis_b, f.axis_b)).v);
    EXPECT_LT(distance(f.axis_a, slope(transform(across, {1.0, 0.0, 0.0}))), 1e-5 * size * std::max(1.0, size));
    EXPECT_LT(distance(f.axis_b, slope(transform(across, {0.0, 1.0, 0.0}))), 1e-5 * size * std::max(1.0, size));
    ++tested;
  }
  EXPECT_GT(tested, 80);
}

TEST(TexturedLight, NothingIsSeenOfALightThatSendsNothing) {
  K k;
  const auto f = k.ltc_texture_footprint(k.ltc_texture_diffuse(), {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1.0);
  EXPECT_FALSE(any_lane(f.valid));
  EXPECT_EQ(dot(f.center, f.center).v, 0);
}

TEST(TexturedLight, AxesOfAnEllipseArePrincipal) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const double length_a = std::exp(random.uniform(-8, 8)), length_b = std::exp(random.uniform(-8, 8));
    const double turn = random.uniform(0, 2 * M_PI), mix = random.uniform(0, 2 * M_PI);
    const double c = std::cos(turn), s = std::sin(turn);
    // Conjugate radii p cos + q sin, q cos - p sin of the ellipse with perpendicular half axes p, q.
    const double px = length_a * c, py = length_a * s, qx = -length_b * s, qy = length_b * c;
    const double cm = std::cos(mix), sm = std::sin(mix);
    const auto e = K{}.ltc_texture_axes({px * cm + qx * sm, py * cm + qy * sm}, {qx * cm - px * sm, qy * cm - py * sm});
    const double longest = std::max(length_a, length_b), shortest = std::min(length_a, length_b);
    EXPECT_NEAR(std::hypot(e.major.x.v, e.major.y.v), longest, 1e-12 * longest);
    EXPECT_NEAR(e.minor.v, shortest, 1e-12 * longest);
  }
}

// On a light that is a Gaussian itself, the centroid under the placed Gaussian is at the requested place. If the Gaussian would have to
// move further than 2.5 of its deviations, it moves only that far.
TEST(TexturedLight, PlacedGaussianHasTheCentroidAskedFor) {
  Random random(4);
  int held = 0;
  for (int i = 0; i < 100; ++i) {
    K k;
    K::LtcTextureEllipse g;
    const double major = random.uniform(0.1, 3), turn = random.uniform(0, M_PI), minor = random.uniform(0.1, 1) * major;
    g.major = {major * std::cos(turn), major * std::sin(turn)};
    g.minor = minor;
    const double vxx = random.uniform(0.1, 1), vyy = random.uniform(0.1, 1), vxy = random.uniform(-0.9, 0.9) * std::sqrt(vxx * vyy);
    const double ax = random.uniform(-1, 1), ay = random.uniform(-1, 1);
    const double lx = i % 2 == 0 ? 0 : random.uniform(-1, 1), ly = i % 2 == 0 ? 0 : random.uniform(-1, 1);  // the cosine's slope
    const auto place = k.ltc_texture_place(g, {ax, ay}, {lx, ly}, {vxx, vxy, vyy});
    // V (V + S)^-1 x
    const double c = std::cos(turn), s = std::sin(turn), a2 = major * major, b2 = minor * minor;
    const double sxx = a2 * c * c + b2 * s * s, sxy = (a2 - b2) * c * s, syy = a2 * s * s + b2 * c * c;
    const double txx = vxx + sxx, txy = vxy + sxy, tyy = vyy + syy, det = txx * tyy - txy * txy;
    const double det_s = sxx * syy - sxy * sxy, det_v = vxx * vyy - vxy * vxy;
    // It is moved along (V^-1 + S^-1)^-1 slope = S (V + S)^-1 V slope = p, to where exp(-x^2/2) (1 + x sqrt(p.slope)) is largest.
    const double wx = vxx * lx + vxy * ly, wy = vxy * lx + vyy * ly;
    const double zx = (tyy * wx - txy * wy) / det, zy = (txx * wy - txy * wx) / det;
    const double px = sxx * zx + sxy * zy, py = sxy * zx + syy * zy, share = 2 / (1 + std::sqrt(1 + 4 * (px * lx + py * ly)));
    const double dx = ax + share * px, dy = ay + share * py;
    const double ex = (vyy * dx - vxy * dy) / det_v, ey = (vxx * dy - vxy * dx) / det_v;
    const double wanted = std::sqrt(sxx * ex * ex + 2 * sxy * ex * ey + syy * ey * ey);
    if (wanted > 2.5) {
      const double mx = place.x.v - dx, my = place.y.v - dy;
      EXPECT_NEAR(std::sqrt((syy * mx * mx - 2 * sxy * mx * my + sxx * my * my) / det_s), 2.5, 1e-3);
      ++held;
      continue;
    }
    const double x = (tyy * place.x.v - txy * place.y.v) / det, y = (txx * place.y.v - txy * place.x.v) / det;
    // The kernel widens the light by a millionth of its variance.
    EXPECT_NEAR(vxx * x + vxy * y, dx, 2e-4);
    EXPECT_NEAR(vxy * x + vyy * y, dy, 2e-4);
  }
  EXPECT_GT(held, 5);
  EXPECT_LT(held, 95);
}

// The mixture's weight and widths minimise the square of the residual of k K_1(k) under dk/k.
TEST(TexturedLight, WidthsFitTheSpectrumOfTheCosine) {
  const auto rest = [](double weight, double first, double second) {
    double sum = 0;
    for (double log_k = -10; log_k < 4; log_k += 0.02) {
      const double k = std::exp(log_k), spectrum = k * std::cyl_bessel_k(1.0, k);
      const double fit = weight * std::exp(-first * first * k * k / 2) + (1 - weight) * std::exp(-second * second * k * k / 2);
      sum += (spectrum - fit) * (spectrum - fit) * 0.02;
    }
    return sum;
  };
  const double w = kMixture[0].weight, a = kMixture[0].width, b = kMixture[1].width, best = rest(w, a, b);
  EXPECT_DOUBLE_EQ(kMixture[0].weight + kMixture[1].weight, 1);
  EXPECT_LT(best, 8e-4);
  // They are rounded to two digits: any step of two hundredths (of five for the flat ones) is worse.
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_GT(rest(w + 0.05 * sign, a, b), best);
    EXPECT_GT(rest(w, a + 0.02 * sign, b), best);
    EXPECT_GT(rest(w, a, b + 0.05 * sign), best);
  }
}

// Levels against the Gaussian's integral over the light, by a fine sum, for radiance and coverage.
TEST(FilteredTexture, LevelsAreGaussianBlurs) {
  constexpr int kTexels = 32;
  std::vector<std::uint8_t> grey;
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x) grey.push_back(x < kTexels / 2 ? 0 : 204);
  std::vector<Image> images;
  const AreaLight light = square_light(kTexels, grey, images);
  const FilteredTexture texture(light, prepare_polygon(flat_polygon(light)), images);
  // A blurred step of height 0.8 has a second derivative of at most 0.242 0.8 / sigma^2. Bilinear look-up between texels of half a sigma
  // adds an eighth of a quarter of that: 0.006. A blur cut at 3 sigma omits 0.0027 of 0.8.
  double worst = 0;
  for (const double sigma : {0.125, 0.25, 0.5, 1.0, 2.0})  // levels: texels are 1/16, the finest sigma 1/32
    for (const double x : {-1.2, -0.4, 0.3, 0.95})
      for (const double y : {-0.9, 0.1}) {
        const Vec3f seen = texture.radiance(texture.under({x, y, sigma, 0, sigma}));
        double sum = 0, total = 0;
        constexpr int kSteps = 256;
        for (int j = 0; j < kSteps; ++j)
          for (int i = 0; i < kSteps; ++i) {
            const double u = (i + 0.5) / kSteps * 2 - 1, v = (j + 0.5) / kSteps * 2 - 1;
            const Vec3d p = Vec3d{u, v, 1};
            const Vec3d q = p - texture.origin();
            const double px = dot(q, texture.axis_x()) - x, py = dot(q, texture.axis_y()) - y;
            const double w = std::exp(-(px * px + py * py) / (2 * sigma * sigma));
            sum += w * texture_radiance(*light.texture, images, p).x;
            total += w;
          }
        const double error = std::fabs(static_cast<double>(seen.x) - sum / total);
        EXPECT_LT(error, 0.0082) << sigma << " " << x << " " << y;
        worst = std::max(worst, error);
      }
  std::printf("largest difference of a blurred radiance %.4f\n", worst);
}

TEST(FilteredTexture, ConstantStaysConstantEverywhere) {
  std::vector<Image> images;
  const AreaLight light = square_light(4, std::vector<std::uint8_t>(16, 102), images);
  const FilteredTexture texture(light, prepare_polygon(flat_polygon(light)), images);
  const float expected = 102.0f / 255;
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const double sigma = std::exp(random.uniform(-6, 3));
    const Vec3f seen =
        texture.radiance(texture.under({random.uniform(-3, 3), random.uniform(-3, 3), 5 * sigma, sigma * random.uniform(-1, 1), sigma}));
    EXPECT_NEAR(seen.x, expected, 2e-6f) << sigma;  // sums of up to 200 terms of one sign, divided
  }
}

// Every table row is within the accuracy that docs/theory/ltc.md promises for its texture: 2 %, plus half a percent for the grid of the
// test.
TEST(TexturedLight, ErrorsAreThoseOfTheTable) {
  TexturedErrorOptions options;
  options.setups = 12;
  options.samples = 80;
  options.distances = 1;
  const auto rows = measure_textured_error(options);
  ASSERT_EQ(rows.size(), 6u);
  for (const TexturedErrorRow& row : rows)
    for (std::size_t t = 0; t < row.error.size(); ++t) {
      EXPECT_LT(row.error[t], 0.025) << row.roughness << " " << test_textures()[t].name;
      // If the mean is already good (fine checkers, rough surfaces), there is nothing to gain.
      if (row.mean[t] > 0.05) {
        EXPECT_LT(row.error[t], 0.2 * row.mean[t]) << row.roughness << " " << test_textures()[t].name;
      }
    }
  std::printf("%s", textured_error_text(rows).c_str());
}

// Cosine-weighted light at a floor's point from a square light: its red part, and all of it, as sums over the light's points.
struct Shine {
  double red, all;
};
Shine shine_at(const AreaLight& light, const std::vector<Image>& images, Vec3d p, int steps) {
  Shine shine{};
  for (int b = 0; b < steps; ++b)
    for (int a = 0; a < steps; ++a) {
      const Vec3d q{-1 + 2 * (a + 0.5) / steps, 1 - 2 * (b + 0.5) / steps, 1}, r = q - p;
      const double weight = 1 / (dot(r, r) * dot(r, r));
      shine.all += weight;
      shine.red += weight * texture_radiance(*light.texture, images, q).x;
    }
  return shine;
}

// A floor under a light of which only a corner of a sixteenth shines, and under one that is half black, against the sum over its points.
TEST(TexturedLight, LitCornersAndHalvesOverAFloor) {
  for (const bool corner : {true, false}) {
    std::vector<std::uint8_t> grey;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) grey.push_back(x < (corner ? 16 : 32) && (!corner || y < 16) ? 255 : 0);
    std::vector<Image> images;
    const AreaLight light = square_light(64, grey, images);
    const TexturedLight textured(light, prepare_polygon(flat_polygon(light)), images);
    double error = 0, signal = 0;
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 9; ++i) {
        const Vec3d p{-2 + 0.5 * i, -2 + 0.5 * j, 0};
        const auto [lit, all] = shine_at(light, images, p, 192);
        const double value = static_cast<double>(textured.seen_by_diffuse({p, {0, 0, 1}, {0, 0, 1}}).x) * all;
        error += (value - lit) * (value - lit);
        signal += lit * lit;
      }
    EXPECT_LT(std::sqrt(error / signal), 0.02) << (corner ? "corner" : "half");
  }
}

// Red and green squares of one luminance: only their colour distinguishes the cells.
TEST(TexturedLight, ColoursOfOneLuminance) {
  std::vector<Image> images;
  const AreaLight light = square_light(64, std::vector<std::uint8_t>(64 * 64, 0), images);
  for (std::size_t i = 0; i < 64 * 64; ++i) images[0].rgba[4 * i + ((i % 64) / 16 + i / 1024) % 2] = 255;
  const TexturedLight textured(light, prepare_polygon(flat_polygon(light)), images);
  double error = 0, signal = 0;
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 9; ++i) {
      const Vec3d p{-1 + 0.25 * i, -1 + 0.25 * j, 0.7};
      const auto [red, all] = shine_at(light, images, p, 96);
      const double off = static_cast<double>(textured.seen_by_diffuse({p, {0, 0, 1}, {0, 0, 1}}).x) - red / all;
      error += off * off;
      signal += red / all * (red / all);
    }
  std::printf("red of red and green squares: relative L2 %.1e\n", std::sqrt(error / signal));
  EXPECT_LT(std::sqrt(error / signal), 0.02);
}

}  // namespace steradian::textured_light_test
