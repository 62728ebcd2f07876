// A session driven by its pointer and keys, without a window: pictures, files, memory, time.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "player.h"
#include "steradian/error.h"
#include "support/gltf_test_file.h"
#include "support/memory.h"
#include "support/viewer_session.h"

namespace steradian::view::session_test {
namespace {

// The promise of the window: at rest it shows the same picture that `render` makes of the saved file.
TEST(ViewSession, SavesASceneThatRendersToTheSameBits) {
  for (const char* name : {"diffuse_floor.glb", "gallery.glb"}) {
    Session s(test::kSourceDir + "/scenes/" + name, small());
    s.wait_until_settled();
    s.camera().orbit(0.05, -0.02);
    s.camera().dolly(1);
    s.select({s.lamps().at(0).node, -1});
    s.add_light("sphere");
    s.changed();
    s.wait_until_settled();
    ASSERT_TRUE(s.message().empty()) << s.message();
    const std::string path = scene::test_path(std::string("saved_") + name);
    s.save_scene(path);
    const Picture again = render(load_scene(path).scene, small());
    ASSERT_EQ(again.width, s.frame().picture.width);
    EXPECT_EQ(again.pixels, s.frame().picture.pixels) << name;
    // The saved file opens in the same state.
    Session opened(path, small());
    opened.wait_until_settled();
    EXPECT_EQ(opened.frame().picture.pixels, again.pixels);
  }
}

// The default light, its fill and its camera are those of the saved file, too.
TEST(ViewSession, SavesASceneOfDefaultsThatRendersToTheSameBits) {
  const std::string from = scene::GltfTestFile::square().write("defaults.glb"), to = scene::test_path("saved_defaults.glb");
  Session s(from, small());
  s.wait_until_settled();
  s.camera().orbit(0.6, 0.1);
  s.changed();
  s.wait_until_settled();
  s.save_scene(to);
  EXPECT_EQ(render(load_scene(to).scene, small()).pixels, s.frame().picture.pixels);
}

// The last picture is that of `render`, also with kept patches.
TEST(ViewSession, BAddsAllLightAndTakesItAway) {
  ViewState state;
  open_stage(state, test::kSourceDir + "/scenes/cornell.glb", small());
  RenderOptions all = small();
  all.bounces = kAllBounces;
  const auto expect_picture_of = [&](const RenderOptions& options) {
    state.session->wait_until_settled();
    EXPECT_EQ(state.session->frame().light, ShownLight::all);
    EXPECT_EQ(state.session->frame().picture.pixels, render(state.session->frame().scene->scene, options).pixels);
  };
  expect_picture_of(small());
  act(state, Action::bounce);
  expect_picture_of(all);
  state.session->camera().orbit(0.1, 0);
  state.session->changed();
  expect_picture_of(all);
  act(state, Action::bounce);
  expect_picture_of(small());
}

TEST(ViewSession, SaysWhatIsWrongAndGoesOn) {
  EXPECT_THROW(Session("/nowhere.glb", small()), Error);
  Session s(room(), small());
  s.wait_until_settled();
  s.document().set("/materials/0/pbrMetallicRoughness/roughnessFactor", 7);
  s.changed();
  s.wait_until_settled();
  EXPECT_NE(s.message().find("roughnessFactor"), std::string::npos) << s.message();
  s.undo();
  s.wait_until_settled();
  EXPECT_EQ(s.message(), "");
}

TEST(ViewSession, ReadsAFileAgainAndKeepsTheCamera) {
  const std::string path = scene::test_path("hot.glb");
  std::filesystem::copy_file(room(), path, std::filesystem::copy_options::overwrite_existing);
  Session s(path, small());
  s.wait_until_settled();
  EXPECT_FALSE(s.file_changed());
  s.camera().orbit(0.1, 0);
  const Vec3d eye = s.camera().camera().position;
  scene::GltfFile file = scene::read_gltf_file(path);
  file.json["extensions"]["EXT_lights_area"]["lights"][0]["intensity"] = 77;
  write_gltf_file(file, path);
  std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) + std::chrono::seconds(2));
  EXPECT_TRUE(s.file_changed());
  s.reload();
  s.wait_until_settled();
  EXPECT_EQ(values_of(s.document(), s.lamps().at(0)).intensity, 77);
  EXPECT_EQ(s.camera().camera().position, eye);
  EXPECT_FALSE(s.file_changed());
}

