// A session driven by its pointer and keys, without a window: by its effect on the scene and on the picture.
#include "session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/test_memory.h"
#include "paths.h"
#include "player.h"
#include "scene/gltf_test_file.h"
#include "steradian/error.h"

namespace steradian::view {
namespace {

RenderOptions small() {
  RenderOptions options;
  options.width = 160;
  options.height = 90;
  options.shadows = Shadows::on;
  return options;
}

std::string room() { return test::kSourceDir + "/scenes/diffuse_floor.glb"; }

Vec2d pixel_of(Session& s, Vec3d point) { return *project(s.camera().camera(), point, s.options().width, s.options().height); }

void drag(Session& s, Vec2d from, Vec2d to) {
  s.press(PointerButton::left, false, from);
  for (int i = 1; i <= 4; ++i) {
    s.drag(from + (to - from) * (i / 4.0));
    s.update();
  }
  s.release(to);
}

TEST(ViewCamera, RaysGoThroughThePixelsThatPointsProjectTo) {
  Session s(room(), small());
  s.wait_until_settled();
  s.camera().orbit(0.1, 0.2);
  s.camera().pan(0.1, -0.3);
  s.camera().look(-0.2, 0.1);
  const Camera c = s.camera().camera();
  EXPECT_NEAR(dot(c.x, c.y), 0, 1e-15);
  EXPECT_NEAR(length(cross(c.x, c.y) - c.z), 0, 1e-14);
  for (const Vec2d p : {Vec2d{0.5, 0.5}, Vec2d{80, 45}, Vec2d{159.5, 3}}) {
    const Ray r = ray_through(c, p, 160, 90);
    const auto back = project(c, r.origin + r.direction * 3, 160, 90);
    ASSERT_TRUE(back);
    EXPECT_NEAR(length(*back - p), 0, 1e-10);
  }
  EXPECT_FALSE(project(c, c.position + c.z, 160, 90)) << "behind";
}

TEST(ViewCamera, OrbitsAboutItsTargetAndDoesNotTurnOver) {
  Camera c;
  c.position = {0, 0, 5};
  ViewCamera v(c, 5);
  v.orbit(0.25, 0.1);
  EXPECT_NEAR(length(v.target()), 0, 1e-14);
  EXPECT_NEAR(length(v.camera().position), 5, 1e-14);
  for (int i = 0; i < 50; ++i) v.orbit(0, 0.3);
  EXPECT_GT(v.camera().y.y, 0) << "up stays up";
  EXPECT_GT(v.camera().position.y, 4.9);
}

TEST(ViewWorker, ChoosesTheLargestPictureThatTheTimeAllows) {
  EXPECT_EQ(divisor_within(33, {0, 20, 1}), 1);
  EXPECT_EQ(divisor_within(33, {0, 100, 1}), 2);
  EXPECT_EQ(divisor_within(33, {0, 30, 4}), 4);
  EXPECT_EQ(divisor_within(33, {0, 1, 4}), 1);
  EXPECT_EQ(divisor_within(33, {0, 1e9, 1}), 8);
  EXPECT_EQ(divisor_within(33, {20, 20, 1}), 2) << "the scene's own time leaves less";
  EXPECT_EQ(divisor_within(33, {1e6, 20, 1}), 2) << "but half of it";
}

// The promise of the window: at rest it shows what `render` makes of what it saves.
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
    // And it opens as it was left.
    Session opened(path, small());
    opened.wait_until_settled();
    EXPECT_EQ(opened.frame().picture.pixels, again.pixels);
  }
}

TEST(ViewSession, PicksALampInThePictureAndDragsItByItsArrow) {
  Session s(room(), small());
  s.wait_until_settled();
  const Lamp lamp = s.lamps().at(0);
  const Vec3d at = s.tree().world(lamp.node).t;
  // A click on the middle of the light, seen from below it.
  s.camera().look_at(at);
  s.changed();
  s.wait_until_settled();
  const Vec2d pixel = pixel_of(s, at);
  s.press(PointerButton::left, false, pixel);
  s.release(pixel);
  ASSERT_EQ(s.selection().node, lamp.node);

  const Picture before = s.frame().picture;
  const Gizmo gizmo = *s.gizmo();
  for (const int axis : {0, 1, 2}) {
    const Vec2d from = pixel_of(s, gizmo.origin + gizmo.axes[axis] * (0.8 * gizmo.size));
    const Vec2d to = pixel_of(s, gizmo.origin + gizmo.axes[axis] * (1.3 * gizmo.size));
    if (length(to - from) < 5) continue;  // seen from its end
    drag(s, from, to);
    const Vec3d by = s.tree().world(lamp.node).t - at;
    EXPECT_NEAR(length(by - gizmo.axes[axis] * (0.5 * gizmo.size)), 0, 1e-9) << axis;
    s.undo();
    EXPECT_NEAR(length(s.tree().world(lamp.node).t - at), 0, 1e-12) << "a drag is one step";
  }
  s.wait_until_settled();
  EXPECT_EQ(s.frame().picture.pixels, before.pixels) << "after undo the picture is as it was";
}

