// TextureTree: a textured light as cells that are split until a lobe is smooth over each, for the mean of the texture under the lobe.
#pragma once

#include <array>
#include <vector>

#include "steradian/vector.h"

namespace steradian {

#include "integrals/textured/texture_rule.glsl"

// Radiance times coverage, and coverage, in square texels of a plane; rows run from the bottom. The centre of the first texel is (left,
// bottom).
struct PlaneTexels {
  double left, bottom, spacing;
  int width, height;
  const std::vector<std::array<float, 4>>& texels;
};

// Covered part of a piece of the light's plane: area, mean radiance, and its deviation (of the channels, rms). Then its centroid, the two
// axes on which the elements lie, and the offset of each channel's centroid in units of the axes. The radius is the largest distance of a
// part of the cell from the centroid.
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

  // Cells of the tree; the first is the whole light.
  const std::vector<TextureCell>& cells() const { return cells_; }
  // One of the two halves (0 and 1) of a smallest cell, or of a cell below it.
  TextureCell half(const TextureCell& cell, int which, const TextureCell& smallest, const PlaneTexels& texels) const;

  double finest() const { return finest_; }                        // deviation of the smallest cells
  const std::array<double, 4>& bounds() const { return bounds_; }  // left, right, bottom, top

 private:
  std::vector<TextureCell> cells_;
  double finest_ = 0;
  std::array<double, 4> bounds_{};
};

}  // namespace steradian
