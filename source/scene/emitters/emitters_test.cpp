#include "scene/emitters/emitters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/affine.h"
#include "scene/framing.h"
#include "steradian/capsule_light.h"
#include "steradian/ellipse_light.h"
#include "steradian/load_scene.h"
#include "support/gltf_test_file.h"
#include "support/meshes.h"

namespace steradian::scene::emitters_test {
namespace {

// A ball of segments and rings as modelling programs build it, under an affine map.
Mesh ball(int segments, int rings, Vec3d x, Vec3d y, Vec3d z, Vec3d center) {
  Mesh mesh;
  const auto corner = [&](int ring, int segment) {
    const double theta = std::numbers::pi * ring / rings,
                 phi = 2 * std::numbers::pi * segment / segments;  // at poles and seam equal up to rounding
    const double s = std::sin(theta), c = std::cos(theta);
    mesh.positions.push_back(static_cast<Vec3f>(center + x * (s * std::cos(phi)) + y * (s * std::sin(phi)) + z * c));
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };
  for (int j = 0; j < rings; ++j)
    for (int i = 0; i < segments; ++i) {
      const std::uint32_t a = corner(j, i), b = corner(j + 1, i), c = corner(j + 1, i + 1), d = corner(j, i + 1);
      if (j + 1 < rings) mesh.indices.insert(mesh.indices.end(), {a, b, c});
      if (j > 0) mesh.indices.insert(mesh.indices.end(), {a, c, d});
    }
  return mesh;
}

// A tube of segments about the y axis, with rings at either end. flat: without the rings.
Mesh tube(int segments, int rings, double radius, double half_length, bool flat) {
  Mesh mesh;
  struct Row {
    double radius, y;
  };
  std::vector<Row> rows;
  for (int j = 0; j <= rings; ++j) {
    const double t = std::numbers::pi / 2 * j / rings;
    rows.push_back({radius * std::sin(t), flat ? half_length : half_length + radius * std::cos(t)});
  }
  for (std::size_t j = rows.size(); j-- > 0;) rows.push_back({rows[j].radius, -rows[j].y});
  const auto corner = [&](std::size_t row, int segment) {
    const double phi = 2 * std::numbers::pi * (segment % segments) / segments;
    mesh.positions.push_back(static_cast<Vec3f>(Vec3d{rows[row].radius * std::sin(phi), rows[row].y, rows[row].radius * std::cos(phi)}));
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };
  for (std::size_t j = 0; j + 1 < rows.size(); ++j)
    for (int i = 0; i < segments; ++i) {
      const std::uint32_t a = corner(j, i), b = corner(j + 1, i), c = corner(j + 1, i + 1), d = corner(j, i + 1);
      if (j + 2 < rows.size()) mesh.indices.insert(mesh.indices.end(), {a, b, c});
      if (j > 0) mesh.indices.insert(mesh.indices.end(), {a, c, d});
    }
  return mesh;
}

// A file with one emissive mesh, rotated and moved by its node.
GltfTestFile file_of(const Mesh& mesh, const Affine& world) {
  GltfTestFile f;
  std::vector<float> positions;
  for (const Vec3f& p : mesh.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
  const std::vector<std::uint16_t> indices(mesh.indices.begin(), mesh.indices.end());
  f.add_mesh({{"POSITION", f.add_floats(positions, "VEC3")}}, f.add_indices(indices));
  f.node()["matrix"] = {world.x.x, world.x.y, world.x.z, 0, world.y.x, world.y.y, world.y.z, 0,
                        world.z.x, world.z.y, world.z.z, 0, world.t.x, world.t.y, world.t.z, 1};
  f.material()["emissiveFactor"] = {1, 1, 1};
  f.material()["doubleSided"] = true;
  return f;
}

Mesh box(Vec3d low, Vec3d high) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back(
        static_cast<Vec3f>(Vec3d{(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z}));
  for (const std::uint32_t q : {0x0264u, 0x1573u, 0x0451u, 0x2376u, 0x0132u, 0x4675u}) {
    const std::uint32_t a = q >> 12, b = q >> 8 & 7, c = q >> 4 & 7, d = q & 7;
    mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
  }
  return mesh;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t c) { return static_cast<Vec3d>(mesh.positions[mesh.indices[i + c]]); };
    area += length(cross(at(1) - at(0), at(2) - at(0))) / 2;
  }
  return area;
}

void turn(Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

std::size_t add_all_emitters(Scene& scene) {
  Budget budget;
  return add_emitters(scene, budget, "a test");
}

Scene emitting(Mesh mesh, bool double_sided) {
  Scene scene;
  SurfaceMaterial m;
  m.emissive = {2, 2, 2};
  m.double_sided = double_sided;
  scene.materials.push_back(m);
  scene.meshes.push_back(std::move(mesh));
  EXPECT_EQ(add_all_emitters(scene), 0u);
  return scene;
}

// Irradiance of the scene's polygons at a point, divided by the radiance.
double irradiance(const Scene& scene, Vec3d position, Vec3d normal) {
  double sum = 0;
  for (const AreaLight& light : scene.area_lights) sum += polygon_irradiance(prepare_polygon(flat_polygon(light)), position, normal);
  return sum;
}

TEST(Emitters, ABallIsOneSphereOfItsAreaWhateverItsSidesAndAxes) {
  const Vec3d x{0.3, 0.1, 0}, y{-0.1, 0.3, 0}, z{0, 0, 0.2}, center{3, 1, -2};
  for (const bool double_sided : {false, true}) {
    const Scene scene = emitting(ball(32, 16, x, y, z, center), double_sided);
    ASSERT_EQ(scene.area_lights.size(), 1u);
    const auto& light = std::get<Ellipsoid>(scene.area_lights[0].shape);
    EXPECT_LT(length(light.center - center), 1e-6);
    const double size = std::sqrt(area_of(ball(32, 16, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {})) / (4 * std::numbers::pi));
    EXPECT_LT(size, 0.997);
    const double volume = std::fabs(dot(light.x, cross(light.y, light.z)));
    EXPECT_NEAR(std::cbrt(volume / dot(x, cross(y, z))), size, 1e-5);
    for (const std::int32_t index : scene.meshes[0].triangle_lights) EXPECT_EQ(index, 0);
    EXPECT_FALSE(scene.meshes[0].casts_shadow);
  }
}

TEST(Emitters, ATubeInAFileIsOneCapsuleThatSendsWhatItsMeshDoes) {
  constexpr int kSegments = 32;
  const Frame frame = Frame::from_normal(normalized(Vec3d{0.3, 0.8, -0.5}));
  const Affine world{frame.x, frame.y, frame.z, {0.5, 2, -1}};
  for (const double radius : {0.2, 0.02}) {
    const LoadedScene loaded = steradian::load_scene(file_of(tube(kSegments, 8, radius, 0.75, false), world).write());
    ASSERT_EQ(loaded.scene.area_lights.size(), 1u) << radius;
    const AreaLight& light = loaded.scene.area_lights[0];
    const auto& capsule = std::get<Capsule>(light.shape);
    EXPECT_NEAR(length(capsule.end_b - capsule.end_a), 1.5, 2e-6);
    EXPECT_NEAR(light.power, 4 * std::numbers::pi * capsule.radius * (capsule.radius + 0.75), 1e-6 * light.power);
    EXPECT_FALSE(loaded.scene.meshes[0].casts_shadow);

    // A fine mesh lies between the coarse mesh's inner and outer radius, as does the capsule. So the widths of their outlines differ by
    // less than these radii do. The ratio of the radii comes from cosines of half a step, around the tube and along the rings of its ends.
    const double between = 1 / (std::cos(std::numbers::pi / kSegments) * std::cos(std::numbers::pi / 32)) - 1;
    const Mesh mesh = tube(256, 64, radius, 0.75, false);
    for (const Vec3d position : {Vec3d{0, 0, 0}, Vec3d{2.5, 1.8, -1.1}, Vec3d{0.9, 2.6, -0.4}}) {
      const Vec3d normal = normalized(Vec3d{0.5, 2, -1} - position);
      double sum = 0;
      for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto at = [&](std::size_t c) { return world.point(static_cast<Vec3d>(mesh.positions[mesh.indices[i + c]])); };
        const Vec3d a = at(0), b = at(1), c = at(2);
        if (dot(cross(b - a, c - a), position - a) > 0) sum += polygon_irradiance(prepare_polygon({{a, b, c}, {}}), position, normal);
      }
      EXPECT_NEAR(capsule_irradiance(capsule, position, normal), sum, between * sum) << radius;
    }
  }
}

TEST(Emitters, ACylinderWithFlatEndsIsItsFacesAndTwoDisks) {
  const Scene scene = emitting(tube(32, 1, 0.2, 0.75, true), true);
  EXPECT_EQ(scene.area_lights.size(), 34u);
  int disks = 0;
  for (const AreaLight& light : scene.area_lights) {
    disks += std::holds_alternative<Ellipse>(light.shape);
    EXPECT_FALSE(light.two_sided);
  }
  EXPECT_EQ(disks, 2);
}

TEST(Emitters, ARoundBoxIsNoTube) {
  Mesh mesh = tube(32, 8, 0.2, 0.75, false);
  for (Vec3f& p : mesh.positions) p.x *= 1.001f;  // an elliptical cross-section
  EXPECT_GT(emitting(mesh, true).area_lights.size(), 1u);
}

TEST(Emitters, ACubeIsNoBall) {
  const Scene scene = emitting(box({-1, -1, -1}, {1, 1, 1}), true);
  EXPECT_EQ(scene.area_lights.size(), 6u);
  EXPECT_TRUE(scene.meshes[0].casts_shadow);
}

TEST(Emitters, AClosedMeshShinesOutwardsWhateverItsFlagAndWinding) {
  const Vec3d point{0, 3, 0}, down{0, -1, 0};
  // Expected irradiance of the front side alone: a square of side 2, two units away.
  Scene front;
  front.area_lights.emplace_back();
  front.area_lights[0].shape = Polygon{{{-1, 1, -1}, {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}}, {}};
  const double right = irradiance(front, point, down);
  EXPECT_GT(right, 0.5);
  for (const bool turned : {false, true}) {
    Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
    if (turned) turn(mesh);
    EXPECT_NEAR(irradiance(emitting(mesh, true), point, down), right, 1e-6) << turned;
  }
  EXPECT_NEAR(irradiance(emitting(box({-1, -1, -1}, {1, 1, 1}), false), point, down), right, 1e-6);
}

TEST(Emitters, AnOpenMeshAndADomeShineAsTheFileSays) {
  Mesh open = box({-1, -1, -1}, {1, 1, 1});
  open.indices.resize(open.indices.size() - 6);
  for (const AreaLight& light : emitting(open, true).area_lights) EXPECT_TRUE(light.two_sided);

  Scene scene;
  SurfaceMaterial m;
  m.emissive = {1, 1, 1};
  m.double_sided = true;
  scene.materials = {m, {}};
  scene.meshes = {box({-9, -9, -9}, {9, 9, 9}), box({-1, -1, -1}, {1, 1, 1})};
  scene.meshes[1].material = 1;
  add_all_emitters(scene);
  ASSERT_EQ(scene.area_lights.size(), 6u);
  EXPECT_GT(irradiance(scene, {0, 2, 0}, {0, 1, 0}), 3.14);  // from inside a dome: pi
}

TEST(Emitters, ARoundFlatPatchIsADisk) {
  for (const int corners : {12, 32}) {
    Mesh mesh;
    for (int i = 0; i < corners; ++i) {
      const double t = 2 * std::numbers::pi * i / corners;
      mesh.positions.push_back(static_cast<Vec3f>(Vec3d{0.5 * std::cos(t), 2, 0.25 * std::sin(t)}));
    }
    for (int i = 1; i + 1 < corners; ++i)
      mesh.indices.insert(mesh.indices.end(), {0u, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i + 1)});
    const Scene scene = emitting(mesh, false);
    ASSERT_EQ(scene.area_lights.size(), 1u);
    const AreaLight& light = scene.area_lights[0];
    EXPECT_EQ(std::holds_alternative<Ellipse>(light.shape), corners == 32);
    if (corners != 32) continue;
    const auto& disk = std::get<Ellipse>(light.shape);
    const double area = std::numbers::pi * length(cross(disk.x, disk.y));
    EXPECT_NEAR(area, 16 * std::sin(2 * std::numbers::pi / 32) * 0.125, 1e-6);  // the area of the mesh
    EXPECT_GT(cross(disk.x, disk.y).y * (dot(Vec3d{0, 1, 0}, prepare_polygon(flat_polygon(light)).normal)), 0);
  }
}