TEST(ViewSession, TurnsAndScalesByItsHandles) {
  RenderOptions large = small();  // handles must be further apart than a hand reaches
  large.width = 640;
  large.height = 360;
  Session s(room(), large);
  s.wait_until_settled();
  const int node = s.lamps().at(0).node;
  s.select({node, -1});
  s.camera().look_at(s.tree().world(node).t);
  s.camera().orbit(0.1, 0);  // no handle behind another
  const Affine before = s.tree().world(node);

  s.gizmo_mode = GizmoMode::turn;
  const Gizmo ring = *s.gizmo();
  // A ring that is seen well: about the axis nearest to the view.
  int axis = 0;
  for (const int i : {1, 2})
    if (std::fabs(dot(ring.axes[i], s.camera().camera().z)) > std::fabs(dot(ring.axes[axis], s.camera().camera().z))) axis = i;
  const Frame frame = Frame::from_normal(ring.axes[axis]);
  const auto on_ring = [&](double angle) {
    return pixel_of(s, ring.origin + (frame.x * std::cos(angle) + frame.y * std::sin(angle)) * ring.size);
  };
  drag(s, on_ring(0.3), on_ring(0.8));
  const Affine turned_world = s.tree().world(node);
  const Vec3d a = before.x - ring.axes[axis] * dot(before.x, ring.axes[axis]);
  const Vec3d b = turned_world.x - ring.axes[axis] * dot(turned_world.x, ring.axes[axis]);
  if (length(a) > 1e-6) {
    EXPECT_NEAR(std::acos(dot(normalized(a), normalized(b))), 0.5, 1e-6);
  }
  s.undo();

  s.gizmo_mode = GizmoMode::scale;
  const Gizmo boxes = *s.gizmo();
  for (const int i : {0, 1}) {
    const Vec2d from = pixel_of(s, boxes.origin + boxes.axes[i] * (0.5 * boxes.size));
    const Vec2d to = pixel_of(s, boxes.origin + boxes.axes[i] * boxes.size);
    if (length(to - from) < 5) continue;
    EXPECT_EQ(static_cast<int>(s.handle_under(from)), i + 1) << from.x << " " << from.y << " to " << to.x << " " << to.y;
    drag(s, from, to);
    EXPECT_NEAR(length((i == 0 ? s.tree().world(node).x : s.tree().world(node).y)) / length(i == 0 ? before.x : before.y), 2, 1e-6);
    s.undo();
  }
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

// Whatever a file says when it is read again, the window lives on and says what is wrong.
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

// What is answered leaves nothing behind: by the memory of the process, in pages. STERADIAN_FRAMES asks for another number of them.
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
  // A frame of this size, its scene and its request are some ten kilobytes: were one in fifty kept, 10,000 would show.
  EXPECT_LT(test::resident_mib(), before + 2);
}

// The corner of a polygon seen in the picture is dragged over the polygon's plane, to where the pointer's ray meets it.
TEST(ViewSession, DragsTheCornersOfAPolygon) {
  Session s(room(), small());
  s.options().width = 640;
  s.options().height = 360;
  s.wait_until_settled();
  s.add_light("polygon");
  s.wait_until_settled();
  ASSERT_EQ(s.message(), "");
  ASSERT_EQ(s.corners().size(), 1u);
  ASSERT_EQ(s.corners()[0].size(), 5u);
  const auto light = [&] {
    for (const AreaLight& l : s.frame().scene->scene.area_lights)
      if (l.name.starts_with("polygon")) return l;
    return AreaLight{};
  };
  const AreaLight before = light();
  const auto* shape = std::get_if<Polygon>(&before.shape);
  ASSERT_TRUE(shape != nullptr && shape->vertices.size() == 5u);
  EXPECT_LT(dot(prepare_polygon(flat_polygon(before)).normal, Vec3d{0, 1, 0}), -0.999) << "it shines down";
  EXPECT_EQ(before.radiance, (Vec3d{5, 5, 5}));

  s.camera().look_at(s.corners()[0][0]);
  s.camera().orbit(0.1, -0.3);  // from below: the plane must not be seen from its edge
  const std::vector<Vec3d> corners = s.corners()[0];
  std::size_t taken = 0;
  for (std::size_t i = 0; i < 5; ++i)  // that nothing else stands before
    if (s.corner_under(pixel_of(s, corners[i])) == CornerPlace{0, i}) taken = i;
  const Vec3d middle = (corners[0] + corners[1] + corners[2] + corners[3] + corners[4]) / 5.0;
  const Vec3d wanted = corners[taken] + (corners[taken] - middle) * 0.5;
  drag(s, pixel_of(s, corners[taken]), pixel_of(s, wanted));
  s.wait_until_settled();
  ASSERT_EQ(s.message(), "");
  double nearest = 1e9, still = 0;
  for (const Vec3d c : s.corners()[0]) nearest = std::min(nearest, length(c - wanted));
  EXPECT_LT(nearest, 1e-6) << "vertices are single precision";
  ASSERT_TRUE(s.corner());
  EXPECT_LT(length(s.corners()[0][s.corner()->corner] - wanted), 1e-6) << "and it stays the one that is taken";
  for (std::size_t i = 0; i < 5; ++i) {
    double d = 1e9;
    for (const Vec3d c : s.corners()[0]) d = std::min(d, length(c - corners[i]));
    if (i != taken) still = std::max(still, d);
  }
  EXPECT_LT(still, 1e-6);
  // The pentagon's area grows by half a corner's triangle: by its base across the neighbours.
  const Vec3d base = corners[(taken + 1) % 5] - corners[(taken + 4) % 5];
  const double grown = length(cross(base, wanted - corners[taken])) / 2;
  EXPECT_NEAR(light().power / 5, before.power / 5 + grown, 1e-5);

  // Over the edge across it goes only as far as the outline is whole.
  const std::vector<Vec3d> whole = s.corners()[0];
  drag(s, pixel_of(s, wanted), pixel_of(s, middle * 3.0 - wanted * 2.0));
  s.wait_until_settled();
  EXPECT_EQ(s.message(), "");
  EXPECT_EQ(s.corners()[0].size(), 5u);
  s.undo();
  s.undo();
  s.wait_until_settled();
  EXPECT_EQ(light().power, before.power) << "each drag is one step";
}

