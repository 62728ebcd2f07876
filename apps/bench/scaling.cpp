// Scaling of a picture's time: frame/pixels/WIDTHxHEIGHT under one quad, frame/triangles/N of a wavy floor, and frame/textured/1080p, whose
// floor has a texture that is minified for most of its area.
#include <cmath>
#include <memory>

#include "benches.h"
#include "floor.h"
#include "frame.h"

namespace steradian::bench {
namespace {

std::shared_ptr<BenchFrame> floor_frame(int width, int height) {
  auto frame = std::make_shared<BenchFrame>();
  frame->scene = floor_scene();
  frame->scene.materials[0] = glossy();
  frame->scene.area_lights = {ceiling_quad(0, 0, 0.5)};
  frame->options.width = width;
  frame->options.height = height;
  frame->options.method = "ltc-compact";
  frame->options.threads = 1;
  frame->options.shadows = Shadows::off;
  return frame;
}

// Low waves in place of the flat floor, with the largest square grid that has no more than that many triangles.
Mesh waves(int triangles) {
  const int side = std::max(1, static_cast<int>(std::sqrt(triangles / 2)));
  Mesh mesh;
  for (int j = 0; j <= side; ++j)
    for (int i = 0; i <= side; ++i) {
      const double x = kFloorHalf * (2.0 * i / side - 1), z = kFloorHalf * (2.0 * j / side - 1);
      mesh.positions.push_back(static_cast<Vec3f>(Vec3d{x, 0.05 * std::sin(3 * x) * std::cos(2 * z), z}));
      mesh.normals.push_back(
          static_cast<Vec3f>(normalized(Vec3d{-0.15 * std::cos(3 * x) * std::cos(2 * z), 1, 0.1 * std::sin(3 * x) * std::sin(2 * z)})));
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (side + 1) + i); };
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
  return mesh;
}

// Squares of 32 texels, eight by eight in a picture that repeats 20 times across the floor.
void lay_squares(Scene& scene) {
  Image image{"squares", 256, 256, {}};
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const std::uint8_t code = (x / 32 + y / 32) % 2 == 0 ? 220 : 40;
      image.rgba.insert(image.rgba.end(), {code, code, code, 255});
    }
  scene.images = {image};
  scene.materials[0].base_color_texture.image = 0;
  scene.materials[0].base_color_texture.color_space = ColorSpace::srgb;
  scene.meshes[0].texcoords[0] = {{0, 0}, {20, 0}, {20, 20}, {0, 20}};
}

}  // namespace

void add_scaling(BenchList& list) {
  for (const auto& [width, height] : {std::pair{320, 180}, {640, 360}, {1280, 720}, {1920, 1080}, {3840, 2160}}) {
    const std::string name = "frame/pixels/" + std::to_string(width) + "x" + std::to_string(height);
    list.add(name, [=, w = width, h = height](const BenchOptions&) { return bench_of(name, floor_frame(w, h)); });
  }
  for (const int triangles : {1000, 10000, 100000, 1000000}) {
    const std::string name = "frame/triangles/" + std::to_string(triangles);
    list.add(name, [=](const BenchOptions&) {
      auto frame = floor_frame(1280, 720);
      frame->scene.meshes = {waves(triangles)};
      return bench_of(name, frame);
    });
  }
  list.add("frame/textured/1080p", [](const BenchOptions&) {
    auto frame = floor_frame(1920, 1080);
    lay_squares(frame->scene);
    return bench_of("frame/textured/1080p", frame);
  });
}

}  // namespace steradian::bench
