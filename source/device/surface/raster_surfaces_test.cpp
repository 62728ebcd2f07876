// The CPU is the reference for the surfaces that a device finds.
#include "device/surface/raster_surfaces.h"

#include <gtest/gtest.h>

#include <utility>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include "device/frame/frame.h"
#include "night.h"
#include "paths.h"
#include "render/frame/frame_surfaces.h"
#include "steradian/load_scene.h"
#include "support/meshes.h"

namespace steradian::vulkan::raster_surfaces_test {
namespace {

#include "shaders/layout.glsl"

using Vec4Floats = std::array<float, 4>;

struct Pixel {
  Vec3f position, normal, tangent, albedo, f0, f90, emission;
  float alpha_x = 0, alpha_y = 0, loss = 0;
  Vec3f geometric{}, sheen{}, coat_normal{};
  float sheen_alpha = 0, coat = 0, coat_alpha = 0;
  const SurfaceMaterial* material = nullptr;
};

// Surfaces by pixel of the picture, with the number of the triangle visible there.
struct Surfaces {
  std::vector<Pixel> pixels;
  std::vector<std::uint64_t> seen;
};

Surfaces by_cpu(const Scene& scene, const RenderOptions& o, int sample) {
  FrameSurfaces frame(scene, o, SceneParts::of(scene, Sorted::for_rays));
  Surfaces s{std::vector<Pixel>(static_cast<std::size_t>(o.width * o.height)),
             std::vector<std::uint64_t>(static_cast<std::size_t>(o.width * o.height))};
  const auto tile = std::make_unique<SurfaceTile>();
  const auto hits = std::make_unique<TileHits>();
  for (int index = 0; index < frame.tile_count(); ++index) {
    const TileArea a = frame.area(index);
    frame.fill(index, sample, *tile);
    trace_tile(frame.rays(), frame.camera(), a, pixel_place(sample, o.aa), *hits);
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) {
        const std::size_t i = tile_slot(x, y), to = static_cast<std::size_t>((a.y + y) * o.width + a.x + x);
        const auto at = [&](const TileVector& v) { return Vec3f{v.x[i], v.y[i], v.z[i]}; };
        if (tile->material[i] == nullptr) continue;
        s.pixels[to] = {at(tile->position),
                        at(tile->normal),
                        at(tile->tangent),
                        at(tile->albedo),
                        at(tile->f0),
                        at(tile->f90),
                        at(tile->radiance),
                        tile->alpha_x[i],
                        tile->alpha_y[i],
                        tile->fresnel_loss[i],
                        at(tile->geometric_normal),
                        at(tile->sheen),
                        at(tile->coat_normal),
                        tile->sheen_alpha[i],
                        tile->coat[i],
                        tile->coat_alpha[i],
                        tile->material[i]};
        s.seen[to] = (std::uint64_t{hits->geometry[i]} << 32 | hits->triangle[i]) + 1;
      }
  }
  return s;
}

std::vector<Pixel> by_device(const Device& device, const Scene& scene, const RenderOptions& o, int sample) {
  const CameraRays camera(find_camera(scene, ""), o.width, o.height);
  const FrameSurfaces frame(scene, o, SceneParts::of(scene, Sorted::for_rays));  // its tiles
  const int count = frame.tile_count();
  const auto tiles = static_cast<std::size_t>(count), slots = static_cast<std::size_t>(kSlots);
  RasterSurfaces::Kept kept(device);
  const MipMaps maps(scene.images);
  RasterSurfaces raster(kept, scene, maps, camera, o, tiles, true);
  const auto tile = std::make_unique<SurfaceTile>();
  Buffer surfaces(device, tiles * slots * kPlanes * sizeof(Vec4Floats)), radiance(device, tiles * kRadiance * sizeof(Vec4Floats));
  raster.look(sample);
  raster.find(0, count, surfaces, radiance);
  std::vector<Pixel> pixels(static_cast<std::size_t>(o.width * o.height));
  for (int index = 0; index < count; ++index) {
    const TileArea a = frame.area(index);
    const auto* planes = static_cast<const Vec4Floats*>(surfaces.mapped()) + static_cast<std::size_t>(index) * slots * kPlanes;
    const auto* shine = static_cast<const Vec4Floats*>(radiance.mapped()) + static_cast<std::size_t>(index) * kRadiance;
    raster.take(radiance, static_cast<std::size_t>(index), *tile);
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) {
        const std::size_t i = tile_slot(x, y);
        const auto plane = [&](int number) { return planes[static_cast<std::size_t>(number) * slots + i]; };
        const auto at = [&](int number) { return Vec3f{plane(number)[0], plane(number)[1], plane(number)[2]}; };
        EXPECT_EQ(tile->material[i] == nullptr, at(kNormal) == Vec3f{});
        if (at(kNormal) == Vec3f{}) continue;
        const auto taken = [&](const TileVector& v) { return Vec3f{v.x[i], v.y[i], v.z[i]}; };
        EXPECT_EQ(taken(tile->position), at(kPosition));
        EXPECT_EQ(taken(tile->f90), at(kF90));
        EXPECT_EQ(tile->coat[i], plane(kTangent)[3]);
        if (kept.scene.has_layers()) {
          EXPECT_EQ(taken(tile->coat_normal), at(kCoatNormal));
          EXPECT_EQ(taken(tile->sheen), at(kSheen));
        }
        Pixel& p = pixels[static_cast<std::size_t>((a.y + y) * o.width + a.x + x)];
        p = {at(kPosition), at(kNormal), at(kTangent), at(kAlbedo), at(kF0), at(kF90), {shine[i][0], shine[i][1], shine[i][2]}};
        p.alpha_x = plane(kPosition)[3];
        p.alpha_y = plane(kNormal)[3];
        p.loss = plane(kView)[3];
        p.geometric = taken(tile->geometric_normal);
        p.sheen = taken(tile->sheen);
        p.sheen_alpha = tile->sheen_alpha[i];
        p.coat_normal = taken(tile->coat_normal);
        p.coat = tile->coat[i];
        p.coat_alpha = tile->coat_alpha[i];
        p.material = tile->material[i];
      }
  }
  return pixels;
}

