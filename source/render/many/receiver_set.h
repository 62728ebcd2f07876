// ReceiverSet: surface points whose diffuse light is summed together, of one tile or of many.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/tile/tile.h"
#include "steradian/vector.h"

namespace steradian::lights {

struct Receiver {
  Vec3f position, normal, albedo;
  float loss = 0;           // Fresnel loss at the boundary above
  std::uint32_t place = 0;  // identifies the point: a slot of a tile, or a pixel of a picture
};
using ReceiverSpan = std::span<Receiver>;

// Light that a receiver gets, and the bound of its error.
struct Received {
  Vec3f radiance, bound;
};

struct ReceiverSet {
  std::vector<Receiver> points;    // in arbitrary order
  std::vector<Received> received;  // result for each point

  // Adds the tile's points that reflect diffusely; place_of(slot) is their place.
  template <class PlaceOf>
  void add(const SurfaceTile& tile, PlaceOf place_of) {
    const auto get = [](const TileVector& v, std::size_t i) { return Vec3f{v.x[i], v.y[i], v.z[i]}; };
    for (std::uint32_t i = 0; i < kTilePixels; ++i) {
      const Vec3f albedo = get(tile.albedo, i);
      if (tile.material[i] != nullptr && albedo.x + albedo.y + albedo.z > 0)
        points.push_back({get(tile.position, i), get(tile.normal, i), albedo, tile.fresnel_loss[i], place_of(i)});
    }
  }
};

}  // namespace steradian::lights
