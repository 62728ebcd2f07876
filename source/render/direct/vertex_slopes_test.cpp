// Derivatives by vertices on packs against the same formulas in double, and their values against those of LobePacks.
#include "render/direct/vertex_slopes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "integrals/phong/phong_derivatives.h"
#include "integrals/polygon_slopes.h"
#include "steradian/ltc.h"
#include "support/random_configurations.h"

namespace steradian::vertex_slopes_test {
namespace {

using K = Kernels<double>;
using slopes::BothParts;

constexpr std::size_t kPoints = 256, kVertices = 4;

// Surface points about one quad: from a size of the quad to a thousand sizes away, at any slant. Views reach 88 degrees from the normal,
// and widths go from 1e-4 to 1. All numbers are floats, so that the judge sees the same ones.
struct Quads {
  PreparedPolygon light;
  PackLight pack;
  std::vector<float> position[3], normal[3], view[3], zero = std::vector<float>(kPoints), alpha;

  explicit Quads(reference::Random& random) {
    const Frame plane = Frame::from_normal(reference::random_direction(random));
    const double aspect = random.uniform(0.1, 1);
    PolygonLight quad;
    quad.two_sided = true;
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
      quad.vertices.push_back(Vec3d(static_cast<Vec3f>(plane.x * x + plane.y * (y * aspect))));
    light = prepare_polygon(quad);
    pack = prepare_light(light);
    while (alpha.size() < kPoints) {
      const Vec3d towards = reference::random_direction(random);
      const Vec3d p = towards * std::exp(random.uniform(0, std::log(1000.0)));
      if (std::fabs(dot(towards, plane.z)) < 0.01) continue;  // an edge-on light is a sliver
      const Vec3d n = normalized(-towards + reference::random_direction(random) * random.uniform(0, 1.2));
      const double slant = random.uniform(0, 88 * std::numbers::pi / 180), turn = random.uniform(0, 2 * std::numbers::pi);
      const Frame about = Frame::from_normal(n);
      const Vec3d v = about.to_world({std::sin(slant) * std::cos(turn), std::sin(slant) * std::sin(turn), std::cos(slant)});
      const auto put = [](std::vector<float>* to, Vec3d from) {
        to[0].push_back(static_cast<float>(from.x));
        to[1].push_back(static_cast<float>(from.y));
        to[2].push_back(static_cast<float>(from.z));
      };
      put(position, p);
      put(normal, n);
      put(view, v);
      alpha.push_back(static_cast<float>(std::exp(random.uniform(std::log(1e-4), 0))));
    }
  }

  static VectorArrays arrays(const std::vector<float>* v) { return {v[0].data(), v[1].data(), v[2].data()}; }
  Points points() const {
    return {kPoints, arrays(position), arrays(normal), arrays(view), {zero.data(), zero.data(), zero.data()}, alpha.data(), alpha.data()};
  }
  static Vec3d at(const std::vector<float>* v, std::size_t i) { return Vec3d(Vec3f{v[0][i], v[1][i], v[2][i]}); }
  ShadingPoint point(std::size_t i) const { return {at(position, i), normalized(at(normal, i)), normalized(at(view, i))}; }
};

struct Errors {
  std::vector<double> all;

  double at(double share) const { return all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))]; }
  void print(const char* name) {
    std::sort(all.begin(), all.end());
    std::printf("%s, %zu quads in float packs: 99 %% %.1e, 99.9 %% %.1e, worst %.1e of the largest derivative\n", name, all.size(),
                at(0.99), at(0.999), all.back());
  }
};