float difference(const Pixel& a, const Pixel& b) {
  float largest = 0;
  for (const float d : {a.alpha_x - b.alpha_x, a.alpha_y - b.alpha_y, a.loss - b.loss, a.coat - b.coat, a.coat_alpha - b.coat_alpha,
                        a.sheen_alpha - b.sheen_alpha})
    largest = std::max(largest, std::fabs(d));
  for (const Vec3f d : {a.normal - b.normal, a.tangent - b.tangent, a.albedo - b.albedo, a.f0 - b.f0, a.f90 - b.f90,
                        a.emission - b.emission, a.geometric - b.geometric, a.sheen - b.sheen, a.coat_normal - b.coat_normal})
    largest = std::max(largest, length(d));
  return a.material == b.material ? largest : 1.0f;
}

// Returns true if the CPU sees another triangle at a neighbour: rasters round corners to a 256th of a pixel, and depths at contacts.
bool where_triangles_meet(const Surfaces& s, int x, int y, const RenderOptions& o) {
  const auto seen = [&](int i, int j) { return s.seen[static_cast<std::size_t>(j * o.width + i)]; };
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, o.height - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, o.width - 1); ++i)
      if (seen(i, j) != seen(x, y)) return true;
  return false;
}

void expect_same(const std::string& name, const Scene& scene, RenderOptions o, double bound) {
  const Device device;
  ASSERT_EQ(what_keeps_on_host(scene, device.info()), "") << name;
  const int sample = o.aa - 1;
  const Surfaces cpu = by_cpu(scene, o, sample);
  const std::vector<Pixel> found = by_device(device, scene, o, sample);
  int outliers = 0, alone = 0;
  double largest = 0, farthest = 0;
  const Vec3f eye = static_cast<Vec3f>(scene.cameras[0].position);
  for (int y = 0; y < o.height; ++y)
    for (int x = 0; x < o.width; ++x) {
      const auto i = static_cast<std::size_t>(y * o.width + x);
      const Pixel &a = cpu.pixels[i], &b = found[i];
      const double off = static_cast<double>(length(a.position - b.position) / std::max(length(a.position - eye), 1e-3f)),
                   change = static_cast<double>(difference(a, b));
      if (off <= 1e-5 && change <= bound) {
        farthest = std::max(farthest, off);
        largest = std::max(largest, change);
        continue;
      }
      ++outliers;
      if (where_triangles_meet(cpu, x, y, o)) continue;
      if (++alone <= 3)
        ADD_FAILURE() << name << " (" << x << ", " << y << "): position off by " << off << " of its distance, the rest by " << change;
    }
  std::printf("%-14s positions off by at most %.1e of their distance, all else by %.1e; %d of %d pixels where triangles meet see another\n",
              name.c_str(), farthest, largest, outliers, o.width * o.height);
  EXPECT_LE(outliers, o.width * o.height / 200) << name;
}

