#include "device/surface/raster_surfaces.h"

#include <algorithm>
#include <array>
#include <utility>

#include "device/vulkan/shaders.h"
#include "render/lights/light_bounds.h"
#include "render/surface/gbuffer.h"

namespace steradian::vulkan {
namespace {

#include "shaders/layout.glsl"
#include "shaders/surface/surface_layout.glsl"

using Vec4Floats = std::array<float, 4>;

constexpr std::size_t kTexels = 6, kBuffers = 4;  // as bound in find
constexpr auto kBytesOfView = static_cast<std::size_t>(kViewVectors) * sizeof(Vec4Floats);

const Vec4Floats* bounds_of(const Buffer& radiance, std::size_t place) {
  return static_cast<const Vec4Floats*>(radiance.mapped()) + place * static_cast<std::size_t>(kRadiance) + kSlots;
}

Vec3f vector(const Vec4Floats& v) { return {v[0], v[1], v[2]}; }

}  // namespace

RasterSurfaces::Kept::Kept(const Device& d)
    : scene(d),
      visibility(d),
      view(d, BufferUse::host_writes, BufferForm::texels),
      taken(d, BufferUse::host_reads),
      program(d, {shader("resolve.comp")}, kBuffers, kTexels) {
  view.fit(kBytesOfView);
}

RasterSurfaces::RasterSurfaces(Kept& kept, const Scene& scene, const MipMaps& maps, const CameraRays& camera, const RenderOptions& options,
                               std::size_t tiles, bool taken)
    : kept_(kept),
      meshes_(scene),
      view_(camera, options.width, options.height),
      steps_(camera.steps(options.aa)),
      samples_(options.aa),
      smooth_(options.shadows != Shadows::off && options.terminator == Terminator::smooth),
      taken_(taken) {
  kept.scene.follow(scene, maps);
  if (taken) kept.taken.fit(tiles * static_cast<std::size_t>(kPlanes * kSlots) * sizeof(Vec4Floats));
}

void RasterSurfaces::write_view(PixelPlace place) {
  std::array<Vec4Floats, static_cast<std::size_t>(kViewVectors)> v;
  const auto put = [&](int at, Vec3f a, float beside) { v[static_cast<std::size_t>(at)] = {a.x, a.y, a.z, beside}; };
  put(kViewOrigin, view_.origin, static_cast<float>(view_.width));
  put(kViewCorner, view_.corner, static_cast<float>(view_.height));
  put(kViewRight, view_.right, static_cast<float>((view_.width + kTileSide - 1) / kTileSide));
  put(kViewDown, view_.down, 0);
  put(kViewStepRight, steps_.right, place.x);
  put(kViewStepDown, steps_.down, place.y);
  put(kViewForward, steps_.forward, 0);
  kept_.view.get().write(v.data(), kBytesOfView);
}

void RasterSurfaces::look(int sample) {
  const PixelPlace place = pixel_place(sample, samples_);
  write_view(place);
  kept_.visibility.draw(kept_.scene, view_, place);
  drawn_ = true;
}

void RasterSurfaces::find(int first_tile, int count, Buffer& surfaces, Buffer& radiance) {
  const SceneBuffers& scene = kept_.scene;
  const std::vector<double> ms = kept_.program.run(
      {&scene.vertices(), &scene.triangles(), &scene.materials(), &kept_.view.get(), &scene.texels(), &scene.tables(),
       &kept_.visibility.seen(), &surfaces, &radiance, taken_ ? &kept_.taken.get() : &surfaces},
      {{kept_.program.pipeline(0, {taken_ ? 1 : 0, scene.has_layers() ? 1 : 0, smooth_ ? 1 : 0}), static_cast<std::uint32_t>(kGroupsOfTile),
        static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(first_tile)}});
  if (!ms.empty()) times_["surfaces"] += ms.front();
  if (std::exchange(drawn_, false)) times_["triangles"] += kept_.visibility.time();
}

bool RasterSurfaces::is_for_host(const Buffer& radiance, std::size_t place) {
  const Vec4Floats* bounds = bounds_of(radiance, place);
  for (int group = 0; group < kGroupsOfTile; ++group, bounds += kBounds)
    if ((static_cast<int>(bounds[0][3]) & kAnyForHost) != 0) return true;
  return false;
}

void RasterSurfaces::find_squares(const Buffer& radiance, std::size_t place, DirectPass::Tile& tile) {
  const Vec4Floats* bounds = bounds_of(radiance, place);
  for (std::size_t group = 0; group < static_cast<std::size_t>(kGroupsOfTile); ++group, bounds += kBounds) {
    const int kinds = static_cast<int>(bounds[0][3]);
    if (kinds == 0) continue;
    DirectPass::Square& square = tile.squares[DirectPass::square_of_group(group)];
    add(square.bounds, {vector(bounds[0]), vector(bounds[1]), vector(bounds[2]), vector(bounds[3])});
    square.any_diffuse |= (kinds & kAnyDiffuse) != 0;
    square.any_specular |= (kinds & kAnySpecular) != 0;
    square.any_sheen |= (kinds & kAnySheen) != 0;
    square.any_coat |= (kinds & kAnyCoat) != 0;
  }
}

void RasterSurfaces::take(const Buffer& radiance, std::size_t place, SurfaceTile& tile) const {
  const Vec4Floats* planes =
      static_cast<const Vec4Floats*>(kept_.taken.get().mapped()) + place * static_cast<std::size_t>(kPlanes * kSlots);
  const Vec4Floats* shine = static_cast<const Vec4Floats*>(radiance.mapped()) + place * static_cast<std::size_t>(kRadiance);
  clear_kinds(tile);
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (shine[i][3] == 0) {
      put_nothing(tile, i);
      continue;
    }
    const auto at = [&](int plane) -> const Vec4Floats& { return planes[static_cast<std::size_t>(plane * kSlots) + i]; };
    Surface s;
    s.position = vector(at(kPosition));
    s.normal = s.coat_normal = vector(at(kNormal));
    s.geometric_normal = {at(kAlbedo)[3], at(kF0)[3], at(kF90)[3]};
    s.tangent = vector(at(kTangent));
    s.emission = vector(shine[i]);
    s.albedo = vector(at(kAlbedo));
    s.fresnel_loss = at(kView)[3];
    s.f0 = vector(at(kF0));
    s.f90 = vector(at(kF90));
    s.alpha_x = at(kPosition)[3];
    s.alpha_y = at(kNormal)[3];
    if (kept_.scene.has_layers()) {
      s.sheen = vector(at(kSheen));
      s.sheen_alpha = at(kSheen)[3];
      s.coat = at(kTangent)[3];
      s.coat_alpha = at(kCoatNormal)[3];
      s.coat_normal = vector(at(kCoatNormal));
    }
    const Mesh& mesh = meshes_.meshes[static_cast<std::size_t>(shine[i][3]) - 1];
    s.material = &meshes_.materials[static_cast<std::size_t>(mesh.material)];
    put_surface(tile, i, s, vector(at(kView)));
  }
}

}  // namespace steradian::vulkan
