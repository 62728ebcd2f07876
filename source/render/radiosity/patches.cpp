#include "render/radiosity/patches.h"

#include <algorithm>
#include <cmath>

#include "render/surface/surface.h"

namespace steradian::radiosity {
namespace {

constexpr std::uint32_t kMostCells = 64;  // along a side of a triangle

float longest_edge(const Mesh& mesh, std::size_t triangle) {
  const auto corner = [&](std::size_t i) { return mesh.positions[mesh.indices[3 * triangle + i]]; };
  return std::max({length(corner(1) - corner(0)), length(corner(2) - corner(1)), length(corner(0) - corner(2))});
}

std::uint32_t cells_for(float edge, double size) {
  const double cells = std::ceil(static_cast<double>(edge) / size);
  return cells > 1 ? static_cast<std::uint32_t>(std::min(cells, double{kMostCells})) : 1;  // not a number: 1
}

// Number of patches before those whose first coordinate lies in cell `row` of a triangle's grid.
std::uint32_t patches_before(std::uint32_t row, std::uint32_t cells) { return row * (2 * cells - row); }

}  // namespace

Patches::Patches(const Scene& scene, std::size_t wanted) {
  for (const Mesh& mesh : scene.meshes) lets_through_.push_back(light_passes(scene, mesh));
  std::vector<float> edges;
  for (const Mesh& mesh : scene.meshes)
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) edges.push_back(longest_edge(mesh, t));
  const float longest = edges.empty() ? 0 : *std::max_element(edges.begin(), edges.end());
  // However many small triangles there are, half of the patches are for cutting the large ones.
  wanted = std::max(wanted, edges.size() + wanted / 2);
  // The largest size of cells that gives as many as wanted.
  double size = static_cast<double>(longest);
  const auto count = [&](double s) {
    std::size_t n = 0;
    for (const float e : edges) n += std::size_t{cells_for(e, s)} * cells_for(e, s);
    return n;
  };
  while (size > 0 && size * 1.1 * kMostCells > static_cast<double>(longest) && count(size / 1.1) <= wanted) size /= 1.1;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    std::vector<Grid>& grids = grids_.emplace_back();
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      const std::uint32_t n = cells_for(longest_edge(mesh, t), size);
      grids.push_back({static_cast<std::uint32_t>(sites_.size()), n});
      const float step = 1.0f / static_cast<float>(n);
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t k = 0; k < 2 * (n - i) - 1; ++k) {
          const float third = k % 2 == 0 ? 1.0f / 3 : 2.0f / 3;
          sites_.push_back({m, t, (static_cast<float>(i) + third) * step, (static_cast<float>(k / 2) + third) * step, step});
        }
    }
  }
}

Patches::Site Patches::place_in(std::uint32_t side, std::size_t part) const {
  constexpr std::uint32_t kParts = 4;  // along a side
  std::uint32_t row = 0;
  while (row + 1 < kParts && part >= patches_before(row + 1, kParts)) ++row;
  const auto k = static_cast<std::uint32_t>(part) - patches_before(row, kParts);
  const float third = k % 2 == 0 ? 1.0f / 3 : 2.0f / 3;
  const float x = (static_cast<float>(row) + third) / kParts - 1.0f / 3, y = (static_cast<float>(k / 2) + third) / kParts - 1.0f / 3;
  Site at = site(side);
  // Every other patch of a grid is turned by half a turn.
  const float cell = at.u / at.step;
  const float scale = cell - std::floor(cell) > 0.5f ? -at.step : at.step;
  at.u += x * scale;
  at.v += y * scale;
  at.step /= kParts;
  return at;
}

std::uint32_t Patches::side_at(std::size_t mesh, std::size_t triangle, float u, float v, bool front) const {
  const Grid grid = grids_[mesh][triangle];
  const std::uint32_t n = grid.cells;
  const auto cell = [&](float x, std::uint32_t most) { return x > 0 ? std::min(static_cast<std::uint32_t>(x), most) : 0u; };
  const float x = u * static_cast<float>(n), y = v * static_cast<float>(n);
  const std::uint32_t i = cell(x, n - 1), j = cell(y, n - 1 - i);
  const bool upper = x - static_cast<float>(i) + y - static_cast<float>(j) > 1 && i + j + 1 < n;
  const std::uint32_t patch = grid.first + patches_before(i, n) + 2 * j + (upper ? 1 : 0);
  return 2 * patch + (front ? 0 : 1);
}

}  // namespace steradian::radiosity