RenderOptions small() {
  RenderOptions options;
  options.width = 200;
  options.height = 120;
  return options;
}

AreaLight lamp() {
  AreaLight lamp;
  lamp.name = "lamp";
  lamp.shape = Polygon{{{-1, 4, -2}, {1, 4, -2}, {1, 4, 0}, {-1, 4, 0}}, {}};
  lamp.radiance = {5, 5, 5};
  lamp.two_sided = true;
  return lamp;
}

// Pictures of noise with every texture, wrap and filter, seen from the side, so that pixels cover many of their texels.
Scene textured() {
  Scene scene;
  std::mt19937 random(1);
  for (const auto& [width, height] : {std::pair{64, 64}, {37, 20}, {1, 5}, {256, 3}}) {
    Image image{"noise", width, height, {}};
    for (int i = 0; i < 4 * width * height; ++i) image.rgba.push_back(static_cast<std::uint8_t>(random()));
    scene.images.push_back(image);
  }
  const auto use = [&](int image, ColorSpace space, Wrap u, Wrap v, Filter filter) {
    TextureUse t;
    t.image = image;
    t.color_space = space;
    t.wrap_u = u;
    t.wrap_v = v;
    t.filter = filter;
    t.uv[0] = 2.5f;
    t.uv[1] = 0.3f;
    t.uv[2] = -0.7f;
    t.uv[4] = 1.5f;
    t.texcoord = image % 2;
    return t;
  };
  SurfaceMaterial a, b;
  a.name = "a";
  a.base_color_texture = use(0, ColorSpace::srgb, Wrap::repeat, Wrap::mirrored_repeat, Filter::linear);
  a.metallic_roughness_texture = use(1, ColorSpace::linear, Wrap::clamp_to_edge, Wrap::repeat, Filter::linear);
  a.normal_texture = use(2, ColorSpace::linear, Wrap::repeat, Wrap::repeat, Filter::linear);
  a.normal_texture.scale = 0.3f;
  b.name = "b";
  b.base_color_texture = use(3, ColorSpace::srgb, Wrap::mirrored_repeat, Wrap::clamp_to_edge, Filter::nearest);
  b.emissive = {1, 2, 3};
  b.emissive_texture = use(0, ColorSpace::srgb, Wrap::repeat, Wrap::repeat, Filter::nearest);
  b.specular_texture = use(1, ColorSpace::linear, Wrap::repeat, Wrap::repeat, Filter::linear);
  b.specular_color_texture = use(0, ColorSpace::srgb, Wrap::repeat, Wrap::repeat, Filter::linear);
  b.double_sided = true;
  scene.materials = {a, b};
  scene.meshes = {scene::quad_mesh({-4, 0, 4}, {4, 0, 4}, {4, 0, -40}, {-4, 0, -40}, 0),
                  scene::quad_mesh({-3, 0.2f, -3}, {1, 0.2f, 1}, {1, 3, 1}, {-3, 3, -3}, 1),
                  scene::quad_mesh({1, 0.2f, -1}, {3, 0.2f, 0}, {3, 3, 0}, {1, 3, -1}, 1)};
  for (Mesh& mesh : scene.meshes) {
    mesh.texcoords[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.texcoords[1] = {{0.1f, 0}, {3, 0.2f}, {2, 2}, {0, 1}};
  }
  scene.meshes[0].tangents.assign(4, {1, 0, 0, -1});
  scene.meshes[2].colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}};
  Camera camera;
  camera.position = {0, 1.5, 5};
  scene.cameras = {camera};
  return scene;
}

