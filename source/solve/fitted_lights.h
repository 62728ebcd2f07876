// FittedLights: the unknowns of a fit, and the lights and materials that their values describe.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solve/fitted_materials.h"
#include "solve/unknown.h"
#include "steradian/solve.h"

namespace steradian::solving {

// One fitted light: its moved shape with the file's radiance, and the factor on it.
struct FittedLight {
  std::size_t number = 0;  // in the scene, as LightFit::light
  bool is_punctual = false;
  AreaLight area;
  PunctualLight punctual;
  Vec3d scale{1, 1, 1};
  LightChange change{};
};

// The channels of the radiance that a light has in the computation. A fit of colours gives each channel the luminance.
class FittedLights {
 public:
  // Throws Error with all problems.
  FittedLights(const Scene& scene, const std::vector<LightFit>& fits, const std::vector<LightTie>& ties,
               const std::vector<MaterialFit>& materials = {});

  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  std::vector<double> start() const;
  // True if all unknowns are powers and colours: the light is linear in their factors.
  bool is_linear() const { return linear_; }
  std::size_t light_count() const { return lights_.size(); }
  // The lights at some values, in the order of light_numbers.
  std::vector<FittedLight> at(const std::vector<double>& x) const;
  // True if vertices are where the outline of their light crosses itself.
  bool crosses_itself(const std::vector<double>& x) const;
  const FittedMaterials& materials() const { return materials_; }
  // True if an unknown moves or scales a light.
  bool drives(std::size_t unknown, std::size_t light) const;
  // True if light `number` of the scene is fitted.
  bool is_fitted(std::size_t number) const;
  const std::string& name_of(std::size_t light) const { return lights_[light].name; }

  // Value for a reader: metres, degrees, flux, radiance. `slope`: its derivative by the unknown, for error bars.
  double shown(std::size_t unknown, double x, double* slope = nullptr) const;

 private:
  struct Driven {
    std::string name;
    FittedLight start;
    std::size_t leader = 0;  // number in lights_; itself for a leader
    bool mirrored = false;
    Vec3d mirror_point{}, mirror_normal{};
    std::vector<std::size_t> unknowns;  // of a leader
    std::vector<std::size_t> corners;   // of a light that follows vertices: its vertex for each of the leader's
  };
  void add_unknowns(const LightFit& fit, std::size_t light, double room, std::vector<std::string>& problems);
  void move_vertices(const std::vector<std::pair<std::size_t, double>>& by, const Driven& leader, const Driven& driven,
                     FittedLight& light) const;
  void move(const Driven& leader, const std::vector<double>& x, FittedLight& light, const Driven& driven) const;

  std::vector<Driven> lights_;
  FittedMaterials materials_;
  std::vector<Unknown> unknowns_;
  bool linear_ = true;
};

}  // namespace steradian::solving
