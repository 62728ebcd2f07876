// Documents, their lamps and nodes: the effect of an edit on a file, and the values that it leaves unchanged.
#include "document/document.h"

#include <gtest/gtest.h>

#include "document/lamps.h"
#include "document/node_pose.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "support/gltf_test_file.h"

namespace steradian::view::document_test {
namespace {

using scene::GltfTestFile;

GltfTestFile lit_square() {
  GltfTestFile f = GltfTestFile::square();
  f.material()["pbrMetallicRoughness"] = {{"roughnessFactor", 0.3}};
  f.json["extensionsUsed"] = {"EXT_lights_area"};
  f.json["extensions"]["EXT_lights_area"]["lights"] = {{{"type", "rect"}, {"size", 2}, {"intensity", 3}}};
  f.append("nodes", {{"translation", {0, 0, 2}}, {"extensions", {{"EXT_lights_area", {{"light", 0}}}}}});
  f.json["nodes"][0]["extras"] = {{"kept", "as it was"}};
  return f;
}

EditedDocument document_of(const GltfTestFile& f, const std::string& name) { return EditedDocument(scene::read_gltf_file(f.write(name))); }

Scene scene_of(const EditedDocument& d) { return load_scene_from_memory(glb_bytes(d.file()), d.file().path).scene; }

TEST(EditedDocument, UndoesAndRedoesStepsAsAWhole) {
  EditedDocument d = document_of(lit_square(), "undo.gltf");
  const Json before = d.json();
  d.set("/nodes/1/translation", {0, 0, 3});
  d.set("/nodes/1/translation", {0, 0, 4});
  d.set("/nodes/1/extras/a/b", 1);
  const Json after = d.json();
  EXPECT_EQ(after["nodes"][1]["extras"]["a"]["b"], 1);
  d.close_step();
  d.set("/nodes/2", {{"name", "new"}});
  d.undo();
  EXPECT_EQ(d.json(), after);
  d.undo();
  EXPECT_EQ(d.json(), before);
  EXPECT_FALSE(d.can_undo());
  d.redo();
  EXPECT_EQ(d.json(), after);
  d.redo();
  EXPECT_EQ(d.json()["nodes"][2]["name"], "new");
  EXPECT_FALSE(d.can_redo());
  d.undo();
  d.set("/asset/copyright", "me");
  EXPECT_FALSE(d.can_redo()) << "a new edit ends what could be done again";
  EXPECT_THROW(d.set("/nodes/9", 1), Error);
}

TEST(EditedDocument, KeepsTheRestOfTheFileAndReadsBackTheSameScene) {
  for (const char* name : {"kept.gltf", "kept.glb"}) {
    EditedDocument d = document_of(lit_square(), name);
    const Json before = d.json();
    LampValues values = values_of(d, lamps_of(d, NodeTree(d)).at(0));
    values.intensity = 0.1 + 0.2;  // 17 digits
    set_values(d, lamps_of(d, NodeTree(d)).at(0), values);
    EXPECT_EQ(d.json().dump().size(), before.dump().size() + std::string("0.30000000000000004").size() - 1) << "one number has changed";
    std::filesystem::create_directories(scene::test_path("elsewhere"));
    for (const char* to : {"saved.gltf", "saved.glb", "elsewhere/saved.gltf"}) {
      const std::string path = scene::test_path(to);
      write_gltf_file(d.file(), path);
      const Scene seen = scene_of(d), read = load_scene(path).scene;
      ASSERT_EQ(read.area_lights.size(), 1u);
      EXPECT_EQ(read.area_lights[0].radiance, seen.area_lights[0].radiance);
      EXPECT_EQ(read.area_lights[0].radiance.x, 0.1 + 0.2);
      EXPECT_EQ(read.meshes.size(), seen.meshes.size());
      EXPECT_EQ(read.meshes[0].positions, seen.meshes[0].positions);
      EXPECT_EQ(scene::read_gltf_file(path).json["nodes"][0]["extras"]["kept"], "as it was");
    }
  }
}

TEST(EditedDocument, FindsFilesBesideItFromAnotherFolder) {
  GltfTestFile f = lit_square();
  f.json["buffers"] = {{{"byteLength", f.buffer.size()}, {"uri", "a%20b.bin"}}};
  scene::write_test_file("a b.bin", f.buffer);
  const EditedDocument d = document_of(f, "beside.gltf");
  std::filesystem::create_directories(scene::test_path("folder/deep"));
  const std::string path = scene::test_path("folder/deep/saved.gltf");
  write_gltf_file(d.file(), path);
  EXPECT_EQ(scene::read_gltf_file(path).json["buffers"][0]["uri"], "../../a%20b.bin");
  EXPECT_EQ(load_scene(path).scene.meshes[0].positions, scene_of(d).meshes[0].positions);
  EXPECT_THROW(write_gltf_file(d.file(), scene::test_path("scene.obj")), Error);
}

TEST(ViewLamps, AreAddedChangedAndRemoved) {
  EditedDocument d = document_of(lit_square(), "lamps.gltf");
  const int node = add_light(d, "disk", {1, 2, 3}, {0, -1, 0}, 0.5);
  Scene s = scene_of(d);
  ASSERT_EQ(s.area_lights.size(), 2u);
  const auto& disk = std::get<Ellipse>(s.area_lights[1].shape);
  EXPECT_NEAR(length(disk.center - Vec3d{1, 2, 3}), 0, 1e-12);
  const Vec3d n = normalized(cross(disk.x, disk.y));
  EXPECT_NEAR(n.y, -1, 1e-12) << "it shines downwards";
  EXPECT_NEAR(length(disk.x), 0.25, 1e-12);

  Lamp lamp = lamps_of(d, NodeTree(d)).at(1);
  EXPECT_EQ(lamp.node, node);
  LampValues v = values_of(d, lamp);
  v.color = {1, 0.5, 0.25};
  v.intensity = 8;
  v.size = 4;
  v.two_sided = true;
  set_values(d, lamp, v);
  s = scene_of(d);
  EXPECT_EQ(s.area_lights[1].radiance, (Vec3d{8, 4, 2}));
  EXPECT_TRUE(s.area_lights[1].two_sided);
  EXPECT_FALSE(s.area_lights[0].two_sided);
  v.type = "sphere";
  set_values(d, lamp, v);
  EXPECT_TRUE(std::holds_alternative<Ellipsoid>(scene_of(d).area_lights[1].shape));

  remove_lamp(d, lamps_of(d, NodeTree(d)).at(0));
  s = scene_of(d);
  ASSERT_EQ(s.area_lights.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<Ellipsoid>(s.area_lights[0].shape));
  d.undo();
  EXPECT_EQ(scene_of(d).area_lights.size(), 1u) << "all of it was one step";
}

TEST(ViewLamps, FindAllKindsAndTheirValues) {
  GltfTestFile f = lit_square();
  f.material()["emissiveFactor"] = {0.5, 0.5, 0};
  f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"intensity", 9}, {"spot", {{"outerConeAngle", 0.5}}}}};
  f.append("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  EditedDocument d = document_of(f, "kinds.gltf");
  const auto lamps = lamps_of(d, NodeTree(d));
  ASSERT_EQ(lamps.size(), 3u);
  EXPECT_EQ(lamps[0].kind, LampKind::mesh);
  EXPECT_EQ(lamps[1].type, "rect");
  EXPECT_EQ(lamps[2].type, "spot");

  LampValues mesh = values_of(d, lamps[0]);
  mesh.intensity = 6;
  mesh.two_sided = true;
  set_values(d, lamps[0], mesh);
  LampValues spot = values_of(d, lamps[2]);
  EXPECT_EQ(spot.outer_angle, 0.5);
  spot.inner_angle = 0.25;
  spot.color = {0, 1, 0};
  set_values(d, lamps[2], spot);
  const Scene s = scene_of(d);
  ASSERT_EQ(s.area_lights.size(), 2u);  // the lights of the rect and of the mesh
  EXPECT_EQ(s.area_lights[1].radiance, (Vec3d{3, 3, 0}));
  EXPECT_TRUE(s.area_lights[1].two_sided);
  ASSERT_EQ(s.punctual_lights.size(), 1u);
  EXPECT_EQ(s.punctual_lights[0].intensity, (Vec3d{0, 9, 0}));
  EXPECT_DOUBLE_EQ(s.punctual_lights[0].cos_inner, std::cos(0.25));

  MaterialValues m = material_values(d, 0);
  EXPECT_EQ(m.roughness, 0.3);
  m.roughness = 0.7;
  m.metallic = 0;
  m.base_color = {1, 0.5, 0};
  set_material_values(d, 0, m);
  const SurfaceMaterial read = scene_of(d).materials.at(0);
  EXPECT_EQ(read.roughness, 0.7f);
  EXPECT_EQ(read.metallic, 0.0f);
  EXPECT_EQ(read.base_color.y, 0.5f);
}

