#include "steradian/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/simd.h"
#include "render/surface/camera_rays.h"
#include "steradian/albedo.h"
#include "steradian/capsule_light.h"
#include "steradian/closed_form.h"
#include "steradian/ellipse_light.h"
#include "steradian/error.h"
#include "steradian/ltc.h"
#include "steradian/radiance.h"
#include "support/meshes.h"
#include "support/z_test.h"

namespace steradian::render_test {
namespace {

using namespace scene;

using namespace image;

SurfaceMaterial diffuse(float albedo) {
  SurfaceMaterial m;
  m.base_color = {albedo, albedo, albedo, 1};
  m.metallic = 0;
  m.specular = 0;  // no specular lobe: the diffuse lobe gets all of the base colour
  return m;
}

// A floor of albedo 0.5, and a camera above it that looks down at an angle.
Scene diffuse_floor() {
  Scene scene = floor_scene(diffuse(0.5f), 8, {0, 3, 4});
  scene.cameras[0].name = "main";
  return scene;
}

AreaLight polygon(std::vector<Vec3d> vertices, Vec3d radiance) {
  AreaLight light;
  light.shape = Polygon{std::move(vertices), {}};
  light.radiance = radiance;
  return light;
}

AreaLight tube_light(Vec3d center, Vec3d half_axis, double radius) {
  AreaLight light;
  light.shape = Capsule{center - half_axis, center + half_axis, radius};
  return light;
}

AreaLight ceiling_light() { return polygon({{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}}, {5, 4, 3}); }
AreaLight wall_light() {  // half of it is below the floor
  return polygon({{-2, -1, -1}, {-2, -1, 1}, {-2, 1.5, 1}, {-2, 1.5, -1}}, {1, 2, 3});
}

RenderOptions small() {
  RenderOptions options;
  options.width = 97;
  options.height = 61;
  options.shadows = Shadows::off;
  return options;
}

Vec3d floor_point(const Scene& scene, const RenderOptions& options, int x, int y) {
  const CameraRays rays(scene.cameras[0], options.width, options.height);
  const auto d = static_cast<Vec3d>(rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
  const Vec3d o = scene.cameras[0].position;
  return o + d * (-o.y / d.y);
}

}  // namespace

TEST(Render, DiffuseFloorIsThePolygonIntegralAtEveryPixel) {
  Scene scene = diffuse_floor();
  scene.area_lights = {ceiling_light(), wall_light()};
  const RenderOptions options = small();
  const Picture picture = render(scene, options);
  double worst = 0;
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      const Vec3d p = floor_point(scene, options, x, y);
      if (std::fabs(p.x) > 7.9 || std::fabs(p.z) > 7.9) continue;
      Vec3d expected{};
      for (const AreaLight& light : scene.area_lights)
        expected += light.radiance * (polygon_irradiance(prepare_polygon(flat_polygon(light)), p, {0, 1, 0}) * 0.5 / M_PI);
      worst = std::max(worst, length(static_cast<Vec3d>(picture.at(x, y)) - expected));
    }
  // Radiance up to 5: float irradiances are accurate to 5e-7 (docs/measured/accuracy.md), hit points to 2e-6 of 10 m.
  EXPECT_LT(worst, 2e-5);
}

// A light with a thousandth of the size and a million times the radiance gives the same light, to the square of size over distance.
TEST(Render, SmallLightsKeepTheirPower) {
  const auto lights = [](double size) {
    const Vec3d power = Vec3d{3, 2, 1} / (size * size), center{0.3, 3, -0.5};
    const Vec3d x = Vec3d{1, 0.1, 0} * size, y = Vec3d{0, 0.2, 1} * size;
    return std::vector<AreaLight>{{Polygon{{center - x - y, center + x - y, center + x + y, center - x + y}, {}}, power},
                                  {Ellipse{center, x, y}, power},
                                  {Ellipsoid{center, {size, 0, 0}, {0, size, 0}, {0, 0, 0.7 * size}}, power},
                                  {Capsule{center - x, center + x, 0.1 * size}, power}};
  };
  for (std::size_t shape = 0; shape < lights(1).size(); ++shape)
    for (const std::string method : {"closed-form", "ltc", "ltc-compact"}) {
      Scene scene = diffuse_floor();
      scene.materials[0].specular = 1;
      scene.materials[0].roughness = 0.5f;
      RenderOptions options = small();
      options.method = method;
      Picture pictures[4];
      const double sizes[] = {3e-2, 1e-3, 1e-4, 1e-6};
      for (int k = 0; k < 4; ++k) {
        scene.area_lights = {lights(sizes[k])[shape]};
        pictures[k] = render(scene, options);
      }
      float largest = 0, worst[4] = {};
      for (std::size_t i = 0; i < pictures[0].pixels.size(); ++i) {
        largest = std::max(largest, length(pictures[3].pixels[i]));
        for (int k = 0; k < 3; ++k) worst[k] = std::max(worst[k], length(pictures[k].pixels[i] - pictures[3].pixels[i]));
      }
      EXPECT_GT(largest, 0.01f);
      // 3 cm at 3 m: 1e-4 of the value times the lobe's curvature. Polygons of round lights are off by a thousandth.
      EXPECT_LT(worst[0], 5e-3f * largest) << shape << " " << method;
      EXPECT_LT(worst[1], 2e-4f * largest) << shape << " " << method;
      EXPECT_LT(worst[2], 2e-4f * largest) << shape << " " << method;
    }
}

// An edge of kilometres is the sum of its parts: the same picture as under a panel with extra corners along its edges. Ends that are a
// million metres to either side leave single precision no direction between them.
TEST(Render, LargeLightsAreTheSumOfTheirParts) {
  for (const double size : {1e3, 1e5, 1e7, 1e9}) {
    const AreaLight whole = polygon({{-size, 0.7, -7}, {size, 0.7, -7}, {size, size, -7}, {-size, size, -7}}, {1, 1, 1});
    std::vector<Vec3d> corners;
    for (const double x : {-size, -1e2, -20.0, -8.0, -3.0, 0.0, 3.0, 8.0, 20.0, 1e2, size}) corners.push_back({x, 0.7, -7});
    for (const Vec3d& far : {Vec3d{size, size, -7}, Vec3d{-size, size, -7}}) corners.push_back(far);
    const AreaLight parts = polygon(corners, {1, 1, 1});
    for (const std::string method : {"closed-form", "ltc", "ltc-compact", "half-vector"}) {
      Scene scene = diffuse_floor();
      scene.materials[0].specular = 1;
      scene.materials[0].roughness = 0.4f;
      RenderOptions options = small();
      options.method = method;
      scene.area_lights = {whole};
      const Picture a = render(scene, options);
      scene.area_lights = {parts};
      const Picture b = render(scene, options);
      float largest = 0, worst = 0;
      for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        largest = std::max(largest, length(b.pixels[i]));
        worst = std::max(worst, length(a.pixels[i] - b.pixels[i]));
      }
      EXPECT_GT(largest, 0.1f);
      // Planes of edges are accurate to 1e-5, for four of them and two lobes. The other two methods average shadowing and Fresnel over
      // nodes along the given edges, to 0.15 % (docs/theory/ggx.md).
      const bool table = method.starts_with("ltc");
      EXPECT_LT(worst, (table ? 1e-4f : 1.5e-3f) * largest) << method << " " << size;
    }
    Scene scene = diffuse_floor();
    scene.area_lights = {whole};
    const RenderOptions options = small();
    const Picture picture = render(scene, options);
    const PreparedPolygon light = prepare_polygon(flat_polygon(whole));
    double worst = 0;
    for (int y = 0; y < options.height; ++y)
      for (int x = 0; x < options.width; ++x) {
        const Vec3d p = floor_point(scene, options, x, y);
        if (std::fabs(p.x) > 7.9 || std::fabs(p.z) > 7.9) continue;
        const double expected = polygon_irradiance(light, p, {0, 1, 0}) * 0.5 / M_PI;
        worst = std::max(worst, std::fabs(static_cast<double>(picture.at(x, y).x) - expected));
      }
    EXPECT_LT(worst, 2e-5) << size;
  }
}

