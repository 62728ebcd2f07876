// PatchSolver: computes the light of all patches (PatchLight).
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "core/mip_maps.h"
#include "core/progress.h"
#include "render/radiosity/bounce_rays.h"
#include "render/radiosity/fineness.h"
#include "render/radiosity/patch_light.h"
#include "render/radiosity/patch_links.h"
#include "render/tile/tile.h"

namespace steradian::radiosity {

struct PatchOptions {
  int bounces = kAllBounces;  // of the light in the picture: the last one is that of the gather
  Fineness fineness = fineness_of(Quality::normal);
  const std::atomic<bool>* stop = nullptr;  // once true, the result is unfinished
  WorkFraction progress{};
};

// Stores a white diffuse surface in the place of another, so that the radiance that it reflects is its irradiance over pi.
void put_white(SurfaceTile& tile, std::size_t slot, const Surface& surface);

// Adds the direct light of a tile's surfaces to their radiance.
using AddDirect = std::function<void(SurfaceTile& tile)>;

// Appends the light that reaches a surface from directions. number: seed of the directions.
using FindIncident = std::function<void(const Surface& surface, std::uint64_t number, std::vector<IncidentLight>& found)>;

// Computes all radiances, on the threads of the caller's arena. kept: if not null, PatchLinks that serve this scene and its options, or
// none; they become those of this scene unless the work was stopped.
PatchLight solve_patches(const Scene& scene, const RayScene& rays, const MipMaps& maps, const PatchOptions& options,
                         const AddDirect& add_direct, const FindIncident& find_incident, std::shared_ptr<const PatchLinks>* kept = nullptr);

// The time of solve_patches, in tiles of a picture that are lit directly: an estimate, for progress.
std::size_t solve_tiles(const Scene& scene, const PatchOptions& options);

}  // namespace steradian::radiosity
