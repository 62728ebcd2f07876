// RenderCache: what pictures of a scene are made with, kept from one to the next: of a scene that moves, only what moved is sorted again.
//
//   RenderCache cache;
//   for (...) picture = render(scene_at(t), options, cache);      // the same bytes as without
//
// What is the same is found by looking: meshes are compared with those of the picture before, by their triangles, images by a fingerprint
// of their texels. A camera that moves costs nothing; a light that moves costs its own shape, a mesh its own triangles, and the order of
// all edges that cast shadows.
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

  struct Parts;  // source/render/cpu/scene_parts.h
  Parts& parts() { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

// As render. A Vulkan device the cache keeps, too, with its pipelines and buffers, which are as large as the largest picture so far needed.
// For one picture at a time.
Picture render(const Scene& scene, const RenderOptions& options, RenderCache& cache, RenderStats* stats = nullptr,
               RenderState* state = nullptr);

}  // namespace steradian
