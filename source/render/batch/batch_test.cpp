// Tests batches against the library's functions for one point, on every instruction set. The Python tests check more.
#include "steradian/batch.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "core/simd.h"

namespace steradian::batch_test {
namespace {

struct Points {
  std::vector<Vec3d> position, normal, view;
};

Points random_points(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.position.push_back({2 * unit(random), 0.5 * unit(random), 2 * unit(random)});
    points.normal.push_back({unit(random), 1 + unit(random), unit(random)});
    points.view.push_back({unit(random), 0.5 + unit(random), unit(random)});
  }
  return points;
}

template <class T>
std::vector<Vector3<T>> as(const std::vector<Vec3d>& v) {
  return {v.begin(), v.end()};
}

AreaLight panel() {
  AreaLight light;
  light.shape = Polygon{{{-1, 2, 1}, {-1, 2, -1}, {1, 2, -1}, {1, 2, 1}}, {}};
  light.radiance = {3, 2, 1};
  return light;
}

std::vector<Material> lobes() {
  Material lambert, ggx, phong, beckmann;
  ggx.brdf = Brdf::ggx;
  ggx.f0 = {0.9, 0.5, 0.1};
  phong.brdf = Brdf::phong;
  phong.exponent = 30;
  beckmann.brdf = Brdf::beckmann;
  return {lambert, ggx, phong, beckmann};
}

// Runs the test with each instruction set of this machine.
template <class Test>
void on_every_simd(Test test) {
  for (const Simd simd : available_simd()) {
    SCOPED_TRACE(name_of(simd));
    setenv("STERADIAN_SIMD", name_of(simd), 1);
    test();
    unsetenv("STERADIAN_SIMD");
  }
}

// Bounds are 1e-13 of the light's radiance (some roundings of double), and 2e-4 in float, for lobes as high as 5 (phong).
template <class T>
void batches_agree(double bound) {
  const Points in_double = random_points(1500);
  const std::vector<Vector3<T>> p = as<T>(in_double.position), n = as<T>(in_double.normal), v = as<T>(in_double.view);
  const PointRows<T> rows = {p.size(), rows_of(p), rows_of(n), rows_of(v)};
  const AreaLight light = panel();
  for (const Material& lobe : lobes()) {
    SCOPED_TRACE(name_of(lobe.brdf));
    std::vector<Vector3<T>> got(p.size());
    radiance(light, rows, lobe, {&got.front().x});
    double worst = 0, largest = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const ShadingPoint at = {Vec3d(p[i]), normalized(Vec3d(n[i])), normalized(Vec3d(v[i]))};
      const Vec3d want = radiance(light, at, lobe).radiance, off = Vec3d(got[i]) - want;
      worst = std::max({worst, std::fabs(off.x), std::fabs(off.y), std::fabs(off.z)});
      largest = std::max(largest, want.x);
    }
    EXPECT_LT(worst, bound * 3);
    EXPECT_GT(largest, 0.1);
  }
}

TEST(Batch, AgreesWithOnePointInDouble) {
  on_every_simd([] { batches_agree<double>(1e-13); });
}
TEST(Batch, AgreesWithOnePointInFloat) {
  on_every_simd([] { batches_agree<float>(2e-4); });
}

TEST(Batch, ThreadsDoNotChangeABit) {
  const Points points = random_points(5000);
  const auto p = as<float>(points.position), n = as<float>(points.normal), v = as<float>(points.view);
  std::vector<Vec3f> one(p.size()), all(p.size());
  const PointRows<float> rows = {p.size(), rows_of(p), rows_of(n), rows_of(v)};
  for (const Material& lobe : lobes()) {
    radiance(panel(), rows, lobe, {&one.front().x}, {.threads = 1});
    radiance(panel(), rows, lobe, {&all.front().x}, {.threads = 3});
    EXPECT_TRUE(one == all) << name_of(lobe.brdf);
  }
}

TEST(Batch, ReferenceAndSampledTellTheirErrors) {
  const Vec3f p{0, 0, 0}, n{0, 1, 0};
  const PointRows<float> rows = {1, {&p.x}, {&n.x}, {&n.x}};
  for (const Method method : {Method::reference, Method::sampled}) {
    Vec3f seen;
    float error = -1;
    radiance(panel(), rows, Material{}, {&seen.x, &error}, {.radiance = {.method = method}});
    EXPECT_GT(seen.x, 0) << name_of(method);
    EXPECT_GT(error, 0) << name_of(method);
  }
}

TEST(Batch, WhatIsNoSurfaceIsDarkAndWhatIsNoNumberIsNone) {
  const std::vector<Vec3f> p = {{0, 0, 0}, {0, 0, 0}, {NAN, 0, 0}}, n = {{0, 2, 0}, {0, 0, 0}, {0, 1, 0}};
  std::vector<Vec3f> seen(3);
  radiance(panel(), PointRows<float>{3, rows_of(p), rows_of(n), rows_of(n)}, Material{}, {&seen.front().x});
  EXPECT_GT(seen[0].x, 0);
  EXPECT_EQ(seen[1].x, 0);
  EXPECT_TRUE(std::isnan(seen[2].x));
}

}  // namespace
}  // namespace steradian::batch_test