TEST(Render, SphereLightIsItsClosedForm) {
  Scene scene = diffuse_floor();
  const Ellipsoid sphere = {{0, 2, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}};
  scene.area_lights = {AreaLight{sphere, {2, 2, 2}}};
  const RenderOptions options = small();
  const Picture picture = render(scene, options);
  double worst = 0;
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      const Vec3d p = floor_point(scene, options, x, y);
      if (std::fabs(p.x) > 7.9 || std::fabs(p.z) > 7.9) continue;
      const Vec3d to = sphere.center - p;  // a sphere completely above the horizon: pi R^2 cos / d^2
      const double irradiance = M_PI * 0.25 * to.y / std::pow(length(to), 3);
      worst = std::max(worst, std::fabs(picture.at(x, y).x / (2 * irradiance * 0.5 / M_PI) - 1));
    }
  // The float error is at most 1e-4 of irradiance, absolute (ellipse_light_test.cpp). Irradiance here is 0.05 and more.
  EXPECT_LT(worst, 1e-3);
  std::printf("largest relative error %.1e\n", worst);
}

// A slanted, two-sided ellipse that the floor cuts, against the form factor in double.
TEST(Render, DiskLightIsItsFormFactor) {
  Scene scene = diffuse_floor();
  const Ellipse disk = {{-2, 0.5, 0}, {0.3, 1, 0}, {0, 0, 1.5}};
  scene.area_lights = {AreaLight{disk, {2, 2, 2}, true}};
  const RenderOptions options = small();
  const Picture picture = render(scene, options);
  double worst = 0;
  int lit = 0;
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      const Vec3d p = floor_point(scene, options, x, y);
      if (std::fabs(p.x) > 7.9 || std::fabs(p.z) > 7.9) continue;
      const double e = std::max(ellipse_irradiance({disk.center, disk.x, disk.y}, p, {0, 1, 0}),
                                ellipse_irradiance({disk.center, disk.y, disk.x}, p, {0, 1, 0}));
      worst = std::max(worst, std::fabs(static_cast<double>(picture.at(x, y).x) - 2 * e * 0.5 / M_PI));
      lit += e > 0.01;
    }
  EXPECT_LT(worst, 1e-4 / M_PI);  // irradiance in float to 1e-4 (ellipse_light_test.cpp), times 2 * 0.5 / pi
  EXPECT_GT(lit, 1000);
  std::printf("largest error of the radiance %.1e\n", worst);
}

