#include "plane/frame/event_walk.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "plane/frame/hull.h"

namespace steradian::plane {

namespace {

// Sixteen squares of so many pixels from (x, y) on: what does not depend on the light, and those in the picture.
class Squares {
 public:
  Squares(const PixelGrid& grid, int x, int y, int side, float slack) {
    // Of a square, only the centres of its pixels count.
    const Vec2d half = grid.step * (0.5 * (side - 1));
    first_ = grid.at(x, y) + half;
    for (int k = 0; k < 16; ++k) {
      offset_x_[k] = static_cast<float>(grid.step.x * (k % 4 * side));
      offset_y_[k] = static_cast<float>(grid.step.y * (k / 4 * side));
      in_picture |= std::uint32_t{x + k % 4 * side < grid.width && y + k / 4 * side < grid.height} << k;
    }
    squares_.offset_x = offset_x_;
    squares_.offset_y = offset_y_;
    squares_.half_x = static_cast<float>(half.x);
    squares_.half_y = static_cast<float>(half.y);
    squares_.slack = slack;
  }
  EventSquares from(const Emitter& e) const {
    EventSquares squares = squares_;
    squares.x = static_cast<float>(first_.x - e.center.x);
    squares.y = static_cast<float>(first_.y - e.center.y);
    squares.limit = static_cast<float>(std::min(e.range + e.radius, 1e15)) + squares.slack;
    return squares;
  }
  std::uint32_t in_picture = 0;