TEST(Framing, OnlyEmissiveTexturesLeaveRoomForTheDefaultLight) {
  Scene scene = emitting(box({-1, -1, -1}, {1, 1, 1}), false);
  measure_bounds(scene);
  const Camera outside = framing_camera(scene, 1);
  for (AreaLight& light : scene.area_lights) light.power = 1e-6;
  EXPECT_FALSE(wants_light(scene, outside));  // placed by its author, however weak
  for (AreaLight& light : scene.area_lights) light.texture.emplace();
  EXPECT_TRUE(wants_light(scene, outside));
  Mesh room = box({-9, -9, -9}, {9, 9, 9});  // it lights this room, so it is a lamp
  turn(room);
  scene.meshes.push_back(room);
  Camera inside;
  inside.position = {0, 2, 5};
  EXPECT_FALSE(wants_light(scene, inside));
  scene.meshes.pop_back();
  scene.area_lights[0].power = default_light(scene).power;
  EXPECT_FALSE(wants_light(scene, outside));
  scene.area_lights.clear();
  EXPECT_TRUE(wants_light(scene, outside));
  add_lights(scene, {AddedLight::sun, AddedLight::studio});
  EXPECT_EQ(scene.punctual_lights.size(), 1u);
  EXPECT_EQ(scene.area_lights.size(), 3u);
  EXPECT_FALSE(wants_light(scene, outside));
}

