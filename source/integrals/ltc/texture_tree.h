// TextureTree: a textured light as cells that are split until a lobe is smooth over each: the mean of the texture as the lobe weighs it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "steradian/kernels.h"
#include "steradian/vector.h"

namespace steradian {

// Radiance times coverage, and coverage, in square texels of a plane; rows from the bottom. The centre of the first is (left, bottom).
struct PlaneTexels {
  double left, bottom, spacing;
  int width, height;
  const std::vector<std::array<float, 4>>& texels;
};

class TextureTree {
 public:
  explicit TextureTree(const PlaneTexels& texels);

  // A lobe over the plane from a point, in the shading frame.
  //   matrix          M^-1 of the linearly transformed cosine that tells how wide it is, and that it is where there is no other
  //   ggx             else the GGX lobe
  //   origin, x, y    of the plane's coordinates, from the point
  struct View {
    Kernels<double>::LtcMatrix matrix;
    std::optional<Kernels<double>::GgxView> ggx;
    Kernels<double>::vec3 origin, x, y;
  };

  // The mean radiance. Nothing where the lobe is too narrow for the cells: what it sees is then a part of the texture that is
  // larger than its texels, and a look-up serves.
  //
  // A cell's radiance is its own mean and first moments, against the lobe's values at its four elements; what both leave out, as
  // the lobe's smoothness and the texture's deviation bound it, is summed, and the worst cell split, until the sum is small.
  //   texels  those of the constructor: below the smallest cells, the texture is what lies between them
  std::optional<Vec3f> mean_under(const View& view, const PlaneTexels& texels) const;

 private:
  // Of the covered part: area, mean radiance, its deviation; centroid and the two axes on which the elements lie; how far each
  // channel's centroid is from there in units of the axes; the farthest that a part of the cell may lie.
  struct Cell {
    double area = 0, deviation = 0, radius = 0;
    Vec3d mean{};
    std::array<double, 2> center{}, axis_a{}, axis_b{};
    Vec3d along_a{}, along_b{};
    int children = 0;  // the first of two; 0: none
    int depth = 0;     // below the smallest cells
  };
  struct Seen;
  struct Prepared;
  static Seen seen(const Cell& cell, const Prepared& view, Vec3d expected);
  static Cell half_of(const Cell& cell, double side, const PlaneTexels& texels);
  bool resolves(const View& view) const;

  std::vector<Cell> cells_;
  double finest_ = 0;               // deviation of the smallest cells
  std::array<double, 4> bounds_{};  // left, right, bottom, top
};

}  // namespace steradian
