#include "render/vulkan/raster_surfaces.h"

#include <algorithm>
#include <array>

#include "render/cpu/light_bounds.h"
#include "render/cpu/tile.h"
#include "render/vulkan/shaders.h"

namespace steradian::vulkan {
namespace {

#include "shaders/layout.glsl"
#include "shaders/surface_layout.glsl"

using Vec4Floats = std::array<float, 4>;

constexpr std::size_t kTexels = 5, kBuffers = 3;  // as bound in find
constexpr auto kBytesOfView = static_cast<std::size_t>(kViewVectors) * sizeof(Vec4Floats);

}  // namespace

RasterSurfaces::RasterSurfaces(const Device& device, const Scene& scene, const CameraRays& camera, const RenderOptions& options)
    : view_(camera, options.width, options.height),
      steps_(camera.steps(options.aa)),
      samples_(options.aa),
      scene_(make_scene_buffers(device, scene, MipMaps(scene.images))),
      visibility_(device, scene_, view_),
      view_buffer_(device, kBytesOfView, BufferUse::host_writes, BufferForm::texels),
      program_(device, {resolve_shader()}, kBuffers, kTexels) {}

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
  view_buffer_.write(v.data(), kBytesOfView);
}

void RasterSurfaces::look(int sample) {
  const PixelPlace place = pixel_place(sample, samples_);
  write_view(place);
  times_["triangles"] += visibility_.draw(place);
}

void RasterSurfaces::find(int first_tile, int count, Buffer& surfaces, Buffer& radiance) {
  const std::vector<double> ms = program_.run(
      {&scene_.vertices, &scene_.triangles, &scene_.materials, &view_buffer_, &scene_.texels, &visibility_.seen(), &surfaces, &radiance},
      {{program_.pipeline(), static_cast<std::uint32_t>(kGroupsOfTile), static_cast<std::uint32_t>(count),
        static_cast<std::uint32_t>(first_tile)}});
  if (!ms.empty()) times_["surfaces"] += ms.front();
}

void RasterSurfaces::find_squares(const Buffer& radiance, std::size_t place, DirectLight::Tile& tile) {
  const auto* bounds = static_cast<const Vec4Floats*>(radiance.mapped()) + place * static_cast<std::size_t>(kRadiance) + kSlots;
  const auto vector = [](const Vec4Floats& v) { return Vec3f{v[0], v[1], v[2]}; };
  for (std::size_t group = 0; group < static_cast<std::size_t>(kGroupsOfTile); ++group, bounds += kBounds) {
    const int kinds = static_cast<int>(bounds[0][3]);
    if (kinds == 0) continue;
    DirectLight::Square& square = tile.squares[DirectLight::square_of_group(group)];
    add(square.bounds, {vector(bounds[0]), vector(bounds[1]), vector(bounds[2]), vector(bounds[3])});
    square.any_diffuse |= (kinds & kAnyDiffuse) != 0;
    square.any_specular |= (kinds & kAnySpecular) != 0;
  }
}

}  // namespace steradian::vulkan
