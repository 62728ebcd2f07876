// RayScene, the rays of a scene, and SceneParts, all structures over its meshes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <embree3/rtcore.h>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/mip_maps.h"
#include "shadow/edges/gather.h"
#include "shadow/edges/segments.h"
#include "shadow/rays/shafts.h"
#include "steradian/render_cache.h"
#include "steradian/scene.h"

namespace steradian {

// RayScene: intersection of rays with a scene, on Embree.

// Meshes that may block a ray: every mesh that casts shadows; those of them whose edges cast exact shadows; cut-outs, which have no edges;
// all that stops light between surfaces, also shapes of lights. clear: the meshes that only tint light.
enum class Casters { all, with_edges, cut_outs, and_lights, clear };

// Unit of length for Embree, a power of two. Embree treats values below 1e-18 as zero, among them areas times lengths of directions; floats
// do so below 1e-38. In this unit the scene's size, its largest coordinate, is about 1 / 256 to 256. Lengths are the same floats, except
// for their exponents. Units are steps of 2^16, so that moving objects stay in their unit.
float unit_of_size(float size);

// The camera sees every mesh. Shadow rays pass through shapes that only stand for rect, disk and sphere lights.
class RayScene {
 public:
  // many_scenes: sorted mesh by mesh, so that follow() need not sort all of them; rays take a little longer.
  enum class Lasts { one_scene, many_scenes };
  explicit RayScene(const Scene& scene, Lasts lasts = Lasts::one_scene);  // throws Error with what Embree reports
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // Changes to another scene; meshes with the same triangles stay as sorted. Returns true if edges that cast shadows have changed. After an
  // Error it belongs to no scene.
  bool follow(const Scene& scene);

  // Traces 16 rays of unit direction; valid[i] is -1 to trace a ray, 0 to skip it. hit.geomID[i] is the mesh.
  // Lanes without a ray hold finite numbers, too. Order: of the rays, for speed alone. scattered: they part soon.
  enum class Order { neighbours, scattered };
  void intersect(const int valid[16], RTCRayHit16& rays, Order order = Order::neighbours) const;

  // Traces one ray from anywhere, in a unit direction. Returns false if it hits nothing.
  bool intersect(Vec3f origin, Vec3f direction, RTCRayHit& hit) const;

  // True if something lies between two points, even close to one of them. A point on a surface must first be moved off it
  // (offset_from_surface).
  bool between(Vec3d from, Vec3d to, Casters casters = Casters::with_edges) const;
  // Tests sixteen rays at once, those in the bits of `asked`. Returns the blocked ones.
  struct Sixteen {
    alignas(64) RTCRay16 rays;
    // Sets ray i from a point along a vector, to the vector's end.
    void set(std::size_t i, Vec3d from, Vec3d along);
  };
  std::uint32_t blocked_among(Sixteen& sixteen, std::uint32_t asked, Casters casters = Casters::with_edges) const;

  // Distance that the origin of a shadow ray keeps from its surface, whose position is in float.
  double offset_from_surface(Vec3d position) const { return shadow::offset_from_surface(position, static_cast<double>(reach_), 0x1p-24); }
  // A position moved off its surface along the surface's normal, where shadow rays begin and end.
  Vec3d off_surface(Vec3d position, Vec3d normal) const { return position + normal * offset_from_surface(position); }
  // The same for the way of a hit from the edges of its triangle, at any place in the scene.
  float offset_from_edges() const { return static_cast<float>(offset_from_surface({double{reach_}, 0, 0})); }
  float reach() const { return reach_; }  // largest coordinate of the meshes

  bool blocked_towards(Vec3d from, Vec3d direction) const;  // blocked by any mesh; direction: unit

  // The same from surface to surface, for rays that need not agree with the shadows of direct light. Both ends are moved in by a fraction
  // of the distance.
  bool occluded(Vec3f from, Vec3f to) const;

 private:
  struct AlphaTest;
  // A mesh as Embree stores it. Embree copies its vertices and corners.
  struct Part {
    RTCGeometry geometry = nullptr;  // belongs to rtc_; null: no mesh
    std::size_t vertices = 0, triangles = 0;
    unsigned mask = 0;
    std::unique_ptr<AlphaTest> alpha;  // for cut-outs only
  };
  bool put(unsigned number, const Mesh& mesh, const Scene& scene);  // true if anything has changed
  void make(unsigned number, const Mesh& mesh);
  void put_vertices(RTCGeometry geometry, const Mesh& mesh) const;
  bool has_vertices(RTCGeometry geometry, const Mesh& mesh) const;
  // The origin is in Embree's unit.
  bool blocked(Vec3f from, Vec3f direction, float near, float far, unsigned mask) const;

  struct Release {
    void operator()(RTCDevice device) const;
    void operator()(RTCScene scene) const;
  };
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> rtc_;
  std::vector<Part> parts_;  // by mesh
  float reach_ = 0;
  float unit_ = 1;  // factor from the scene's lengths to Embree's
};

// SceneParts: structures over a scene's meshes for rays and shadows, and its images at smaller sizes. They serve any camera and any lights.

namespace vulkan {
struct KeptOnDevice;
class SceneRays;
}  // namespace vulkan
namespace radiosity {
class KeptPatches;
}  // namespace radiosity

// The edges that cast shadows, and the trees over them and their triangles.
struct ShadowEdges {
  explicit ShadowEdges(const Scene& scene)
      : bodies(shadow::bodies_of(scene.area_lights)),
        mesh(shadow::build_edges(scene)),
        trees(mesh),
        edges(*trees.edges),
        triangles(*trees.triangles) {}
  ShadowEdges(const ShadowEdges&) = delete;
  // True for a scene of the same meshes if its round lights cut them as before.
  bool suit(const std::vector<AreaLight>& lights) const;
  // Two threads sort them at the same time.
  struct Trees {
    explicit Trees(const shadow::EdgeMesh& mesh);
    std::optional<shadow::EdgeTree> edges;
    std::optional<shadow::TriangleTree> triangles;
  };
  const std::vector<Body> bodies;  // of the round lights, which cut the triangles that enter them
  const shadow::EdgeMesh mesh;
  const Trees trees;
  const shadow::EdgeTree& edges;
  const shadow::TriangleTree& triangles;
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
  std::shared_ptr<radiosity::KeptPatches> patches;  // null before the first picture with bounces
};

}  // namespace steradian
