#include "device/shadow/first_hits.h"

#include <algorithm>

#include "device/vulkan/shaders.h"

namespace steradian::vulkan {
namespace {

#include "shaders/ray_layout.glsl"

constexpr std::size_t kThreads = 64;  // work group size of shaders/bounce_rays.comp

static_assert(sizeof(indirect::MapRay) == static_cast<std::size_t>(kMapRay) * 4 * sizeof(float));

}  // namespace

FirstHits::FirstHits(std::shared_ptr<const SceneRays> scene)
    : scene_(std::move(scene)), program_(scene_->device(), {bounce_rays_shader()}, 3) {}

std::size_t FirstHits::most() const { return std::size_t{1} << 20; }  // 32 MiB; in one row of work groups

indirect::MapRay* FirstHits::rays(std::size_t count) {
  if (rays_ == nullptr || rays_->bytes() < count * sizeof(indirect::MapRay)) {
    const std::size_t room = rays_ == nullptr ? std::max<std::size_t>(count, kThreads) : std::min(count + count / 2, most());
    rays_ = std::make_unique<Buffer>(scene_->device(), room * sizeof(indirect::MapRay), BufferUse::host_writes);
    met_ = std::make_unique<Buffer>(scene_->device(), room * sizeof(std::uint32_t), BufferUse::host_reads);
  }
  return static_cast<indirect::MapRay*>(rays_->mapped());
}

void FirstHits::find(std::size_t count) {
  const auto groups = static_cast<std::uint32_t>((count + kThreads - 1) / kThreads);
  const auto ms =
      program_.run({rays_.get(), met_.get(), &scene_->hierarchy()}, {{program_.pipeline(), groups, 1, static_cast<std::uint32_t>(count)}});
  if (!ms.empty()) time_ += ms.front();
}

indirect::FirstHit FirstHits::hit(std::size_t ray) const {
  const std::uint32_t met = static_cast<const std::uint32_t*>(met_->mapped())[ray];
  if (met == static_cast<std::uint32_t>(kMeetsNothing)) return {};
  if (met == static_cast<std::uint32_t>(kHostFinds)) return {indirect::FirstHit::kUnknown, 0};
  const SceneRays::Triangle triangle = scene_->triangle(met - 1);
  return {triangle.mesh, triangle.triangle};
}

}  // namespace steradian::vulkan