TEST(Framing, ABoxShowsItsFrontAndASideAndNeitherIsBlack) {
  Scene scene = emitting(box({-1, -1, -1}, {1, 1, 1}), false);
  scene.area_lights.clear();
  measure_bounds(scene);
  scene.cameras = {framing_camera(scene, 1.5)};
  const Camera& camera = scene.cameras[0];
  EXPECT_NEAR(camera.z.x / camera.z.z, 0.6, 1e-12);
  EXPECT_GT(camera.z.y, 0.5) << "from 30 degrees up, the top is seen under half of its area";
  EXPECT_EQ(camera.x.y, 0) << "the horizon is level";
  EXPECT_NEAR(dot(cross(camera.x, camera.y), camera.z), 1, 1e-12);
  add_lights(scene, {AddedLight::standard});
  ASSERT_EQ(scene.area_lights.size(), 1u);
  ASSERT_EQ(scene.punctual_lights.size(), 1u);
  const PunctualLight& fill = scene.punctual_lights[0];
  const PreparedPolygon key = prepare_polygon(flat_polygon(scene.area_lights[0]));
  const double whole = scene.area_lights[0].radiance.x * polygon_irradiance(key, {}, -key.normal);
  EXPECT_NEAR(fill.intensity.x, whole / 4, 0.1 * whole) << "a quarter of the default light, whose irradiance is pi only from afar";
  for (const Vec3d normal : {Vec3d{1, 0, 0}, Vec3d{0, 0, 1}}) {
    EXPECT_GT(dot(camera.position - normal, normal), 0) << "the side is in view";
    EXPECT_GT(-dot(fill.direction, normal), 0.3) << "and lit";
  }
}

TEST(Framing, LabelsBehindWhatTheCameraSeesAreNoLight) {
  // The light is very bright and as large as the ball; it lights the ball's rim.
  Scene scene = emitting(quad_mesh({-4, -1, 0}, {-2, -1, 0}, {-2, 1, 0}, {-4, 1, 0}, 0), false);
  scene.area_lights[0].texture.emplace();
  scene.materials.push_back({});
  scene.meshes.push_back(ball(32, 16, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1.1}));
  scene.meshes[1].material = 1;
  measure_bounds(scene);
  Camera camera;
  camera.position = {0, 0, 10};
  EXPECT_TRUE(wants_light(scene, camera));
  camera.position = {-10, 0, 1.1};  // the side that it lights
  EXPECT_FALSE(wants_light(scene, camera));
  scene.area_lights[0].texture.reset();
  camera.position = {0, 0, 10};
  EXPECT_FALSE(wants_light(scene, camera));
}

}  // namespace
}  // namespace steradian::scene::emitters_test
