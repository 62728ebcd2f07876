// The question of `steradian solve`: free parameters and targets, from options and from a JSON file.
#pragma once

#include <string>
#include <vector>

#include "eval/json_object.h"
#include "steradian/limits.h"
#include "steradian/load_scene.h"
#include "steradian/solve.h"

namespace steradian::app {

struct SolveJob {
  std::vector<LightFit> fits;
  std::vector<LightTie> ties;
  std::vector<MaterialFit> materials;
  std::vector<LightTarget> targets;
  bool least_power = false;
};

// Settings of pictures that their target does not give itself.
struct PictureDefaults {
  std::string camera;
  ResidualSpace space = ResidualSpace::root;
  ResidualLoss loss = ResidualLoss::squares;
  int width = 0, height = 0;  // pictures are resampled to this size; 0: they stay as they are
};

class SolveJobReader {
 public:
  // The scene must outlive this object.
  SolveJobReader(const Scene& scene, const PictureDefaults& defaults, const Limits& limits)
      : scene_(scene), defaults_(defaults), limits_(limits) {}

  // "lamp*:position,power", or "material:floor:albedo,roughness"
  void add_fit(const std::string& text);
  void add_target(const std::string& picture, const std::string& mask);
  // The keys are in docs/solve-questions.md. Paths are relative to the file.
  void add_file(const std::string& path);
  // The same for the bytes of such a file. place: for messages; folder: of relative paths, empty or ending in a slash.
  void add_text(std::string_view text, const std::string& place, const std::string& folder);

  // Throws Error with all problems of everything that was added.
  SolveJob finish();

 private:
  struct TargetKeys;
  using Place = eval::Place;
  using Json = eval::Json;
  // The name of a light in the question: lights of one name are numbered from 1 on, as in "panel 3".
  std::string name_of_light(std::size_t number) const;
  std::vector<std::size_t> lights_named(const std::string& glob, const Place& place);
  void add_fits(const std::string& glob, const LightFit& like, const Place& place);
  void add_materials(const std::string& glob, const MaterialFit& like, const Place& place);
  void read_fit(const Place& place, Json value);
  void read_material_fit(const Place& place, Json value);
  void read_tie(const Place& place, Json value);
  void read_target(const Place& place, Json value, const std::string& folder);
  void add_picture(const Place& place, const std::string& path, const std::string& mask, PictureTarget target);
  void add_strokes(const Place& place, const std::string& path, Vec3d radiance, double around, PictureTarget target);
  void check_camera(const Place& place, const std::string& name);
  void add_mesh_points(const Place& place, const std::string& glob, double grid, LuxTarget& target);

  const Scene& scene_;
  const PictureDefaults defaults_;
  const Limits limits_;
  SolveJob job_;
  std::vector<int> emissive_;  // materials whose lights are fitted
  eval::Problems problems_;
};

}  // namespace steradian::app
