// The kernels of kernels/indirect/indirect.glsl against GGX itself and against the definitions that they simplify.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

#include "core/random.h"
#include "fit/lobe.h"
#include "integrals/ggx/ltc_radiance.h"
#include "integrals/tables/ggx_tables.h"
#include "lobes/lobe.h"
#include "paths.h"
#include "render/bounce/light_sets.h"
#include "render/bounce/point_light_plane.h"
#include "steradian/kernels.h"
#include "support/random_configurations.h"

namespace steradian::indirect::indirect_kernel_test {
namespace {

using namespace fit;

using D = Kernels<double>;

const double kRoughness[] = {0.2, 0.3, 0.4, 0.6, 0.8, 1.0};
const double kAngles[] = {0, 20, 40, 60, 80};

double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return (v[v.size() / 2] + v[(v.size() - 1) / 2]) / 2;
}

template <class K>
typename K::vec3 vector(Vec3d v) {
  return {v.x, v.y, v.z};
}
Vec3d plain(D::vec3 v) { return {v.x.v, v.y.v, v.z.v}; }

template <class K>
typename K::LtcMatrix matrix(const LtcInverse& m) {
  typename K::LtcMatrix k;
  k.xx = m.xx, k.xz = m.xz, k.yy = m.yy, k.zx = m.zx, k.zz = m.zz;
  return k;
}

// A surface with its lobe, in a random orientation.
template <class K>
struct RandomEnd {
  Vec3d normal, view;
  double alpha;
  LtcValue value;
  typename K::mat3 frame;
  typename K::IndirectLobe lobe;

  explicit RandomEnd(reference::Random& random, double least_roughness = 0.1) {
    K k;
    normal = random_direction(random);
    do view = random_direction(random);
    while (dot(normal, view) < 0.05);
    const double roughness = random.uniform(least_roughness, 1);
    alpha = alpha_from_roughness(roughness);
    value = ggx_compact_table().look_up(roughness, dot(normal, view));
    frame = k.frame_from_normal_and_view(vector<K>(normal), vector<K>(view));
    lobe = k.indirect_lobe(matrix<K>(value.inverse), frame);
  }
  // The lobe in a unit direction, by the table's own matrix.
  double evaluate(Vec3d l) const {
    const Frame f = Frame::from_normal_and_tangent(normal, view);
    return ltc_evaluate(value.inverse, f.to_local(l));
  }
};

TEST(IndirectKernel, PointLightIsTheLobeOverTheSquaredDistance) {
  reference::Random random(1);
  D k;
  for (int i = 0; i < 2000; ++i) {
    const RandomEnd<D> end(random);
    const Vec3d v = random_direction(random) * std::exp(random.uniform(-3, 3));
    const double expected = end.evaluate(normalized(v)) / dot(v, v);
    EXPECT_NEAR(k.indirect_point_light(end.lobe, vector<D>(v)).v, expected, 1e-11 * expected + 1e-300) << "lobe " << i;
  }
}

// The table of docs/indirect.md, row by row and digit by digit. All is in double, so no tolerance is needed.
TEST(IndirectKernel, PointLightOverAPlane) {
  std::ifstream file(test::kSourceDir + "/docs/indirect.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  for (const double roughness : {0.1, 0.2, 0.3, 0.5, 0.7, 1.0}) {
    const indirect::PointLightPlane p = indirect::point_light_over_plane(roughness, 800, 600);
    char row[80];
    std::snprintf(row, sizeof row, "| %.1f | %.4f | %.4f | %.4f |\n", roughness, p.rmse, p.relative_l2, p.mean_ratio);
    EXPECT_NE(page.find(row), std::string::npos) << "the page lacks " << row;
  }
}

template <class K>
double largest_pair_error(std::uint64_t seed, int count) {
  reference::Random random(seed);
  K k;
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const RandomEnd<K> eye(random, 0.2), light(random, 0.2);
    // Points are in front of the eye, so that not all pairs are dark.
    Vec3d l = random_direction(random);
    if (dot(l, eye.normal) < 0) l = -l;
    const double distance = std::exp(random.uniform(-2, 2));
    const auto pair =
        k.indirect_pair(vector<K>(l * distance), vector<K>(eye.normal), eye.lobe, vector<K>(-light.normal), k.indirect_turned(light.lobe));
    const double out = std::max(-dot(light.normal, l), 0.0), in = std::max(dot(eye.normal, l), 0.0);
    const double expected[] = {in / distance, out / distance, in > 0 ? eye.evaluate(l) / distance : 0,
                               out > 0 ? light.evaluate(-l) / distance : 0};
    const double found[] = {static_cast<double>(pair.to_diffuse.v), static_cast<double>(pair.from_diffuse.v),
                            static_cast<double>((pair.to_glossy * eye.lobe.scale).v),
                            static_cast<double>((pair.from_glossy * light.lobe.scale).v)};
    for (int c = 0; c < 4; ++c) worst = std::max(worst, std::fabs(found[c] - expected[c]) / (expected[c] + 1e-3 / distance));
  }
  return worst;
}

