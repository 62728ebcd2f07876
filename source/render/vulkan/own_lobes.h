// The lobes of extras.steradian that a scene's surfaces have, as shaders read them (shaders/own_lobe.glsl).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "render/cpu/methods.h"
#include "render/cpu/tile.h"
#include "render/vulkan/light_records.h"
#include "steradian/phong.h"
#include "steradian/scene.h"

namespace steradian::vulkan {

// The number of shaders/phong_methods.glsl. Throws Error for a method of other lobes.
int phong_method(const PhongOptions& options);

class OwnLobes {
 public:
  // A lobe by its method. form, phong, low: the constants LOBE_FORM, METHOD and LOW_EXPONENT of shaders/direct.glsl.
  struct Lobe {
    Material material;
    Method method;
    std::uint32_t first;  // where it stands
    int form = 0;
    int phong = 0;
    int low = 0;
    bool by_points;          // whether the CPU takes it point by point, with as many corners for round lights as `eval` has
    double least_distance2;  // as DirectLight's
  };

  // The details of lights hold them from vector `first` on. The scene must stay.
  OwnLobes(const Scene& scene, const DirectMethod& method, std::size_t first);

  // Whether the shaders have a lobe by its method, and all lobes of the surfaces of a tile.
  bool has(const Material& lobe) const;
  bool has_all(const SurfaceTile& tile) const;
  // Of a surface's material, counted from 1, whose lobes `of` are; 0: it has none.
  std::size_t number_of(const SurfaceMaterial* material) const;
  std::span<const Lobe> of(std::size_t number) const { return lobes_[number - 1]; }

  static std::size_t most_vectors(const Scene& scene);
  const std::vector<Vec4Floats>& values() const { return values_; }

 private:
  const Scene& scene_;
  const DirectMethod method_;
  std::vector<std::vector<Lobe>> lobes_;  // by material
  std::vector<Vec4Floats> values_;
};

}  // namespace steradian::vulkan
