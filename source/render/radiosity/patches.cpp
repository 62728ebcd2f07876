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

Patches::Patches(const Scene& scene, std::size_t wanted) : clear_(scene) {
  for (const Mesh& mesh : scene.meshes) lets_through_.push_back(light_passes(scene, mesh));
  std::vector<float> edges;
  for (const Mesh& mesh : scene.meshes)
    for (std::size_t t = 0; t < mesh.triangle_count() && !mesh.is_light_shape; ++t) edges.push_back(longest_edge(mesh, t));
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
  size_ = static_cast<float>(size);
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    first_grid_.push_back(grids_.size());
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      const std::uint32_t n = mesh.is_light_shape ? 0 : cells_for(longest_edge(mesh, t), size);
      grids_.push_back({static_cast<std::uint32_t>(sites_.size()), n});
      const float step = 1.0f / static_cast<float>(n);
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t k = 0; k < 2 * (n - i) - 1; ++k) {
          const float third = k % 2 == 0 ? 1.0f / 3 : 2.0f / 3;
          sites_.push_back({m, t, (static_cast<float>(i) + third) * step, (static_cast<float>(k / 2) + third) * step, step});
        }
    }
  }
  grid_patches_ = sites_.size();
}

namespace {

constexpr std::uint32_t kPartsAlong = 4;  // a side of a patch

// A cell of a triangle that is cut `n` times along each side: row, column, and the half of the square at its corner. The upper half is
// turned by half a turn, and so are the coordinates within it.
struct TriangleCell {
  std::uint32_t row, column;
  bool upper;
  float u, v;  // within the cell

  TriangleCell(float x, float y, std::uint32_t n) {
    // Without branches: a processor cannot predict where rays arrive.
    const auto cell = [&](float at, int most) { return std::min(static_cast<int>(std::max(0.0f, at)), most); };
    const int last = static_cast<int>(n) - 1, i = cell(x * static_cast<float>(n), last), k = cell(y * static_cast<float>(n), last - i);
    row = static_cast<std::uint32_t>(i);
    column = static_cast<std::uint32_t>(k);
    u = x * static_cast<float>(n) - static_cast<float>(i);
    v = y * static_cast<float>(n) - static_cast<float>(k);
    upper = (u + v > 1) & (i + k < last);
    u = std::fabs(static_cast<float>(upper) - u);
    v = std::fabs(static_cast<float>(upper) - v);
  }
  std::uint32_t number(std::uint32_t n) const { return patches_before(row, n) + 2 * column + (upper ? 1 : 0); }
};

}  // namespace

Patches::Site Patches::site(PatchPlace place) const {
  std::uint32_t row = 0;
  while (row + 1 < kPartsAlong && place.part >= patches_before(row + 1, kPartsAlong)) ++row;
  const std::uint32_t k = place.part - patches_before(row, kPartsAlong);
  const float third = k % 2 == 0 ? 1.0f / 3 : 2.0f / 3;
  const float x = (static_cast<float>(row) + third) / kPartsAlong - 1.0f / 3;
  const float y = (static_cast<float>(k / 2) + third) / kPartsAlong - 1.0f / 3;
  Site at = sites_[whole(place.side / 2)];
  // Every other patch of a grid is turned by half a turn.
  const float cell = at.u / at.step;
  const float scale = cell - std::floor(cell) > 0.5f ? -at.step : at.step;
  at.u += x * scale;
  at.v += y * scale;
  at.step /= kPartsAlong;
  return at;
}

PatchPlace Patches::place_at(std::size_t mesh, std::size_t triangle, float u, float v, bool front) const {
  const Grid& grid = grid_of(mesh, triangle);
  if (grid.cells == 0) return {};
  const TriangleCell cell(u, v, grid.cells), part(cell.u, cell.v, kPartsAlong);
  PatchPlace at{2 * (grid.first + cell.number(grid.cells)) + (front ? 0 : 1), part.number(kPartsAlong)};
  if (const Split* split = split_of(at.side)) at.side = split->of_parts[at.part];
  return at;
}

bool Patches::holds(PatchPlace place) const {
  const Split* split = split_of(place.side);
  return split != nullptr ? split->of_parts[place.part] == place.side : place.side / 2 < grid_patches_;
}

float Patches::area(std::uint32_t side) const {
  const float step = site(side).step;
  std::uint32_t parts = 0;
  for (std::uint32_t part = 0; part < kPatchParts; ++part) parts += holds({side, part}) ? 1 : 0;
  return step * step * static_cast<float>(parts) / kPatchParts;
}

std::uint32_t Patches::group_of(std::uint32_t side) const {
  const Site& at = site(side);
  const Grid& grid = grid_of(at.mesh, at.triangle);
  const TriangleCell cell(at.u, at.v, grid.cells);
  return 2 * (grid.first + patches_before(cell.row / 2 * 2, grid.cells) + 2 * (cell.column / 2 * 2)) + side % 2;
}

}  // namespace steradian::radiosity
