#include "plane/extras/frame.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "plane/extras/extras.h"
#include "plane/extras/sight.h"

namespace steradian::plane {
namespace {

constexpr int kSide = 16;

// Every tile tests every body against every mirror.
void take_work(const World& world, const PixelGrid& grid, Budget& budget) {
  std::uint64_t edges = 0;
  for (std::size_t i : world.extras->mirrors) edges += world.first_curve[i + 1] - world.first_curve[i];
  if (edges == 0) return;
  const auto pixels = static_cast<std::uint64_t>(grid.width) * static_cast<std::uint64_t>(grid.height);
  budget.take_work(world.scene.name, "what " + std::to_string(edges) + " edges of its mirrors show of suns without width",
                   pixels * edges * world.extras->hard_suns * world.curves.size() * 4);
  const auto tiles =
      static_cast<std::uint64_t>((grid.width + kSide - 1) / kSide) * static_cast<std::uint64_t>((grid.height + kSide - 1) / kSide);
  budget.take_work(world.scene.name, "what " + std::to_string(edges) + " edges of its mirrors show",
                   tiles * edges * world.scene.bodies.size() * 20);
}

struct Tile {
  int x0, y0, x1, y1;
  Box2d box;
  Tile(const PixelGrid& grid, int column, int row)
      : x0(column * kSide),
        y0(row * kSide),
        x1(std::min(x0 + kSide, grid.width)),
        y1(std::min(y0 + kSide, grid.height)),
        box{grid.at(x0, y0), grid.at(x1 - 1, y1 - 1)} {}
  BodyDisk disk() const { return {box.center(), box.radius()}; }
};

// Calls f(x, y, light) for all pixels.
template <class F>
void for_each_pixel(const World& world, const PixelGrid& grid, const SightRules& rules, const TileSet* only,
                    const std::function<void(int, int)>& row_done, F f) {
  const int columns = (grid.width + kSide - 1) / kSide, rows = (grid.height + kSide - 1) / kSide;
  std::vector<std::size_t> deep;
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i)
    if (world.extras->matter[i] == Matter::deep) deep.push_back(i);
  std::atomic<int> done{0};
  tbb::parallel_for(0, rows, [&](int row) {
    tbb::parallel_for(0, columns, [&](int column) {
      const Tile tile(grid, column, row);
      if (only != nullptr && !only->any(tile.x0, tile.y0, kSide)) return;
      const auto overlaps = [&](std::size_t i) { return world.boxes[i].meets(tile.box); };
      const View view = view_of(world, tile.disk(), rules.all || std::any_of(deep.begin(), deep.end(), overlaps));
      if (view.blocking.empty() && view.all.empty() && world.scene.suns.empty()) return;
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) f(x, y, sight(world, view, grid.at(x, y), rules));
    });
    if (row_done) row_done(++done, rows);
  });
}

}  // namespace

// Fine enough for single precision.
constexpr double kTolerance = 1e-7;

void add_extras(const World& world, const PixelGrid& grid, Budget& budget, Picture& picture, const TileSet* only) {
  take_work(world, grid, budget);
  for_each_pixel(world, grid, {kTolerance, false, EmissionParts::radiance}, only, nullptr,
                 [&](int x, int y, const PlaneLight& light) { picture.at(x, y) += static_cast<Vec3f>(light.radiance); });
}

void draw_with_extras(const World& world, const PlaneFrameOptions& options, const PixelGrid& grid, Budget& budget, Picture& picture,
                      const TileSet* only) {
  take_work(world, grid, budget);
  if (only != nullptr)
    clear_tiles(*only, picture);
  else
    std::fill(picture.pixels.begin(), picture.pixels.end(), Vec3f{});
  std::vector<Vec3f>*x_layer = nullptr, *y_layer = nullptr;
  if (options.moments) {
    x_layer = &picture.layers["moment_x"], x_layer->assign(picture.pixels.size(), {});
    y_layer = &picture.layers["moment_y"], y_layer->assign(picture.pixels.size(), {});
  }
  const auto row_done = [&](int done, int rows) {
    if (options.progress) options.progress(static_cast<std::uint64_t>(done), static_cast<std::uint64_t>(rows));
  };
  const EmissionParts parts = options.moments ? EmissionParts::radiance_and_moments : EmissionParts::radiance;
  for_each_pixel(world, grid, {kTolerance, true, parts}, only, row_done, [&](int x, int y, const PlaneLight& light) {
    picture.at(x, y) = static_cast<Vec3f>(light.radiance);
    if (!options.moments) return;
    const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x);
    (*x_layer)[i] = static_cast<Vec3f>(light.moment_x);
    (*y_layer)[i] = static_cast<Vec3f>(light.moment_y);
  });
}

void mark_with_extras(const World& world, const std::vector<std::size_t>& bodies, const PixelGrid& grid, TileSet& tiles) {
  if (bodies.empty()) return;
  const bool all = world.extras->changes_frames(world.scene);
  tbb::parallel_for(0, tiles.rows, [&](int row) {
    for (int column = 0; column < tiles.columns; ++column) {
      const Tile tile(grid, column, row);
      if (!tiles.any(tile.x0, tile.y0, kSide) && may_matter(world, tile.disk(), all, bodies)) tiles.mark(tile.x0, tile.y0, kSide);
    }
  });
}

void clear_tiles(const TileSet& tiles, Picture& picture) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; x += kSide)
      if (tiles.any(x, y, kSide)) std::fill_n(&picture.at(x, y), std::min(kSide, picture.width - x), Vec3f{});
}

}  // namespace steradian::plane