// The node's world transform changes as requested, whatever the parents, and whether the file gives a matrix or its parts.
TEST(ViewNodes, MoveTurnAndScaleInTheWorldUnderAnyParent) {
  const Json poses[] = {{{"translation", {1, 2, 3}}, {"rotation", {0, 0.6, 0, 0.8}}, {"scale", {2, 2, 2}}},
                        {{"matrix", {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1}}}};
  for (const Json& parent : poses)
    for (const Json& child : poses) {
      GltfTestFile f = GltfTestFile::square();
      f.json["nodes"][0].update(nlohmann::json(child));
      f.append("nodes", nlohmann::json(parent));
      f.json["nodes"][1]["children"] = {0};
      EditedDocument d = document_of(f, "pose.gltf");
      const Affine before = NodeTree(d).world(0);
      const Affine above = NodeTree(d).parent_world(0);

      set_pose(d, 0, moved(pose_of(d, 0), above, {0.5, -1, 2}));
      EXPECT_NEAR(length(NodeTree(d).world(0).t - before.t - Vec3d{0.5, -1, 2}), 0, 1e-12);
      EXPECT_NEAR(length(NodeTree(d).world(0).x - before.x), 0, 1e-12);

      d.undo();
      const Vec3d axis = normalized(Vec3d{1, 2, 2});
      set_pose(d, 0, turned(pose_of(d, 0), above, axis, 0.7));
      const Affine turned_world = NodeTree(d).world(0);
      EXPECT_NEAR(length(turned_world.t - before.t), 0, 1e-12);
      // Rodrigues' formula in world space.
      const auto expected = [&](Vec3d v) {
        return v * std::cos(0.7) + cross(axis, v) * std::sin(0.7) + axis * (dot(axis, v) * (1 - std::cos(0.7)));
      };
      EXPECT_NEAR(length(turned_world.x - expected(before.x)), 0, 1e-11);
      EXPECT_NEAR(length(turned_world.z - expected(before.z)), 0, 1e-11);

      d.undo();
      set_pose(d, 0, scaled(pose_of(d, 0), {3, 1, 0.5}));
      EXPECT_NEAR(length(NodeTree(d).world(0).x - before.x * 3), 0, 1e-11);
      EXPECT_NEAR(length(NodeTree(d).world(0).y - before.y), 0, 1e-12);
      EXPECT_NEAR(length(NodeTree(d).world(0).z - before.z * 0.5), 0, 1e-11);
    }
}

}  // namespace
}  // namespace steradian::view::document_test
