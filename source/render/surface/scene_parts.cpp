#include "render/surface/scene_parts.h"

namespace steradian {
SceneParts SceneParts::of(const Scene& scene, Sorted sorted) {
  return {std::make_shared<const RayScene>(scene),
          sorted == Sorted::for_rays_and_edges ? std::make_shared<const ShadowEdges>(scene) : nullptr,
          std::make_shared<const MipMaps>(scene.images)};
}

SceneParts RenderCache::Parts::follow(const Scene& scene, Sorted sorted) {
  if (rays == nullptr) {
    rays = std::make_shared<RayScene>(scene, RayScene::Lasts::many_scenes);
  } else {
    try {
      if (rays->follow(scene)) {
        shadows.reset();
        device_rays.reset();
      }
    } catch (...) {  // a half-finished state is of no use
      rays.reset();
      shadows.reset();
      device_rays.reset();
      throw;
    }
  }
  if (sorted == Sorted::for_rays_and_edges && shadows == nullptr) shadows = std::make_shared<const ShadowEdges>(scene);
  return {rays, sorted == Sorted::for_rays_and_edges ? shadows : nullptr, std::make_shared<const MipMaps>(scene.images, pyramids)};
}

RenderCache::RenderCache() : parts_(std::make_unique<Parts>()) {}
RenderCache::~RenderCache() = default;
RenderCache::RenderCache(RenderCache&&) noexcept = default;
RenderCache& RenderCache::operator=(RenderCache&&) noexcept = default;

}  // namespace steradian