TEST(ViewSession, ADragIsAnsweredBySmallPicturesAndEndsInTheWholeOne) {
  Session s(test::kSourceDir + "/scenes/gallery.glb", small());
  s.options().width = 640;
  s.options().height = 360;
  s.changed();
  while (!s.update()) std::this_thread::yield();
  EXPECT_EQ(s.frame().divisor, 4) << "nothing is known of the machine: a quarter comes first";
  s.press(PointerButton::left, false, {10, 10});
  for (int i = 0; i < 20; ++i) {
    s.drag({10.0 + 4 * i, 10});
    s.update();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_FALSE(s.settled());
  s.release({90, 10});
  s.wait_until_settled();
  EXPECT_EQ(s.frame().divisor, 1);
  EXPECT_EQ(s.frame().picture.width, 640);
}

TEST(ViewSession, DoesNotLoseWhatIsUnsavedToAFileThatChanges) {
  const std::string path = scene::test_path("followed.glb");
  std::filesystem::copy_file(room(), path, std::filesystem::copy_options::overwrite_existing);
  ViewState state;
  open_stage(state, path, small());
  state.stage->wait_until_settled();
  const auto touch = [&](int seconds) {
    std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) + std::chrono::seconds(seconds));
  };
  const auto intensity = [&] { return values_of(state.session->document(), state.session->lamps().at(0)).intensity; };
  const double before = intensity();
  state.stage->select_named("panel");
  set_value(state, "intensity", before + 1);
  touch(2);
  follow_file(state);
  EXPECT_NE(state.stage->message().find("F5"), std::string::npos);
  EXPECT_EQ(intensity(), before + 1);
  act(state, Action::reload);
  EXPECT_EQ(intensity(), before);
  EXPECT_FALSE(state.stage->unsaved());
  touch(4);
  EXPECT_TRUE(state.stage->file_changed());
  follow_file(state);
  EXPECT_FALSE(state.stage->file_changed());
  EXPECT_THROW(set_value(state, "weight", 1), Error);
  EXPECT_THROW(set_value(state, "intensity", "much"), Error);
}

// Whatever a file contains when it is read again, the window survives and shows the problem.
TEST(ViewSession, SurvivesFilesThatBreakWhileTheyAreOpen) {
  const std::string path = scene::test_path("breaks.gltf");
  const scene::GltfFile good = scene::read_gltf_file(room());
  write_gltf_file(good, path);
  Session s(path, small());
  s.wait_until_settled();
  s.select_named("panel");
  const Json wrong[] = {nullptr, "x", 7, -1, 1e300, Json::array(), Json::object(), Json::array({"a", "b", "c"}), Json::array({nullptr})};
  int said = 0, refused = 0;
  for (const char* place : {"/nodes", "/nodes/0", "/nodes/1/extensions", "/nodes/1/extensions/EXT_lights_area/light", "/nodes/1/matrix",
                            "/cameras", "/cameras/0", "/scenes", "/scenes/0/nodes", "/scene", "/materials/0/pbrMetallicRoughness",
                            "/meshes/0/primitives", "/extensions/EXT_lights_area/lights/0", "/extensions/EXT_lights_area/lights/0/color",
                            "/nodes/0/children", "/nodes/0/mesh", "/animations"})
    for (const Json& value : wrong) {
      scene::GltfFile broken = good;
      broken.json[Json::json_pointer(place)] = value;
      write_gltf_file(broken, path);
      try {
        s.reload();
      } catch (const std::exception&) {
        ++refused;
        continue;
      }
      s.wait_until_settled();
      said += s.message().empty() ? 0 : 1;
      s.gizmo();
      for (const Lamp& lamp : s.lamps()) values_of(s.document(), lamp);
      material_values(s.document(), 0);
      pose_of(s.document(), 0);
      s.press(PointerButton::left, false, {80, 45});
      s.release({80, 45});
    }
  write_gltf_file(good, path);
  s.reload();
  s.wait_until_settled();
  EXPECT_EQ(s.message(), "");
  std::printf("%d files refused, %d said to be wrong\n", refused, said);
  EXPECT_GT(refused + said, 50);
}

