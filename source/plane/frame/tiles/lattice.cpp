#include "plane/frame/tiles/lattice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace steradian::plane {
namespace {

constexpr int kCell = 8;      // pixels from node to node: two blocks of a tile
constexpr double kNear = 1;   // pixels: an outline this near to a cell counts as in it
constexpr int kChords = 256;  // largest number of chords for an ellipse

// Cells of a picture, by rows.
struct Cells {
  int columns, rows;
  std::vector<char> drawn;  // pixel by pixel
  explicit Cells(const PixelGrid& grid)
      : columns((grid.width + kCell - 1) / kCell),
        rows((grid.height + kCell - 1) / kCell),
        drawn(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0) {}
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
  }
  char& at(int x, int y) { return drawn[index(x, y)]; }
};

// Marks the cells that a line comes near to; places are in cells.
void mark_line(Vec2d a, Vec2d b, double margin, Cells& cells) {
  const auto cell = [](double at, int last) { return static_cast<int>(std::clamp(std::floor(at), -1.0, last + 1.0)); };
  if (a.y > b.y) std::swap(a, b);
  const int first = std::max(cell(a.y - margin, cells.rows), 0), last = std::min(cell(b.y + margin, cells.rows), cells.rows - 1);
  for (int y = first; y <= last; ++y) {
    // Range of the line within the row.
    const auto x_at = [&](double row) {
      const double t = b.y > a.y ? std::clamp((row - a.y) / (b.y - a.y), 0.0, 1.0) : 0;
      return a.x + t * (b.x - a.x);
    };
    double low = x_at(y - margin), high = x_at(y + 1 + margin);
    if (b.y == a.y) high = b.x;
    if (low > high) std::swap(low, high);
    const int x0 = std::max(cell(low - margin, cells.columns), 0), x1 = std::min(cell(high + margin, cells.columns), cells.columns - 1);
    for (int x = x0; x <= x1; ++x) cells.at(x, y) = 1;
  }
}

void mark_outlines(const World& world, const PixelGrid& grid, Cells& cells) {
  // A cell reaches from the centre of its first pixel to that of the next cell's.
  const auto place = [&](Vec2d p) {
    return Vec2d{((p.x - grid.origin.x) / grid.step.x - 0.5) / kCell, ((p.y - grid.origin.y) / grid.step.y - 0.5) / kCell};
  };
  for (const Curve& c : world.curves) {
    if (c.kind == Curve::Kind::segment) {
      mark_line(place(c.a), place(c.b), kNear / kCell, cells);
      continue;
    }
    const int chords = std::max(static_cast<int>(kChords * c.tau_span / (2 * std::numbers::pi)), 1);
    // Chords of this number differ from the arc by 8e-5 of the half axes.
    const double size = std::sqrt(dot(c.ellipse.x, c.ellipse.x) + dot(c.ellipse.y, c.ellipse.y)) / std::min(grid.step.x, grid.step.y);
    for (int i = 0; i < chords; ++i)
      mark_line(place(c.ellipse.at(c.tau0 + c.tau_span * i / chords)), place(c.ellipse.at(c.tau0 + c.tau_span * (i + 1) / chords)),
                (kNear + 1e-4 * size) / kCell, cells);
  }
}

double largest_of(Vec3f v) { return static_cast<double>(std::max({v.x, v.y, v.z})); }

}  // namespace

LatticeError add_by_lattice(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, double tolerance,
                            Picture& picture, PlaneFrameStats& stats) {
  Cells cells(grid);
  mark_outlines(*frame.world, grid, cells);
  PlaneFrameOptions silent = options;
  silent.progress = nullptr;
  PlaneFrameStats part;
  const auto draw = [&](const PixelGrid& at, Picture& to, const TileSet* only) {
    render_tiles(frame, only != nullptr ? options : silent, at, to, part, only);
    stats.tile_lights += part.tile_lights;
    stats.tile_blockers += part.tile_blockers;
  };
  const Vec2d wide = grid.step * static_cast<double>(kCell);
  Picture nodes(cells.columns + 1, cells.rows + 1), middles(cells.columns, cells.rows);
  draw({grid.origin + (grid.step - wide) * 0.5, wide, nodes.width, nodes.height}, nodes, nullptr);
  draw({grid.origin + grid.step * 0.5, wide, middles.width, middles.height}, middles, nullptr);

  double brightest = 0;
  for (const Vec3f& v : nodes.pixels) brightest = std::max(brightest, largest_of(v));
  const auto between = [&](int x, int y, float u, float v) {
    const Vec3f top = nodes.at(x, y) * (1 - u) + nodes.at(x + 1, y) * u;
    return top * (1 - v) + (nodes.at(x, y + 1) * (1 - u) + nodes.at(x + 1, y + 1) * u) * v;
  };
  LatticeError error;
  std::vector<double> off_by(cells.drawn.size());
  for (int y = 0; y < cells.rows; ++y)
    for (int x = 0; x < cells.columns; ++x) {
      const Vec3f off = between(x, y, 0.5f, 0.5f) - middles.at(x, y);
      const double most = largest_of({std::fabs(off.x), std::fabs(off.y), std::fabs(off.z)});
      off_by[cells.index(x, y)] = most;
    }
  // A feature that ends near a cell's corner may miss its middle, but not its neighbour's. Outlines separate cells: beyond them is another
  // light.
  Cells wrong(grid);
  for (int y = 0; y < cells.rows; ++y)
    for (int x = 0; x < cells.columns; ++x) {
      if (cells.at(x, y) != 0 || off_by[cells.index(x, y)] <= tolerance * brightest) continue;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, cells.rows - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, cells.columns - 1); ++u) wrong.at(u, v) = 1;
    }
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < cells.drawn.size(); ++i) {
    if (wrong.drawn[i] != 0) cells.drawn[i] = 1;
    drawn += cells.drawn[i] != 0 ? 1 : 0;
    if (cells.drawn[i] == 0) error.largest = std::max(error.largest, off_by[i]);
  }
  error.drawn = static_cast<double>(drawn) / static_cast<double>(cells.drawn.size());

  TileSet tiles(grid);
  tiles.blocks.assign(tiles.marked.size(), 0);
  for (int y = 0; y < cells.rows; ++y)
    for (int x = 0; x < cells.columns; ++x) {
      if (cells.at(x, y) == 0) continue;
      const auto tile = static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(tiles.columns) + static_cast<std::size_t>(x / 2);
      tiles.marked[tile] = 1;
      // A cell has two by two of the tile's four by four blocks.
      tiles.blocks[tile] = static_cast<std::uint16_t>(tiles.blocks[tile] | 0x33u << (y % 2 * 8 + x % 2 * 2));
    }
  Picture exact(grid.width, grid.height);
  draw(grid, exact, &tiles);
  tbb::parallel_for(0, grid.height, [&](int y) {
    for (int x = 0; x < grid.width; ++x) {
      const int column = x / kCell, row = y / kCell;
      const float u = static_cast<float>(x % kCell) / kCell, v = static_cast<float>(y % kCell) / kCell;
      picture.at(x, y) += cells.at(column, row) != 0 ? exact.at(x, y) : between(column, row, u, v);
    }
  });
  return error;
}

}  // namespace steradian::plane
