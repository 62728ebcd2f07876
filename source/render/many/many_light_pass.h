// The diffuse light of many lights on the tiles of a picture, tile by tile or over blocks of them. docs/manylights.md.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <memory>
#include <vector>

#include "render/lights/light_list.h"
#include "render/many/many_lights.h"
#include "render/surface/gbuffer.h"
#include "steradian/render.h"

namespace steradian {

class ManyLightPass {
 public:
  // Arguments as for lights::ManyLights.
  ManyLightPass(const std::vector<PackLight>& lights, Vec3f eye, float error);

  bool serves_all() const { return serves_all_; }
  const lights::FarLights& lights() const { return sum_.lights(); }
  float error() const { return sum_.error(); }

  // Bound of the error of this thread's tile, in radiance.
  TileVector& bound() { return workspace().bound; }

  // Adds the diffuse light of the lights that it serves to a tile, and their error to bound(). Returns the other lights.
  std::vector<const PackLight*> add_to_tile(SurfaceTile& tile, const std::vector<const PackLight*>& lights);
  std::vector<const PackLight*> others(const std::vector<const PackLight*>& lights) const;

  // Blocks: points of this thread from many tiles, lit together by all lights that it serves.
  void clear_block() { workspace().block.points.clear(); }
  void take(const SurfaceTile& tile, TileArea area, int width);
  // Adds `weight` times the block's light to the picture, and `weight` times its bound to the layer light_bound.
  void add_block(float weight, Picture& picture);

  void report(RenderStats& stats) const;

 private:
  struct Workspace {
    lights::ManyLights::WorkPointer sum = lights::ManyLights::make_work();
    lights::ReceiverSet block;
    TileVector bound;
  };
  Workspace& workspace() { return *workspaces_.local(); }

  const lights::ManyLights sum_;
  const bool serves_all_;
  tbb::enumerable_thread_specific<std::unique_ptr<Workspace>> workspaces_{[] { return std::make_unique<Workspace>(); }};
};

}  // namespace steradian
