// Surfaces that let light from behind pass: blended ones and thin walls.
#include <gtest/gtest.h>

#include "steradian/render.h"
#include "support/meshes.h"

namespace steradian::layers_render_test {
namespace {

using namespace scene;

SurfaceMaterial unlit(Vec4f color) {
  SurfaceMaterial m;
  m.base_color = color;
  m.unlit = true;
  m.alpha_mode = AlphaMode::blend;
  return m;
}

// Squares across the view of a camera that looks along -z. The first material is nearest to it.
Scene stack(std::vector<SurfaceMaterial> materials) {
  Scene scene;
  scene.materials = std::move(materials);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const float z = -static_cast<float>(i);
    scene.meshes.push_back(quad_mesh({-50, -50, z}, {50, -50, z}, {50, 50, z}, {-50, 50, z}, static_cast<int>(i)));
  }
  Camera camera;
  camera.position = {0, 0, 5};
  scene.cameras = {camera};
  return scene;
}

Vec3f middle(const Scene& scene, const std::string& method = "auto") {
  RenderOptions options;
  options.width = options.height = 8;
  options.method = method;
  return render(scene, options).at(4, 4);
}

void expect_near(Vec3f a, Vec3f b) { EXPECT_LT(length(a - b), 1e-5f) << a.x << " " << a.y << " " << a.z; }

}  // namespace

TEST(Layers, BlendedSurfacesCoverByTheirAlphaNearestFirst) {
  expect_near(middle(stack({unlit({1, 0, 0, 0.25f}), unlit({0, 1, 0, 0.5f}), unlit({0, 0, 1, 1})})), {0.25f, 0.375f, 0.375f});
  expect_near(middle(stack({unlit({1, 0, 0, 0.25f})})), {0.25f, 0, 0});  // the background is black
  expect_near(middle(stack({unlit({1, 0, 0, 0}), unlit({0, 1, 0, 1})})), {0, 1, 0});
  SurfaceMaterial opaque = unlit({1, 0, 0, 0.25f});
  opaque.alpha_mode = AlphaMode::opaque;
  expect_near(middle(stack({opaque, unlit({0, 1, 0, 1})})), {1, 0, 0});
}

TEST(Layers, TheOrderOfTheFileDoesNotCount) {
  Scene scene = stack({unlit({1, 0, 0, 0.25f}), unlit({0, 1, 0, 0.5f}), unlit({0, 0, 1, 1})});
  const Vec3f before = middle(scene);
  std::swap(scene.meshes[0], scene.meshes[2]);
  EXPECT_EQ(middle(scene), before);
}

TEST(Layers, EndAfterEight) {
  std::vector<SurfaceMaterial> many(30, unlit({0, 0, 0, 0.05f}));
  many.push_back(unlit({1, 1, 1, 1}));
  expect_near(middle(stack(many)), {0, 0, 0});
  many.erase(many.begin(), many.begin() + 23);  // seven, and the white one
  const float left = 0.95f * 0.95f * 0.95f * 0.95f * 0.95f * 0.95f * 0.95f;
  expect_near(middle(stack(many)), {left, left, left});
}

TEST(Layers, AThinWallShowsWhatIsBehindInItsColour) {
  SurfaceMaterial glass;
  glass.base_color = {0.5f, 1, 0.8f, 1};
  glass.metallic = 0;
  glass.specular = 0;
  glass.transmission = 1;
  expect_near(middle(stack({glass, unlit({1, 1, 1, 1})})), {0.5f, 1, 0.8f});
  glass.specular = 1;  // index 1.5, seen from straight above: it reflects 0.04 of nothing
  expect_near(middle(stack({glass, unlit({1, 1, 1, 1})})), {0.48f, 0.96f, 0.768f});
  glass.metallic = 1;
  expect_near(middle(stack({glass, unlit({1, 1, 1, 1})})), {0, 0, 0});
}

// A wall that is half diffuse, lit from the camera's side: half of the diffuse light remains.
TEST(Layers, TransmissionTakesFromTheDiffuseLobe) {
  SurfaceMaterial wall;
  wall.metallic = 0;
  wall.specular = 0;
  Scene scene = stack({wall});
  PunctualLight sun;
  sun.kind = PunctualKind::directional;
  sun.direction = {0, 0, -1};
  scene.punctual_lights = {sun};
  const Vec3f whole = middle(scene);
  EXPECT_GT(whole.x, 0.3f);
  scene.materials[0].transmission = 0.5f;
  expect_near(middle(scene), whole * 0.5f);
  expect_near(middle(scene, "reference"), whole * 0.5f);
}

}  // namespace steradian::layers_render_test
