// Gather: the light that surfaces of a picture receive from the patches, by rays of fixed directions.
//
// A diffuse lobe takes the mean over a grid of directions, weighted by the cosine. Each of 4 x 4 pixels shifts the grid by its own fraction
// of a cell, and a linear fit over the pixels of one surface joins their means: together they see sixteen times as many directions. Where
// the light of 8 x 8 pixels is a plane, a quarter of the directions serves each. In previews, one pixel of 2 x 2 gathers for all of a
// plane. A glossy lobe takes directions of its own. Narrow lobes would show single patches: mirrored rays serve them (mirrored_fraction)
// but in the last mirror of a row.
#pragma once

#include <array>
#include <vector>

#include "render/radiosity/block_fit.h"
#include "render/radiosity/fineness.h"
#include "render/radiosity/patch_light.h"
#include "render/surface/gbuffer.h"

namespace steradian::radiosity {

class Gather {
 public:
  static constexpr std::size_t kLanes = SixteenSurfaces::kLanes;

  struct Options {
    // Fraction of the scene's mean light. Pixels with a larger standard error take up to sixteen times as many directions; 0: all take as
    // many as the fineness says.
    double error = 0;
    bool strict = false;  // all take sixteen times as many, and no fit joins pixels
    int samples = 1;      // primary samples of a pixel, which shift the grid
  };
  // All must outlive this object, but for the options.
  Gather(const PatchLight& light, const RayScene& rays, const Fineness& fineness, const Options& options);

  struct Asked {
    bool mirrored_rays;  // they show the light of narrow lobes; else the patches do
    bool smooth;         // lobes that reflect much take more directions where their noise would show
  };
  // Radiance that each surface reflects to its view, and an estimate of its error.
  struct Result {
    std::array<Vec3f, kLanes> radiance{}, error{};
  };
  Result reflected(const SixteenSurfaces& surfaces, int sample, Asked asked) const;
  // The same for 8 x 8 pixels.
  std::array<Result, 4> reflected(const FourBlocks& blocks, int sample, Asked asked) const;

 private:
  // Sums by quarter of the rays. The differences between the quarters estimate the error of all.
  template <class T>
  using Quarters = std::array<std::array<T, 4>, kLanes>;
  // Sums over directions, by quarter, and what the size of the patches changes.
  struct Sums {
    Quarters<Vec3f> light{};
    Quarters<float> weight{};
    std::array<Vec3f, kLanes> basis{};
  };
  struct Cell {
    std::array<Vec3f, kLanes> direction;  // of each pixel
  };
  using Grid = std::vector<Cell>;  // over the sphere, quarter after quarter: those of every other row and column

  struct Lit;
  const Grid& grid(std::size_t level, int sample) const { return grids_[level][static_cast<std::size_t>(sample % samples_)]; }
  bool is_within(const Lit& lit) const;
  void add_bright(const SixteenSurfaces& surfaces, std::uint32_t asked, int sample, std::size_t level, Quarters<Vec3f>& light) const;
  std::array<FittedValue, kLanes> bright(const SixteenSurfaces& surfaces, std::uint32_t asked, int sample, std::size_t level) const;
  Sums quarter_sums(const SixteenSurfaces& surfaces, std::uint32_t asked, const Grid& cells,
                    const std::array<std::size_t, kLanes>& quarters) const;
  std::array<FittedValue, kLanes> arriving(const SixteenSurfaces& surfaces, std::uint32_t asked, int sample, std::size_t level,
                                           std::size_t block, const Sums* first) const;
  Lit diffuse(const SixteenSurfaces& surfaces, std::uint32_t asked, int sample, std::size_t level, std::size_t block,
              const Sums* first) const;
  void diffuse_of_every_other(const FourBlocks& blocks, int sample, std::array<Lit, 4>& lit) const;
  bool diffuse_of_square(const FourBlocks& blocks, int sample, std::array<Sums, 4>& first, std::array<Lit, 4>& lit) const;
  Lit glossy(const SixteenSurfaces& surfaces, const std::array<const SurfaceLobe*, kLanes>& lobes, int sample, bool mirrored_rays,
             std::size_t level) const;
  void add_diffuse(const SixteenSurfaces& surfaces, int sample, std::size_t block, const Sums* first, Result& sum) const;
  void add_glossy(const SixteenSurfaces& surfaces, int sample, Asked asked, Result& sum) const;
  static void add(const Result& result, Result& sum);
  void add_grids(int rows);

  static constexpr std::size_t kFinest = 2;  // level; each has four times the directions of the one before
  const PatchLight& light_;
  const RayScene& rays_;
  const bool strict_;
  const int samples_;
  const std::size_t lobe_rays_;
  const bool every_other_;
  float near_ = 0;  // distance within which rays meet bright sides more often than places stand for them
  const float tolerance_;
  std::vector<std::vector<Grid>> grids_;  // by level and primary sample
};

}  // namespace steradian::radiosity
