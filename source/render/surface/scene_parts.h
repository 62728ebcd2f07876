// SceneParts: structures over a scene's meshes for rays and shadows, and its images at smaller sizes. They serve any camera and any lights.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/mip_maps.h"
#include "render/surface/ray_scene.h"
#include "shadow/edges/gather.h"
#include "shadow/rays/open_shaft.h"
#include "steradian/render_cache.h"

namespace steradian {

namespace vulkan {
struct KeptOnDevice;
class SceneRays;
}  // namespace vulkan

// The edges that cast shadows, and the trees over them and their triangles.
struct ShadowEdges {
  explicit ShadowEdges(const Scene& scene) : mesh(shadow::build_edges(scene)), edges(mesh), triangles(mesh) {}
  ShadowEdges(const ShadowEdges&) = delete;
  const shadow::EdgeMesh mesh;
  const shadow::EdgeTree edges;
  const shadow::TriangleTree triangles;
};

// for_rays_and_edges: also for shadows without sampling.
enum class Sorted { for_rays, for_rays_and_edges };

struct SceneParts {
  std::shared_ptr<const RayScene> rays;
  std::shared_ptr<const ShadowEdges> shadows;  // null if only rays are needed
  std::shared_ptr<const MipMaps> maps;         // mip maps of the scene's images, which must outlive them

  static SceneParts of(const Scene& scene, Sorted sorted);
};

// Parts of the last scene.
struct RenderCache::Parts {
  // Parts of this scene. Parts of the last scene that are the same are reused.
  SceneParts follow(const Scene& scene, Sorted sorted);

  std::shared_ptr<RayScene> rays;
  std::shared_ptr<const ShadowEdges> shadows;
  MipMaps::Pyramids pyramids;
  std::pair<std::shared_ptr<vulkan::KeptOnDevice>, std::string> on_device;  // and the device's name in the options
  std::shared_ptr<const vulkan::SceneRays> device_rays;
};

}  // namespace steradian
