// Many lights together against the same lights one by one: every pixel must be within the bound that comes with the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "night.h"
#include "steradian/render.h"
#include "support/meshes.h"

namespace steradian::many_lights_test {
namespace {

using namespace scene;

using Random = std::mt19937;
double uniform(Random& random, double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
Vec3d direction(Random& random) {
  std::normal_distribution<double> normal;
  return normalized(Vec3d{normal(random), normal(random), normal(random)});
}
Vec3d color(Random& random) { return {uniform(random, 0.2, 1), uniform(random, 0.2, 1), uniform(random, 0.2, 1)}; }

SurfaceMaterial diffuse() {
  SurfaceMaterial m;
  m.base_color = {0.7f, 0.6f, 0.5f, 1};
  m.metallic = 0;
  m.specular = 0;
  return m;
}

// Below a dielectric's boundary the diffuse lobe also depends on the light's direction.
SurfaceMaterial painted() {
  SurfaceMaterial m = diffuse();
  m.specular = 1;
  m.roughness = 0.6f;
  return m;
}

constexpr double kX = 10, kY = 5, kZ = 15;

// A floor, a ceiling and three walls, with a camera at the open end.
Scene hall(const SurfaceMaterial& material) {
  Scene scene;
  scene.materials = {material};
  const auto v = [](double x, double y, double z) { return Vec3f{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}; };
  scene.meshes = {quad_mesh(v(-kX, 0, kZ), v(kX, 0, kZ), v(kX, 0, -kZ), v(-kX, 0, -kZ), 0),
                  quad_mesh(v(-kX, kY, -kZ), v(kX, kY, -kZ), v(kX, kY, kZ), v(-kX, kY, kZ), 0),
                  quad_mesh(v(-kX, 0, kZ), v(-kX, 0, -kZ), v(-kX, kY, -kZ), v(-kX, kY, kZ), 0),
                  quad_mesh(v(kX, 0, -kZ), v(kX, 0, kZ), v(kX, kY, kZ), v(kX, kY, -kZ), 0),
                  quad_mesh(v(-kX, 0, -kZ), v(kX, 0, -kZ), v(kX, kY, -kZ), v(-kX, kY, -kZ), 0)};
  Camera camera;
  camera.name = "main";
  camera.position = {0, 1.7, kZ - 0.5};
  camera.yfov = 1.0;
  scene.cameras = {camera};
  return scene;
}

// A ball of 1,024 triangles.
Mesh ball(Vec3f center, float radius) { return scene::ball_mesh(center, radius, 0, 32, 16); }

AreaLight light_of(Shape shape, Vec3d radiance) {
  AreaLight light;
  light.shape = std::move(shape);
  light.radiance = radiance;
  return light;
}

Shape rectangle(Vec3d center, Vec3d normal, double a, double b) {
  const Vec3d x = normalized(cross(std::abs(normal.x) < 0.8 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}, normal)) * a,
              y = normalized(cross(normal, x)) * b;
  return Polygon{{center - x - y, center + x - y, center + x + y, center - x + y}, {}};
}
Shape disk(Vec3d center, Vec3d normal, double a, double b) {
  const Vec3d x = normalized(cross(std::abs(normal.x) < 0.8 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}, normal)) * a;
  return Ellipse{center, x, normalized(cross(normal, x)) * b};
}
Shape sphere(Vec3d center, double r) { return Ellipsoid{center, {r, 0, 0}, {0, r, 0}, {0, 0, r}}; }

// Most lights are below the ceiling, some on walls, and some are lamps of any direction.
AreaLight mixed_light(Random& random, double size) {
  const double kind = uniform(random, 0, 1), a = size * uniform(random, 0.3, 1), b = size * uniform(random, 0.3, 1);
  const double z = uniform(random, -kZ, kZ);
  if (kind < 0.6)
    return light_of(rectangle({uniform(random, -kX, kX), kY - uniform(random, 0.05, 1), z},
                              normalized(Vec3d{uniform(random, -0.5, 0.5), -1, uniform(random, -0.5, 0.5)}), a, b),
                    color(random));
  if (kind < 0.8)
    return light_of(disk({-kX + 0.1, uniform(random, 0.5, kY), z}, normalized(Vec3d{1, uniform(random, -0.3, 0.3), 0}), a, b),
                    color(random));
  const Vec3d center{uniform(random, -kX, kX), uniform(random, 0.3, 2), z};
  if (kind < 0.9) return light_of(sphere(center, a), color(random));
  return light_of(rectangle(center, direction(random), a, b), color(random));
}

void add_lights(Scene& scene, int count, unsigned seed, const std::function<AreaLight(Random&)>& make) {
  Random random(seed);
  for (int i = 0; i < count; ++i) scene.area_lights.push_back(make(random));
}

RenderOptions options(LightSum lights, double error) {
  RenderOptions o;
  o.width = 112;
  o.height = 64;
  o.shadows = Shadows::off;
  o.lights = lights;
  o.light_error = error;
  return o;
}

struct Difference {
  double worst = 0;  // largest |difference| - bound, relative to the picture's mean
  double over_bound = 0, rms = 0, mean_bound = 0;
  double wide = 0;  // fraction of the channels, except nearly black ones, whose bound exceeds 5 times their allowed error
};

// rounding: possible error of single precision in two pictures. Edges that appear at a hundred times their length lose 6e-8 a hundredfold
// each.
Difference difference(const Picture& all, const Picture& tree, double error, float rounding = 2e-5f) {
  const std::vector<Vec3f>& bounds = tree.layers.at("light_bound");
  Difference d;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < all.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const auto channel = [c](Vec3f v) { return c == 0 ? v.x : c == 1 ? v.y : v.z; };
      const float a = channel(all.pixels[i]), off = std::abs(channel(tree.pixels[i]) - a), bound = channel(bounds[i]);
      d.worst = std::max(d.worst, static_cast<double>(off - bound - rounding * a));
      if (bound > 1e-4f * a) d.over_bound = std::max(d.over_bound, static_cast<double>(off / bound));
      sum += static_cast<double>(a);
      squares += static_cast<double>(off * off);
      d.mean_bound += static_cast<double>(bound);
    }
  const auto count = static_cast<double>(3 * all.pixels.size());
  const double mean = sum / count;
  double wide = 0, lit = 0;
  for (std::size_t i = 0; i < all.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const auto channel = [c](Vec3f v) { return static_cast<double>(c == 0 ? v.x : c == 1 ? v.y : v.z); };
      if (!(channel(all.pixels[i]) > 0.01 * mean)) continue;
      lit += 1;
      wide += channel(bounds[i]) > 5 * error * channel(all.pixels[i]) ? 1 : 0;
    }
  d.wide = wide / lit;
  d.worst /= mean;
  d.rms = std::sqrt(squares / count) / mean;
  d.mean_bound /= sum;
  return d;
}

