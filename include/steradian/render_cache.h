// RenderCache: data from which pictures of a scene are rendered, cached from one to the next. For a moving scene, only what moved is sorted
// again.
//
//   RenderCache cache;
//   for (...) picture = render(scene_at(t), options, cache);      // the same bytes as without a cache
//
// Unchanged data is detected: meshes are compared with those of the previous picture by their triangles, images by a fingerprint of their
// texels. A camera that moves costs nothing. A light that moves costs its own shape, a mesh its own triangles and the order of all edges
// that cast shadows. With bounces, where two surfaces lie at one place, rays may meet the other one after a light has moved.
#pragma once

#include <memory>

#include "steradian/render.h"

namespace steradian {

class RenderCache {
 public:
  RenderCache();
  ~RenderCache();
  RenderCache(RenderCache&&) noexcept;
  RenderCache& operator=(RenderCache&&) noexcept;

  struct Parts;  // source/render/surface/ray_scene.h
  Parts& parts() { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

// Renders like the function without a cache. The cache also stores a Vulkan device with its pipelines and buffers, whose size is that for
// the largest picture so far. It serves one picture at a time.
Picture render(const Scene& scene, const RenderOptions& options, RenderCache& cache, RenderStats* stats = nullptr,
               RenderState* state = nullptr);

}  // namespace steradian
