// The indirect light of a picture, pass by pass.
#pragma once

#include <optional>

#include "render/bounce/passes.h"
#include "render/bounce/receivers/receivers.h"
#include "render/direct/ltc_tables.h"
#include "render/surface/gbuffer.h"
#include "steradian/render.h"

namespace steradian::indirect {

class Pipeline {
 public:
  // Keeps references to all arguments but the options. device: runs some of the passes; null: packs run all.
  Pipeline(const Scene& scene, const RayScene& rays, const RenderOptions& options, int threads, Passes* device = nullptr);

  // Takes the surfaces of a tile of the picture. Any thread may call it, once per tile.
  void take(const SurfaceTile& tile, TileArea area);

  // Adds the indirect light of all tiles taken, and stores it as the layer "indirect".
  void add_to(Picture& picture);

  const std::vector<PassTime>& passes() const { return passes_; }

 private:
  void add_sum(Picture& picture);
  void add_true(Picture& picture);
  void add_radiance(const VectorArray& radiance, int y, Picture& picture) const;
  template <class Work>
  auto timed(const char* name, Work work);

  const Scene& scene_;
  const RayScene& rays_;
  const RenderOptions options_;
  const int threads_;
  Passes* device_;
  const LtcPackTables tables_;
  PictureSurfaces surfaces_;
  std::vector<Surface> whole_;  // for ground truth only: with coat, sheen and material; empty at places that take no light
  std::vector<PassTime> passes_;
};

}  // namespace steradian::indirect
