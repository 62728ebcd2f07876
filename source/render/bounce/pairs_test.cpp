// The sums of the bench's pairs, in float on packs, against the sum over virtual lights in double.
#include "render/bounce/pairs.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "core/random.h"
#include "integrals/tables/ggx_tables.h"
#include "render/bounce/true_light.h"

namespace steradian::indirect::pairs_test {
namespace {

constexpr std::size_t kReceivers = 32, kLights = 64;
constexpr Vec3f kAlbedo{0.5f, 0.4f, 0.3f}, kF0{0.04f, 0.05f, 0.06f}, kF90{1, 1, 1};

// Glossy dielectrics on the lower side of a box that are lit by others on its upper side.
struct Pairs {
  Receivers receivers;
  ShadowMap map;
  LtcPackTables tables = ltc_pack_tables(Method::ltc_compact);
  IncomingLight light;

  Pairs() {
    reference::Random random(7);
    const auto number = [&](double low, double high) { return static_cast<float>(random.uniform(low, high)); };
    const auto direction = [&](Vec3f about) { return normalized(about + Vec3f{number(-0.7, 0.7), number(-0.7, 0.7), number(-0.7, 0.7)}); };
    Receivers& r = receivers;
    for (VectorArray* a : {&r.position, &r.normal, &r.view, &r.f0, &r.f90, &light.diffuse, &light.glossy}) a->resize(kReceivers);
    r.alpha.resize(kReceivers);
    r.glossy.resize(kReceivers);
    for (std::size_t i = 0; i < kReceivers; ++i) {
      r.position.put(i, {number(-2, 2), number(-0.2, 0), number(-2, 2)});
      r.normal.put(i, direction({0, 1, 0}));
      r.view.put(i, direction(r.normal[i]));
      r.alpha[i] = number(0.1, 0.8);
      r.glossy[i] = 1;
      r.f0.put(i, kF0);
      r.f90.put(i, kF90);
    }
    map.resize(kLights);
    for (std::size_t i = 0; i < kLights; ++i) {
      map.position.put(i, {number(-2, 2), number(1, 1.5), number(-2, 2)});
      map.normal.put(i, direction({0, -1, 0}));
      map.incoming.put(i, direction(map.normal[i]));
      map.flux.put(i, {number(0.5, 1), number(0.5, 1), number(0.5, 1)});
      map.albedo.put(i, kAlbedo);
      map.f0.put(i, kF0);
      map.f90.put(i, kF90);
      map.alpha[i] = number(0.1, 0.8);
    }
  }

  // By algorithm 2. Fresnel is averaged over the lobe, or by pair.
  std::vector<PairLight> lights(bool by_pair) const {
    LobeArrays lobes(map.alpha.size());
    virtual_light_table_for(active_simd()).prepare(map, tables, lobes);
    std::vector<PairLight> result;
    for (std::size_t i = 0; i < kLights; ++i) {
      const Vec3f flux = map.flux[i], plain = flux * (lobes.scale[i] * lobes.n_a[i]);
      const Vec3f rest = kF90 - kF0;
      const Vec3f mean = flux * (kF0 * lobes.n_a[i] + rest * lobes.f_a[i]) * lobes.scale[i];
      result.push_back({map.position[i], lobes.x[i], lobes.y[i], lobes.z[i], -map.normal[i], diffuse(i), by_pair ? plain * kF0 : mean,
                        by_pair ? plain * rest : Vec3f{}, map.incoming[i]});
    }
    return result;
  }
  std::vector<GgxPairLight> lights_by_surface() const {
    std::vector<GgxPairLight> result;
    for (std::size_t i = 0; i < kLights; ++i) {
      const Vec3f n = map.normal[i], w = map.incoming[i], x = normalized(w - n * dot(n, w));
      result.push_back({map.position[i], x, cross(n, x), n, dot(x, w), dot(n, w), map.alpha[i], diffuse(i), map.flux[i] * kF0,
                        map.flux[i] * (kF90 - kF0)});
    }
    return result;
  }
  Vec3f diffuse(std::size_t i) const { return map.flux[i] * kAlbedo * (1 / std::numbers::pi_v<float>); }

  // Relative L2 of the light at all receivers from the sum in double. The light's glossy part is that of the lobe, or without Fresnel.
  enum class Glossy { whole, demodulated };
  double error(SumLobe lobe, Glossy glossy) const {
    double squares = 0, difference = 0;
    for (std::size_t i = 0; i < kReceivers; ++i) {
      Surface s;
      s.position = receivers.position[i];
      s.normal = receivers.normal[i];
      s.albedo = kAlbedo;
      s.f0 = kF0;
      s.f90 = kF90;
      s.alpha_x = s.alpha_y = receivers.alpha[i];
      const Vec3d truth = sum_virtual_lights(map, s, receivers.view[i], {lobe});
      const LtcValue seen = ggx_compact_table().look_up(std::sqrt(static_cast<double>(receivers.alpha[i])),
                                                        static_cast<double>(dot(receivers.normal[i], receivers.view[i])));
      const Vec3d f0 = static_cast<Vec3d>(kF0), rest = static_cast<Vec3d>(kF90) - f0;
      const Vec3d fresnel = glossy == Glossy::whole ? Vec3d{1, 1, 1} : f0 * seen.n_a + rest * seen.f_a;
      const Vec3d found = static_cast<Vec3d>(light.diffuse[i] * kAlbedo) / std::numbers::pi + static_cast<Vec3d>(light.glossy[i]) * fresnel;
      squares += dot(truth, truth);
      difference += dot(found - truth, found - truth);
    }
    return std::sqrt(difference / squares);
  }
};

// The bound is that of sums of pictures (IndirectLighting.SumOnPacksIsTheSumInDouble).
TEST(IndirectPairs, AreTheSumsInDouble) {
  for (const Simd simd : available_simd()) {
    Pairs p;
    const PairTable& table = pair_table_for(simd);
    const std::vector<GgxPairLight> by_surface = p.lights_by_surface();
    table.ltc(p.lights(false).data(), kLights, p.receivers, p.tables, p.light);
    EXPECT_LT(p.error(SumLobe::ltc_averaged, Pairs::Glossy::demodulated), 2e-4) << name_of(simd);
    table.ltc_schlick(p.lights(true).data(), kLights, p.receivers, p.tables, p.light);
    EXPECT_LT(p.error(SumLobe::ltc, Pairs::Glossy::demodulated), 2e-4) << name_of(simd);
    table.ltc_outgoing(by_surface.data(), kLights, p.receivers, p.tables, p.light);
    EXPECT_LT(p.error(SumLobe::ltc_outgoing, Pairs::Glossy::demodulated), 2e-4) << name_of(simd);
    EXPECT_GT(p.error(SumLobe::ltc_averaged, Pairs::Glossy::demodulated), 1e-3) << "the two algorithms differ by the fit";
    table.ggx(by_surface.data(), kLights, p.receivers, p.light);
    EXPECT_LT(p.error(SumLobe::ggx, Pairs::Glossy::whole), 2e-4) << name_of(simd);
  }
}

}  // namespace
}  // namespace steradian::indirect::pairs_test