// The four halves of a pair, from one division, equal both ends' cosines and lobes over the distance.
TEST(IndirectKernel, PairHoldsBothEndsHalves) {
  EXPECT_LT(largest_pair_error<D>(2, 4000), 1e-10);
  // |w|^2 cancels by the lobe's width squared at the peak's flank: alpha >= 0.04 leaves 1/0.04^2 = 625 roundings, and |w|^4 doubles them.
  EXPECT_LT(largest_pair_error<Kernels<float>>(3, 4000), 1250 * 1.2e-7 * 8);
}

TEST(IndirectKernel, GgxEndIsTheLobeOfTheReference) {
  reference::Random random(4);
  D k;
  for (int i = 0; i < 500; ++i) {
    const RandomEnd<D> end(random);
    const Vec3d l = random_direction(random);
    Material m;
    m.brdf = Brdf::ggx;
    m.alpha_x = m.alpha_y = end.alpha;
    const Frame f = Frame::from_normal_and_tangent(end.normal, end.view);
    const lobes::LobeValue truth = lobes::Lobe(m, f.to_local(end.view)).evaluate(f.to_local(l));
    const auto found = k.indirect_ggx(end.frame, vector<D>(f.to_local(end.view)), end.alpha, vector<D>(l));
    EXPECT_NEAR(found.lobe.v, truth.plain, 1e-10 * truth.plain);
    if (!(truth.plain > 0)) continue;
    EXPECT_NEAR(found.grazing.v, truth.fresnel / truth.plain, 1e-10);
    const auto grazing = k.indirect_grazing(vector<D>(end.view), vector<D>(l * -3.0), 9.0);
    EXPECT_NEAR(grazing.v, truth.fresnel / truth.plain, 1e-9);
  }
}

TEST(IndirectKernel, LargestStretchIsTheLongestImageOfAUnitVector) {
  reference::Random random(5);
  D k;
  for (int i = 0; i < 300; ++i) {
    const RandomEnd<D> end(random);
    const double bound = k.indirect_largest_stretch(matrix<D>(end.value.inverse)).v;
    // The least image under M^-1 over unit vectors in the plane of x and z. y is separate.
    double least = std::fabs(end.value.inverse.yy);
    const LtcInverse& m = end.value.inverse;
    for (int s = 0; s < 20000; ++s) {
      const double a = std::numbers::pi * s / 20000, x = std::cos(a), z = std::sin(a);
      least = std::min(least, std::hypot(m.xx * x + m.xz * z, m.zx * x + m.zz * z));
    }
    EXPECT_GE(bound * least, 1 - 1e-9);
    EXPECT_LE(bound * least, 1 + 1e-4) << "lobe " << i;
  }
}

