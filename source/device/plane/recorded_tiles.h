// The lists of tiles as the words that shaders read.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <vector>

#include "plane/frame/tiles/tile_lists.h"

namespace steradian::plane {

// Lights that one shader serves.
enum class LightGroup : std::size_t { disks, cuts, arcs };
inline constexpr std::size_t kLightGroups = 3;

struct RecordedTile {
  int x = 0, y = 0;  // the first pixel
  Vec2d center;
  std::bitset<kTilePixels> filled;
  bool for_cpu = false;  // one light needs more steps than a job may have
  std::size_t words = 0;
  std::size_t first_job = 0, jobs = 0;
};

// Lights of a tile that are one thread's work. A software device silently ends a thread's loops after 65,535 rounds of all of them
// together, and other devices have watchdogs for long work. So larger work becomes several jobs, one after another.
struct RecordedJob {
  LightGroup group;
  int round;                     // number of jobs of the same tile and group that come before it
  std::size_t first, words = 0;  // in RecordedTiles::words
  std::uint32_t lights = 0;
  std::size_t steps = 0;  // upper bound
};

class RecordedTiles final : public TileLists {
 public:
  // Keeps its memory for the next frame. The device has the first `pairs` of the frame's pairs; `elsewhere` must stay valid.
  void clear(std::size_t pairs, const std::vector<char>& elsewhere);

  const std::vector<char>* elsewhere() const override { return elsewhere_; }
  void begin_tile(int x, int y, Vec2d center) override;
  void add(const TileLight& light) override;
  bool add(const EventLight& light, const int* pairs, int count) override;
  void end_tile(const std::bitset<kTilePixels>& filled) override;

  const std::vector<RecordedTile>& tiles() const { return tiles_; }
  const RecordedJob* jobs(const RecordedTile& tile) const { return jobs_.data() + tile.first_job; }
  const std::uint32_t* words(LightGroup group) const { return words_[static_cast<std::size_t>(group)].data(); }

 private:
  // Destination of a light of so many steps; null: in no job.
  std::vector<std::uint32_t>* begin_light(LightGroup group, std::size_t steps);
  void end_light(LightGroup group);

  std::array<std::vector<std::uint32_t>, kLightGroups> words_;
  std::vector<RecordedTile> tiles_;
  std::vector<RecordedJob> jobs_;
  RecordedTile tile_;
  std::size_t open_[kLightGroups] = {};  // the tile's last job of each group
  std::size_t pairs_ = 0;
  const std::vector<char>* elsewhere_ = nullptr;
};

}  // namespace steradian::plane
