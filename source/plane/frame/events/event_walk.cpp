#include "plane/frame/events/event_walk.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "plane/frame/runs/convex.h"

namespace steradian::plane {
namespace {

// Gathers blockers of one kind until a batch is full.
class Batch {
 public:
  Batch(void (*make)(const EventOutlines&, float), double radius) : make_(make), radius_(static_cast<float>(radius)) {}
  int add(EventPair& pair) {
    if (outlines_.count == EventOutlines::kRoom) flush();
    outlines_.to[outlines_.count] = &pair;
    return outlines_.count++;
  }
  void flush() {
    if (outlines_.count > 0) make_(outlines_, radius_);
    outlines_.count = outlines_.most_vertices = 0;
  }
  EventOutlines& outlines() { return outlines_; }

 private:
  void (*make_)(const EventOutlines&, float);
  float radius_;
  EventOutlines outlines_;
};

void set_line(EventPair& pair, int line, double x, double y, double c) {
  const double size = std::fabs(x) + std::fabs(y), scale = size > 0 ? 1 / size : 1;
  pair.lines[line][0] = static_cast<float>(x * scale);
  pair.lines[line][1] = static_cast<float>(y * scale);
  pair.lines[line][2] = static_cast<float>(c * scale);
}

// Lines of a pair that touches every square and occludes no end of the light.
void set_general(EventPair& pair) {
  for (int line = 0; line < 6; ++line) set_line(pair, line, 0, 0, line < 3 ? -kNever : kNever);
}

// Nothing is occluded on the light's side of the common chord, between the light's tangents at the crossings of the two outlines.
void set_lens(EventPair& pair, const Lens& lens, Vec2d light, double radius, Vec2d blocker) {
  set_general(pair);
  if (lens.count != 2) return;
  Vec2d n = blocker - light;
  n = n / length(n);
  set_line(pair, 0, n.x, n.y, dot(n, lens.crossings[0].at - light));
  for (int k = 0; k < 2; ++k) set_line(pair, k + 1, lens.crossings[k].light_normal.x, lens.crossings[k].light_normal.y, radius);
}

}  // namespace

void make_event_pairs(FrameScene& frame, const Emitter& disk, const std::vector<int>& blockers, std::size_t first) {
  const EventTable& table = event_table_for(active_simd());
  Batch convex(table.make_convex, disk.radius), round(table.make_round, disk.radius);
  for (std::size_t i = 0; i < blockers.size(); ++i) {
    const Blocker& b = frame.blockers[static_cast<std::size_t>(blockers[i])];
    EventPair& pair = frame.pairs[first + i];
    pair.blocker = blockers[i];
    pair.radius = static_cast<float>(b.bound);
    pair.first = static_cast<std::int32_t>(b.first);
    pair.count = static_cast<std::uint8_t>(b.count);
    const Vec2d center = b.center - disk.center;
    if (b.kind == Blocker::Kind::lens) {
      pair.kind = EventPair::Kind::lens;
      if (b.round)
        set_lens(pair, frame.lenses[static_cast<std::size_t>(b.lens)], disk.center, disk.radius, b.center);
      else
        set_general(pair);
    } else if (b.kind == Blocker::Kind::convex && b.edges == 0 && b.count <= EventOutlines::kMostVertices) {
      pair.kind = EventPair::Kind::convex;
      const int k = convex.add(pair);
      EventOutlines& o = convex.outlines();
      o.most_vertices = std::max(o.most_vertices, static_cast<int>(b.count));
      // A blocker with fewer vertices repeats the first one.
      for (int v = 0; v <= EventOutlines::kMostVertices; ++v) {
        const Vec2d at = frame.vertices[b.first + (static_cast<std::size_t>(v) < b.count ? static_cast<std::size_t>(v) : 0)] - disk.center;
        o.x[v][k] = static_cast<float>(at.x);
        o.y[v][k] = static_cast<float>(at.y);
      }
    } else if (length(center) > disk.radius + b.bound) {
      // A chain or an ellipse is no nearer than its bounding circle.
      pair.kind = b.kind == Blocker::Kind::ellipse && b.round ? EventPair::Kind::round : EventPair::Kind::general;
      const int k = round.add(pair);
      EventOutlines& o = round.outlines();
      o.x[0][k] = static_cast<float>(center.x);
      o.y[0][k] = static_cast<float>(center.y);
      o.radius[k] = static_cast<float>(b.bound);
    } else {
      pair.kind = EventPair::Kind::general;
      set_general(pair);
    }
  }
  convex.flush();
  round.flush();
  for (std::size_t i = first; i < first + blockers.size(); ++i) {
    // A general blocker has the inner lines of its bounding circle; its outer lines decide nothing.
    EventPair& pair = frame.pairs[i];
    if (pair.kind == EventPair::Kind::general)
      for (int line = 3; line < 6; ++line) set_line(pair, line, 0, 0, kNever);
  }
}

namespace {

// Sixteen squares of `side` pixels from (x, y) on: the data that does not depend on the light, and the set of those in the picture.
class PictureSquares {
 public:
  PictureSquares(const PixelGrid& grid, int x, int y, int side, float slack) {
    // Only the centres of a square's pixels count.
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

EventWalk::EventWalk(const FrameScene& frame, const PixelGrid& grid, const TileSet* only, ShareStore* store)
    : frame_(frame), grid_(grid), only_(only), store_(store), slack_(slack_of(frame)) {
  for (std::size_t e = 0; e < frame.emitters.size(); ++e)
    if (frame.emitters[e].kind == Emitter::Kind::disk && !frame.emitters[e].hidden) disks_.push_back(static_cast<int>(e));
}

void EventWalk::leave_out(const std::vector<char>& elsewhere) {
  std::erase_if(disks_, [&](int e) { return elsewhere[static_cast<std::size_t>(e)] != 0; });
}

void EventWalk::enter_256(int x, int y, const TileRectangle& tile) {
  x_256_ = x;
  y_256_ = y;
  top_.clear();
  top_pairs_.clear();
  if (store_ != nullptr) find_changed(x, y);
  const Wanted wants = wanted(x, y, 64);
  for (int index : disks_) {
    if (wants.everything == 0 && changed_[static_cast<std::size_t>(index)] == 0) continue;
    const Emitter& e = frame_.emitters[static_cast<std::size_t>(index)];
    const Vec2d axis = e.center - tile.center;
    const double reach = e.range + e.bound + tile.radius;
    if (dot(axis, axis) >= reach * reach) continue;
    const std::size_t begin = frame_.first_nearby[static_cast<std::size_t>(index)],
                      end = begin + frame_.nearby_count[static_cast<std::size_t>(index)];
    top_pairs_.reserve_more(end - begin);
    if (hiders_.size() < end - begin) hiders_.resize(2 * (end - begin));
    const std::size_t first = top_pairs_.size;
    cull_.cull(hull_of(tile, e, frame_.world->scene.origin), frame_.nearby, begin, end, top_pairs_, hiders_.data());
    top_.push_back({index, first, static_cast<int>(top_pairs_.size - first)});
  }
  split(top_, top_pairs_.index.data(), x, y, 64, wants, of_256_);
}

void EventWalk::enter_64(int x, int y) {
  const int child = (y - y_256_) / 64 * 4 + (x - x_256_) / 64;
  x_64_ = x;
  y_64_ = y;
  split(of_256_.lights[child], of_256_.pairs[child].data(), x, y, 16, wanted(x, y, 16), of_64_);
}

EventWalk::Wanted EventWalk::wanted(int x, int y, int side) const {
  if (only_ == nullptr) return {0xffff, 0xffff};
  Wanted result;
  for (int k = 0; k < 16; ++k) {
    const int x0 = x + k % 4 * side, y0 = y + k / 4 * side;
    for (int ty = y0; ty < std::min(y0 + side, grid_.height); ty += kTileSide)
      for (int tx = x0; tx < std::min(x0 + side, grid_.width); tx += kTileSide) {
        if (!only_->any(tx, ty, kTileSide)) continue;
        result.any |= 1u << k;
        if (store_ == nullptr || !store_->at(tx, ty).kept) result.everything |= 1u << k;
      }
  }
  return result;
}

void EventWalk::find_changed(int x, int y) {
  changed_.assign(frame_.emitters.size(), 0);
  for (int ty = y; ty < std::min(y + 256, grid_.height); ty += kTileSide)
    for (int tx = x; tx < std::min(x + 256, grid_.width); tx += kTileSide) {
      if (only_ != nullptr && !only_->any(tx, ty, kTileSide)) continue;
      TileShares& tile = store_->at(tx, ty);
      if (!tile.kept) continue;
      tile.changed.insert(tile.changed.end(), tile.always.begin(), tile.always.end());
      std::sort(tile.changed.begin(), tile.changed.end());
      for (int e : tile.changed) changed_[static_cast<std::size_t>(e)] = 1;
    }
}

void EventWalk::split(const std::vector<Entry>& lights, const int* pairs, int x, int y, int side, const Wanted& wants, Children& to) const {
  for (int k = 0; k < 16; ++k) to.lights[k].clear(), to.used[k] = 0;
  const PictureSquares squares(grid_, x, y, side, slack_);
  EventLists lists;
  for (const Entry& entry : lights) {
    const EventSquares seen = squares.from(frame_.emitters[static_cast<std::size_t>(entry.emitter)]);
    const auto count = static_cast<std::size_t>(entry.count);
    for (int k = 0; k < 16; ++k) {
      if (to.pairs[k].size() < to.used[k] + count) to.pairs[k].resize(2 * (to.used[k] + count));
      lists.pairs[k] = to.pairs[k].data() + to.used[k];
      lists.sizes[k] = 0;
    }
    const bool changed = store_ != nullptr && changed_[static_cast<std::size_t>(entry.emitter)] != 0;
    const std::uint32_t squares_wanted = squares.in_picture & (changed ? wants.any : wants.everything);
    const std::uint32_t open = table_.split(frame_.pairs.data(), pairs + entry.begin, entry.count, seen, squares_wanted, lists);
    for (int k = 0; k < 16; ++k) {
      if ((open >> k & 1) == 0) continue;
      to.lights[k].push_back({entry.emitter, to.used[k], lists.sizes[k]});
      to.used[k] += static_cast<std::size_t>(lists.sizes[k]);
    }
  }
}

namespace {

EventLight event_light(const FrameScene& frame, const TileRectangle& tile) {
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

void EventWalk::list_lights(int x, int y, const TileRectangle& tile, TileLists& lists, LeafBuilder& general) {
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

void EventWalk::add_lights(int x, int y, const TileRectangle& tile, std::uint32_t open, TileBuffer& buffer, LeafBuilder& general) {
  const int child = child_of_64(x, y);
  const PictureSquares blocks(grid_, x, y, 4, slack_);
  EventLight light = event_light(frame_, tile);
  light.open = open & blocks.in_picture;
  light.block = static_cast<float>(4 * std::max(grid_.step.x, grid_.step.y));
  TileShares* keep = store_ == nullptr ? nullptr : &store_->at(x, y);
  const bool kept = keep != nullptr && keep->kept;
  const auto has_changed = [&](int emitter) { return std::binary_search(keep->changed.begin(), keep->changed.end(), emitter); };
  next_.emitters.clear();
  next_.slots.clear();
  next_.always.clear();
  if (keep != nullptr && !kept) keep->forget();
  if (kept)
    for (std::size_t i = 0; i < keep->emitters.size(); ++i)
      if (has_changed(keep->emitters[i])) keep->free_slots.push_back(keep->slots[i]);
  std::size_t held = 0;
  // Adds the cached lights that have not changed, up to the given one.
  const auto add_held = [&](int before) {
    for (; kept && held < keep->emitters.size() && keep->emitters[held] < before; ++held) {
      const int emitter = keep->emitters[held], slot = keep->slots[held];
      if (has_changed(emitter)) continue;
      const Vec3d radiance = emission_of(frame_, frame_.emitters[static_cast<std::size_t>(emitter)]).radiance;
      table_.add_shares(keep->at(slot), static_cast<float>(radiance.x), static_cast<float>(radiance.y), static_cast<float>(radiance.z),
                        buffer);
      next_.emitters.push_back(emitter);
      next_.slots.push_back(slot);
    }
  };
  for (const Entry& entry : of_64_.lights[child]) {
    if (kept && !has_changed(entry.emitter)) continue;
    add_held(entry.emitter);
    const Emitter& e = frame_.emitters[static_cast<std::size_t>(entry.emitter)];
    light.blocks = blocks.from(e);
    set_emitter(light, frame_, e);
    const int* list = of_64_.pairs[child].data() + entry.begin;
    const int slot = keep != nullptr ? keep->take_slot() : 0;
    table_.add_light(light, list, entry.count, buffer, rest_, keep != nullptr ? keep->at(slot) : nullptr);
    if (rest_.blocks != 0) next_.always.push_back(entry.emitter);
    if (rest_.blocks == 0 && rest_.shared) {
      next_.emitters.push_back(entry.emitter);
      next_.slots.push_back(slot);
    } else if (keep != nullptr) {
      keep->free_slots.push_back(slot);
    }
    tile_lights += rest_.lit ? 1 : 0;
    tile_blockers += rest_.taken;
    if (rest_.blocks == 0) continue;
    const auto [whole, visible] = general.build(e, rest_.blockers.data(), rest_.blockers.size());
    if (visible) tiles_.add_light(whole, buffer, rest_.blocks);
  }
  add_held(std::numeric_limits<int>::max());
  if (keep == nullptr) return;
  keep->emitters.swap(next_.emitters);
  keep->slots.swap(next_.slots);
  keep->always.swap(next_.always);
  keep->changed.clear();
  keep->kept = true;
}

namespace {

void mark_below(const FrameScene& frame, const PixelGrid& grid, const Emitter& disk, int pair, int x, int y, int side,
                const std::function<void(int, int, int)>& mark) {
  const EventTable& table = event_table_for(active_simd());
  const PictureSquares squares(grid, x, y, side, slack_of(frame));
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
      mark(at_x, at_y, side);
    else if (lists.sizes[k] > 0)
      mark_below(frame, grid, disk, pair, at_x, at_y, side / 4, mark);
  }
}

}  // namespace

void mark_touched(const FrameScene& frame, const PixelGrid& grid, const Emitter& disk, int pair,
                  const std::function<void(int, int, int)>& mark) {
  for (int y = 0; y < grid.height; y += 256)
    for (int x = 0; x < grid.width; x += 256) mark_below(frame, grid, disk, pair, x, y, 64, mark);
}

}  // namespace steradian::plane