// A glossy floor under disk and sphere: polygons about the lobe against polygon lights of 256 vertices.
TEST(Render, RoundLightsOnGlossAgreeWithFinePolygons) {
  for (float roughness : {0.1f, 0.5f}) {
    Scene scene = diffuse_floor();
    scene.materials[0].specular = 1;
    scene.materials[0].roughness = roughness;
    const AreaLight disk = {Ellipse{{0, 2, -3}, {-1.2, 0, 0}, {0, 0.8, -0.2}}, {1, 1, 1}, true};
    const AreaLight fine = area_light(flat_polygon(disk, 256));
    const RenderOptions options = small();
    scene.area_lights = {disk};
    const Picture round = render(scene, options);
    scene.area_lights = {fine};
    const Picture truth = render(scene, options);
    double worst = 0, largest = 0;
    for (int y = 0; y < options.height; ++y)
      for (int x = 0; x < options.width; ++x) {
        worst = std::max(worst, std::fabs(static_cast<double>(round.at(x, y).x - truth.at(x, y).x)));
        largest = std::max(largest, static_cast<double>(truth.at(x, y).x));
      }
    // The full lobe, K = 12, is off by 0.003 (ellipse_light_test.cpp). Cubature nodes differ with the edges: 0.003 more
    // (docs/measured/accuracy.md, "GGX with shadowing and Fresnel").
    EXPECT_LT(worst, 0.006) << "roughness " << roughness;
    EXPECT_GT(largest, 0.02) << "roughness " << roughness;
    std::printf("roughness %.1f: largest difference %.1e of %.2f\n", static_cast<double>(roughness), worst, largest);
  }
}

