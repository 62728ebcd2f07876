#include "device/plane/listed_disks.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "plane/frame/events/event_walk.h"

namespace steradian::plane {
namespace {

#include "shaders/plane/plane_layout.glsl"

// A thread processes a disk's pairs one after another, each in a few turns of its loops.
constexpr std::size_t kMostPairs = kMostTurns / 8;

std::uint32_t bits(double x) { return std::bit_cast<std::uint32_t>(static_cast<float>(x)); }
std::uint32_t rest(double x) { return bits(x - static_cast<double>(static_cast<float>(x))); }

// The limit within which EventWalk treats a place as in range.
double limit_of(const FrameScene& frame, const Emitter& e) {
  return std::min(e.range + e.radius, 1e15) + static_cast<double>(slack_of(frame));
}

// Tiles from the first to the last, along one axis, that are no further from a place than the limit.
struct TileStretch {
  int first, count;
  TileStretch(double place, double limit, double step, int tiles) {
    const double size = step * kTileSide;
    first = static_cast<int>(std::clamp(std::floor((place - limit) / size), 0.0, static_cast<double>(tiles)));
    const int last = static_cast<int>(std::clamp(std::floor((place + limit) / size), -1.0, static_cast<double>(tiles - 1)));
    count = std::max(last - first + 1, 0);
  }
};

}  // namespace

// Calls use(disk, tile, cell) for the tiles in each disk's range.
template <class Use>
void ListedDisks::for_each_tile(const FrameScene& frame, const PixelGrid& grid, Use use) const {
  const Vec2d half = grid.step * (0.5 * (kTileSide - 1));
  for (std::size_t disk = 0; disk < emitters_.size(); ++disk) {
    const Emitter& e = frame.emitters[static_cast<std::size_t>(emitters_[disk])];
    const std::uint32_t* tiles = &records_[disk * kRecord + kDiskTiles];
    const double limit = limit_of(frame, e);
    for (std::uint32_t y = 0; y < tiles[3]; ++y)
      for (std::uint32_t x = 0; x < tiles[2]; ++x) {
        const int column = static_cast<int>(tiles[0] + x), row = static_cast<int>(tiles[1] + y);
        const Vec2d from = grid.at(column * kTileSide, row * kTileSide) + half - e.center;
        const Vec2d away{std::max(std::fabs(from.x) - half.x, 0.0), std::max(std::fabs(from.y) - half.y, 0.0)};
        if (dot(away, away) < limit * limit)
          use(disk, static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column),
              y * tiles[2] + x);
      }
  }
}

void ListedDisks::choose(const FrameScene& frame, const PixelGrid& grid, std::size_t pairs, std::size_t mask_words) {
  columns_ = (grid.width + kTileSide - 1) / kTileSide;
  const int rows = (grid.height + kTileSide - 1) / kTileSide;
  records_.clear();
  emitters_.clear();
  is_listed_.assign(frame.emitters.size(), 0);
  mask_words_ = most_cells_ = 0;
  for (std::size_t i = 0; i < frame.emitters.size(); ++i) {
    const Emitter& e = frame.emitters[i];
    if (e.kind != Emitter::Kind::disk || e.hidden) continue;
    const std::size_t begin = frame.first_nearby[i], count = static_cast<std::size_t>(frame.nearby_count[i]);
    const std::size_t first = count > 0 ? static_cast<std::size_t>(frame.nearby.index[begin]) : 0;
    if (count > kMostPairs || first + count > pairs) continue;
    bool has_lines = true;
    for (std::size_t k = 0; k < count && has_lines; ++k)
      has_lines =
          static_cast<std::size_t>(frame.nearby.index[begin + k]) == first + k && frame.pairs[first + k].kind <= EventPair::Kind::round;
    if (!has_lines) continue;
    const Vec2d corner = e.center - grid.origin;
    const double limit = limit_of(frame, e);
    const TileStretch across(corner.x, limit, grid.step.x, columns_), down(corner.y, limit, grid.step.y, rows);
    const std::size_t cells = static_cast<std::size_t>(across.count) * static_cast<std::size_t>(down.count);
    const std::size_t words = cells * ((count + 31) / 32 + 1);
    if (mask_words_ + words > mask_words) continue;
    is_listed_[i] = 1;
    if (cells == 0) continue;
    const PlaneEmission& emission = emission_of(frame, e);
    const auto number = [](auto x) { return static_cast<std::uint32_t>(x); };
    const std::uint32_t record[kRecord] = {bits(e.center.x),
                                           rest(e.center.x),
                                           bits(e.center.y),
                                           rest(e.center.y),
                                           bits(e.radius),
                                           emission.range < 1e300 ? bits(1 / emission.range) : 0,
                                           bits(emission.radiance.x),
                                           bits(emission.radiance.y),
                                           bits(emission.radiance.z),
                                           bits(corner.x),
                                           bits(corner.y),
                                           number(first),
                                           number(count),
                                           number(across.first),
                                           number(down.first),
                                           number(across.count),
                                           number(down.count),
                                           number(mask_words_)};
    static_assert(kRecord == static_cast<std::size_t>(kDisk) && kDiskMasks == 17 && kDiskTiles == 13 && kDiskCorner == 9);
    records_.insert(records_.end(), std::begin(record), std::end(record));
    emitters_.push_back(static_cast<int>(i));
    mask_words_ += words;
    most_cells_ = std::max(most_cells_, cells);
  }
  // Counts the entries of each tile, computes their starts, and then writes each to its place.
  first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows) + 1, 0);
  for_each_tile(frame, grid, [&](std::size_t, std::size_t tile, std::uint32_t) { ++first_[tile + 1]; });
  for (std::size_t tile = 1; tile < first_.size(); ++tile) first_[tile] += first_[tile - 1];
  entries_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_each_tile(frame, grid, [&](std::size_t disk, std::size_t tile, std::uint32_t cell) {
    const std::uint32_t* record = &records_[disk * kRecord];
    const std::uint32_t count = record[kDiskPairs];
    entries_[next[tile]++] = {static_cast<std::uint32_t>(disk), record[kDiskMasks] + cell * ((count + 31) / 32 + 1), count};
  });
}

std::span<const ListedDisks::Entry> ListedDisks::of_tile(int column, int row) const {
  const std::size_t tile = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  return {entries_.data() + first_[tile], first_[tile + 1] - first_[tile]};
}

}  // namespace steradian::plane
