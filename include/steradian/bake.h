// bake: light maps of scenes, as `steradian bake` makes them. docs/bake.md describes the files.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "steradian/bounces.h"
#include "steradian/limits.h"
#include "steradian/method.h"

namespace steradian {

struct LightMapOptions {
  double texels = 16;                 // a metre
  int bounces = kAllBounces;          // of the light between surfaces
  Quality quality = Quality::normal;  // of that light
  std::vector<std::string> groups{};  // beginnings of names of lights: a map for each, and one for all other lights
  int threads = 0;                    // 0: all
  Limits limits{};                    // of the scene's file, the map and its fit
};

struct LightMapFacts {
  int width = 0, height = 0;  // texels
  std::size_t charts = 0, samples = 0;
  double mean = 0;                    // of the irradiance's luminance over the surfaces
  double rms_residual = 0;            // of the texels' light over that mean
  std::vector<std::string> warnings;  // whole sentences
};

// Bakes the light of a scene's file (.gltf, .glb). Writes the scene with its light map to `output` (.gltf, .glb), and the map as .exr of
// that name beside it. Throws Error for a scene without light, for meshes whose charts are broken, and for maps beyond the limits. Each
// file is complete or as it was.
LightMapFacts bake_light_map(const std::string& scene, const std::string& output, const LightMapOptions& options = {});

}  // namespace steradian