// run(quads, result): the packs. judge(quads, i): the parts' derivatives by the vertices at point i, in walk order. least(quads, i): the
// size that the largest derivative counts as at least.
Errors errors_of(std::uint64_t seed, int lights, const std::function<void(const Quads&, const VertexSlopes&)>& run,
                 const std::function<std::vector<BothParts>(const Quads&, std::size_t)>& judge,
                 const std::function<double(const Quads&, std::size_t)>& least = {}) {
  reference::Random random(seed);
  Errors errors;
  std::vector<float> value(2 * kPoints), plain(3 * kVertices * kPoints), fresnel(3 * kVertices * kPoints);
  for (int l = 0; l < lights; ++l) {
    const Quads quads(random);
    run(quads, {{value.data(), value.data() + kPoints}, plain.data(), fresnel.data()});
    for (std::size_t i = 0; i < kPoints; ++i) {
      const std::vector<BothParts> truth = judge(quads, i);
      double largest = 0, off = 0;
      for (std::size_t v = 0; v < kVertices; ++v) {
        const auto got = [&](const std::vector<float>& from) {
          return Vec3d(Vec3f{from[(3 * v) * kPoints + i], from[(3 * v + 1) * kPoints + i], from[(3 * v + 2) * kPoints + i]});
        };
        largest = std::max(largest, length(truth[v].plain));
        off = std::max(off, length(got(plain) - truth[v].plain));
        EXPECT_TRUE(std::isfinite(length(got(plain))) && std::isfinite(length(got(fresnel))));
      }
      if (least) largest = std::max(largest, least(quads, i));
      if (largest > 1e-12) errors.all.push_back(off / largest);
    }
  }
  return errors;
}

BothParts parts(const K::vec3& v) { return {slopes::to_vector(v), {}}; }

int side_of(const Quads& quads, std::size_t i) { return quads.light.side_of(quads.point(i).position); }

}  // namespace

// A direction in float is 6e-8 off, and the shortest edges are 1e-4 wide: 6e-4 of what they give.
TEST(VertexSlopes, OfLambertKeepTheirDigits) {
  Errors errors = errors_of(
      1, 640, [](const Quads& q, const VertexSlopes& to) { vertex_slope_packs_for(active_simd()).diffuse(q.pack, q.points(), {}, to); },
      [](const Quads& q, std::size_t i) {
        const ShadingPoint p = q.point(i);
        return slopes::by_edges(q.light, side_of(q, i), p.position, Frame::from_normal(p.normal), [](const auto& a, const auto& b) {
          const auto s = K().polygon_edge_slopes(a, b);
          return slopes::EdgeDerivatives{parts(s.normal * s.by_start), parts(s.normal * s.by_end)};
        });
      });
  errors.print("Lambert");
  EXPECT_GT(errors.all.size(), 150000u);
  EXPECT_LT(errors.at(0.999), 1e-3);
}

TEST(VertexSlopes, OfTransformedCosinesKeepTheirDigits) {
  const LtcPackTables tables = ltc_pack_tables(Method::ltc);
  const Material ggx{.brdf = Brdf::ggx};
  Errors errors = errors_of(
      2, 640,
      [&](const Quads& q, const VertexSlopes& to) {
        vertex_slope_packs_for(active_simd()).ltc(q.pack, q.points(), {{}, {Method::ltc}, &tables}, to);
      },
      [&](const Quads& q, std::size_t i) {
        Material m = ggx;
        m.alpha_x = m.alpha_y = static_cast<double>(q.alpha[i]);
        m.f0 = m.f90 = {1, 1, 1};
        const RadianceDerivatives d = ltc_radiance_derivatives(LtcMethod::classic, q.light, q.point(i), m);
        std::vector<BothParts> result;
        for (const auto& v : d.vertices) result.push_back({v[0], {}});
        return result;
      });
  errors.print("transformed cosines");
  EXPECT_GT(errors.all.size(), 100000u);
  EXPECT_LT(errors.at(0.99), 1e-3);
}

// Judged by Gauss and Kronrod's rule in double. Lights that the lobe barely reaches count as fractions of what its hundredth part gives:
// the series of the cosines is 9e-5 of a half circle off at exponent 0, 4e-5 from 1 on, 7e-6 from 5 on.
TEST(VertexSlopes, OfPhongKeepTheirDigits) {
  for (const double exponent : {0.0, 1.0, 5.5, 20.0, 300.0}) {
    Material m{.brdf = Brdf::phong, .exponent = exponent};
    m.albedo = {1, 1, 1};
    Errors errors = errors_of(
        5, 64, [&](const Quads& q, const VertexSlopes& to) { vertex_slope_packs_for(active_simd()).phong(q.pack, q.points(), {m}, to); },
        [&](const Quads& q, std::size_t i) { return slopes::phong_derivatives(q.light, side_of(q, i), q.point(i), m).by_vertex; },
        [&](const Quads& q, std::size_t i) {
          const Vec3d p = q.point(i).position;
          return 0.01 * (exponent + 1) / (2 * std::numbers::pi) / dot(p, p);
        });
    errors.print(("Phong, exponent " + std::to_string(exponent)).c_str());
    EXPECT_GT(errors.all.size(), 15000u);
    EXPECT_LT(errors.at(0.99), 1e-3);
  }
}

