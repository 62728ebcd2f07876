// FilteredTexture: a textured light's radiance over its plane in increasingly blurred copies, for a lobe's look-up.
#pragma once

#include <array>
#include <vector>

#include "integrals/textured/texture_tree.h"
#include "steradian/area_light.h"

namespace steradian {

// A Gaussian on a plane: standard deviations `major` (a vector) and, across it, `minor`.
struct PlaneGaussian {
  double x = 0, y = 0;
  double major_x = 0, major_y = 0, minor = 0;
};

// Level k is blurred with a Gaussian of standard deviation sigma_0 2^k. Beyond the border, the nearby light is extended. A texel contains
// radiance times coverage, and coverage (1 on the light, 0 off it), blurred alike; a look-up divides the one by the other. So nothing dark
// bleeds in from outside, and nothing wraps around.
class FilteredTexture {
 public:
  // The light must have a texture; `polygon` is its prepared outline.
  FilteredTexture(const AreaLight& light, const PreparedPolygon& polygon, const std::vector<Image>& images);

  // Coordinates of look-ups on the light's plane [m].
  Vec3d origin() const { return origin_; }
  Vec3d axis_x() const { return x_; }  // unit
  Vec3d axis_y() const { return y_; }

  // Radiance times coverage, and coverage, under a Gaussian. Sums of these over Gaussians may be divided.
  struct Sum {
    std::array<float, 4> rgbw{};
    Sum& add(const Sum& other, float weight) {
      for (std::size_t c = 0; c < 4; ++c) rgbw[c] += other.rgbw[c] * weight;
      return *this;
    }
  };
  Sum under(const PlaneGaussian& gaussian) const;

  // The quotient, or the light's mean if a look-up met next to none of the light.
  Vec3f radiance(const Sum& sum) const;

  Vec3f mean() const { return mean_; }

  std::size_t level_count() const { return levels_.size(); }
  double sigma(std::size_t level) const { return levels_[level].sigma; }
  PlaneTexels level(std::size_t level) const {
    const Level& l = levels_[level];
    return {l.left, l.bottom, l.spacing, l.width, l.height, l.texels};
  }
  PlaneTexels finest() const { return level(0); }

  // Moments of the light's shape: centroid, and covariance about it (xx, xy, yy).
  const std::array<double, 2>& centroid() const { return centroid_; }
  const std::array<double, 3>& covariance() const { return covariance_; }

 private:
  struct Level {
    double left, bottom, spacing, sigma;  // of the first texel's centre
    int width, height;
    std::vector<std::array<float, 4>> texels;
    Sum at(double x, double y) const;  // bilinear
  };
  void measure_light();
  static Level blurred(const Level& fine, const Level& last);
  Level rastered(const AreaLight& light, const PreparedPolygon& polygon, const std::vector<Image>& images) const;
  Sum at(double x, double y, double sigma) const;

  Vec3d origin_, x_, y_;
  Vec3f mean_{};
  std::array<double, 2> centroid_{};
  std::array<double, 3> covariance_{};
  std::vector<Level> levels_;
};

}  // namespace steradian