Difference compare(const Scene& scene, double error, float rounding = 2e-5f) {
  return difference(render(scene, options(LightSum::all, error)), render(scene, options(LightSum::tree, error)), error, rounding);
}

struct Case {
  std::string name;
  std::function<Scene()> scene;
  float rounding = 2e-5f;
};

std::vector<Case> cases() {
  const auto mixed = [](double size) { return [size](Random& random) { return mixed_light(random, size); }; };
  std::vector<Case> list;
  const auto add = [&](std::string name, std::function<Scene()> make) { list.push_back({std::move(name), std::move(make)}); };
  for (const bool loss : {false, true}) {
    const std::string suffix = loss ? " under Fresnel" : "";
    const SurfaceMaterial material = loss ? painted() : diffuse();
    add("mixed" + suffix, [=] {
      Scene scene = hall(material);
      add_lights(scene, 400, 1, mixed(0.15));
      return scene;
    });
    add("large lights" + suffix, [=] {
      Scene scene = hall(material);
      add_lights(scene, 70, 2, mixed(1.0));
      return scene;
    });
    add("balls" + suffix, [=] {
      Scene scene = hall(material);
      add_lights(scene, 300, 3, mixed(0.15));
      for (int i = 0; i < 6; ++i) scene.meshes.push_back(ball({static_cast<float>(3 * i - 8), 1.2f, static_cast<float>(5 - 2 * i)}, 1.1f));
      return scene;
    });
    add("two-sided, of any direction" + suffix, [=] {
      Scene scene = hall(material);
      add_lights(scene, 200, 4, [](Random& random) {
        AreaLight light = mixed_light(random, 0.2);
        light.two_sided = light.is_flat();
        return light;
      });
      return scene;
    });
    add("through floor and walls" + suffix, [=] {
      Scene scene = hall(material);
      add_lights(scene, 150, 5, [](Random& random) {
        const bool floor = uniform(random, 0, 1) < 0.5;
        const Vec3d at{floor ? uniform(random, -kX, kX) : kX, floor ? 0 : uniform(random, 0, kY), uniform(random, -kZ, kZ)};
        return light_of(rectangle(at, direction(random), 0.2, 0.1), color(random));
      });
      return scene;
    });
    add("in a wall's plane and next to the floor" + suffix, [=] {
      Scene scene = hall(material);
      add_lights(scene, 150, 6, [](Random& random) {
        const bool wall = uniform(random, 0, 1) < 0.5;
        const Vec3d at{wall ? -kX : uniform(random, -kX, kX), wall ? uniform(random, 0.5, kY) : 0.02, uniform(random, -kZ, kZ)};
        return light_of(rectangle(at, wall ? Vec3d{1, 0, 0} : Vec3d{0, -1, 0}, 0.2, 0.1), color(random));
      });
      return scene;
    });
    add("triangles, tubes, ellipsoids" + suffix, [=] {
      Scene scene = hall(material);
      add_lights(scene, 120, 7, [](Random& random) {
        const Vec3d at{uniform(random, -kX, kX), uniform(random, 1, kY - 0.5), uniform(random, -kZ, kZ)};
        const double kind = uniform(random, 0, 1);
        if (kind < 0.4) return light_of(Polygon{{at, at + direction(random) * 0.3, at + direction(random) * 0.2}, {}}, color(random));
        if (kind < 0.7) return light_of(Capsule{at, at + direction(random) * 0.5, 0.05}, color(random));
        return light_of(Ellipsoid{at, {0.2, 0, 0}, {0, 0.1, 0}, {0, 0, 0.3}}, color(random));
      });
      return scene;
    });
    // Their outlines are evaluated at every pixel. In single precision a distant thin tube has three correct digits, which differ between
    // the pictures.
    list.back().rounding = 1e-3f;
  }
  add("one light a thousand times", [] {
    Scene scene = hall(diffuse());
    Random random(8);
    scene.area_lights.assign(1000, mixed_light(random, 0.2));
    return scene;
  });
  // A thousand equal numbers in a row round the same way: by up to half of 1000 times 6e-8.
  list.back().rounding = 5e-5f;
  for (const bool loss : {false, true})
    add(loss ? "points under Fresnel" : "points", [loss] {
      Scene scene = hall(loss ? painted() : diffuse());
      scene.meshes.push_back(ball({-1, 1.2f, 5}, 1.1f));
      Random random(12);
      for (int i = 0; i < 150; ++i) {
        PunctualLight lamp;
        lamp.position = {uniform(random, -kX, kX), uniform(random, 0.1, kY), uniform(random, -kZ, kZ)};
        lamp.intensity = color(random);
        scene.punctual_lights.push_back(lamp);
      }
      return scene;
    });
  add("points, suns, no area", [] {
    Scene scene = hall(diffuse());
    add_lights(scene, 80, 9, [](Random& random) { return mixed_light(random, 0.2); });
    for (int i = 0; i < 5; ++i) {
      PunctualLight lamp;
      lamp.kind = i < 2 ? PunctualKind::point : i < 4 ? PunctualKind::spot : PunctualKind::directional;
      lamp.position = {i - 2.0, 3, 0};
      lamp.direction = normalized(Vec3d{0.2, -1, 0.1});
      scene.punctual_lights.push_back(lamp);
    }
    scene.area_lights.push_back(light_of(rectangle({0, 1, 0}, {0, -1, 0}, 0, 0.1), {1, 1, 1}));
    return scene;
  });
  return list;
}

}  // namespace