 private:
  Vec2d first_;
  alignas(64) float offset_x_[16];
  alignas(64) float offset_y_[16];
  EventSquares squares_;
};

}  // namespace

float slack_of(const FrameScene& frame) { return static_cast<float>(std::max(frame.slack, 1e-3)); }

EventWalk::EventWalk(const FrameScene& frame, const PixelGrid& grid) : frame_(frame), grid_(grid), slack_(slack_of(frame)) {
  for (std::size_t e = 0; e < frame.emitters.size(); ++e)
    if (frame.emitters[e].kind == Emitter::Kind::disk && !frame.emitters[e].hidden) disks_.push_back(static_cast<int>(e));
}

void EventWalk::enter_256(int x, int y, const TileArea& tile) {
  x_256_ = x;
  y_256_ = y;
  top_.clear();
  top_pairs_.clear();
  for (int index : disks_) {
    const Emitter& e = frame_.emitters[static_cast<std::size_t>(index)];
    const Vec2d axis = e.center - tile.center;
    const double reach = e.range + e.bound + tile.radius;
    if (dot(axis, axis) >= reach * reach) continue;
    const std::size_t begin = frame_.first_nearby[static_cast<std::size_t>(index)],
                      end = frame_.first_nearby[static_cast<std::size_t>(index) + 1];
    top_pairs_.reserve_more(end - begin);
    if (hiders_.size() < end - begin) hiders_.resize(2 * (end - begin));
    const std::size_t first = top_pairs_.size;
    cull_.cull(hull_of(tile, e, frame_.world->scene.origin), frame_.nearby, begin, end, top_pairs_, hiders_.data());
    top_.push_back({index, first, static_cast<int>(top_pairs_.size - first)});
  }
  split(top_, top_pairs_.index.data(), x, y, 64, of_256_);
}

void EventWalk::enter_64(int x, int y) {
  const int child = (y - y_256_) / 64 * 4 + (x - x_256_) / 64;
  x_64_ = x;
  y_64_ = y;
  split(of_256_.lights[child], of_256_.pairs[child].data(), x, y, 16, of_64_);
}

void EventWalk::split(const std::vector<Entry>& lights, const int* pairs, int x, int y, int side, Children& to) const {
  for (int k = 0; k < 16; ++k) to.lights[k].clear(), to.used[k] = 0;
  const Squares squares(grid_, x, y, side, slack_);
  EventLists lists;
  for (const Entry& entry : lights) {
    const EventSquares seen = squares.from(frame_.emitters[static_cast<std::size_t>(entry.emitter)]);
    const auto count = static_cast<std::size_t>(entry.count);
    for (int k = 0; k < 16; ++k) {
      if (to.pairs[k].size() < to.used[k] + count) to.pairs[k].resize(2 * (to.used[k] + count));
      lists.pairs[k] = to.pairs[k].data() + to.used[k];
      lists.sizes[k] = 0;
    }
    const std::uint32_t open = table_.split(frame_.pairs.data(), pairs + entry.begin, entry.count, seen, squares.in_picture, lists);
    for (int k = 0; k < 16; ++k) {
      if ((open >> k & 1) == 0) continue;
      to.lights[k].push_back({entry.emitter, to.used[k], lists.sizes[k]});
      to.used[k] += static_cast<std::size_t>(lists.sizes[k]);
    }
  }
}

namespace {

EventLight event_light(const FrameScene& frame, const TileArea& tile) {
  EventLight light{};
  light.tile_x = tile.center.x;
  light.tile_y = tile.center.y;
  light.vertices = frame.vertices.data();
  light.pairs = frame.pairs.data();
  return light;
}

void set_emitter(EventLight& light, const FrameScene& frame, const Emitter& e) {
  const PlaneEmission& emission = emission_of(frame, e);
  light.x = static_cast<float>(e.center.x - light.tile_x);
  light.y = static_cast<float>(e.center.y - light.tile_y);
  light.radius = static_cast<float>(e.radius);
  light.inverse_range = emission.range < 1e300 ? static_cast<float>(1 / emission.range) : 0;
  light.red = static_cast<float>(emission.radiance.x);
  light.green = static_cast<float>(emission.radiance.y);
  light.blue = static_cast<float>(emission.radiance.z);
}

}  // namespace

void EventWalk::list_lights(int x, int y, const TileArea& tile, TileLists& lists, LeafBuilder& general) {
  const int child = child_of_64(x, y);
  EventLight light = event_light(frame_, tile);
  for (const Entry& entry : of_64_.lights[child]) {
    const Emitter& e = frame_.emitters[static_cast<std::size_t>(entry.emitter)];
    set_emitter(light, frame_, e);
    const int *list = of_64_.pairs[child].data() + entry.begin, *last = list + entry.count;
    ++tile_lights;
    tile_blockers += static_cast<std::uint64_t>(entry.count);
    const auto has_lines = [&](int pair) { return frame_.pairs[static_cast<std::size_t>(pair)].kind <= EventPair::Kind::round; };
    if (std::all_of(list, last, has_lines) && lists.add(light, list, entry.count)) continue;
    rest_.blockers.clear();
    std::transform(list, last, std::back_inserter(rest_.blockers),
                   [&](int pair) { return frame_.pairs[static_cast<std::size_t>(pair)].blocker; });
    const auto [whole, visible] = general.build(e, rest_.blockers.data(), rest_.blockers.size());
    if (visible) lists.add(whole);
  }
}

void EventWalk::add_lights(int x, int y, const TileArea& tile, std::uint32_t open, TileBuffer& buffer, LeafBuilder& general) {
  const int child = child_of_64(x, y);
  const Squares blocks(grid_, x, y, 4, slack_);
  EventLight light = event_light(frame_, tile);
  light.open = open & blocks.in_picture;
  light.block = static_cast<float>(4 * std::max(grid_.step.x, grid_.step.y));
  for (const Entry& entry : of_64_.lights[child]) {
    const Emitter& e = frame_.emitters[static_cast<std::size_t>(entry.emitter)];
    light.blocks = blocks.from(e);
    set_emitter(light, frame_, e);
    const int* list = of_64_.pairs[child].data() + entry.begin;
    table_.add_light(light, list, entry.count, buffer, rest_);
    tile_lights += rest_.lit ? 1 : 0;
    tile_blockers += rest_.taken;
    if (rest_.blocks == 0) continue;
    const auto [whole, visible] = general.build(e, rest_.blockers.data(), rest_.blockers.size());
    if (visible) tiles_.add_light(whole, buffer, rest_.blocks);
  }
}

namespace {

void mark_below(const FrameScene& frame, const PixelGrid& grid, const Emitter& disk, int pair, int x, int y, int side, TileSet& tiles) {
  const EventTable& table = event_table_for(active_simd());
  const Squares squares(grid, x, y, side, slack_of(frame));
  const EventSquares seen = squares.from(disk);
  int touched[16][1];
  EventLists lists;
  for (int k = 0; k < 16; ++k) lists.pairs[k] = touched[k], lists.sizes[k] = 0;
  const std::uint32_t in_range = table.split(frame.pairs.data(), nullptr, 0, seen, squares.in_picture, lists),
                      open = table.split(frame.pairs.data(), &pair, 1, seen, squares.in_picture, lists);
  for (int k = 0; k < 16; ++k) {
    const int at_x = x + k % 4 * side, at_y = y + k / 4 * side;
    const bool hides = ((in_range & ~open) >> k & 1) != 0;
    if (hides || (lists.sizes[k] > 0 && side == kTileSide))
      tiles.mark(at_x, at_y, side);
    else if (lists.sizes[k] > 0)
      mark_below(frame, grid, disk, pair, at_x, at_y, side / 4, tiles);
  }
}

}  // namespace

void mark_touched(const FrameScene& frame, const PixelGrid& grid, const Emitter& disk, int pair, TileSet& tiles) {
  for (int y = 0; y < grid.height; y += 256)
    for (int x = 0; x < grid.width; x += 256) mark_below(frame, grid, disk, pair, x, y, 64, tiles);
}

}  // namespace steradian::plane
