// TileLighting: direct light of a tile's surfaces past occluders, without sampling. All back ends share this part on the CPU.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "render/frame/methods.h"
#include "render/frame/specular.h"
#include "render/lights/light_choice.h"
#include "render/lights/light_list.h"
#include "render/many/many_light_pass.h"
#include "render/shadow/few_rays.h"
#include "render/shadow/pass.h"
#include "render/surface/ray_scene.h"
#include "render/tile/pass_clock.h"
#include "steradian/render.h"

namespace steradian {

// Shadows that rays have estimated over a tile.
struct EstimatedShadows {
  TileVector bound;    // largest error of each slot's light: the light that an area light sends times the larger of its fractions
  double squares = 0;  // of the estimated errors of the luminance, summed over slots
  void clear();
};

class TileLighting {
 public:
  // All arguments must outlive this object. lights: from prepare_lights. many_lights: null if each light is summed by itself.
  TileLighting(const Scene& scene, const RenderOptions& options, const DirectMethod& method, const std::vector<PackLight>& lights,
               const SceneParts& parts, ManyLightPass* many_lights);

  bool has_shadows() const { return shadows_.has_value(); }
  // Exact shadows of a tile stop when is_late() becomes true: the tile then lacks light. It may be called from any thread.
  void give_up_when(std::function<bool()> is_late) { is_late_ = std::move(is_late); }
  // True if the picture has the layer "shadow_bound" of RenderOptions::shadow_error.
  bool bounds_shadows() const;
  // True if the shadows of dim lights may be estimated.
  bool may_estimate() const;

  // Adds the light of lights that nothing occludes to tile.radiance. With many lights, their bound() grows.
  void add(SurfaceTile& tile, const std::vector<const PackLight*>& lights);
  // The same, but many lights' diffuse light is added elsewhere, for a block of tiles.
  void add_beside_block(SurfaceTile& tile, const std::vector<const PackLight*>& lights) {
    add_many(tile, lights, many_lights_->others(lights));
  }
  // Adds the light of lights that may be occluded. estimate: takes the bound of shadows within options.shadow_error; null: all are exact.
  void add_shadowed(SurfaceTile& tile, const std::vector<const PackLight*>& lights, int sample = 0, EstimatedShadows* estimate = nullptr);
  // The same with the shadows of area lights estimated by a few rays. Adds to the estimate.
  void add_shadowed_by_rays(SurfaceTile& tile, const std::vector<const PackLight*>& lights, std::size_t rays, int sample,
                            EstimatedShadows& estimate);
  // Finds the lights that are occluded from the tile. `taker` adds the light of all pairs that it takes; this adds that of the others.
  // Returns the lights that nothing occludes.
  std::vector<const PackLight*> hand_over_shadows(SurfaceTile& tile, const std::vector<const PackLight*>& lights, ShadowTaker& taker);
  // Adds the light of an area light at some points of the tile.
  void add_at(SurfaceTile& tile, const TilePoints& points, const PackLight& light);

  PassTime direct_time(int threads) const { return direct_clock_.time(threads); }
  PassTime specular_time(int threads) const { return specular_clock_.time(threads); }
  PassTime shadow_time(int threads) const { return shadow_clock_.time(threads); }
  // Fraction of pairs of a surface and a light whose shadows were estimated by rays.
  double shadow_fallback() const;
  // Fraction of pairs whose shadows were estimated within RenderOptions::shadow_error.
  double shadows_estimated() const;
  ShadowCounts shadow_counts() const;

 private:
  struct Work;
  struct WholeLight;
  void add_many(SurfaceTile& tile, const std::vector<const PackLight*>& lights, const std::vector<const PackLight*>& plain);
  std::vector<const PackLight*> add_past_blockers(SurfaceTile& tile, const std::vector<const PackLight*>& lights, Work& work,
                                                  ShadowTaker* taker = nullptr);
  bool many_seem_dim(const SurfaceTile& tile, const std::vector<const PackLight*>& lights) const;
  std::vector<const PackLight*> add_within_error(SurfaceTile& tile, const std::vector<const PackLight*>& lights, int sample, Work& work,
                                                 EstimatedShadows& estimate);
  template <class Add>
  void with_coats(SurfaceTile& tile, Work& work, Add add);
  void add_by_rays(SurfaceTile& tile, const std::vector<const PackLight*>& lights, std::size_t rays, int sample, Work& work,
                   EstimatedShadows& estimate);
  void add_by_chosen(SurfaceTile& tile, const TilePoints& points, const std::vector<const PackLight*>& lights, std::size_t count,
                     int sample, Work& work, EstimatedShadows& estimate);
  std::vector<std::uint32_t> find_whole(const SurfaceTile& tile, Work& work);
  void add_whole(SurfaceTile& tile, const PackLight& light, Work& work);
  void add_parts(SurfaceTile& tile, const PackLight& light, Work& work);
  void add_batch(SurfaceTile& tile, const PackLight& light, TileShadow::Batch& batch, Work& work);
  SurfaceTile& light_slots(const SurfaceTile& tile, const PackLight& light, Work& work);
  template <class Use>
  void light_pieces(const SurfaceTile& tile, packed::Pieces& pieces, Work& work, Use use);

  const RenderOptions& options_;
  const DirectMethod& method_;
  ManyLightPass* const many_lights_;
  const LobePacks& packs_;
  const SpecularPass specular_;
  const std::shared_ptr<const RayScene> rays_;
  std::optional<ShadowPass> shadows_;
  std::optional<FewRays> few_rays_;  // only where time is limited, for patches, and for dim lights
  std::optional<LightChoice> choice_;
  std::size_t area_lights_ = 0;
  std::function<bool()> is_late_;  // empty: never
  tbb::enumerable_thread_specific<std::shared_ptr<Work>> work_;
  PassClock direct_clock_{"direct"}, specular_clock_{"specular"}, shadow_clock_{"shadows"};
};

}  // namespace steradian