TEST(ManyLights, EveryPixelIsWithinItsBound) {
  for (const Case& c : cases()) {
    const Scene scene = c.scene();
    for (const double error : {1e-1, 1e-2, 1e-3}) {
      if (error > 0.05 && c.name.find("Fresnel") == std::string::npos) continue;
      if (error < 0.005 && !test::is_night()) continue;
      const Difference d = compare(scene, error, c.rounding);
      std::printf("%-42s error %g: rms %.1e, largest over bound %.3f, mean bound %.1e, above 5 errors %.4f\n", c.name.c_str(), error, d.rms,
                  d.over_bound, d.mean_bound, d.wide);
      EXPECT_LE(d.worst, 0) << c.name << ", error " << error;
      EXPECT_LT(d.rms, error / 5) << c.name;  // lights that the horizon cuts err in one direction
      // The bound is a fraction of the light sent head-on; in these halls a tenth of that arrives, or more.
      EXPECT_LT(d.mean_bound, 10 * error) << c.name;
    }
  }
}

// Glossy lobes under flat lights also use elements. Under the map of transformed cosines an edge appears at a hundred times its length
// more often than from the surface: hence the larger rounding. The closed form itself has a cubature of shadowing: its error is up to 2.5
// % for dim lights (docs/theory/ggx.md). An element has no such error.
TEST(ManyLights, LobesAreWithinTheirBound) {
  for (const char* method : {"ltc", "ltc-compact", "closed-form"})
    for (const float roughness : {0.25f, 0.5f, 0.9f}) {
      const bool closed_form = std::string(method) == "closed-form";
      SurfaceMaterial material = painted();
      material.metallic = roughness < 0.8f ? 1 : 0;
      material.roughness = roughness;
      Scene scene = hall(material);
      add_lights(scene, 200, 11, [](Random& random) { return mixed_light(random, 0.15); });
      scene.meshes.push_back(ball({-1, 1.2f, 5}, 1.1f));
      for (const double error : {1e-1, 1e-2}) {
        RenderOptions all = options(LightSum::all, error), tree = options(LightSum::tree, error);
        all.method = tree.method = method;
        const Picture one_by_one = render(scene, all);
        const Difference d = difference(one_by_one, render(scene, tree), error, closed_form ? 0.01f : 1e-4f);
        std::printf("%s, roughness %.2f, error %g: rms %.1e, largest over bound %.3f, mean bound %.1e\n", method,
                    static_cast<double>(roughness), error, d.rms, d.over_bound, d.mean_bound);
        EXPECT_LE(d.worst, 0) << method << ", roughness " << roughness << ", error " << error;
        EXPECT_LT(d.rms, error / 10);
      }
    }
}

