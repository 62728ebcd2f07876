// Degenerate input: every method stays finite, not negative and within the full lobe; packs agree with scalar code.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/studies/table2.h"
#include "core/float_mode.h"
#include "integrals/phong/phong.h"
#include "render/direct/lobe_packs.h"
#include "steradian/phong.h"
#include "support/adversarial_quads.h"

namespace steradian::phong_fuzz_test {
namespace {

using reference::Random;

Material phong(double n) {
  Material material;
  material.brdf = Brdf::phong;
  material.exponent = n;
  return material;
}

// A coordinate that often coincides with others and with the ends of the range.
double odd_number(Random& random) {
  static constexpr double kOdd[] = {0, 0, -0.0, 1, -1, 0.5, 1e-30, -1e-30, 1e30, -1e30, 1e-18, 1e18, 1e-7, 1 + 1e-7};
  return random.uniform() < 0.6 ? kOdd[random.bits() % std::size(kOdd)] : random.uniform(-2, 2);
}

template <class S>
typename Kernels<S>::vec3 odd_direction(Random& random) {
  Kernels<S> k;
  const typename Kernels<S>::vec3 v(odd_number(random), odd_number(random), odd_number(random));
  return k.polygon_direction(v);
}

// Walks odd outlines through the kernels themselves, which do not check that a light is flat.
template <class S, Method method, Quality quality = Quality::normal>
void walk_odd_outlines(int count) {
  Kernels<S> k;
  Random random(20);
  const FlushDenormals flush;
  for (int i = 0; i < count; ++i) {
    static constexpr double kExponents[] = {0, 1, 2, 3, 7, 8, 64, 100, 1001, 10000};
    const double n = method == Method::arvo || i % 2 ? kExponents[random.bits() % 10] : random.uniform(0, 50);
    const integrals::PhongLobe<S> lobe(n, {.relative_precision = i % 3 == 0 ? 1e-4 : 0, .form = i % 2 == 0 ? PeakForm::one : PeakForm::x});
    auto r = odd_direction<S>(random);
    r.z = abs(r.z);
    Real<S> sum(0.0);
    auto clip = k.horizon_clip_begin();
    typename Kernels<S>::vec3 outline[5];
    const int vertices = 3 + static_cast<int>(random.bits() % 3);
    for (int v = 0; v < vertices; ++v)
      outline[v] = v > 0 && random.uniform() < 0.2   ? outline[v - 1]
                   : v > 0 && random.uniform() < 0.1 ? -outline[v - 1]
                   : random.uniform() < 0.1          ? r
                                                     : odd_direction<S>(random);
    for (int v = 0; v < vertices; ++v) {
      clip = k.horizon_clip_edge(clip, outline[v], outline[(v + 1) % vertices]);
      sum += lobe.template share<method, quality>(clip.start, clip.end, r);
      if (any_lane(clip.closes)) sum += lobe.template share<method, quality>(clip.arc_start, clip.arc_end, r);
    }
    clip = k.horizon_clip_finish(clip);
    if (any_lane(clip.closes)) sum += lobe.template share<method, quality>(clip.arc_start, clip.arc_end, r);
    const S radiance = k.moment_phong_radiance(sum, Mask<S>(false)).v;
    ASSERT_TRUE(std::isfinite(sum.v)) << name_of(method) << " " << i << ": n = " << n;
    ASSERT_TRUE(radiance >= 0 && radiance <= 1) << name_of(method) << " " << i << ": " << radiance;
  }
}

template <class S>
void walk_by_every_method() {
  walk_odd_outlines<S, Method::exact>(20000);
  walk_odd_outlines<S, Method::arvo>(2000);
  walk_odd_outlines<S, Method::lorentzian>(40000);
  walk_odd_outlines<S, Method::pearson>(40000);
  walk_odd_outlines<S, Method::ellipsoid>(40000);
  walk_odd_outlines<S, Method::series>(40000);
  walk_odd_outlines<S, Method::series, Quality::high>(40000);
}

}  // namespace

TEST(PhongFuzz, KernelsStayWithinTheFullLobeInFloat) { walk_by_every_method<float>(); }
TEST(PhongFuzz, KernelsStayWithinTheFullLobeInDouble) { walk_by_every_method<double>(); }

TEST(PhongPacks, AgreeWithScalarFloatForEveryMethodAndInstructionSet) {
  const FlushDenormals flush;
  Random random(21);
  for (int i = 0; i < 60; ++i) {
    auto c = moment::adversarial_quad(random);
    const PreparedPolygon light = prepare_polygon(c.light);
    const double n = i % 4 == 0 ? random.uniform() : std::floor(std::sqrt(c.n));
    // Sixteen points around the one for which the quad was built.
    std::vector<float> a[9], result(16);
    std::vector<ShadingPoint> at;
    for (int j = 0; j < 16; ++j) {
      const auto shift = [&] { return static_cast<double>(static_cast<float>(0.02 * j * random.uniform(-1, 1))); };
      const Vec3d p{shift(), shift(), shift()};
      const Vec3d values[] = {p, c.at.normal, c.at.view};
      for (int v = 0; v < 3; ++v) {
        a[3 * v].push_back(static_cast<float>(values[v].x));
        a[3 * v + 1].push_back(static_cast<float>(values[v].y));
        a[3 * v + 2].push_back(static_cast<float>(values[v].z));
      }
      at.push_back({p, c.at.normal, c.at.view});
    }
    const auto arrays = [&](int first) { return VectorArrays{a[first].data(), a[first + 1].data(), a[first + 2].data()}; };
    const Points points{16, arrays(0), arrays(3), arrays(6)};
    for (const auto& method : moment::compared_methods()) {
      if (method.options.method == Method::arvo && n != std::floor(n)) continue;
      for (const Simd simd : available_simd()) {
        lobe_packs_for(simd)[methods::Procedure::phong_lobe](prepare_light(light), points, {phong(n), method.options}, {result.data()});
        for (std::size_t j = 0; j < 16; ++j) {
          const double scalar = static_cast<double>(phong_radiance_float(light, at[j], phong(n), method.options).x);
          // Both round directions to float, 1.2e-7, under a lobe whose slope is at most sqrt(n): n <= 100 here. The
          // recurrence's stop depends on the other lanes, by up to its precision; fits magnify roundings of widths.
          const double bound = method.options.relative_precision > 0 ? 4e-4 : 1e-4;
          ASSERT_NEAR(static_cast<double>(result[j]), scalar, bound)
              << method.name << " " << name_of(simd) << ", light " << i << ", point " << j << ", n = " << n;
        }
      }
    }
  }
}

}  // namespace steradian::phong_fuzz_test