// Surfaces with sheen, a coat and brushing by textures; coats and sheen by numbers; no light at all.
Scene layered() {
  Scene scene = textured();
  const TextureUse colors = scene.materials[0].base_color_texture, numbers = scene.materials[0].metallic_roughness_texture,
                   bumps = scene.materials[0].normal_texture;
  SurfaceMaterial &a = scene.materials[0], &b = scene.materials[1];
  a.sheen_color = {0.7f, 0.4f, 0.9f};
  a.sheen_color_texture = colors;
  a.sheen_roughness = 0.8f;
  a.sheen_roughness_texture = numbers;
  a.clearcoat = 0.9f;
  a.clearcoat_texture = numbers;
  a.clearcoat_roughness = 0.7f;
  a.clearcoat_roughness_texture = numbers;
  a.clearcoat_normal_texture = bumps;
  a.clearcoat_normal_texture.uv[4] = 3.5f;
  a.anisotropy = 0.8f;
  a.anisotropy_rotation = 0.3f;
  a.anisotropy_texture = numbers;
  b.sheen_color = {0.2f, 0.3f, 0.1f};
  b.clearcoat = 0.5f;
  scene.materials.push_back(b);
  SurfaceMaterial& unlit = scene.materials.back();
  unlit.name = "unlit";
  unlit.unlit = true;
  scene.meshes[2].material = 2;
  return scene;
}

class VulkanSurfaces : public testing::Test {
 protected:
  void SetUp() override {
    if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  }
};

}  // namespace

// The intersection of a ray and a triangle is known to its distance times float's rounding over the cosine of their angle. At a cosine of
// a hundredth, that is 1e-5 of the distance. Blended normals change with position over the length of an edge, a hundred times as fast.
TEST_F(VulkanSurfaces, AreTheCpusButWhereTrianglesMeet) {
  for (const char* name : {"gallery", "ring", "tubes"})
    expect_same(name, load_scene(test::kSourceDir + "/scenes/" + name + ".glb").scene, small(), 1e-3);
  RenderOptions options = small();
  options.aa = 3;
  expect_same("textured", textured(), options, 2e-3);
  Scene layers = layered();
  expect_same("layers", layers, options, 2e-3);
  layers.multiple_scattering = true;
  layers.materials[0].anisotropy = 0;
  expect_same("scattering", layers, options, 2e-3);
}

TEST_F(VulkanSurfaces, SayWhatKeepsThemOnTheHost) {
  const DeviceInfo info = list_devices().front();
  Scene scene = textured();
  EXPECT_EQ(what_keeps_on_host(scene, info), "");
  EXPECT_TRUE(materials_for_host(scene).empty());
  scene.materials[1].alpha_mode = AlphaMode::blend;
  ASSERT_EQ(materials_for_host(scene).size(), 1u);  // one of two meshes
  EXPECT_NE(materials_for_host(scene)[0].find("'b'"), std::string::npos);
  scene.materials[1].alpha_mode = AlphaMode::opaque;
  scene.materials[0].clearcoat = 1;
  scene.materials[0].anisotropy = 1;
  EXPECT_TRUE(materials_for_host(scene).empty());
  scene.multiple_scattering = true;
  ASSERT_EQ(materials_for_host(scene).size(), 1u);
  EXPECT_NE(materials_for_host(scene)[0].find("'a'"), std::string::npos);
  DeviceInfo without = info;
  without.graphics = false;
  EXPECT_EQ(what_keeps_on_host(scene, without), "the device draws no triangles");
  DeviceInfo small = info;
  small.texel_buffer = 8;
  EXPECT_EQ(what_keeps_on_host(scene, small), "more triangles than a buffer has room for");
  small.texel_buffer = 1024;
  scene.images.assign(1, Image{"", 32, 32, std::vector<std::uint8_t>(std::size_t{4} * 32 * 32)});
  EXPECT_EQ(what_keeps_on_host(scene, small), "more texels than a buffer has room for");
}

namespace {

// Renders with the host's and the device's surfaces, and prints how many pixels differ. One of 200 may differ where triangles meet.
void expect_same_picture(const std::string& name, const Scene& scene, const RenderOptions& options) {
  static const auto device = std::make_shared<Device>();
  const Picture by_host = DeviceFrame(scene, options, device, SurfacesBy::host).render();
  DeviceFrame frame(scene, options, device, SurfacesBy::device);
  const Picture by_raster = frame.render();
  double squares = 0, errors = 0, light = 0;
  for (const Vec3f& p : by_host.pixels) light += static_cast<double>(length(p));
  const auto pixels = static_cast<double>(by_host.pixels.size());
  int off = 0;
  for (std::size_t i = 0; i < by_host.pixels.size(); ++i) {
    const auto error = static_cast<double>(length(by_raster.pixels[i] - by_host.pixels[i]));
    ASSERT_TRUE(std::isfinite(error)) << name << " pixel " << i;
    squares += static_cast<double>(dot(by_host.pixels[i], by_host.pixels[i]));
    if (error > 1e-3 * (static_cast<double>(length(by_host.pixels[i])) + light / pixels))
      ++off;
    else
      errors += error * error;
  }
  std::printf("%-22s %4d of %.0f pixels see something else, the others relative L2 %.1e\n", name.c_str(), off, pixels,
              std::sqrt(errors / squares));
  EXPECT_LE(off, pixels / 200) << name;
  EXPECT_LE(std::sqrt(errors / squares), 1e-4) << name;
}

}  // namespace

