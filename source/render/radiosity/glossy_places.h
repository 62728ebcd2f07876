// GlossyPlaces: where the light of glossy sides arrives from, in arrays for packs.
#pragma once

#include <cstddef>
#include <vector>

#include "core/simd.h"
#include "steradian/vector.h"

namespace steradian::radiosity {

struct GlossyPlaces {
  static constexpr std::size_t kStep = 16;  // each lobe has a multiple of so many places; those added have no light

  std::vector<float> x, y, z;           // directions in the lobe's frame
  std::vector<float> red, green, blue;  // radiance times solid angle
  std::vector<float> alpha_x, alpha_y;  // of the lobe, widened
  // Light that the lobe sends, over that of the lobe widened for few rays: without Fresnel, and of Schlick's fifth power.
  std::vector<float> energy, grazing_energy;

  void add(Vec3f direction, Vec3f light, float width_x, float width_y, float over_wider, float grazing_over_wider) {
    x.push_back(direction.x), y.push_back(direction.y), z.push_back(direction.z);
    red.push_back(light.x), green.push_back(light.y), blue.push_back(light.z);
    alpha_x.push_back(width_x), alpha_y.push_back(width_y);
    energy.push_back(over_wider), grazing_energy.push_back(grazing_over_wider);
  }
  // Adds those of some places that have light once more.
  void repeat(std::size_t begin, std::size_t count) {
    for (std::size_t i = begin; i < begin + count; ++i)
      if (red[i] > 0 || green[i] > 0 || blue[i] > 0)
        add({x[i], y[i], z[i]}, {red[i], green[i], blue[i]}, alpha_x[i], alpha_y[i], energy[i], grazing_energy[i]);
  }
};

struct GlossyTable {
  // Light that places from `first` on send along a GGX lobe of reflectances 1 without Fresnel, and what of it is grazing: Schlick's fifth
  // power. view: unit, in the lobe's frame. wider: width to add. keeps_energy: `wider` is that for few rays, and the places' energies hold.
  struct Sent {
    Vec3f all, grazing;
  };
  Sent (*sent)(const GlossyPlaces& places, std::size_t first, std::size_t count, Vec3f view, float wider, bool keeps_energy);
};

}  // namespace steradian::radiosity

namespace steradian {

STERADIAN_DECLARE_PACK_TABLE(radiosity::GlossyTable, glossy_table)

}  // namespace steradian