TEST(ViewSession, AddsAndRemovesCorners) {
  Session s(test::kSourceDir + "/scenes/gallery.glb", small());
  s.wait_until_settled();
  s.add_light("polygon");
  s.press(PointerButton::left, false, pixel_of(s, s.corners().at(0).at(1)));
  s.release(pixel_of(s, s.corners()[0][1]));
  ASSERT_TRUE(s.corner());
  const Vec3d first = s.corners()[0][s.corner()->corner], second = s.corners()[0][(s.corner()->corner + 1) % 5];
  s.add_corner();
  ASSERT_EQ(s.corners()[0].size(), 6u);
  ASSERT_TRUE(s.corner()) << "the new one is taken";
  EXPECT_NEAR(length(s.corners()[0][s.corner()->corner] - (first + second) * 0.5), 1e-3 * length(second - first), 1e-5);
  for (int i = 0; i < 5; ++i) {
    s.press(PointerButton::left, false, pixel_of(s, s.corners()[0][0]));
    s.release(pixel_of(s, s.corners()[0][0]));
    s.remove_corner();
  }
  EXPECT_EQ(s.corners()[0].size(), 3u) << "a triangle keeps its corners";
  s.wait_until_settled();
  EXPECT_EQ(s.message(), "");
  for (int i = 0; i < 5; ++i) s.undo();
  EXPECT_TRUE(s.corners().empty()) << "and with it the lamp";
}

// Lobes stand in the place of the specular one, as extras.steradian has them; undone, the file is as it was.
TEST(ViewSession, OverridesLobes) {
  ViewState state;
  open_stage(state, room(), small());
  Session& s = *state.session;
  s.wait_until_settled();
  const Picture before = s.frame().picture;
  const Json untouched = s.document().json();
  const auto material = [&] { return s.frame().scene->scene.materials.at(0); };
  for (const std::string& name : lobe_names()) {
    set_value(state, "material", 0);
    set_value(state, "lobe", name);
    s.wait_until_settled();
    EXPECT_EQ(s.message(), "") << name;
    ASSERT_EQ(material().specular_override.size(), 1u);
    EXPECT_EQ(name_of(material().specular_override[0].brdf), name);
    EXPECT_NE(s.frame().picture.pixels, before.pixels) << name;
    s.undo();
    EXPECT_EQ(s.document().json(), untouched);
  }
  set_value(state, "material", 0);
  set_value(state, "lobe", {{"brdf", "phong"}, {"exponent", 120}, {"albedo", 0.5}});
  s.wait_until_settled();
  EXPECT_EQ(material().specular_override.at(0).exponent, 120);
  set_value(state, "lobe", nullptr);
  s.wait_until_settled();
  EXPECT_EQ(s.frame().picture.pixels, before.pixels);
}

TEST(ViewSession, AddsEveryKindOfLight) {
  Session s(room(), small());
  s.wait_until_settled();
  for (const char* type : {"rect", "disk", "sphere", "capsule", "polygon", "point", "spot", "directional"}) {
    const Picture before = s.frame().picture;
    s.add_light(type);
    s.wait_until_settled();
    EXPECT_EQ(s.message(), "") << type;
    EXPECT_NE(s.frame().picture.pixels, before.pixels) << type;
    ASSERT_GE(s.selection().node, 0);
  }
  const std::size_t lamps = s.lamps().size();
  s.remove_selected();
  EXPECT_EQ(s.lamps().size(), lamps - 1);
}

// Of a scene that changes, pictures by what is kept are those of the same scene read and sorted anew, bit by bit.
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
}  // namespace steradian::view