// One tube above the floor, and one that pierces it: on packs, against the closed form in double.
TEST(Render, TubesAreTheirClosedForm) {
  Scene scene = diffuse_floor();
  scene.area_lights = {tube_light({0.5, 1.5, -1}, {1.5, 0.4, 0}, 0.1), tube_light({-2, 0.2, 0}, {0.3, 0.8, -0.2}, 0.25)};
  const RenderOptions options = small();
  const Picture picture = render(scene, options);
  double worst = 0;
  int lit = 0;
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      const Vec3d p = floor_point(scene, options, x, y);
      if (std::fabs(p.x) > 7.9 || std::fabs(p.z) > 7.9) continue;
      double e = 0;
      for (const AreaLight& light : scene.area_lights) e += capsule_irradiance(std::get<Capsule>(light.shape), p, {0, 1, 0});
      worst = std::max(worst, std::fabs(static_cast<double>(picture.at(x, y).x) - e * 0.5 / M_PI));
      lit += e > 0.01;
    }
  // Irradiance in float is accurate to 1e-5 (capsule_light_test.cpp), hit points to 2e-6 of 10 m, 0.1 m or more from the tubes' surfaces.
  EXPECT_LT(worst, (1e-5 + M_PI * 2e-5 / 0.1) * 0.5 / M_PI);
  EXPECT_GT(lit, 1000);
  std::printf("largest error of the radiance %.1e, %d pixels lit\n", worst, lit);
}

// A glossy floor by every method that runs on packs or point by point, against high quality and the double library.
TEST(Render, TubesOnGlossAgreeWithFinePolygons) {
  for (float roughness : {0.2f, 0.5f}) {
    Scene scene = diffuse_floor();
    scene.materials[0].base_color = {1, 1, 1, 1};
    scene.materials[0].metallic = 1;
    scene.materials[0].roughness = roughness;
    scene.area_lights = {tube_light({0, 1.2, -2}, {1, 0.3, 0.2}, 0.2)};
    RenderOptions options = small();
    Material m;
    m.brdf = Brdf::ggx;
    m.alpha_x = m.alpha_y = static_cast<double>(roughness) * static_cast<double>(roughness);
    for (const char* method : {"closed-form", "ltc", "ltc-clipless"}) {
      options.method = method;
      const Picture picture = render(scene, options);
      double worst = 0, largest = 0;
      for (int y = 0; y < options.height; y += 3)
        for (int x = 0; x < options.width; x += 3) {
          const Vec3d p = floor_point(scene, options, x, y);
          if (std::fabs(p.x) > 7.9 || std::fabs(p.z) > 7.9) continue;
          const ShadingPoint at = {p, {0, 1, 0}, normalized(scene.cameras[0].position - p)};
          const double truth =
              closed_form_radiance(prepare_polygon(polygon_seen_from(scene.area_lights[0], p, 128)), at, m, Quality::high).x;
          worst = std::max(worst, std::fabs(static_cast<double>(picture.at(x, y).x) - truth));
          largest = std::max(largest, truth);
        }
      // Errors of the full lobe: closed form 0.01 for K = 12 and 0.005 for its cubature; LTC's fit 0.05, worse without a clip.
      EXPECT_LT(worst, method == std::string("closed-form") ? 0.015 : 0.08) << method << ", roughness " << roughness;
      EXPECT_GT(largest, 0.2) << "roughness " << roughness;
      std::printf("%-12s roughness %.1f: largest difference %.1e of %.2f\n", method, static_cast<double>(roughness), worst, largest);
    }
  }
}

TEST(Render, PunctualLightsFollowTheInverseSquare) {
  Scene scene = diffuse_floor();
  PunctualLight light;
  light.position = {0.5, 2, 0.25};
  light.intensity = {10, 20, 30};
  scene.punctual_lights = {light};
  const RenderOptions options = small();
  const Picture picture = render(scene, options);
  const Vec3d p = floor_point(scene, options, 40, 30), to = light.position - p;
  const double e = to.y / std::pow(length(to), 3) * 0.5 / M_PI;
  EXPECT_NEAR(picture.at(40, 30).z, 30 * e, 30 * e * 1e-5);
}

