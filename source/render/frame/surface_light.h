// SurfaceLight: the irradiance of given surfaces, which no camera needs to see. Light maps are made of it (docs/bake.md).
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <functional>
#include <memory>
#include <vector>

#include "render/frame/frame_surfaces.h"
#include "render/frame/methods.h"
#include "render/frame/tile_lighting.h"
#include "render/frame/tinted_shadows.h"
#include "render/radiosity/gather.h"
#include "render/radiosity/patch_solver.h"
#include "render/sampled/monte_carlo.h"

namespace steradian {

// Stores a surface whose irradiance is asked for: white and diffuse, so that its other properties do not count.
using radiosity::put_white;

// Finds the direct light of a patch by direction, for its glossy lobe: nothing where there are too many lights for it. number: of the
// patch.
void find_incident_on_patch(DirectSampler& sampler, bool has_environment, const Surface& surface, std::uint64_t number,
                            std::vector<IncidentLight>& found);

// Adds the direct light of surfaces that no camera needs to see, with the environment's. scratch: of the caller's thread.
enum class ReceiverKind { patch, asked };
struct DirectLight {
  TileLighting& lighting;
  const TintedShadows& tinted;
  FrameSurfaces& surfaces;
  const std::vector<const PackLight*>& lights;
  std::size_t shadow_rays;  // of a patch to each light; 0: exact shadows

  void add(SurfaceTile& tile, ReceiverKind receiver, EstimatedShadows& scratch) const;
};

// Lights for rays that estimate shadows: these take the faces of closed meshes one by one.
struct FaceLights {
  const std::vector<PackLight> lights;
  const std::vector<const PackLight*> pointers;
  TileLighting lighting;
  const TintedShadows tinted;

  // All arguments must outlive this object.
  FaceLights(const Scene& scene, const RenderOptions& options, const DirectMethod& method, const SceneParts& parts,
             std::span<const AreaLight> spots);
};

class SurfaceLight {
 public:
  // Solves the light between surfaces if options.bounces asks for it, on the threads of the caller's arena. The scene and the options must
  // outlive this object. The lights are always summed one by one.
  SurfaceLight(const Scene& scene, const RenderOptions& options, const WorkFraction& solved = {});
  // The time of that in tiles that find() takes: an estimate.
  static std::size_t solve_tiles(const Scene& scene, const RenderOptions& options);

  const RayScene& rays() const { return surfaces_.rays(); }
  const MipMaps& maps() const { return *parts_.maps; }

  // Light of a tile of white surfaces. Slots 4 x 4 of a block that lie side by side on one plane help each other (gather.h).
  struct Irradiance {
    TileVector value;
    TileVector error;  // estimate for the light between surfaces
  };
  enum class Direct { on, off };  // light of lamps and of the environment
  // Finds the irradiance of a tile made by put_white. Changes the tile. Any number of threads may ask at once.
  void find(SurfaceTile& tile, Direct direct, Irradiance& result);

  double shadow_fallback() const { return lights_.lighting.shadow_fallback(); }
  std::size_t patches() const { return patches_ ? patches_->patches().side_count() / 2 : 0; }

 private:
  void add_direct(SurfaceTile& tile, ReceiverKind receiver) {
    DirectLight{lights_.lighting, lights_.tinted, surfaces_, lights_.pointers, radiosity::fineness_of(options_).shadow_rays}.add(
        tile, receiver, *estimates_.local());
  }

  const RenderOptions& options_;
  const DirectMethod method_;
  const SceneParts parts_;
  FrameSurfaces surfaces_;
  FaceLights lights_;
  tbb::enumerable_thread_specific<std::unique_ptr<EstimatedShadows>> estimates_;
  tbb::enumerable_thread_specific<std::unique_ptr<DirectSampler>> samplers_;
  std::unique_ptr<const radiosity::PatchLight> patches_;  // null without bounces
  std::unique_ptr<const radiosity::Gather> gather_;
};

}  // namespace steradian
