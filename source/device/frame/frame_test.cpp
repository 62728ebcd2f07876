// The CPU is the reference for the device: whole frames, every method, all kinds of lights.
#include "device/frame/frame.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <tuple>

#include "device/shadow/shadows.h"
#include "night.h"
#include "steradian/error.h"
#include "support/device_frames.h"
#include "support/memory.h"

namespace steradian::vulkan::frame_test {
namespace {

// A circle of corners about a centre, in a plane z = constant, with the lit side along z.
std::vector<Vec3d> ring(Vec3d center, double radius, int corners) {
  std::vector<Vec3d> vertices;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    vertices.push_back(center + Vec3d{radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return vertices;
}

// Every kind of light, and surfaces of every lobe that the device has: a floor, a wall behind it, a cloth, and a pane in front of them.
// Lights touch the surfaces' horizons, stand next to them and far away.
Scene everything() {
  Scene scene;
  SurfaceMaterial floor, wall, pane, cloth;
  floor.name = "floor";
  floor.metallic = 0.3f;
  floor.roughness = 0.35f;
  floor.base_color = {0.7f, 0.6f, 0.5f, 1};
  floor.clearcoat = 0.5f;
  floor.clearcoat_roughness = 0.3f;
  wall.name = "wall";
  wall.metallic = 0;
  wall.roughness = 0.6f;
  pane.name = "pane";
  pane.alpha_mode = AlphaMode::blend;
  pane.base_color = {0.2f, 0.4f, 0.5f, 0.4f};
  pane.roughness = 0.2f;
  cloth.name = "cloth";
  cloth.metallic = 0;
  cloth.specular = 0;
  cloth.sheen_color = {0.4f, 0.1f, 0.1f};
  cloth.sheen_roughness = 0.5f;
  scene.materials = {floor, wall, pane, cloth};
  scene.meshes = {scene::quad_mesh({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}, 0),
                  scene::quad_mesh({-4, 0, -4}, {4, 0, -4}, {4, 4, -4}, {-4, 4, -4}, 1),
                  scene::quad_mesh({-2, 0.2f, 1}, {0, 0.2f, 1}, {0, 2, 1}, {-2, 2, 1}, 2),
                  scene::quad_mesh({1, 0, 0}, {3, 0, 0}, {3, 1, -1}, {1, 1, -1}, 3)};
  Camera camera;
  camera.position = {0, 2, 7};
  scene.cameras = {camera};
  scene.area_lights = {
      light_of(Polygon{{{-2, -0.5, -1}, {0, -0.5, -1}, {0, 1.5, -1}, {-2, 1.5, -1}}, {}}, {3, 2, 1}, true),
      light_of(Polygon{ring({1, 2, -3.5}, 0.8, 6), {ring({1, 2, -3.5}, 0.4, 5)}}, {2, 3, 2}),
      light_of(Polygon{ring({-3, 2.5, -3}, 0.5, 100), {}}, {4, 4, 2}),
      light_of(Polygon{{{-40, 30, -60}, {-39, 30, -60}, {-39, 31, -60}, {-40, 31, -60}}, {}}, {900, 800, 700}),
      light_of(Ellipse{{2, 0.6, -3.9}, {0.9, 0, 0}, {0.1, 0.5, 0}}, {2, 1, 3}),
      light_of(Ellipsoid{{0.5, 0.5, -2}, {0.3, 0, 0}, {0, 0.5, 0}, {0, 0, 0.2}}, {5, 1, 1}),
      light_of(Ellipsoid{{-3, 0.4, 0}, {0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}}, {1, 5, 1}),
      light_of(Capsule{{-1, 3, -1}, {1, 2.5, -2}, 0.05}, {20, 20, 30}),
  };
  scene.punctual_lights = {punctual(PunctualKind::point, {0, 1, 2}, {0, 0, -1}), punctual(PunctualKind::spot, {2, 3, 2}, {-1, -2, -1}),
                           punctual(PunctualKind::directional, {}, {1, -2, -2})};
  return scene;
}

// Profile of a lamp that shines most to the side.
std::shared_ptr<const LightProfile> lamp_profile() {
  LightProfile p;
  p.vertical = {0, 30, 60, 90, 180};
  p.horizontal = {0, 90, 180};
  p.candela = {5, 8, 4, 1, 0, 5, 6, 2, 1, 0, 5, 9, 3, 0, 0};
  return std::make_shared<const LightProfile>(p);
}

// A lattice of needles below kSquare: half of them along x, the others a little lower along z.
Scene under_needles(int count) {
  Scene scene = under_triangles(count);
  const float step = 1.4f / static_cast<float>(count), width = 0.2f * step;
  for (int i = 0; i < count; ++i) {
    const float at = -0.7f + 2 * step * static_cast<float>(i / 2), y = i % 2 == 0 ? 2.0f : 1.98f;
    const Vec3f corners[] = {{-0.7f, y, at}, {0.7f, y, at + width}, {0.7f, y, at - width}};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3f c = corners[corner];
      scene.meshes[1].positions[3 * static_cast<std::size_t>(i) + corner] = i % 2 == 0 ? c : Vec3f{c.z, c.y, c.x};
    }
  }
  return scene;
}

// A leak of two hundred bytes in each of ten thousand frames would be detected. A software device uses the process's own memory.
void expect_no_growth(const Scene& scene, SurfacesBy surfaces, int frames, Shadows shadows = Shadows::off) {
  RenderOptions options = small("ltc-compact");
  options.width = options.height = 8;
  options.shadows = shadows;
  DeviceFrame frame(scene, options, nullptr, surfaces);
  for (int i = 0; i < 100; ++i) frame.render();
  const double before = test::resident_mib();
  for (int i = 0; i < frames; ++i) frame.render();
  const double after = test::resident_mib();
  std::printf("resident: %.1f MiB after 100 frames, %.1f MiB after %d\n", before, after, frames + 100);
  EXPECT_LE(after, before + 2);
}

}  // namespace

TEST_F(VulkanFrame, AgreesWithTheCpuByEveryMethod) {
  const Scene gallery = scene_of("gallery");
  for (const char* method : {"auto", "half-vector", "ltc", "ltc-compact", "ltc-clipless", "representative-point"})
    expect_same("gallery", gallery, small(method));
}

TEST_F(VulkanFrame, AgreesWithTheCpuByEveryQuality) {
  const Scene gallery = scene_of("gallery");
  for (const auto& [method, quality] : {std::pair{"closed-form", Quality::draft},
                                        {"closed-form", Quality::high},
                                        {"half-vector", Quality::draft},
                                        {"half-vector", Quality::high},
                                        {"ltc", Quality::high},
                                        {"representative-point", Quality::high}}) {
    RenderOptions options = small(method);
    options.width = 80;  // as by every method: a quality only changes numbers
    options.height = 45;
    options.quality = quality;
    expect_same(quality == Quality::high ? "gallery, high" : "gallery, draft", gallery, options);
  }
}

TEST_F(VulkanFrame, AgreesWithTheCpuInEveryScene) {
  for (const char* name : {"plane", "ring", "tubes", "textured_floor"}) {
    const Scene scene = scene_of(name);
    for (const char* method : {"auto", "ltc-compact"}) expect_same(name, scene, small(method));
  }
}

TEST_F(VulkanFrame, AgreesWithTheCpuUnderEveryKindOfLight) {
  Scene scene = everything();
  const int outliers = small("auto").width * small("auto").height / 1000;
  for (const char* method : {"ltc-compact", "ltc-clipless", "half-vector"}) expect_same("everything", scene, small(method), outliers);
  RenderOptions high = small("ltc");
  high.quality = Quality::high;
  expect_same("everything, by two tables", scene, high, outliers);
  scene.materials[0].anisotropy = 0.6f;
  RenderOptions options = small("auto");
  options.aa = 2;
  expect_same("everything", scene, options, outliers);
}

// Points with a profile, of both types of angles, next to one without.
TEST_F(VulkanFrame, AgreesWithTheCpuUnderMeasuredPoints) {
  Scene scene = everything();
  scene.area_lights.clear();
  const auto type_c = lamp_profile();
  LightProfile type_b = *type_c;
  type_b.type = LightProfile::Type::b;
  type_b.vertical = {-90, -40, 0, 50, 90};
  type_b.horizontal = {-90, 0, 90};
  PunctualLight lamp = punctual(PunctualKind::point, {1, 2, 1}, {0, -1, 0});
  lamp.profile = type_c;
  lamp.profile_axes = profile_axes({-0.2, -1, -0.3}, {1, 0.5, 0});
  scene.punctual_lights.push_back(lamp);
  lamp.profile = std::make_shared<const LightProfile>(type_b);
  lamp.position = {-2, 2, -1};
  scene.punctual_lights.push_back(lamp);
  for (const char* method : {"auto", "ltc-compact"}) expect_same("measured points", scene, small(method));
  RenderOptions shadowed = small("ltc-compact");
  shadowed.shadows = Shadows::on;
  expect_same("measured points, shadows", scene, shadowed);
  EXPECT_EQ(warnings_of(scene, small("auto")), std::vector<std::string>());
}

TEST_F(VulkanFrame, AgreesWithTheCpuOnShadows) {
  RenderOptions options = small("auto");
  options.width = 160;  // in smaller pictures of lamp_shade, one pixel has a light whose nodes change with a rounding
  options.height = 90;
  options.shadows = Shadows::on;
  for (const char* name : {"gallery", "lamp_shade"}) {
    const double share = expect_same(std::string(name) + ", shadows", scene_of(name), options);
    std::printf("%s: %.1f %% of the parts by the host\n", name, 100 * share);
    EXPECT_LE(share, 0.01) << name;  // a few points see thin regions
  }
  // The host sees tubes in their flat parts, since walls stand close to them.
  EXPECT_GT(expect_same("tubes, shadows", scene_of("tubes"), options), 0.01);
}

// Covers every method and lobe.
TEST_F(VulkanFrame, FindsTheVisiblePartsOfPolygons) {
  RenderOptions options = small("auto");
  options.shadows = Shadows::on;
  for (const std::string& method : test::by_day_or_night<std::vector<std::string>>(
           {"auto", "ltc-compact"}, {"auto", "half-vector", "ltc-compact", "ltc-clipless", "representative-point"})) {
    options.method = method;
    EXPECT_EQ(expect_same("12 triangles", under_triangles(12), options), 0);
  }
  options.method = "ltc-compact";
  // A few points see thin regions. 190 triangles and the walls of those that the box's left side cuts fit the largest space.
  for (const int triangles : {40, 190})
    EXPECT_LE(expect_same(std::to_string(triangles) + " triangles", under_triangles(triangles), options), 0.01);
  // The light crosses the triangles, which leave sections in its plane.
  const Scene crossed = under_triangles(12, Polygon{{{-1, 0.5, -1}, {1, 2.5, -1}, {1, 2.5, 1}, {-1, 0.5, 1}}, {}});
  EXPECT_EQ(expect_same("12 across", crossed, options), 0);
  const double share = expect_same("room, shadows", scene_of("room"), options);
  std::printf("room: %.1f %% of the parts by the host\n", 100 * share);
  EXPECT_LE(share, 0.02);
}

// Each point sees four segments of the light and three of every triangle, none of which crosses another. A subgroup has capacity for 608,
// the host for any number.
TEST_F(VulkanFrame, FindsPartsBehindAsManyEdgesAsThereIsSpaceFor) {
  RenderOptions options = small("ltc-compact");
  options.shadows = Shadows::on;
  options.width = 64;
  options.height = 36;
  const auto by_host = [&](int triangles) {
    return expect_same(std::to_string(triangles) + " apart", under_triangles(triangles, kSquare, kFlatBeforeSquare), options);
  };
  EXPECT_EQ(by_host(201), 0);
  EXPECT_EQ(by_host(202), 1);
}

// Most pairs of a pixel and a light see none of their group's edges, or few of them. Many triangles take the last space.
TEST_F(VulkanFrame, SeesAtOnceWhatNoEdgeOccludes) {
  RenderOptions options = small("ltc-compact");
  options.backend = Backend::vulkan;
  options.shadows = Shadows::on;
  RenderStats stats;
  render(scene_of("room"), options, &stats);
  ASSERT_EQ(stats.shadow_pairs.size(), 6u);
  EXPECT_GT(stats.shadow_pairs[0], 0u);
  EXPECT_GT(stats.shadow_pairs[1], 0u);
  EXPECT_GT(stats.shadow_pairs[2], 0u);
  EXPECT_LT(10 * stats.shadow_pairs[5], stats.shadow_pairs[1] + stats.shadow_pairs[2]);
  EXPECT_GT(stats.shadow_looks, 0u);
  EXPECT_GT(stats.shadow_gathered[0], stats.shadow_gathered[1]);
  EXPECT_GT(stats.shadow_gathered[1], 0u);
  ASSERT_EQ(stats.shadow_work.size(), 5u);
  EXPECT_GT(stats.shadow_work[1][0], 0u);
  EXPECT_EQ(stats.submissions, 1u);
  render(under_triangles(201, kSquare, kFlatBeforeSquare), options, &stats);
  EXPECT_EQ(stats.shadow_pairs[1], 0u);
  EXPECT_GT(stats.shadow_pairs[5], 0u);
}

// Holes between needles have four pieces each. With 12, 20 and 32 needles they exceed more and more spaces, with 32 all. Behind a
// plate that leaves few pieces, the crossings of 160 needles exceed all spaces (kSegments of shadows.cpp).
TEST_F(VulkanFrame, GoesOnToMoreSpaceForPiecesAndCrossings) {
  RenderOptions options = small("ltc-compact");
  options.shadows = Shadows::on;
  options.width = 32;
  options.height = 18;
  const auto by_host = [&](int needles, const Scene& scene) { return expect_same(std::to_string(needles) + " needles", scene, options); };
  for (const auto& [needles, share] : {std::pair{12, 0.0}, {20, 0.0}, {32, 1.0}})
    EXPECT_EQ(by_host(needles, under_needles(needles)), share);
  for (const auto& [needles, share] : {std::pair{12, 0.0}, {160, 1.0}}) {
    Scene scene = under_needles(needles);
    scene.meshes.push_back(scene::quad_mesh({-0.75f, 1.9f, -0.75f}, {0.75f, 1.9f, -0.75f}, {0.75f, 1.9f, 0.75f}, {-0.75f, 1.9f, 0.75f}, 0));
    EXPECT_EQ(by_host(needles, scene), share);
  }
}

// Lights of every shape: fractions of polygons, frames of the points' own, sections of triangles by the light's plane.
TEST_F(VulkanFrame, FindsPartsBehindManyEdges) {
  RenderOptions options = small("ltc-compact");
  options.shadows = Shadows::on;
  options.width = 64;
  options.height = 36;
  const std::tuple<const char*, Shape, Spread> lights[] = {
      {"90 before a disk", Ellipse{{0, 2.5, 0}, {1, 0, 0}, {0.2, 0.1, 0.8}}, kFlatBeforeSquare},
      {"90 before a ball", Ellipsoid{{0, 2.9, 0}, {0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}}, {0.3, 0.02, 2.4, 0.02}},
      {"90 across", Polygon{{{-1, 0.5, -1}, {1, 2.5, -1}, {1, 2.5, 1}, {-1, 0.5, 1}}, {}}, {}},
  };
  for (const auto& [name, light, spread] : lights) {
    const double share = expect_same(name, under_triangles(90, light, spread), options);
    std::printf("%s: %.2f %% of the parts by the host\n", name, 100 * share);
    EXPECT_LE(share, 0.01) << name;  // a few points see thin regions
  }
}

// Covers every lobe: for round lights, the fraction of a polygon's light counts.
TEST_F(VulkanFrame, LightsByPartsOfRoundLights) {
  RenderOptions options = small("auto");
  options.shadows = Shadows::on;
  const std::pair<const char*, Shape> lights[] = {
      {"under a disk", Ellipse{{0, 2.5, 0}, {1, 0, 0}, {0.2, 0.1, 0.8}}},
      {"under a ball", Ellipsoid{{0, 2.7, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}}},
      {"under an ellipsoid", Ellipsoid{{0, 2.9, 0}, {0.6, 0.1, 0}, {-0.05, 0.3, 0}, {0, 0, 0.4}}},
      {"under a tube", Capsule{{-0.9, 2.4, 0.2}, {0.8, 2.6, 0}, 0.1}},
  };
  for (const auto& [name, light] : lights) {
    const Scene scene = under_triangles(12, light);
    for (const std::string& method :
         test::by_day_or_night<std::vector<std::string>>({"auto"}, {"auto", "ltc-compact", "representative-point"})) {
      options.method = method;
      // One pixel was counted. A single point for the whole light jumps from edge to edge, and fractions divide two such lights: likely
      // its cause.
      const double by_host = expect_same(name, scene, options, method == "representative-point" ? 2 : 0);
      EXPECT_TRUE(by_host == 0 || std::holds_alternative<Capsule>(light)) << name << by_host;
    }
  }
}

// The device has direct light. The host gathers the light between surfaces meanwhile, as it does for its own pictures.
TEST_F(VulkanFrame, AddsTheLightBetweenSurfaces) {
  RenderOptions options = small("auto");
  options.bounces = kAllBounces;
  options.bounce_preview = true;
  for (const char* name : {"room", "ring"}) {
    const Scene scene = scene_of(name);
    expect_same(std::string(name) + ", bounces", scene, options);
    options.backend = Backend::cpu;
    const Picture cpu = render(scene, options);
    options.backend = Backend::vulkan;
    RenderStats stats;
    const Picture device = render(scene, options, &stats);
    EXPECT_FALSE(stats.device.empty());
    EXPECT_GT(stats.patches, 0u);
    EXPECT_EQ(device.layers.at("indirect"), cpu.layers.at("indirect")) << name;
    EXPECT_EQ(device.layers.size(), cpu.layers.size()) << name;
  }
  EXPECT_EQ(lack_of_devices(scene_of("room"), options), "");
  options.bound = true;
  EXPECT_EQ(lack_of_devices(scene_of("room"), options), "it has no --bound");
}

// The search for visible parts, its rays and the lighting are one submission. The host adds the light of points that are left to it: with
// 32 needles, points have more pieces than a subgroup has space for. With 20 needles, the parts of the first frame exceed the buffer. So
// it takes one submission more than the next frame, and has the same bytes. Its second light leaves thin regions to the host.
TEST_F(VulkanFrame, LightsInOneSubmission) {
  const auto device = std::make_shared<const Device>();
  RenderOptions options = small("ltc-compact");
  options.shadows = Shadows::on;
  Scene two_lights = under_needles(20);
  two_lights.area_lights.push_back(light_of(Polygon{{{-0.7, 2.6, -1.2}, {1.1, 2.6, -1.1}, {0.9, 2.6, 0.9}}, {}}, {1, 2, 3}));
  for (const auto& [name, scene, first_ones, next_ones] : {std::tuple{"20 needles, two lights", two_lights, 2u, 1u},
                                                           {"room", scene_of("room"), 1u, 1u},
                                                           {"32 needles", under_needles(32), 1u, 1u}}) {
    DeviceFrame frame(scene, options, device);
    std::size_t before = device->submissions();
    const Picture first = frame.render();
    EXPECT_EQ(device->submissions() - before, first_ones) << name;
    before = device->submissions();
    EXPECT_EQ(frame.render().pixels, first.pixels) << name;
    EXPECT_EQ(device->submissions() - before, next_ones) << name;
  }
  // The host finds shafts between surfaces that the device draws and the search.
  const Scene triangles = under_triangles(12);
  DeviceFrame drawn(triangles, options, device, SurfacesBy::device);
  drawn.render();  // its parts may exceed the buffer
  const std::size_t before = device->submissions();
  drawn.render();
  EXPECT_EQ(device->submissions() - before, 2u);
}

// Each option that the device does not have has a reason of its own. No picture is rendered.
TEST_F(VulkanFrame, SaysWhatItDoesNotHave) {
  struct Refusal {
    const char* reason;
    void (*change)(RenderOptions&);
  };
  const Refusal refusals[] = {
      {"it has no --bound", [](RenderOptions& o) { o.bounces = kAllBounces, o.bound = true; }},
      {"it has no --time-limit", [](RenderOptions& o) { o.time_limit = 1; }},
      {"it has no --lights tree", [](RenderOptions& o) { o.lights = LightSum::tree; }},
      {"it has no method sampled", [](RenderOptions& o) { o.method = "sampled"; }},
      {"it has no bounce by paths", [](RenderOptions& o) { o.indirect.mode = IndirectMode::path; }},
      {"it has no --indirect ltc-outgoing", [](RenderOptions& o) { o.indirect.mode = IndirectMode::ltc_outgoing; }},
      {"it has no --indirect-shadows", [](RenderOptions& o) { o.indirect.mode = IndirectMode::ltc, o.indirect.shadow_rays = 1; }},
  };
  const Scene scene = scene_of("glossy_floor");
  for (const Refusal& refusal : refusals) {
    RenderOptions options = small("auto");
    refusal.change(options);
    const std::string lack = lack_of_devices(scene, options);
    EXPECT_EQ(lack.empty() ? DeviceFrame(scene, options).lacks() : lack, refusal.reason);
    if (!lack.empty()) {
      EXPECT_THROW(DeviceFrame(scene, options), UsageError) << refusal.reason;
    }
  }
  for (const char* name : {"no such device", "99"}) {
    RenderOptions options = small("auto");
    options.device = name;
    EXPECT_THROW(DeviceFrame(scene, options), Error) << name;
  }
}

// 1,600 triangles have 6,400 vertices and planes. 700 lights need them in their own coordinates, twice, which takes more than 128 MiB.
TEST_F(VulkanFrame, HasNoSpaceForTheEdgesOfManyTrianglesBeforeManyLights) {
  Scene scene = under_triangles(1600);
  scene.area_lights.assign(700, scene.area_lights.front());
  RenderOptions options = small("ltc-compact");
  options.shadows = Shadows::on;
  EXPECT_EQ(DeviceFrame(scene, options).lacks(), "its buffers have no space for the edges of 1602 triangles before 700 lights");
  scene.area_lights.resize(70);
  EXPECT_EQ(DeviceFrame(scene, options).lacks(), "");
}

// A buffer of 128 MiB holds 33 million numbers.
TEST_F(VulkanFrame, LeavesAProfileThatExceedsItsBuffersToTheCpu) {
  LightProfile fine;
  const std::size_t vertical = 4096, horizontal = list_devices().front().storage_buffer / sizeof(float) / vertical;
  for (std::size_t i = 0; i < vertical; ++i) fine.vertical.push_back(180.0 * static_cast<double>(i) / static_cast<double>(vertical - 1));
  for (std::size_t i = 0; i < horizontal; ++i)
    fine.horizontal.push_back(360.0 * static_cast<double>(i) / static_cast<double>(horizontal - 1));
  fine.candela.assign(vertical * horizontal, 10);
  Scene scene = scene_of("glossy_floor");
  scene.area_lights.clear();
  scene.punctual_lights = {punctual(PunctualKind::point, {0, 1, 0}, {0, -1, 0})};
  scene.punctual_lights[0].profile = std::make_shared<const LightProfile>(std::move(fine));
  expect_rendered_by_cpu(scene, small("ltc-compact"), "a profiled point light exceeds its buffers");
}

// The host finds the surfaces of wider pictures. The first is as wide as the device draws.
TEST_F(VulkanFrame, FindsTheSurfacesOfWidePicturesOnTheCpu) {
  const auto device = std::make_shared<const Device>();
  const Scene scene = scene_of("glossy_floor");
  RenderOptions options = small("ltc-compact");
  options.width = static_cast<int>(device->info().picture);
  options.height = 1;
  EXPECT_NO_THROW(DeviceFrame(scene, options, device, SurfacesBy::device));
  ++options.width;
  try {
    DeviceFrame frame(scene, options, device, SurfacesBy::device);
    FAIL();
  } catch (const UsageError& e) {
    EXPECT_NE(std::string(e.what()).find("a picture larger than the device draws"), std::string::npos) << e.what();
  }
  expect_same("wide", scene, options);
}

TEST_F(VulkanFrame, HasNoShadowsWithoutWhatTheirShadersNeed) {
  DeviceInfo device = Device().info();
  EXPECT_TRUE(DeviceShadows::has(device));
  for (bool DeviceInfo::*feature : {&DeviceInfo::adds, &DeviceInfo::int64}) {
    DeviceInfo without = device;
    without.*feature = false;
    EXPECT_FALSE(DeviceShadows::has(without));
  }
  for (const unsigned subgroup : {1u, 128u}) {
    device.subgroup = subgroup;
    EXPECT_FALSE(DeviceShadows::has(device)) << subgroup;
  }
}

TEST_F(VulkanFrame, TheValidationLayerFindsNothing) {
  const auto device = std::make_shared<Device>(DeviceOptions{"", true});
  const Scene scene = everything();
  for (const auto& [method, shadows] : {std::pair{"closed-form", Shadows::off}, {"ltc-compact", Shadows::on}}) {
    RenderOptions options = small(method);
    options.width = 48;  // the layer checks the calls, not their results
    options.height = 27;
    options.shadows = shadows;
    DeviceFrame frame(scene, options, device, SurfacesBy::automatic, RaysBy::device);
    for (int i = 0; i < 2; ++i) frame.render();
  }
  EXPECT_TRUE(device->validation_messages().empty())
      << device->validation_messages().size() << " messages, the first: " << device->validation_messages().front();
}

TEST_F(VulkanFrame, ManyFramesLeaveMemoryWhereItWas) {
  for (const SurfacesBy surfaces : {SurfacesBy::host, SurfacesBy::device})
    expect_no_growth(scene_of("glossy_floor"), surfaces, test::by_day_or_night(200, 10000));
}

TEST_F(VulkanFrame, FramesWithShadowsLeaveMemoryWhereItWas) {
  expect_no_growth(under_triangles(12), SurfacesBy::host, test::by_day_or_night(60, 300), Shadows::on);
}

}  // namespace steradian::vulkan::frame_test
