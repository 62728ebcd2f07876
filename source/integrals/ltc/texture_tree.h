// TextureTree: a textured light as cells that are split until a lobe is smooth over each: the mean of the texture as the lobe weighs it.
#pragma once

#include <array>
#include <vector>

#include "steradian/vector.h"

namespace steradian {

#include "integrals/ltc/texture_rule.glsl"

// Radiance times coverage, and coverage, in square texels of a plane; rows from the bottom. The centre of the first is (left, bottom).
struct PlaneTexels {
  double left, bottom, spacing;
  int width, height;
  const std::vector<std::array<float, 4>>& texels;
};

// Of the covered part of a piece of the light's plane: area, mean radiance, its deviation (of the channels, rms); centroid and the two axes
// on which the elements lie; how far each channel's centroid is from there in units of the axes; the farthest that a part of the cell may
// lie.
struct TextureCell {
  double area = 0, deviation = 0, radius = 0;
  Vec3d mean{};
  std::array<double, 2> center{}, axis_a{}, axis_b{};
  Vec3d along_a{}, along_b{};
  int children = 0;  // the first of two; 0: none
  int depth = 0;     // below the smallest cells
};

class TextureTree {
 public:
  explicit TextureTree(const PlaneTexels& texels);

  // The first is the whole light.
  const std::vector<TextureCell>& cells() const { return cells_; }
  // One of the two halves (0 and 1) of a smallest cell, or of what lies below it.
  TextureCell half(const TextureCell& cell, int which, const TextureCell& smallest, const PlaneTexels& texels) const;

  double finest() const { return finest_; }                        // deviation of the smallest cells
  const std::array<double, 4>& bounds() const { return bounds_; }  // left, right, bottom, top

 private:
  std::vector<TextureCell> cells_;
  double finest_ = 0;
  std::array<double, 4> bounds_{};
};

}  // namespace steradian
