// Lights without an extent by every method: the material's lobe, or the method's own.
#include "integrals/point_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <tuple>

#include "core/random.h"
#include "integrals/ggx/ltc_radiance.h"
#include "integrals/tables/ggx_tables.h"
#include "shapes/polygon.h"
#include "support/point_light_error.h"

namespace steradian::point_light_test {
namespace {

using reference::Random;

Material ggx(double alpha) {
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = m.alpha_y = alpha;
  m.f0 = {0.3, 0.5, 0.04};
  m.f90 = {1, 0.9, 1};
  return m;
}

struct LitPoint {
  ShadingPoint at;
  Material material;
  Vec3d direction;  // to the light
};

// A surface in any position, seen from above, with a light from any direction above it.
LitPoint any_scene(Random& random) {
  const auto vector = [&] { return Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
  const Vec3d normal = normalized(vector());
  const auto above = [&] {
    const Vec3d v = normalized(vector());
    return dot(v, normal) < 0 ? v - normal * (2 * dot(v, normal)) : v;
  };
  const Vec3d view = above(), direction = above();
  return {{vector(), normal, view}, ggx(std::exp(random.uniform(-3.5, 0))), direction};
}

// A table of another lobe.
std::shared_ptr<const ClassicTable> other_table() {
  auto table = std::make_shared<ClassicTable>(ggx_classic_table());
  for (auto& m : table->matrix) m[0] *= 1.5f;
  for (auto& m : table->magnitude) m[0] *= 0.5f;
  return table;
}

RadianceOptions options_of(Method method, Quality quality, Precision precision, bool other) {
  RadianceOptions options;
  options.method = method;
  options.quality = quality;
  options.precision = precision;
  if (other) options.table = other_table();
  return options;
}

}  // namespace

// A square of size s that faces the point is off by the square of s times the lobe's sharpness, at most 100. Float rounds directions, to
// which lobes are as sensitive.
TEST(PointLight, IsTheLimitOfSmallLightsByEveryTable) {
  Random random(41);
  const double size = 1e-6;
  int lit = 0;
  for (const auto& [method, quality, other] : {std::tuple{Method::ltc, Quality::normal, false},
                                               {Method::ltc, Quality::high, false},
                                               {Method::ltc, Quality::normal, true},
                                               {Method::ltc_compact, Quality::normal, false},
                                               {Method::ltc_clipless, Quality::normal, false}})
    for (const Precision precision : {Precision::double_, Precision::float_}) {
      const methods::Row& row = methods::row_of(method);
      const RadianceOptions options = options_of(method, quality, precision, other);
      for (int i = 0; i < 100; ++i) {
        const LitPoint s = any_scene(random);
        if (dot(s.direction, s.at.normal) < 0.01) continue;  // the square stays above the horizon
        const double distance = std::exp(random.uniform(-2, 2));
        const Frame across = Frame::from_normal(s.direction);
        const Vec3d place = s.at.position + s.direction * distance, x = across.x * (size * distance), y = across.y * (size * distance);
        const PolygonLight square = {{place - x - y, place + x - y, place + x + y, place - x + y}, {}, {1, 1, 1}, true};
        const PreparedPolygon prepared = prepare_polygon(square);
        const Vec3d truth = row.polygon(prepared, s.at, s.material, options).radiance / prepared.area;
        const Vec3d value = methods::point_light_radiance({place, {1, 1, 1}}, s.at, s.material, row, options);
        const double error = (precision == Precision::float_ ? 1e-4 : 1e-7) * (std::fabs(truth.x) + 1e-3 / (distance * distance));
        EXPECT_NEAR(value.x, truth.x, error) << row.name << " " << i;
        EXPECT_NEAR(value.y, truth.y, error) << row.name << " " << i;
        EXPECT_NEAR(value.z, truth.z, error) << row.name << " " << i;
        lit += value.x * distance * distance > 1e-3;
      }
    }
  EXPECT_GT(lit, 500);
}

// docs/theory/indirect.md, "A pair": I rho |M^-1| / pi max(w_z, 0) |v| / |w|^4 with w = M^-1 v.
TEST(PointLight, ByLtcIsThePublishedFormula) {
  Random random(42);
  for (int i = 0; i < 200; ++i) {
    const LitPoint s = any_scene(random);
    const double distance = std::exp(random.uniform(-2, 2)), c = dot(s.at.normal, s.at.view);
    const Vec3d x = normalized(s.at.view - s.at.normal * c), y = cross(s.at.normal, x), v = s.direction * distance;
    const Vec3d local = {dot(v, x), dot(v, y), dot(v, s.at.normal)};
    const LtcValue table = ggx_classic_table().look_up(std::sqrt(s.material.alpha_x), c);
    const LtcInverse& m = table.inverse;
    const Vec3d w = {m.xx * local.x + m.xz * local.z, m.yy * local.y, m.zx * local.x + m.zz * local.z};
    const double determinant = m.yy * (m.xx * m.zz - m.xz * m.zx);
    const double rho = s.material.f0.x * table.n_a + (s.material.f90.x - s.material.f0.x) * table.f_a;
    const double truth = 7 * rho * determinant / std::numbers::pi * std::max(w.z, 0.0) * distance / (dot(w, w) * dot(w, w));
    const Vec3d value =
        methods::point_light_radiance({s.at.position + v, {7, 7, 7}}, s.at, s.material, methods::row_of(Method::ltc), {Method::ltc});
    EXPECT_NEAR(value.x, truth, 1e-9 * (truth + 1e-3)) << i;
  }
}

// Methods without a lobe of their own give GGX itself, to the bit. Transformed cosines are near it, and no more.
TEST(PointLight, OtherMethodsTakeTheMaterialsLobe) {
  Random random(43);
  double largest = 0;
  for (int i = 0; i < 100; ++i) {
    const LitPoint s = any_scene(random);
    const PointLight light = {s.at.position + s.direction, {1, 1, 1}};
    const auto by = [&](Method method) {
      return methods::point_light_radiance(light, s.at, s.material, methods::row_of(method), {method}).x;
    };
    const double truth = by(Method::reference);
    for (const Method method : {Method::closed_form, Method::half_vector, Method::sampled}) EXPECT_EQ(by(method), truth);
    EXPECT_NEAR(by(Method::representative_point), truth, 1e-9 * truth);
    largest = std::max(largest, std::fabs(by(Method::ltc) - truth));
  }
  EXPECT_GT(largest, 1e-3);
}

TEST(PointLight, IsDarkBelowEitherHorizon) {
  const ShadingPoint at = {{}, {0, 0, 1}, {0.6, 0, 0.8}}, from_below = {{}, {0, 0, 1}, {0.6, 0, -0.8}};
  for (const methods::Row& row : methods::all()) {
    const Material m = ggx(0.3);
    if (!row.serves(m)) continue;
    const auto by = [&](const ShadingPoint& p, Vec3d to) {
      return methods::directional_light_radiance({-normalized(to), {1, 1, 1}}, p, m, row, {row.method}).x;
    };
    EXPECT_EQ(by(at, {-0.6, 0, -0.01}), 0) << row.name;
    EXPECT_EQ(by(from_below, {-0.6, 0, 0.8}), 0) << row.name;
    EXPECT_GT(by(at, {-0.6, 0, 0.8}), 0) << row.name;
  }
}

// The figure in the table of methods. docs/measured/accuracy.md has those of dielectrics and of the worst pairs.
TEST(PointLight, HasTheErrorOfTheTableOfMethods) {
  for (const Method method : {Method::ltc, Method::ltc_compact, Method::ltc_clipless}) {
    const methods::Row& row = methods::row_of(method);
    const double error = test::error_under_points(row, Quality::normal, 1).rms;
    const std::string percent = std::to_string(static_cast<int>(std::lround(100 * error)));
    EXPECT_NE(std::string(row.error).find("points: " + percent + " %"), std::string::npos) << row.name << " has " << percent << " %";
  }
}

}  // namespace steradian::point_light_test
