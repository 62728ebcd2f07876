// Changes of lights in a document, read back as a scene.
#include "document/light_changes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "document/lamps.h"
#include "document/node_pose.h"
#include "document/outline.h"
#include "paths.h"
#include "scene/gltf/gltf_file.h"
#include "steradian/area_light.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"

namespace steradian::view::light_changes_test {
namespace {

EditedDocument room_with_polygon() {
  EditedDocument document(scene::read_gltf_file(test::kSourceDir + "/scenes/diffuse_floor.glb"));
  add_polygon_light(document, {0.3, 2, -0.2}, {0.2, -1, 0.1}, 1.2);
  document.close_step();
  return document;
}

LoadedScene loaded(const EditedDocument& document) {
  LoadOptions options;
  options.lights = {AddedLight::none};
  return scene::load_scene(document.file(), options);
}

std::size_t polygon_in(const Scene& scene) {
  for (std::size_t i = 0; i < scene.area_lights.size(); ++i)
    if (scene.area_lights[i].node < 0) return i;
  return scene.area_lights.size();
}

TEST(LightChanges, MoveTheCornersOfAMesh) {
  EditedDocument document = room_with_polygon();
  const LoadedScene before = loaded(document);
  const std::size_t light = polygon_in(before.scene);
  ASSERT_LT(light, before.scene.area_lights.size());
  const PolygonLight polygon = flat_polygon(before.scene.area_lights[light]);
  ASSERT_EQ(polygon.vertices.size(), 5u);
  const Frame plane = Frame::from_normal(prepare_polygon(polygon).normal);
  LightChange change;
  change.light = light;
  change.radiance = polygon.radiance * 3.0;
  for (std::size_t i = 0; i < 5; ++i)
    change.vertices.push_back(polygon.vertices[i] + plane.x * (0.02 * static_cast<double>(i)) - plane.y * 0.05);
  apply_changes(document, before.scene, {change});

  const LoadedScene after = loaded(document);
  const AreaLight& moved = after.scene.area_lights.at(polygon_in(after.scene));
  EXPECT_NEAR(moved.radiance.x / polygon.radiance.x, 3, 1e-6);
  const std::vector<Vec3d> corners = flat_polygon(moved).vertices;
  ASSERT_EQ(corners.size(), 5u);
  for (const Vec3d& wanted : change.vertices) {
    double nearest = 1;
    for (const Vec3d& corner : corners) nearest = std::min(nearest, length(corner - wanted));
    EXPECT_LT(nearest, 1e-6) << "in single precision";
  }
  document.undo();
  EXPECT_EQ(document.json(), room_with_polygon().json());
}

TEST(LightChanges, RefuseAnOutlineThatCrossesItself) {
  EditedDocument document = room_with_polygon();
  const LoadedScene before = loaded(document);
  LightChange change;
  change.light = polygon_in(before.scene);
  const AreaLight& light = before.scene.area_lights.at(change.light);
  change.radiance = light.radiance;
  change.vertices = flat_polygon(light).vertices;
  std::swap(change.vertices[0], change.vertices[1]);
  EXPECT_THROW(apply_changes(document, before.scene, {change}), Error);
}

}  // namespace
}  // namespace steradian::view::light_changes_test
