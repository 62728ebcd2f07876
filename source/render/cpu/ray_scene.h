// RayScene: what rays of a scene hit, on Embree.
#pragma once

#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "steradian/scene.h"

namespace steradian {

// What may block a ray, the shapes of lights never: every mesh; those whose edges cast exact shadows; cut-outs, which have none.
enum class Casters { all, with_edges, cut_outs };

// Embree takes what is below 1e-18 for nothing, areas times lengths of directions among it, and floats what is below 1e-38. In this unit, a
// power of two, the scene's size, its largest coordinate, is from 1 / 256 to 256 or so: every length is the same float but for its
// exponent. Steps of 2^16, so that what moves stays in its unit.
float unit_of_size(float size);

// The camera sees every mesh. Shadow rays pass the shapes that only stand for rect, disk and sphere lights.
class RayScene {
 public:
  // many_scenes: sorted mesh by mesh, so that follow() need not sort all; rays take a little longer.
  enum class Lasts { one_scene, many_scenes };
  explicit RayScene(const Scene& scene, Lasts lasts = Lasts::one_scene);  // throws Error with what Embree reports
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // Becomes that of another scene; meshes with the same triangles stay as they are sorted. Whether edges that cast shadows have changed.
  // After an Error it is of no scene.
  bool follow(const Scene& scene);

  // Traces 16 neighbouring camera rays, of unit directions; valid[i] is -1 for a ray to trace, 0 for none. hit.geomID[i] is the mesh.
  // Lanes without a ray hold finite numbers, too.
  void intersect(const int valid[16], RTCRayHit16& rays) const;

  // One ray from anywhere, in a unit direction. Returns false when nothing is hit.
  bool intersect(Vec3f origin, Vec3f direction, RTCRayHit& hit) const;

  // Whether something stands between two points, near the ends included: a point on a surface is moved off it first
  // (shadow::offset_from_surface).
  bool between(Vec3d from, Vec3d to, Casters casters = Casters::with_edges) const;
  // Sixteen at once, those in the bits of `asked`; casters: those whose edges cast exact shadows. Returns which are blocked.
  struct Sixteen {
    alignas(64) RTCRay16 rays;
    // From a point along a vector, to its end.
    void set(std::size_t i, Vec3d from, Vec3d along);
  };
  std::uint32_t blocked_among(Sixteen& sixteen, std::uint32_t asked) const;

  bool blocked_towards(Vec3d from, Vec3d direction) const;  // by any; of length 1

  // The same from surface to surface, for rays that need not agree with the shadows of direct light: both ends are moved in
  // by a share of the distance.
  bool occluded(Vec3f from, Vec3f to) const;

 private:
  struct AlphaTest;
  // A mesh as Embree has it. Its vertices and corners lie in Embree's own copy.
  struct Part {
    RTCGeometry geometry = nullptr;  // of rtc_; null: nothing is there
    std::size_t vertices = 0, triangles = 0;
    unsigned mask = 0;
    std::unique_ptr<AlphaTest> alpha;  // of cut-outs
  };
  bool put(unsigned number, const Mesh& mesh, const Scene& scene);  // whether anything has changed
  void make(unsigned number, const Mesh& mesh);
  void put_vertices(RTCGeometry geometry, const Mesh& mesh) const;
  bool has_vertices(RTCGeometry geometry, const Mesh& mesh) const;
  // From a point in Embree's unit.
  bool blocked(Vec3f from, Vec3f direction, float near, float far, unsigned mask) const;

  struct Release {
    void operator()(RTCDevice device) const;
    void operator()(RTCScene scene) const;
  };
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> rtc_;
  std::vector<Part> parts_;  // by mesh
  float unit_ = 1;           // Embree's lengths are the scene's by this
};

}  // namespace steradian