// Error of a fitted lobe against GGX as a virtual light: looked up for the incoming light (algorithm 2), and looked up at the outgoing
// direction (algorithm 1), without and with the factor that reciprocity requires.
struct LobeErrors {
  std::vector<double> algorithm2, algorithm1_raw, algorithm1, energy;
};
LobeErrors lobe_errors() {
  LobeErrors errors;
  constexpr int kSide = 160;
  for (const double roughness : kRoughness)
    for (const double angle : kAngles) {
      const double alpha = alpha_from_roughness(roughness);
      const Vec3d incoming = view_from_cosine(cosine(angle));
      const Lobe truth = ggx_lobe(alpha, incoming);
      const LtcValue value = ggx_compact_table().look_up(roughness, incoming.z);
      double d2 = 0, d1 = 0, raw = 0, norm = 0, energy = 0, true_energy = 0;
      for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
          const Vec3d o = truth.sample((i + 0.5) / kSide, (j + 0.5) / kSide);
          const double pdf = truth.pdf(o);
          if (!(pdf > 0) || !(o.z > 0)) continue;
          const double f = truth.evaluate(o);
          const double two = value.n_a * ltc_evaluate(value.inverse, o);
          const LtcValue out = ggx_compact_table().look_up(roughness, o.z);
          const Vec3d x = normalized(Vec3d{o.x, o.y, 0});
          const Frame turned{x, cross({0, 0, 1}, x), {0, 0, 1}};
          const double one = out.n_a * ltc_evaluate(out.inverse, turned.to_local(incoming));
          const double correction = o.z / incoming.z;
          norm += f * f / pdf;
          d2 += (two - f) * (two - f) / pdf;
          raw += (one - f) * (one - f) / pdf;
          d1 += (one * correction - f) * (one * correction - f) / pdf;
          energy += two / pdf;
          true_energy += f / pdf;
        }
      errors.algorithm2.push_back(std::sqrt(d2 / norm));
      errors.algorithm1_raw.push_back(std::sqrt(raw / norm));
      errors.algorithm1.push_back(std::sqrt(d1 / norm));
      errors.energy.push_back(energy / true_energy);
    }
  return errors;
}

TEST(IndirectKernel, LobesOfVirtualLightsAreNearGgx) {
  const LobeErrors e = lobe_errors();
  const auto [low, high] = std::minmax_element(e.energy.begin(), e.energy.end());
  std::cout << "relative L2 of " << e.algorithm2.size() << " lobes, median: algorithm 2 " << median(e.algorithm2) << " (worst "
            << *std::max_element(e.algorithm2.begin(), e.algorithm2.end()) << "), algorithm 1 " << median(e.algorithm1)
            << ", without its correction " << median(e.algorithm1_raw) << "; energy " << *low << " to " << *high << "\n";
  EXPECT_LE(median(e.algorithm2), 0.08);
  EXPECT_GT(median(e.algorithm1_raw), 4 * median(e.algorithm1));  // the missing factor matters
  EXPECT_NEAR(*low, 1, 0.03);
  EXPECT_NEAR(*high, 1, 0.03);
}

// ---- culling ---------------------------------------------------------------------------------------------------------

