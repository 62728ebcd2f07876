// PatchLinks: the patches of a scene, and the sides that the rays of each side meet. They depend on no light. Shapes of lamps have no
// patches, but stop rays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/mip_maps.h"
#include "render/radiosity/patches.h"
#include "render/radiosity/side_rays.h"
#include "render/surface/ray_scene.h"
#include "render/surface/surface.h"

namespace steradian::radiosity {

// The surface at a place of a side, as a ray sees it that comes along the normal.
Surface surface_at_site(const Scene& scene, const MipMaps& maps, const Patches::Site& at, bool front);

class PatchLinks {
 public:
  // Cuts the scene into patches. Their sides have no rays yet.
  PatchLinks(const Scene& scene, const RayScene& rays, std::size_t wanted);
  // True if two scenes of as many meshes have the same patches, and differ by nothing but lights, their shapes and cameras.
  static bool serve_both(const Scene& a, const Scene& b);

  // Calls a work for every number below a count, on several threads.
  using Each = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;
  // Traces so many rays of each side.
  void find(const Scene& scene, const RayScene& rays, const MipMaps& maps, std::size_t count, const Each& each);
  // Traces those rays again that may meet the shape of a lamp that has changed. The scene is served by these patches. Then each ray meets
  // what it meets after find(), or a surface at the same place. False if rays would begin at other places.
  bool follow(const Scene& scene, const RayScene& rays, const MipMaps& maps, const Each& each);

  const std::shared_ptr<const Patches>& patches() const { return patches_; }
  std::size_t rays() const { return side_rays_.count(); }  // of each side
  std::uint64_t traced() const { return traced_; }         // by the last find() or follow()
  const SideRays& side_rays() const { return side_rays_; }
  std::uint32_t met(std::size_t side, std::size_t ray) const { return met_[side * rays() + ray]; }  // a side, or kNoSide
  struct Absorbed {
    std::size_t ray;
    Vec3f fraction;  // that the glass before it takes
  };
  const std::vector<Absorbed>& absorbed(std::size_t side) const { return absorbed_[side]; }  // its rays through glass

 private:
  struct LampShape {
    std::size_t mesh;
    std::vector<Vec3f> positions;
  };
  // True for rays that are to be traced.
  using Asked = std::function<bool(Vec3d from, Vec3d along)>;
  void trace(const Scene& scene, const RayScene& rays, const MipMaps& maps, const Each& each, const Asked& asked);
  void keep_lamps(const Scene& scene, const RayScene& rays);

  std::shared_ptr<const Patches> patches_;
  SideRays side_rays_;
  std::vector<std::uint32_t> met_;
  std::vector<std::vector<Absorbed>> absorbed_;
  std::vector<LampShape> lamps_;
  float reach_ = 0;  // of the rays' scene: the distance of their origins from surfaces goes by it
  std::uint64_t traced_ = 0;
};

}  // namespace steradian::radiosity