// Finished requests leave no memory behind, measured by the process's memory in pages. STERADIAN_FRAMES sets another number of frames.
TEST(ViewSession, ManyFramesLeaveMemoryWhereItWas) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer keeps what is freed";
#endif
  RenderOptions tiny = small();
  tiny.width = 16;
  tiny.height = 9;
  tiny.threads = 1;
  Session s(room(), tiny);
  const auto frames = [&](int count) {
    s.select_named("panel");
    for (int i = 0; i < count; ++i) {
      LampValues v = values_of(s.document(), s.lamps().at(0));
      v.intensity = 1 + i % 7;
      set_values(s.document(), s.lamps().at(0), v);
      s.changed();
      s.wait_until_settled();
    }
    s.document().close_step();
  };
  frames(100);
  const double before = test::resident_mib();
  const char* asked = std::getenv("STERADIAN_FRAMES");
  const int count = asked != nullptr ? std::max(1, std::atoi(asked)) : 10000;
  frames(count);
  std::printf("%d frames: %.1f MB more\n", count, test::resident_mib() - before);
  // A frame of this size, its scene and its request take some ten kilobytes. If one in fifty leaked, 10,000 frames would show it.
  EXPECT_LT(test::resident_mib(), before + 2);
}

// For a changing scene, pictures from cached data equal those of the same scene read and sorted from scratch, bit by bit.
TEST(ViewSession, KeepsWhatHasNotChangedAndLosesNothing) {
  const RenderOptions options = small();
  Session s(test::kSourceDir + "/scenes/room.glb", options);
  s.wait_until_settled();
  const std::size_t meshes = s.frame().scene->scene.meshes.size();
  const auto check = [&](const char* what) {
    s.wait_until_settled();
    ASSERT_EQ(s.message(), "");
    const std::string path = scene::test_path("kept.glb");
    s.save_scene(path);
    EXPECT_EQ(render(load_scene(path).scene, options).pixels, s.frame().picture.pixels) << what;
  };
  s.camera().orbit(0.02, 0.01);
  s.changed();
  check("a camera");
  const int lamp = s.lamps().at(0).node;
  set_pose(s.document(), lamp, moved(pose_of(s.document(), lamp), s.tree().parent_world(lamp), {0.1, 0.05, 0}));
  s.changed();
  check("a light that moves");
  EXPECT_GT(s.frame().scene->kept_meshes, 0u);
  LampValues v = values_of(s.document(), s.lamps().at(0));
  v.intensity *= 2;
  set_values(s.document(), s.lamps().at(0), v);
  s.changed();
  check("a light's radiance");
  const int node = s.frame().scene->mesh_nodes.at(1);
  set_pose(s.document(), node, turned(pose_of(s.document(), node), s.tree().parent_world(node), {0, 1, 0}, 0.2));
  s.changed();
  check("a mesh that turns");
  EXPECT_GT(s.frame().scene->kept_meshes, 0u);
  EXPECT_LT(s.frame().scene->kept_meshes, meshes);
  s.add_light("polygon");
  check("a light that comes");
  s.remove_selected();
  check("and goes");
  while (s.document().can_undo()) s.undo();
  s.changed();
  check("all of it undone");
}

TEST(ViewSession, ShowsTheMomentsOfAnAnimation) {
  Session s(test::kSourceDir + "/scenes/morph.glb", small());
  s.wait_until_settled();
  ASSERT_EQ(s.animations().size(), 1u);
  const Picture start = s.frame().picture;
  const auto corners = [&] {  // 0: an ellipse
    const auto* polygon = std::get_if<Polygon>(&s.frame().scene->scene.area_lights.at(0).shape);
    return polygon != nullptr ? polygon->vertices.size() : 0u;
  };
  EXPECT_EQ(corners(), 40u) << "a star, with points on its edges";
  s.set_time(2);
  s.wait_until_settled();
  EXPECT_EQ(corners(), 0u) << "an outline on a circle is taken for a disk";
  s.set_time(1);
  s.wait_until_settled();
  EXPECT_EQ(corners(), 40u) << "between them";
  EXPECT_NE(s.frame().picture.pixels, start.pixels);
  s.set_time(8);  // twice its length
  s.wait_until_settled();
  s.set_time(4);
  s.wait_until_settled();
  EXPECT_EQ(corners(), 40u);
  EXPECT_EQ(s.message(), "");
}

}  // namespace
}  // namespace steradian::view::session_test