TEST_F(VulkanSurfaces, AreTakenForWhatTheHostAdds) {
  RenderOptions options;
  options.width = 120;
  options.height = 70;
  options.method = "ltc-compact";
  const Scene gallery = load_scene(test::kSourceDir + "/scenes/gallery.glb").scene,
              ring = load_scene(test::kSourceDir + "/scenes/ring.glb").scene;
  options.shadows = steradian::Shadows::on;
  if (test::is_night()) expect_same_picture("gallery, shadows", gallery, options);
  options.shadows = steradian::Shadows::off;
  options.indirect.mode = IndirectMode::ltc;
  options.indirect.virtual_lights = 1024;
  expect_same_picture("ring, bounce", ring, options);
  options.indirect.mode = IndirectMode::off;

  Scene lit = textured();
  Environment environment;
  environment.map = Picture(4, 2);
  for (std::size_t i = 0; i < environment.map.pixels.size(); ++i)
    environment.map.pixels[i] = {0.2f + 0.1f * static_cast<float>(i), 0.5f, 1.0f};
  const auto sky = std::make_shared<const Environment>(std::move(environment));
  lit.environment = sky;
  options.aa = 2;
  expect_same_picture("environment", lit, options);
  lit = layered();
  lit.environment = sky;
  options.method = "auto";
  expect_same_picture("layers, environment", lit, options);
}

// The scenes have lamps alone, which light them without the host, or lights with a part for the host.
TEST_F(VulkanSurfaces, AreLitWithTheirLayers) {
  RenderOptions options;
  options.width = 120;
  options.height = 70;
  options.aa = 2;
  Scene scene = layered();
  scene.area_lights = {lamp()};
  expect_same_picture("layers", scene, options);
  options.method = "half-vector";
  expect_same_picture("layers, half vectors", scene, options);
  options.shadows = steradian::Shadows::on;
  const float coat = std::exchange(scene.materials[0].clearcoat, 0.0f);  // over a normal texture in shadow, the CPU renders the picture
  expect_same_picture("layers, shadows", scene, options);
  scene.multiple_scattering = true;
  scene.materials[0].anisotropy = 0;
  options.method = "ltc-compact";
  expect_same_picture("scattering, shadows", scene, options);
  options.shadows = steradian::Shadows::off;
  scene.materials[0].clearcoat = coat;
  expect_same_picture("scattering", scene, options);
}

TEST_F(VulkanSurfaces, MoveToTheSurfaceOfTheirNormals) {
  RenderOptions options;
  options.width = 120;
  options.height = 70;
  options.method = "ltc-compact";
  options.shadows = steradian::Shadows::on;
  Scene scene = textured();
  scene.meshes.push_back(scene::ball_mesh({0, 0.6f, 0}, 0.6f, 0, 12, 6));
  scene.area_lights = {lamp()};
  expect_same_picture("smooth terminator", scene, options);
  options.terminator = Terminator::strict;
  expect_same_picture("strict terminator", scene, options);
}

TEST_F(VulkanSurfaces, LeaveTilesToTheHost) {
  RenderOptions options;
  options.width = 120;
  options.height = 70;
  options.method = "ltc-compact";
  Scene scene = textured();
  scene.area_lights = {lamp()};
  const auto expect = [&](const std::string& name, auto change) {
    Scene changed = scene;
    change(changed.materials[1]);
    expect_same_picture(name, changed, options);
  };
  expect("blended", [](SurfaceMaterial& m) { m.alpha_mode = AlphaMode::blend; });
  expect("cut out", [](SurfaceMaterial& m) { m.alpha_mode = AlphaMode::mask; });
  options.shadows = steradian::Shadows::on;
  expect("cut out, shadows", [](SurfaceMaterial& m) { m.alpha_mode = AlphaMode::mask; });
  expect("thin, shadows", [](SurfaceMaterial& m) { m.transmission = 0.5f; });
}

}  // namespace steradian::vulkan::raster_surfaces_test
