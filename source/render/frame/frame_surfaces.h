// FrameSurfaces: the surfaces that the camera sees of a scene, tile by tile. All back ends share this part of a frame.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "render/environment/environment_light.h"
#include "render/environment/environment_shadows.h"
#include "render/surface/camera_rays.h"
#include "render/surface/gbuffer.h"
#include "render/surface/passed_rays.h"
#include "render/surface/ray_scene.h"
#include "render/surface/surface_pack.h"
#include "render/tile/pass_clock.h"
#include "steradian/render.h"

namespace steradian {

class FrameSurfaces {
 public:
  // Scene, options and table must outlive this object. fitted: as lobes_of. estimates: paths estimate the light.
  FrameSurfaces(const Scene& scene, const RenderOptions& options, const SceneParts& parts, const ClassicTable* fitted = nullptr,
                bool estimates = false);

  int tile_count() const { return tiles_x_ * tiles_y_; }
  int tiles_across() const { return tiles_x_; }
  TileArea area(int index) const;
  const CameraRays& camera() const { return camera_; }
  const RayScene& rays() const { return *rays_; }
  const environment::EnvironmentLight* environment() const { return environment_.get(); }  // null without one
  std::span<const AreaLight> environment_spots() const;                                    // lights in addition to the scene's own

  // Fills a tile with the surfaces through the places of a primary sample, and the background around them. behind: distances to look past;
  // null for the nearest surfaces. Returns the distances of the surfaces.
  TilePlane fill(int index, int sample, SurfaceTile& tile, const TilePlane* behind = nullptr);
  // Fills a tile with the surfaces that moved rays meet.
  const PassedRays& passed_rays() const { return passed_; }
  void look_through(const SurfaceTile& tile, PassedRays::Ways& ways) const { passed_.look_through(tile, ways); }
  void fill_behind(int index, int sample, SurfaceTile& tile, PassedRays::Ways& ways);
  // SurfaceTile::seed. It depends on the pixels' places, not on their surfaces, which may differ by a rounding on another back end.
  std::uint64_t seed(int index, int sample) const {
    return static_cast<std::uint64_t>(sample) * static_cast<std::uint64_t>(tile_count()) + static_cast<std::uint64_t>(index);
  }
  // Adds the background where a tile holds no surface, for callers that fill the tile in another way.
  void add_background(int index, int sample, SurfaceTile& tile) const;
  // Adds all of the environment's light except that of its spots, past the meshes if the picture has shadows.
  void add_environment(int index, int sample, SurfaceTile& tile) {
    add_environment(sample, tile, halves_of_rays_[static_cast<std::size_t>(index)]);
  }
  // The same for surfaces of no tile of the picture. Adds to `halves`.
  void add_environment(int sample, SurfaceTile& tile, environment::HalvesOfRays& halves);
  // Error of the shadows of that light: rms over its mean (HalvesOfRays).
  double environment_shadow_error() const;

  double environment_build_ms() const { return environment_build_ms_; }
  // Times of the passes `rays` and `gbuffer`, and of `environment` if the scene has one.
  PassTime rays_time(int threads) const { return rays_clock_.time(threads); }
  PassTime gbuffer_time(int threads) const { return gbuffer_clock_.time(threads); }
  PassTime environment_time(int threads) const { return environment_clock_.time(threads); }

 private:
  std::unique_ptr<const environment::EnvironmentLight> prepare_environment(const ClassicTable* fitted);
  PassedRays::Background background() const;
  void show_background(const TileVector& directions, SurfaceTile& tile, const TilePlane* behind) const;

  const Scene& scene_;
  const RenderOptions& options_;
  const CameraRays camera_;
  const std::shared_ptr<const RayScene> rays_;
  double environment_build_ms_ = 0;
  const std::unique_ptr<const environment::EnvironmentLight> environment_;
  const std::unique_ptr<const environment::EnvironmentShadows> environment_shadows_;  // null without an environment or without shadows
  std::vector<environment::HalvesOfRays> halves_of_rays_;                             // by tile
  const std::shared_ptr<const MipMaps> maps_;
  const HitShading shading_;
  const PassedRays passed_;
  const int tiles_x_, tiles_y_;
  PassClock rays_clock_{"rays"}, gbuffer_clock_{"gbuffer"}, environment_clock_{"environment"};
};

// Adds `weight` times a tile's values to the pixels of a picture. shares: fraction of them that arrives; null for all.
void add_to_picture(const TileVector& values, TileArea area, const TileVector* shares, float weight, std::vector<Vec3f>& pixels, int width);

// Clears the pixels of a tile, in all layers, and copies them to a picture of the same size and layers.
void clear_area(TileArea area, Picture& picture);
void copy_area(TileArea area, const Picture& from, Picture& to);

}  // namespace steradian
