// TileModel: the light on the tiles of a fit as a function of its unknowns, with derivatives.
#pragma once

#include <functional>
#include <vector>

#include "solve/fitted_lights.h"
#include "solve/receiving_tiles.h"

namespace steradian::solving {

enum class Wants { cost, derivatives };

class TileModel {
 public:
  // Both must outlive this object. The tiles have all their surfaces and their fixed light. all: the numbers of all tiles.
  TileModel(const FittedLights& lights, const ReceivingTiles& tiles, const std::vector<std::size_t>& all);

  // Calls use(number of the tile, light, its derivative by each unknown) for some tiles, on all threads, in any order. The derivatives are
  // those of the boundary for polygons without shadows, else central differences.
  void each(const std::vector<double>& x, Wants wants, const std::vector<std::size_t>& numbers,
            const std::function<void(std::size_t, const TileVector&, const TileLight&)>& use) const;

 private:
  // By unknown, of materials alone, and by tile.
  std::vector<TileLight> slopes_by_materials(const std::vector<double>& x, const std::vector<FittedLight>& lights,
                                             const std::vector<std::size_t>& numbers) const;

  const FittedLights& lights_;
  const ReceivingTiles& tiles_;
  std::vector<TileLight> columns_;  // of a linear problem: the light of each lamp at its start, by tile
};

}  // namespace steradian::solving
