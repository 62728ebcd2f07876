// TimedPicture: a picture whose tiles get better until its time is over (docs/time-limit.md).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "render/surface/gbuffer.h"
#include "steradian/picture.h"

namespace steradian {

// Finder of the shadows of a tile.
enum class ShadowsBy { edges, rays, nothing };
struct ShadowWork {
  ShadowsBy by = ShadowsBy::edges;
  std::size_t rays = 0;  // of a pixel to a light
};

class TimedPicture {
 public:
  // The renderer's part. All functions may be called from any thread.
  struct Tiles {
    int count = 0;
    std::function<TileArea(int index)> area;
    // Adds a tile to a picture. Returns the sum of the squares of the estimated errors over its pixels.
    std::function<double(int index, ShadowWork work, Picture& to)> render;
    std::function<double()> seconds;  // since the picture was begun
    std::function<bool()> stopped;
    std::function<void()> advance;  // called once for the first rays of a tile, and once for its exact shadows
  };

  // The picture has its size and layers. It must outlive this object.
  TimedPicture(Picture& picture, double limit, Tiles tiles);

  // Renders all tiles with shadows by 4 rays, then by 16 and 64 if they fit into a part of the time. Then makes tiles exact, those with the
  // largest estimated error first, until the time is over. Tiles for which not even rays have time show the light without shadows.
  void render(int threads);

  double exact_tiles() const;      // fraction
  double estimated_error() const;  // rms over the picture's mean light

 private:
  void improve(const std::vector<int>& order, ShadowWork work, double until, int threads);

  Picture& picture_;
  const double limit_;
  const Tiles tiles_;
  Picture scratch_;             // where a tile is rendered before it replaces that of the picture
  std::vector<double> errors_;  // by tile: sum of the squares of the estimated errors
  std::vector<std::uint8_t> exact_;
};

}  // namespace steradian