TEST(ManyLights, SmallerErrorsComeWithSmallerBounds) {
  const Scene scene = cases().front().scene();
  const Difference coarse = compare(scene, 1e-1), fine = compare(scene, 1e-3);
  EXPECT_GT(coarse.mean_bound, 0);
  EXPECT_LT(fine.mean_bound, coarse.mean_bound / 10);
}

TEST(ManyLights, AutomaticTakesTheTreeFrom64LightsOn) {
  Scene scene = hall(diffuse());
  add_lights(scene, 63, 1, [](Random& random) { return mixed_light(random, 0.1); });
  EXPECT_EQ(render(scene, options(LightSum::automatic, 1e-2)).layers.count("light_bound"), 0u);
  EXPECT_EQ(render(scene, options(LightSum::automatic, 1e-2)).pixels, render(scene, options(LightSum::all, 1e-2)).pixels);
  scene.area_lights.push_back(scene.area_lights.front());
  EXPECT_EQ(render(scene, options(LightSum::automatic, 1e-2)).layers.count("light_bound"), 1u);
}

TEST(ManyLights, SameBytesAtAnyNumberOfThreads) {
  const Scene scene = cases()[2].scene();
  RenderOptions o = options(LightSum::tree, 1e-2);
  o.threads = 1;
  const Picture one = render(scene, o);
  o.threads = 3;
  const Picture three = render(scene, o);
  EXPECT_EQ(one.pixels, three.pixels);
  EXPECT_EQ(one.layers, three.layers);
}

TEST(ManyLights, StatsHoldTheLayersLargestAndMean) {
  const Scene scene = cases().front().scene();
  RenderStats stats;
  const Picture picture = render(scene, options(LightSum::tree, 1e-2), &stats);
  EXPECT_TRUE(stats.light_tree);
  double largest = 0;
  for (const Vec3f& b : picture.layers.at("light_bound")) largest = std::max(largest, static_cast<double>(std::max({b.x, b.y, b.z})));
  EXPECT_EQ(stats.light_bound_max, largest);
  EXPECT_GT(stats.light_bound_mean, 0);
  EXPECT_LT(stats.light_bound_mean, largest);
}

// Behind blockers, lights that are fully visible from a tile are evaluated together.
TEST(ManyLights, ShadowsStayWhereTheyAre) {
  Scene scene = hall(diffuse());
  add_lights(scene, 80, 10, [](Random& random) { return mixed_light(random, 0.15); });
  scene.meshes.push_back(ball({0, 1, 4}, 0.8f));
  RenderOptions all = options(LightSum::all, 1e-2), tree = options(LightSum::tree, 1e-2);
  all.shadows = tree.shadows = Shadows::on;
  const Difference d = difference(render(scene, all), render(scene, tree), 1e-2);
  EXPECT_LE(d.worst, 0);
  EXPECT_GT(d.mean_bound, 0);
}

}  // namespace steradian::many_lights_test