TEST(Render, GivesTheSameBytesAtAnyNumberOfThreads) {
  Scene scene = diffuse_floor();
  scene.area_lights = {ceiling_light(), wall_light()};
  RenderOptions options = small();
  options.aa = 3;
  options.threads = 1;
  const Picture one = render(scene, options);
  options.threads = 2;
  EXPECT_EQ(one.pixels, render(scene, options).pixels);
}

TEST(Render, InstructionSetsAgree) {
  Scene scene = diffuse_floor();
  scene.area_lights = {ceiling_light(), wall_light()};
  Picture first;
  for (Simd simd : available_simd()) {
    setenv("STERADIAN_SIMD", name_of(simd), 1);
    const Picture picture = render(scene, small());
    unsetenv("STERADIAN_SIMD");
    if (first.pixels.empty()) first = picture;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
      ASSERT_LT(length(picture.pixels[i] - first.pixels[i]), 2e-5f) << name_of(simd) << " pixel " << i;
  }
}

TEST(Render, LightsBehindTheFloorChangeNothing) {
  Scene scene = diffuse_floor();
  scene.area_lights = {ceiling_light()};
  const Picture alone = render(scene, small());
  scene.area_lights.push_back(polygon({{-1, -2, -1}, {-1, -2, 1}, {1, -2, 1}, {1, -2, -1}}, {9, 9, 9}));
  EXPECT_EQ(alone.pixels, render(scene, small()).pixels);
}

TEST(Render, ExactDiffuseLightAgreesWithTheReferenceAtEveryPixel) {
  Scene scene = diffuse_floor();
  scene.area_lights = {ceiling_light(), wall_light()};
  RenderOptions options;
  options.width = 40;
  options.height = 24;
  options.shadows = Shadows::off;
  const Picture exact = render(scene, options);
  options.method = "reference";
  options.target_error = 0.01;
  RenderStats stats;
  const Picture reference = render(scene, options, &stats);
  // Float radiances round by 2e-6 unless the irradiance is small (see DiffuseFloorIsThePolygonIntegral...).
  const ZTest test = z_test(exact, reference, 1e-5);
  EXPECT_GE(test.share(), 0.9975) << test.tested << " tested, worst " << test.worst << " sigma, threshold " << test.threshold;
  // The test can fail: it notices a light that is a tenth stronger.
  Picture brighter = exact;
  for (Vec3f& p : brighter.pixels) p *= 1.1f;
  EXPECT_LT(z_test(brighter, reference, 1e-5).share(), 0.9975);
  double square = 0, variance = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    square += dot(reference.pixels[i], reference.pixels[i]);
    const Vec3f v = reference.layers.at("variance")[i];
    variance += v.x + v.y + v.z;
  }
  EXPECT_LT(std::sqrt(variance / square), 0.015);  // the target, with the pilot's own error
}

TEST(Render, ShadowsDarkenOnlyWhatTheLightDoesNotSee) {
  Scene scene = diffuse_floor();
  scene.area_lights = {ceiling_light()};
  // A plate halfway to the light, above the middle of the floor.
  scene.meshes.push_back(quad_mesh({-0.6f, 1, 0.6f}, {0.6f, 1, 0.6f}, {0.6f, 1, -0.6f}, {-0.6f, 1, -0.6f}, 0));
  RenderOptions options = small();
  options.method = "sampled";
  options.spp = 16;
  const Picture open = render(scene, options);
  options.shadows = Shadows::on;
  const Picture shadowed = render(scene, options);
  const CameraRays rays(scene.cameras[0], options.width, options.height);
  int umbra = 0, lit = 0;
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      const Vec3d p = floor_point(scene, options, x, y);
      const auto d = static_cast<Vec3d>(rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
      const Vec3d o = scene.cameras[0].position, at_plate = o + d * ((1 - o.y) / d.y);
      if (std::fabs(at_plate.x) < 0.65 && std::fabs(at_plate.z) < 0.65) continue;  // the plate occludes the floor
      if (std::fabs(p.x) < 0.15 && std::fabs(p.z) < 0.15) {
        EXPECT_EQ(shadowed.at(x, y).x, 0.0f) << x << ", " << y;
        ++umbra;
      }
      if (std::fabs(p.x) > 2.5 && std::fabs(p.x) < 7.5 && std::fabs(p.z) < 7.5) {
        EXPECT_NEAR(shadowed.at(x, y).x, open.at(x, y).x, 0.5f * open.at(x, y).x + 1e-3f);
        ++lit;
      }
    }
  EXPECT_GT(lit, 100);
  EXPECT_GT(umbra, 8);
}

