// FitProblem: the residuals of a fit and their derivatives, summed to normal equations.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solve/fitted_lights.h"
#include "solve/receiving_tiles.h"
#include "solve/tile_model.h"

namespace steradian::solving {

// Half the sum of squares at one place, with its gradient J^T r and J^T J (row by row) where they were asked for.
struct Evaluation {
  double cost = 0;
  double pictures = 0;  // share of the cost that pictures have
  std::vector<double> gradient, hessian;
};

// The pixels that count: all, or a few of each picture, for the first steps. The cost is nearly the same.
enum class Detail { all, coarse };

class FitProblem {
 public:
  // All arguments must outlive this object. least_alpha: the least width of specular lobes. Throws Error with all problems.
  FitProblem(const Scene& scene, const FittedLights& lights, const std::vector<LightTarget>& targets, const SolveOptions& options,
             float least_alpha = 0);

  Evaluation evaluate(const std::vector<double>& x, Wants wants, Detail detail = Detail::all) const;
  // True if fewer pixels count by Detail::coarse.
  bool has_coarse() const { return has_coarse_; }

  std::size_t unknown_count() const { return lights_.unknowns().size(); }
  std::size_t residual_count() const { return residuals_; }
  std::size_t picture_residual_count() const { return picture_residuals_; }
  const FittedLights& lights() const { return lights_; }

  // Illuminances of the points of all LuxTargets, one after the other, and their derivatives: one row of unknown_count() a point.
  struct Lux {
    std::vector<double> value, slopes;
  };
  Lux illuminances(const std::vector<double>& x, Wants wants) const;
  // The values of all targets: the radiances of pictures' pixels that count, in three channels, and illuminances. `wanted` as LightModel.
  Lux values(const std::vector<double>& x, Wants wants) const;
  std::vector<double> wanted() const;
  // The points of target `i` in them: the first, and one past the last.
  std::pair<std::size_t, std::size_t> lux_range(std::size_t target) const {
    return {parts_[target].first_value, parts_[target].last_value};
  }
  // The factor on a start's powers that brings the mean of all targets to the wanted one, by coarse pictures.
  double brightness(const std::vector<double>& x) const;

 private:
  // The tiles and the values of one target.
  struct Part {
    std::size_t first_tile = 0, last_tile = 0;
    std::size_t first_coarse = 0, last_coarse = 0;  // tiles of a picture by Detail::coarse; none: all of its tiles
    double coarse_weight = 1;                       // of their pixels
    std::size_t first_value = 0, last_value = 0;    // of points
    double mean = 1;                                // of a picture's counted values
    std::vector<float> weights;                     // of a picture, by pixel
    std::vector<std::uint32_t> row;                 // of a picture: number of each pixel among those that count; kNoValue for others
    std::size_t counted = 0;                        // number of these pixels

    bool has(std::size_t tile) const { return (tile >= first_tile && tile < last_tile) || (tile >= first_coarse && tile < last_coarse); }
  };
  struct Sums;
  void add_picture(const PictureTarget& target, const std::string& name, Part& part, std::vector<std::string>& problems);
  void take_lux(std::size_t number, const TileVector& value, const TileLight& slopes, Lux& lux) const;
  void add_picture_tile(const PictureTarget& target, const Part& part, std::size_t number, const TileVector& value, const TileLight& slopes,
                        Sums& sums) const;
  void add_coarse(Part& part);
  const std::vector<std::size_t>& numbers(Detail detail) const { return detail == Detail::all ? all_ : coarse_; }
  void add_lux(const LuxTarget& target, const Part& part, const Lux& lux, Wants wants, Sums& sums) const;
  void add_keep(const std::vector<double>& x, Wants wants, Sums& sums) const;

  const FittedLights& lights_;
  const std::vector<LightTarget>& targets_;
  const float least_alpha_;
  std::vector<Part> parts_;  // by target
  std::unique_ptr<ReceivingTiles> tiles_;
  std::vector<std::size_t> all_, coarse_;  // numbers of the tiles
  bool has_coarse_ = false;
  std::optional<TileModel> model_;  // of tiles_, once they have all surfaces
  std::size_t residuals_ = 0, picture_residuals_ = 0, points_ = 0;
};

}  // namespace steradian::solving
