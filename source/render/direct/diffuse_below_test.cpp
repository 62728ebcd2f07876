// The diffuse lobe of a dielectric: light that its boundary reflects does not reach it.
#include "support/diffuse_below.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lobes/lobe.h"
#include "render/surface/camera_rays.h"
#include "steradian/closed_form.h"
#include "steradian/ellipse_light.h"
#include "steradian/ltc.h"
#include "steradian/render.h"
#include "support/meshes.h"

namespace steradian::diffuse_below_test {
namespace {

using namespace scene;

Kernels<double> kernels;

// Integral of (1 - v.h)^5 over the hemisphere, weighted by the cosine: midpoints in azimuth and squared cosine.
double sky_by_quadrature(double v_z) {
  constexpr int kNodes = 300;
  const double v_x = std::sqrt(1 - v_z * v_z);
  double sum = 0;
  for (int i = 0; i < kNodes; ++i)
    for (int j = 0; j < kNodes; ++j) {
      const double z = std::sqrt((i + 0.5) / kNodes), r = std::sqrt(1 - z * z), phi = M_PI * (j + 0.5) / kNodes;
      sum += kernels.lambert_grazing({r * std::cos(phi), r * std::sin(phi), z}, {v_x, 0.0, v_z}).v;
    }
  return sum / (kNodes * kNodes);
}

}  // namespace

TEST(LambertUnderFresnel, MeanOverTheSkyIsThatOfQuadrature) {
  // Least squares over 1 - v_z, in 61 even steps, by the normal equations.
  constexpr int kTerms = 5, kSteps = 60;
  std::array<std::array<double, kTerms + 1>, kTerms> a{};
  double worst = 0;
  for (int s = 0; s <= kSteps; ++s) {
    const double t = static_cast<double>(s) / kSteps, truth = sky_by_quadrature(1 - t);
    for (int i = 0; i < kTerms; ++i) {
      for (int j = 0; j < kTerms; ++j) a[i][j] += std::pow(t, i + j);
      a[i][kTerms] += truth * std::pow(t, i);
    }
    worst = std::max(worst, std::fabs(kernels.lambert_grazing_of_sky(1 - t).v - truth));
  }
  for (int i = 0; i < kTerms; ++i)
    for (int k = 0; k < kTerms; ++k) {
      if (k == i) continue;
      const double f = a[k][i] / a[i][i];
      for (int j = i; j <= kTerms; ++j) a[k][j] -= f * a[i][j];
    }
  for (double v_z : {0.0, 0.1, 0.37, 0.8, 1.0}) {
    double found = 0;
    for (int i = kTerms - 1; i >= 0; --i) found = found * (1 - v_z) + a[i][kTerms] / a[i][i];
    EXPECT_NEAR(kernels.lambert_grazing_of_sky(v_z).v, found, 3e-6) << v_z;  // the midpoint rule's own error: a root at the horizon
  }
  EXPECT_LT(worst, 1e-5);
  std::printf("largest error %.1e\n", worst);
}

TEST(LambertUnderFresnel, IsFarNearerToTheLobeThanAConstantWeight) {
  for (double side : {0.05, 1.0, 5.0})
    for (double degrees : {60.0, 75.0, 85.0}) {
      const auto e = reference::measure_diffuse_below(side, degrees, 60, 11);
      std::printf("side %.2f view %.0f: %.4f, constant %.4f\n", side, degrees, e.ours, e.constant);
      EXPECT_LT(e.ours, 0.7 * e.constant) << side << " " << degrees;
      EXPECT_LT(e.ours, side < 0.1 ? 0.001 : 0.02) << side << " " << degrees;  // docs/measured/accuracy.md, "Diffuse under Fresnel"
    }
}

// A point light opposite the view at 75 degrees: the half vector is the normal, and F is Schlick's at cos 75.
TEST(LambertUnderFresnel, TheReferenceWeighsEveryDirection) {
  Material m;
  m.fresnel_loss = 1;
  const double c = std::cos(75 * M_PI / 180), s = std::sin(75 * M_PI / 180);
  const lobes::Lobe lobe(m, {s, 0, c});
  const double fresnel = 0.04 + 0.96 * std::pow(1 - c, 5);
  EXPECT_NEAR(0.96 * lobe.radiance(lobe.evaluate({-s, 0, c})).x, c / M_PI * (1 - fresnel), 1e-15);
  EXPECT_NEAR(1 - fresnel, 0.75, 0.005);
  const double f = std::pow(1 - std::cos(37.5 * M_PI / 180), 5);
  EXPECT_NEAR(lobe.radiance(lobe.evaluate({0, 0, 1})).x, (1 - f) / M_PI, 1e-15);
}

// Pixels of a dielectric at grazing views: the closed form's glossy lobe, and the diffuse lobe by quadrature.
TEST(LambertUnderFresnel, PicturesShowIt) {
  Scene scene;
  SurfaceMaterial m;
  m.metallic = 0;
  m.roughness = 0.8f;
  scene.materials = {m};
  scene.meshes = {quad_mesh({-8, 0, 8}, {8, 0, 8}, {8, 0, -8}, {-8, 0, -8}, 0)};
  const Camera camera = scene::camera_at({0, 1, 5}, {0, -1, -5}, 0.5);
  scene.cameras = {camera};
  RenderOptions options;
  options.width = 32;
  options.height = 20;
  const CameraRays rays(camera, options.width, options.height);
  Material lambert, ggx;
  lambert.albedo = {0.96, 0.96, 0.96};
  lambert.fresnel_loss = 1;
  ggx.brdf = Brdf::ggx;
  ggx.alpha_x = ggx.alpha_y = 0.64;
  ggx.f0 = {0.04, 0.04, 0.04};
  // A panel and a disk, low behind the floor.
  AreaLight panel;
  panel.shape = Polygon{{{-1, 0.2, -5}, {1, 0.2, -5}, {1, 1.2, -5}, {-1, 1.2, -5}}, {}};
  panel.radiance = {3, 3, 3};
  const AreaLight disk = {Ellipse{{0, 0.9, -5}, {0.8, 0, 0}, {0, 0.8, 0}}, {3, 3, 3}};
  for (const AreaLight& light : {panel, disk})
    for (const std::string method : {"closed-form", "ltc"}) {
      if (method == "ltc" && std::holds_alternative<Ellipse>(light.shape)) continue;  // its glossy lobe sees another polygon
      options.method = method;
      scene.area_lights = {light};
      const Picture picture = render(scene, options);
      const PreparedPolygon polygon = prepare_polygon(flat_polygon(light));
      double error = 0, signal = 0, constant = 0;
      for (int y = 0; y < options.height; ++y)
        for (int x = 0; x < options.width; ++x) {
          const auto d = static_cast<Vec3d>(rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
          const Vec3d p = camera.position - d * (camera.position.y / d.y);
          if (d.y > -0.02 || std::fabs(p.x) > 7.9 || p.z < -4.5) continue;
          const ShadingPoint at = {p, {0, 1, 0}, normalized(-d)};
          const double diffuse = reference_radiance(polygon, at, lambert, {1e-6, 1e-9, 50'000}).radiance.x;
          Material even = lambert;
          even.fresnel_loss = 0;
          const double constant_weight = reference_radiance(polygon, at, even, {1e-6, 1e-9, 50'000}).radiance.x;
          const Vec3d glossy =
              method == "ltc" ? ltc_radiance(LtcMethod::classic, polygon, at, ggx) : closed_form_radiance(polygon, at, ggx);
          const double got = static_cast<double>(picture.at(x, y).x) - glossy.x;
          error += (got - diffuse) * (got - diffuse);
          constant += (constant_weight - diffuse) * (constant_weight - diffuse);
          signal += diffuse * diffuse;
        }
      std::printf("%s: relative L2 %.4f, of a constant weight %.4f\n", method.c_str(), std::sqrt(error / signal),
                  std::sqrt(constant / signal));
      EXPECT_GT(std::sqrt(constant / signal), 0.05);
      EXPECT_LT(std::sqrt(error / signal), 0.02) << method;  // docs/measured/accuracy.md, "Diffuse under Fresnel": 0.010 at 85 degrees
    }
}

}  // namespace steradian::diffuse_below_test