TEST(Render, MethodsThatDoNotServeALobeAreWrongUse) {
  Scene scene = diffuse_floor();
  scene.materials[0].specular = 1;
  scene.materials[0].name = "tiles";
  RenderOptions options = small();
  options.method = "exact";
  try {
    render(scene, options);
    FAIL();
  } catch (const UsageError& e) {
    EXPECT_NE(std::string(e.what()).find("tiles"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("ggx"), std::string::npos) << e.what();
  }
}

TEST(Render, AnUnknownCameraIsNamedWithThoseThereAre) {
  RenderOptions options = small();
  options.camera = "nobody";
  try {
    render(diffuse_floor(), options);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("main"), std::string::npos);
  }
}

// The layers of cloth: base under sheen, each pixel by the library's own calls. Sampling agrees within its variance.
TEST(Render, SheenIsItsCubatureOverADimmedBase) {
  Scene scene = diffuse_floor();
  scene.materials[0].sheen_color = {0.8f, 0.5f, 0.2f};
  scene.materials[0].sheen_roughness = 0.5f;
  scene.area_lights = {ceiling_light()};
  const PreparedPolygon light = prepare_polygon(flat_polygon(scene.area_lights[0]));
  RenderOptions options = small();
  const Picture picture = render(scene, options);
  Material sheen;
  sheen.brdf = Brdf::charlie;
  sheen.alpha_x = sheen.alpha_y = 0.25;
  sheen.albedo = static_cast<Vec3d>(scene.materials[0].sheen_color);
  for (int y = 30; y < options.height; y += 7)
    for (int x = 3; x < options.width; x += 10) {
      const Vec3d p = floor_point(scene, options, x, y);
      const ShadingPoint at = {p, {0, 1, 0}, normalized(scene.cameras[0].position - p)};
      const double under = 1 - sheen.albedo.x * charlie_albedo(0.25, at.view.y);
      const double base = 0.5 / std::numbers::pi * under * polygon_irradiance(light, p, at.normal) * light.radiance.x;
      const double expected = base + radiance(light, at, sheen).radiance.x;
      EXPECT_NEAR(picture.at(x, y).x, expected, 2e-5 * expected + 1e-6) << x << " " << y;
    }

  options.method = "sampled";
  options.spp = 64;
  const Picture sampled = render(scene, options);
  double analytic_sum = 0, sampled_sum = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    analytic_sum += static_cast<double>(picture.pixels[i].y);
    sampled_sum += static_cast<double>(sampled.pixels[i].y);
  }
  EXPECT_NEAR(analytic_sum / sampled_sum, 1,
              0.01);  // error of both lobes: the cubature to 0.002, and three standard errors of the mean of 6,000 pixels
}

TEST(Render, MultipleScatteringBrightensARoughMetal) {
  Scene scene = diffuse_floor();
  scene.materials[0].base_color = {0.9f, 0.6f, 0.3f, 1};
  scene.materials[0].metallic = 1;
  scene.materials[0].specular = 1;
  scene.materials[0].roughness = 0.9f;
  scene.area_lights = {ceiling_light()};
  const Picture one = render(scene, small());
  scene.multiple_scattering = true;
  const Picture all = render(scene, small());
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = m.alpha_y = 0.81;
  m.f0 = {0.9, 0.6, 0.3};
  m.multiple_scattering = true;
  for (int y = 30; y < 61; y += 10) {
    const Vec3d p = floor_point(scene, small(), 48, y);
    const Material scaled = with_multiple_scattering(m, {p, {0, 1, 0}, normalized(scene.cameras[0].position - p)});
    const double ratio = static_cast<double>(all.at(48, y).x / one.at(48, y).x);
    EXPECT_GT(ratio, 1.1);
    // F90 grows with F0, so the whole lobe does too.
    EXPECT_NEAR(ratio, scaled.f0.x / 0.9, 1e-4);
  }
}

}  // namespace steradian::render_test
