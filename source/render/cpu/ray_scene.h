// RayScene: what rays of a scene hit, on Embree.
#pragma once

#include <embree3/rtcore.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "steradian/scene.h"

namespace steradian {

// The camera sees every mesh. Shadow rays pass the shapes that only stand for rect, disk and sphere lights.
class RayScene {
 public:
  explicit RayScene(const Scene& scene);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // Traces 16 neighbouring camera rays; valid[i] is -1 for a ray to trace, 0 for none. hit.geomID[i] is the mesh.
  void intersect(const int valid[16], RTCRayHit16& rays) const;

  // One ray from anywhere. Returns false when nothing is hit.
  bool intersect(Vec3f origin, Vec3f direction, RTCRayHit& hit) const;

  // True when something stands between two points. Both ends are moved in by a share of the distance, so that the
  // surfaces on which they lie do not count.
  bool occluded(Vec3f from, Vec3f to) const;
  bool occluded_towards(Vec3f from, Vec3f direction) const;

 private:
  struct AlphaTest;
  RTCDevice device_;
  RTCScene rtc_;
  std::vector<std::unique_ptr<AlphaTest>> alpha_tests_;
};

}  // namespace steradian
