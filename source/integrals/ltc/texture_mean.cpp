#include "integrals/ltc/texture_mean.h"

#include <algorithm>
#include <vector>

namespace steradian {

std::optional<Vec3f> mean_under(const TextureTree& tree, const TextureView<double>& view, const PlaneTexels& texels) {
  if (!any_lane(cells_resolve(view, tree.finest(), tree.bounds()))) return std::nullopt;
  const PreparedTextureView<double> prepared(view);
  struct Open {
    TextureCell cell;
    Vec3d radiance;
    double weight, error;
    bool operator<(const Open& other) const { return error < other.error; }
  };
  std::vector<Open> open;
  open.reserve(128);
  Vec3d expected = tree.cells().front().mean;
  const auto look = [&](const TextureCell& cell) {
    const auto s = seen_cell(cell, prepared, {expected.x, expected.y, expected.z});
    open.push_back({cell, {s.radiance.x.v, s.radiance.y.v, s.radiance.z.v}, s.weight.v, s.error.v});
  };
  look(tree.cells().front());
  double weight = open[0].weight, error = open[0].error;
  Vec3d radiance = open[0].radiance;
  for (int i = 0; i < TextureTree::kMostSplits && error > TextureTree::kTolerance * luminance_of(radiance); ++i) {
    std::pop_heap(open.begin(), open.end());
    const Open worst = open.back();
    if (worst.cell.depth == TextureTree::kDeepest) return std::nullopt;
    open.pop_back();
    weight -= worst.weight;
    radiance = radiance - worst.radiance;
    error -= worst.error;
    for (int c = 0; c < 2; ++c) {
      look(tree.half(worst.cell, c, texels));
      weight += open.back().weight;
      radiance += open.back().radiance;
      error += open.back().error;
      std::push_heap(open.begin(), open.end());
    }
    if (weight > 0) expected = radiance / weight;
  }
  // Afresh: differences have left their rounding in the sums.
  weight = 0;
  radiance = {};
  for (const Open& part : open) {
    weight += part.weight;
    radiance += part.radiance;
  }
  if (!(weight > 0)) return std::nullopt;
  return static_cast<Vec3f>(radiance / weight);
}

}  // namespace steradian
