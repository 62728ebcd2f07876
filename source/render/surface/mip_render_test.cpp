// Textures in whole pictures: pixels show the mean of their footprints.
#include <gtest/gtest.h>

#include <cmath>

#include "render/surface/camera_rays.h"
#include "render/surface/surface.h"
#include "steradian/render.h"
#include "support/meshes.h"
#include "support/random_configurations.h"

namespace steradian::mip_render_test {
namespace {

// A checkered floor up to the horizon, that shines by itself.
Scene checkered_floor() {
  Scene scene;
  Image image{"squares", 64, 64, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::uint8_t code = (x / 16 + y / 16) % 2 == 0 ? 250 : 30;
      image.rgba.insert(image.rgba.end(), {code, code, code, 255});
    }
  scene.images = {image};
  SurfaceMaterial m;
  m.unlit = true;
  m.base_color_texture.image = 0;
  m.base_color_texture.color_space = ColorSpace::srgb;
  scene.materials = {m};
  scene.meshes = {scene::quad_mesh({-40, 0, 4}, {40, 0, 4}, {40, 0, -76}, {-40, 0, -76}, 0)};
  scene.meshes[0].texcoords[0] = {{0, 0}, {20, 0}, {20, 20}, {0, 20}};
  scene.cameras = {scene::camera_at({0, 2, 4}, {0, 0, -1}, 0.8)};
  return scene;
}

constexpr int kWidth = 160, kHeight = 90;

// The floor's mean over n x n points of every pixel, with a texture look-up at each point.
std::vector<double> means_of_points(const Scene& scene, int n) {
  const CameraRays camera(scene.cameras[0], kWidth, kHeight);
  std::vector<double> means;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      double sum = 0;
      for (int k = 0; k < n * n; ++k) {
        const auto place = [&](int i, int at) { return static_cast<float>(at) + (static_cast<float>(i) + 0.5f) / static_cast<float>(n); };
        const Vec3f d = camera.direction(place(k % n, x), place(k / n, y));
        if (!(d.y < 0)) continue;
        const Vec3f p = camera.origin() + d * (-camera.origin().y / d.y);
        const Vec2f t{(p.x + 40) / 4, (4 - p.z) / 4};
        if (t.x < 0 || t.x > 20 || t.y > 20) continue;
        sum += static_cast<double>(sample_texture(scene.images, scene.materials[0].base_color_texture, t).x);
      }
      means.push_back(sum / (n * n));
    }
  return means;
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

// A picture with one ray per pixel is closer to the truth than one with sixteen texture points per pixel.
TEST(Textures, PixelsShowTheMeanOfWhatTheyCover) {
  const Scene scene = checkered_floor();
  RenderOptions options;
  options.width = kWidth;
  options.height = kHeight;
  std::vector<double> one;
  for (const Vec3f p : render(scene, options).pixels) one.push_back(static_cast<double>(p.x));
  const std::vector<double> truth = means_of_points(scene, 32), points = means_of_points(scene, 4);
  EXPECT_LT(rms(one, truth), rms(points, truth));
  double sum = 0;
  for (std::size_t i = 0; i < one.size(); ++i) sum += one[i] - truth[i];
  // Nor is it darker or brighter: at most by half a code of its levels' values, in linear light.
  EXPECT_LT(std::fabs(sum / static_cast<double>(one.size())), 0.5 / 255 * 2.275);
}

// Barycentric coordinates of hits in neighbouring pixels, by rays in double that differ by a thousandth of a pixel.
TEST(Textures, FootprintsFollowTheNextPixel) {
  reference::Random random(11);
  const auto any = [&](double from, double to) { return random.uniform(from, to); };
  const std::vector<Image> none;
  const MipMaps maps(none);
  for (int i = 0; i < 500; ++i) {
    Mesh mesh;
    mesh.indices = {0, 1, 2};
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(static_cast<Vec3f>(Vec3d{any(-3, 3), any(-3, 3), any(-9, -2)}));
    const Vec3d p0 = static_cast<Vec3d>(mesh.positions[0]), e1 = static_cast<Vec3d>(mesh.positions[1]) - p0,
                e2 = static_cast<Vec3d>(mesh.positions[2]) - p0, n = cross(e1, e2);
    const Vec3d right{0.002, 0, 0}, down{0, -0.002, 0}, forward{0, 0, -1};
    const Vec3d ray{any(-0.5, 0.5), any(-0.5, 0.5), -1};  // ends on the plane at distance 1
    if (std::fabs(dot(normalized(n), normalized(ray))) < 0.05 || length(n) < 0.5) continue;
    const auto hit = [&](Vec3d d) {  // barycentric coordinates, from the camera at the origin
      const Vec3d q = d * (dot(n, p0) / dot(n, d)) - p0;
      return std::pair{dot(cross(q, e2), n) / dot(n, n), dot(cross(e1, q), n) / dot(n, n)};
    };
    const double distance = length(ray * (dot(n, p0) / dot(n, ray)));
    if (!(dot(n, p0) / dot(n, ray) > 0)) continue;
    const SurfaceFootprint found = footprint_on(maps, mesh, 0, static_cast<Vec3f>(normalized(ray)), static_cast<float>(distance),
                                                {static_cast<Vec3f>(right), static_cast<Vec3f>(down), static_cast<Vec3f>(forward)});
    const auto slope = [&](Vec3d step) {
      const double h = 1e-3;
      const auto a = hit(ray + step * h), b = hit(ray - step * h);
      return std::pair{(a.first - b.first) / (2 * h), (a.second - b.second) / (2 * h)};
    };
    const auto expect = [&](Vec2f of, std::pair<double, double> truth) {
      const double size = std::hypot(truth.first, truth.second) + 1e-3;
      EXPECT_NEAR(static_cast<double>(of.x), truth.first, 2e-4 * size);  // float, at grazing angles down to 3 degrees
      EXPECT_NEAR(static_cast<double>(of.y), truth.second, 2e-4 * size);
    };
    expect(found.right, slope(right));
    expect(found.down, slope(down));
  }
}

}  // namespace steradian::mip_render_test
