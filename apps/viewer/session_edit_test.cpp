// Edits of a scene in a session: their effect on the scene and on the picture.
#include <gtest/gtest.h>

#include <cmath>

#include "player.h"
#include "steradian/error.h"
#include "support/viewer_session.h"

namespace steradian::view::session_edit_test {
namespace {

TEST(ViewSession, PicksALampInThePictureAndDragsItByItsArrow) {
  Session s(room(), small());
  s.wait_until_settled();
  const Lamp lamp = s.lamps().at(0);
  const Vec3d at = s.tree().world(lamp.node).t;
  // A click on the middle of the light, viewed from below.
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
    if (length(to - from) < 5) continue;  // viewed from its end
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
  RenderOptions large = small();  // handles must be further apart than the pointer's reach
  large.width = 640;
  large.height = 360;
  Session s(room(), large);
  s.wait_until_settled();
  const int node = s.lamps().at(0).node;
  s.select({node, -1});
  s.camera().look_at(s.tree().world(node).t);
  s.camera().orbit(0.1, 0);  // no handle occludes another
  const Affine before = s.tree().world(node);

  s.gizmo_mode = GizmoMode::turn;
  const Gizmo ring = *s.gizmo();
  // The ring about the axis nearest to the view is the most visible one.
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

// A visible corner of a polygon is dragged over the polygon's plane, to the point where the pointer's ray meets it.
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
  s.camera().orbit(0.1, -0.3);  // from below: the plane must not be viewed edge-on
  const std::vector<Vec3d> corners = s.corners()[0];
  std::size_t taken = 0;
  for (std::size_t i = 0; i < 5; ++i)  // an unoccluded corner
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
  // The pentagon's area grows by a triangle over the base across the corner's neighbours.
  const Vec3d base = corners[(taken + 1) % 5] - corners[(taken + 4) % 5];
  const double grown = length(cross(base, wanted - corners[taken])) / 2;
  EXPECT_NEAR(light().power / 5, before.power / 5 + grown, 1e-5);

  // Beyond the opposite edge the corner goes only as far as the outline stays valid.
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

// Lobes replace the specular one, as in extras.steradian. After undo the file is as before.
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
  const char* last = "directional";
  for (const char* type : {"rect", "disk", "sphere", "capsule", "polygon", "point", "spot", last}) {
    const Picture before = s.frame().picture;
    s.add_light(type);
    s.wait_until_settled();
    EXPECT_EQ(s.message(), "") << type;
    EXPECT_NE(s.frame().picture.pixels, before.pixels) << type;
    ASSERT_GE(s.selection().node, 0);
    if (type == last) break;
    s.remove_selected();  // the next one stands at the same place, and one in the plane of another is ill-posed
    s.wait_until_settled();
  }
  const std::size_t lamps = s.lamps().size();
  s.remove_selected();
  EXPECT_EQ(s.lamps().size(), lamps - 1);
}

}  // namespace
}  // namespace steradian::view::session_edit_test
