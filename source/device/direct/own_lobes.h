// Custom lobes (extras.steradian) of a scene's surfaces, in the layout of shaders (shaders/lobes/own_lobe.glsl).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "device/direct/light_records.h"
#include "render/frame/methods.h"
#include "render/tile/tile.h"
#include "steradian/phong.h"
#include "steradian/scene.h"

namespace steradian::vulkan {

// Number of a method in shaders/lobes/phong_methods.glsl. Throws Error for a method of other lobes.
int phong_method(const PhongOptions& options);

class OwnLobes {
 public:
  // A lobe with its method. form, phong, low: the constants LOBE_FORM, METHOD and LOW_EXPONENT of shaders/direct.glsl.
  struct Lobe {
    methods::Procedure procedure;
    std::uint32_t first;  // its first vector
    int form = 0;
    int phong = 0;
    int low = 0;
    bool by_points;          // true: the CPU evaluates it point by point, with as many corners for round lights as `eval`
    double least_distance2;  // of Phong lobes: as in DirectLight
  };

  // The details of lights contain the lobes from vector `first` on. The scene must outlive this object.
  OwnLobes(const Scene& scene, const DirectMethod& method, std::size_t first);

  // Returns true if the shaders have a lobe by its method.
  bool has(const Material& lobe) const;
  // Number of a surface's material, counted from 1, for use in `of`; 0: it has no such lobes.
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