TEST(VertexSlopes, OfGgxKeepTheirDigits) {
  Errors errors = errors_of(
      3, 640,
      [](const Quads& q, const VertexSlopes& to) {
        vertex_slope_packs_for(active_simd()).closed_form(q.pack, q.points(), {{}, {Method::closed_form}}, to);
      },
      [](const Quads& q, std::size_t i) {
        const ShadingPoint p = q.point(i);
        const Frame frame = Frame::from_normal(p.normal);
        const auto alpha = static_cast<double>(q.alpha[i]);
        const auto view = K().ggx_view(integrals::to_kernel<double>(frame.to_local(p.view)), alpha, alpha);
        return slopes::by_edges(q.light, side_of(q, i), p.position, frame, [&](const auto& a, const auto& b) {
          const auto s = K().ggx_edge_slopes(view, a, b, 1.0, 4, 1);
          return slopes::EdgeDerivatives{{slopes::to_vector(s.normal * s.by_start.x), slopes::to_vector(s.normal * s.by_start.y)},
                                         {slopes::to_vector(s.normal * s.by_end.x), slopes::to_vector(s.normal * s.by_end.y)}};
        });
      });
  errors.print("GGX");
  EXPECT_GT(errors.all.size(), 100000u);
  EXPECT_LT(errors.at(0.99), 1e-3);
}

// The walk that has the derivatives has the value, too. LobePacks takes a small light's elements instead, within 1e-3 of it.
TEST(VertexSlopes, HaveTheValuesOfTheLobes) {
  reference::Random random(4);
  const LtcPackTables tables = ltc_pack_tables(Method::ltc);
  const auto& walks = vertex_slope_packs_for(active_simd());
  const auto& lobes = lobe_packs_for(active_simd());
  std::vector<float> value(2 * kPoints), judge(2 * kPoints), slopes(6 * kVertices * kPoints);
  const VertexSlopes to = {{value.data(), value.data() + kPoints}, slopes.data(), slopes.data() + 3 * kVertices * kPoints};
  const auto compare = [&](const char* name) {
    double largest = 0, off = 0;
    for (std::size_t i = 0; i < kPoints; ++i) {
      largest = std::max(largest, static_cast<double>(judge[i]));
      off = std::max(off, static_cast<double>(std::fabs(value[i] - judge[i])));
    }
    EXPECT_GT(largest, 0) << name;
    EXPECT_LT(off, 1e-3 * largest) << name;
  };
  for (int l = 0; l < 8; ++l) {
    const Quads q(random);
    const Points points = q.points();
    const LobeRadiance wanted = {judge.data(), judge.data() + kPoints};
    walks.diffuse(q.pack, points, {}, to);
    lobes[methods::Procedure::diffuse](q.pack, points, {}, {judge.data()});
    compare("diffuse");
    walks.ltc(q.pack, points, {{}, {Method::ltc}, &tables}, to);
    lobes[methods::Procedure::ltc](q.pack, points, {{}, {Method::ltc}, &tables}, wanted);
    compare("ltc");
    const Material twenty{.brdf = Brdf::phong, .exponent = 20.0};
    walks.phong(q.pack, points, {twenty}, to);
    lobes[methods::Procedure::phong_lobe](q.pack, points, {twenty}, wanted);
    compare("phong");
    walks.closed_form(q.pack, points, {{}, {Method::closed_form}}, to);
    lobes[methods::Procedure::closed_form](q.pack, points, {{}, {Method::closed_form}}, wanted);
    compare("closed form");
  }
}

}  // namespace steradian::vertex_slopes_test