// A receiver at which the light's irradiance equals the threshold must lie in the spheroid.
TEST(IndirectCulling, SpheroidHoldsEveryPointAboveTheThreshold) {
  reference::Random random(6);
  D k;
  int inside = 0;
  double worst = 0;
  for (int i = 0; i < 100'000; ++i) {
    const RandomEnd<D> light(random);
    const auto turned = k.indirect_turned(light.lobe);
    const double stretch = k.indirect_largest_stretch(matrix<D>(light.value.inverse)).v;
    const double bright = std::exp(random.uniform(-5, 5)), threshold = std::exp(random.uniform(-5, 5));
    // Half of the directions are sampled from the lobe itself, because its peak decides.
    Vec3d o = random_direction(random);
    if (i % 2 == 0) {
      const Frame f = Frame::from_normal_and_tangent(light.normal, light.view);
      o = f.to_world(ggx_lobe(light.alpha, f.to_local(light.view)).sample(random.uniform(), random.uniform()));
    }
    const double intensity = bright * light.lobe.scale.v * light.evaluate(o) / light.lobe.scale.v;
    if (!(intensity > 0)) continue;
    const double distance = std::sqrt(intensity / threshold);
    const double range = std::sqrt(bright * light.lobe.scale.v * stretch / threshold);
    const Vec3d q = plain(k.indirect_spheroid(turned, vector<D>(o * -distance), range));
    worst = std::max(worst, length(q));
    ASSERT_LE(length(q), 1 + 1e-9) << "lobe " << i;
    ++inside;
  }
  std::cout << inside << " points on the edge of the light, the outermost at " << worst << " of the bound\n";
  EXPECT_GT(inside, 60'000);
  EXPECT_GT(worst, 0.99);  // the bound is tight
}

// Volumes within which a lobe's irradiance exceeds a threshold, relative to those of the spheroid and the ball.
TEST(IndirectCulling, SpheroidIsSmall) {
  std::vector<double> ratios, balls, gains;
  D k;
  for (const double roughness : kRoughness)
    for (const double angle : {0.0, 20.0, 40.0, 60.0, 80.0, 85.0}) {
      const Vec3d view = view_from_cosine(cosine(angle));
      const LtcValue value = ggx_compact_table().look_up(roughness, view.z);
      const auto m = matrix<D>(value.inverse);
      // The true volume at threshold 1, with range^2 = intensity, sampled by the transformed cosine itself.
      const Lobe truth = ggx_lobe(alpha_from_roughness(roughness), view);
      constexpr int kSide = 400;
      double volume = 0, most = 0, total = 0, squares = 0;
      for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
          const Vec3d o = truth.sample((i + 0.5) / kSide, (j + 0.5) / kSide);
          const double pdf = truth.pdf(o), n = double{kSide} * kSide;
          if (!(pdf > 0)) continue;
          const double intensity = ltc_evaluate(value.inverse, o);
          most = std::max(most, intensity);
          volume += std::pow(intensity, 1.5) / (3 * pdf * n);
          total += intensity / (pdf * n);
          squares += intensity * intensity / (pdf * n);
        }
      const auto lobe = k.indirect_lobe(m, k.frame_from_normal_and_view({0.0, 0.0, 1.0}, vector<D>(view)));
      const double scale = lobe.scale.v, range2 = scale * k.indirect_largest_stretch(m).v;
      const double determinant = scale * std::numbers::pi;  // determinant of M^-1
      const double bound = 4 * std::numbers::pi / 3 * 0.54 * 0.628 * 0.628 * std::pow(range2, 1.5) / determinant;
      ratios.push_back(bound / volume);
      balls.push_back(4 * std::numbers::pi / 3 * std::pow(most, 1.5) / volume);
      // Far from the light, pairs are kept with probability bound / (d^2 threshold). Per length of the way out, a ball costs 4 pi most and
      // its variance is squares / most. A tight bound costs its fraction of the volume and varies by total.
      gains.push_back(4 * std::numbers::pi * most * (squares / most) / (ratios.back() * total * total));
    }
  std::cout << "volume over the true one: spheroid median " << median(ratios) << ", worst "
            << *std::max_element(ratios.begin(), ratios.end()) << "; ball median " << median(balls) << ", worst "
            << *std::max_element(balls.begin(), balls.end()) << "; cost times variance below the ball's: median " << median(gains)
            << ", least " << *std::min_element(gains.begin(), gains.end()) << "\n";
  EXPECT_LE(median(ratios), 1.8);
  EXPECT_LE(*std::max_element(ratios.begin(), ratios.end()), 2.6);
  EXPECT_GE(median(gains), 2.5);
}

TEST(IndirectCulling, WhatIsKeptWeighsWhatIsLeftOut) {
  D k;
  reference::Random random(7);
  for (int i = 0; i < 50; ++i) {
    const double value = std::exp(random.uniform(-4, 4)), reach = std::exp(random.uniform(-2, 2));
    double sum = 0;
    constexpr int kSteps = 100'000;
    for (int s = 0; s < kSteps; ++s) sum += k.indirect_kept(value, reach, (s + 0.5) / kSteps).v;
    EXPECT_NEAR(sum / kSteps, value, reach / kSteps + 1e-9 * value);
  }
}

}  // namespace
}  // namespace steradian::indirect::indirect_kernel_test
