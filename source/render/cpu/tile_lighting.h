// TileLighting: the direct light of a tile's surfaces without sampling, past what blocks it: what every back end has on the CPU.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <memory>
#include <optional>
#include <vector>

#include "render/cpu/light_list.h"
#include "render/cpu/many_light_pass.h"
#include "render/cpu/methods.h"
#include "render/cpu/pass_clock.h"
#include "render/cpu/ray_scene.h"
#include "render/cpu/shadow_pass.h"
#include "render/cpu/specular.h"
#include "steradian/render.h"

namespace steradian {

struct DirectTable;

class TileLighting {
 public:
  // All must stay; lights: of prepare_lights. many_lights: null where each light is done by itself.
  TileLighting(const Scene& scene, const RenderOptions& options, const DirectMethod& method, const std::vector<PackLight>& lights,
               const SceneParts& parts, ManyLightPass* many_lights);

  bool has_shadows() const { return shadows_.has_value(); }

  // Adds the light of lights before which nothing stands to tile.radiance. Under many lights their bound() grows.
  void add(SurfaceTile& tile, const std::vector<const PackLight*>& lights);
  // ... of which many lights' diffuse light is done elsewhere: for a block of tiles.
  void add_beside_block(SurfaceTile& tile, const std::vector<const PackLight*>& lights) {
    add_many(tile, lights, many_lights_->others(lights));
  }
  // ... of lights before which something may stand.
  void add_shadowed(SurfaceTile& tile, const std::vector<const PackLight*>& lights);
  // ... of those of them before which something does stand, and returns the others. Coats with a normal of their own are done with for
  // good: they weigh nothing in the tile then. taker: where it is not null, they are its to add.
  std::vector<const PackLight*> add_hidden(SurfaceTile& tile, const std::vector<const PackLight*>& lights, ShadowTaker* taker = nullptr);
  // What some points see of an area light. It stays until the thread asks for more.
  const TileShadow& find_at(const TilePoints& points, const PackLight& light);

  PassTime direct_time(int threads) const { return direct_clock_.time(threads); }
  PassTime specular_time(int threads) const { return specular_clock_.time(threads); }
  PassTime shadow_time(int threads) const { return shadow_clock_.time(threads); }
  // Share of pairs of a surface and a light whose shadows rays have estimated.
  double shadow_fallback() const;
  ShadowCounts shadow_counts() const;

 private:
  struct Work;
  void add_many(SurfaceTile& tile, const std::vector<const PackLight*>& lights, const std::vector<const PackLight*>& plain);
  std::vector<const PackLight*> add_past_blockers(SurfaceTile& tile, const std::vector<const PackLight*>& lights, Work& work,
                                                  ShadowTaker* taker = nullptr);
  void add_whole(SurfaceTile& tile, const PackLight& light, Work& work);
  void add_parts(SurfaceTile& tile, const PackLight& light, Work& work);
  void add_batch(SurfaceTile& tile, const PackLight& light, TileShadow::Batch& batch, Work& work);
  SurfaceTile& light_slots(const SurfaceTile& tile, const PackLight& light, Work& work);
  template <class Use>
  void light_pieces(const SurfaceTile& tile, packed::Pieces& pieces, Work& work, Use use);

  const RenderOptions& options_;
  const DirectMethod& method_;
  ManyLightPass* const many_lights_;
  const DirectTable& direct_;
  const SpecularPass specular_;
  std::optional<ShadowPass> shadows_;
  tbb::enumerable_thread_specific<std::shared_ptr<Work>> work_;
  PassClock direct_clock_{"direct"}, specular_clock_{"specular"}, shadow_clock_{"shadows"};
};

}  // namespace steradian
