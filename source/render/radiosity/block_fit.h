// Linear fits over the pixels of one plane: together they see as many directions as all of them, and their values lose their noise.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/surface/gbuffer.h"

namespace steradian::radiosity {

// A mean over directions, and its standard error as the directions themselves tell it.
struct Gathered {
  Vec3f value, error;
};

// The mean of sums over four quarters of the directions. Its standard error is that of the quarters' means. weight: of each quarter.
Gathered mean_of_quarters(const std::array<Vec3f, 4>& light, const std::array<float, 4>& weight);
// Standard deviation of radiances about their mean, times the weight of all. squares, light: sums of the radiances by weight.
Vec3f spread(Vec3f squares, Vec3f light, Vec3f weight);

// The least squares of a plane through the values of pixels.
class LinearFit {
 public:
  struct Point {
    float x, y;  // of the pixel
    Gathered mean;
  };
  explicit LinearFit(std::span<const Point> points);
  Vec3f at(float x, float y) const { return mean_ + slope_x_ * (x - middle_x_) + slope_y_ * (y - middle_y_); }
  Vec3f squares() const { return squares_; }  // sum of those of the distances from the fit
  Vec3f variance() const;                     // of a value about the fit
  Vec3f of_rays() const { return of_rays_; }  // mean variance that the directions tell
  // Standard error of the fit's values where it has three parameters and the values about it have a variance of so much.
  Vec3f standard_error(Vec3f variance) const;
  // Sets slopes to zero that the variance of the values explains: they would show as steps from block to block.
  void shrink_slopes();

  static constexpr float kDoubt = 4;  // variances below which a difference counts as chance

 private:
  float count_, middle_x_ = 0, middle_y_ = 0, xx_ = 0, yy_ = 0;
  Vec3f mean_{}, slope_x_{}, slope_y_{}, squares_{}, of_rays_{};
};

// A value of a fit: 2 standard errors and what is known of its distance from the truth, and one standard error alone.
struct FittedValue {
  Vec3f value, error, standard;
};

// Joins the values of sixteen pixels, 4 x 4, by fits over those of one plane.
class BlockFit {
 public:
  static constexpr std::size_t kLanes = SixteenSurfaces::kLanes;
  static constexpr float kFlat = 0.2f;  // angle between the normals of pixels in one plane
  // alone: every pixel keeps its own value. turn: most angle between the normals of pixels that one fit joins.
  BlockFit(const SixteenSurfaces& surfaces, std::uint32_t asked, bool alone, float turn = kFlat);

  // own_values: the pixel's own value takes the place of the fit's where the values differ by more than their errors.
  enum class Keeps { nothing, own_values };
  FittedValue at(std::size_t lane, const std::array<Gathered, kLanes>& means, Keeps keeps) const;

 private:
  const SixteenSurfaces& surfaces_;
  const std::uint32_t asked_;
  const bool alone_;
  const float same_direction_;  // least cosine between normals
};

// Four blocks of 4 x 4 pixels that make 8 x 8.
using FourBlocks = std::array<SixteenSurfaces, 4>;

// True if all pixels of four blocks lie in one plane; all have a surface.
bool in_one_plane(const FourBlocks& blocks);

// Joins the values of 8 x 8 pixels in one plane by one fit. False where their light is no plane: one fit for each block fits better than
// chance, or pixels differ by more than their errors.
bool fit_square(const std::array<std::array<Gathered, BlockFit::kLanes>, 4>& means,
                std::array<std::array<FittedValue, BlockFit::kLanes>, 4>& fitted);

// The value at a pixel of 8 x 8, from those of the pixels with even coordinates, row by row: linear between them, and the last one beyond
// it.
FittedValue between_even_pixels(const std::array<FittedValue, BlockFit::kLanes>& even, std::size_t x, std::size_t y);

}  // namespace steradian::radiosity
