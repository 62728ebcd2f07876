// A frame by tile recursion: 256, 128, 64, 32, 16 pixels. At every level a light keeps only the blockers that touch the hull of tile and
// light. It is dropped if one of them occludes it from all of the tile.
#include "plane/frame/tiles/tiles.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <tbb/parallel_for.h>

#include "core/float_mode.h"
#include "plane/frame/events/event_walk.h"
#include "plane/frame/runs/convex.h"
#include "plane/frame/runs/overlap.h"
#include "plane/frame/runs/runs.h"
#include "plane/frame/tiles/filling.h"
#include "plane/frame/tiles/leaf.h"

namespace steradian::plane {
namespace {

constexpr int kSides[] = {256, 128, 64, 32, kTileSide};
constexpr int kLevels = 5;

struct Entry {
  int emitter;
  std::size_t begin, end;  // its blockers in the level's list
  // Number of entries, itself and those that it represents, which follow it; a run without them is visible as one from all of the tile.
  std::size_t group = 1;
  bool within = false;  // a run `around` from within its hull: its light in all directions. Its lids follow
};

struct Level {
  std::vector<Entry> entries;
  BlockerList blockers;
  std::vector<int> bodies;   // bodies whose boxes touch the tile
  std::vector<int> general;  // general lights in range
};

// One thread's work.
class TileWorker {
 public:
  // lists: null for the packs.
  TileWorker(const FrameScene& frame, const PixelGrid& grid, const TileTable& table, Picture& picture, const TileSet* only,
             ShareStore* store, TileLists* lists)
      : only_(only),
        lists_(lists),
        frame_(frame),
        world_(*frame.world),
        grid_(grid),
        table_(table),
        picture_(picture),
        leaf_(frame),
        filling_(frame, grid),
        events_(frame, grid, only, store) {
    if (lists != nullptr && lists->elsewhere() != nullptr) events_.leave_out(*lists->elsewhere());
    for (int y = 0; y < kTileSide; ++y)
      for (int x = 0; x < kTileSide; ++x) {
        buffer_.x[TileBuffer::slot(x, y)] = static_cast<float>((x - 0.5 * (kTileSide - 1)) * grid_.step.x);
        buffer_.y[TileBuffer::slot(x, y)] = static_cast<float>((y - 0.5 * (kTileSide - 1)) * grid_.step.y);
      }
  }

  // Renders the 256 pixels from (x, y) on.
  void run(int x, int y) {
    Level& top = levels_[0];
    top.entries.clear();
    top.blockers.clear();
    top.bodies.clear();
    top.general.clear();
    const TileRectangle tile = area(x, y, kSides[0]);
    for (std::size_t i = 0; i < world_.boxes.size(); ++i) {
      if (touches(world_.boxes[i], tile)) top.bodies.push_back(static_cast<int>(i));
      if (frame_.general[i] != 0 && in_range(i, tile)) top.general.push_back(static_cast<int>(i));
    }
    if (stays_dark(top, x, y, kSides[0])) return;
    for (std::size_t e = 0; e < frame_.emitters.size();) {
      const Emitter& emitter = frame_.emitters[e];
      if (frame_.general[static_cast<std::size_t>(emitter.body)] == 0 && emitter.kind != Emitter::Kind::disk) take_first(e, tile, top);
      e += emitter.group;
    }
    events_.enter_256(x, y, tile);
    descend(0, x, y);
  }

  std::uint64_t tile_lights() const { return tile_lights_ + events_.tile_lights; }
  std::uint64_t tile_blockers() const { return tile_blockers_ + events_.tile_blockers; }

 private:
  TileRectangle area(int x, int y, int side) const {
    return {grid_.at(x, y) + grid_.step * (0.5 * (side - 1)), grid_.step * (0.5 * side), 0.5 * side * length(grid_.step)};
  }

  bool touches(const Box2d& box, const TileRectangle& t) const { return box.meets({t.center - t.half, t.center + t.half}); }
  bool in_range(std::size_t body, const TileRectangle& t) const {
    const Box2d& b = world_.boxes[body];
    const Vec2d gap{std::max({b.low.x - t.center.x - t.half.x, 0.0, t.center.x - t.half.x - b.high.x}),
                    std::max({b.low.y - t.center.y - t.half.y, 0.0, t.center.y - t.half.y - b.high.y})};
    return length(gap) < world_.scene.bodies[body].light->range;
  }

  // Appends an emitter; for a run that does not face all of the tile, also the emitters that it represents.
  void take_first(std::size_t index, const TileRectangle& tile, Level& to) {
    const Emitter& e = frame_.emitters[index];
    const bool whole = frame_.whole_run[index] != 0;
    const Facing faces = is_run(e) ? seen_as_one(&e, tile) : Facing::all;
    if (faces == Facing::none) return;
    const std::size_t at = to.entries.size();
    if (whole && takes_within(index, tile, to)) return;
    if (!is_run(e) || whole) {
      if (!filter(static_cast<int>(index), frame_.nearby, frame_.first_nearby[index],
                  frame_.first_nearby[index] + frame_.nearby_count[index], tile, to))
        return;
      if (faces == Facing::all) return;
    }
    for (std::size_t k = index + 1 + count_lids(&e); k < index + e.group; k += frame_.emitters[k].group) take_first(k, tile, to);
    if (whole) close_group(at, to);
  }

  // The same for entries of the level above: the first one and the entries that it represents.
  void take(const Level& from, std::size_t first, const TileRectangle& tile, Level& to) {
    const Entry& entry = from.entries[first];
    if (entry.within) return to.entries.push_back({entry.emitter, 0, 0, 1, true});
    if (entry.group > 1 && takes_within(static_cast<std::size_t>(entry.emitter), tile, to)) return;
    const Facing faces = entry.group > 1 ? seen_as_one(&frame_.emitters[static_cast<std::size_t>(entry.emitter)], tile) : Facing::all;
    if (faces == Facing::none) return;
    const std::size_t at = to.entries.size();
    if (!filter(entry.emitter, from.blockers, entry.begin, entry.end, tile, to) || faces == Facing::all) return;
    for (std::size_t k = first + 1; k < first + entry.group; k += from.entries[k].group) take(from, k, tile, to);
    close_group(at, to);
  }

  // If the tile lies within the hull of a run `around`: appends its light from within, and the lids.
  bool takes_within(std::size_t index, const TileRectangle& tile, Level& to) {
    const Emitter& e = frame_.emitters[index];
    if (frame_.filled_run[index] == 0 || lists_ != nullptr || !is_within_hull(e, tile)) return false;
    to.entries.push_back({static_cast<int>(index), 0, 0, 1, true});
    for (std::size_t k = index + 1; k < index + 1 + count_lids(&e); ++k) take_first(k, tile, to);
    return true;
  }

  // Removes a run if none of its parts remains.
  static void close_group(std::size_t at, Level& to) {
    const std::size_t group = to.entries.size() - at;
    if (group == 1)
      to.entries.pop_back();
    else
      to.entries[at].group = group;
  }

  // Appends the emitter with those of from[begin, end) that touch the hull of it and the tile. Returns false if it is invisible.
  bool filter(int index, const BlockerList& from, std::size_t begin, std::size_t end, const TileRectangle& tile, Level& to) {
    const Emitter& e = frame_.emitters[static_cast<std::size_t>(index)];
    const double half = tile.radius, bound = e.bound;
    const Vec2d axis = e.center - tile.center;
    const double length2 = dot(axis, axis), reach = e.range + bound + half;
    if (e.hidden || length2 >= reach * reach) return false;
    if (e.kind == Emitter::Kind::arc && !e.whole && faces_away(e, tile)) return false;
    if (e.kind == Emitter::Kind::edge && !is_run(e) && facing(e, tile) == Facing::none) return false;
    to.blockers.reserve_more(end - begin);
    if (hiders_.size() < end - begin) hiders_.resize(2 * (end - begin));
    const std::size_t first = to.blockers.size,
                      hiders = cull_.cull(hull_of(tile, e, world_.scene.origin), from, begin, end, to.blockers, hiders_.data());
    for (std::size_t i = 0; i < hiders; ++i)
      if (hides(hiders_[i], e, tile)) {
        to.blockers.size = first;
        return false;
      }
    to.entries.push_back({index, first, to.blockers.size});
    return true;
  }

  bool hides(int blocker, const Emitter& e, const TileRectangle& tile) const {
    const Blocker& b = frame_.blockers[static_cast<std::size_t>(blocker)];
    // Within a chain's hull, its edges decide on their own.
    if (b.edges != 0 && length(b.center - tile.center) < b.bound + tile.radius) return false;
    return plane::hides(&frame_.vertices[b.first], b.count, e, tile);
  }

  // Fills a tile that lies entirely within one convex occluder.
  bool stays_dark(const Level& level, int x0, int y0, int side) {
    const int x1 = std::min(x0 + side, grid_.width) - 1, y1 = std::min(y0 + side, grid_.height) - 1;
    for (int i : level.bodies) {
      const std::size_t k = static_cast<std::size_t>(i);
      const auto holds = [&](int x, int y) { return world_.boxes[k].contains(grid_.at(x, y)) && world_.contains(k, grid_.at(x, y)); };
      if (world_.scene.bodies[k].light || frame_.convex[k] == 0 || !holds(x0, y0) || !holds(x1, y1) || !holds(x0, y1) || !holds(x1, y0))
        continue;
      for (int y = y0; y <= y1; ++y) std::fill(&picture_.at(x0, y), &picture_.at(x1, y) + 1, Vec3f{});
      return true;
    }
    return false;
  }

  void descend(int level, int x, int y) {
    if (level + 1 == kLevels) {
      leaf(levels_[static_cast<std::size_t>(level)], x, y);
      return;
    }
    const Level& from = levels_[static_cast<std::size_t>(level)];
    Level& to = levels_[static_cast<std::size_t>(level) + 1];
    const int side = kSides[level + 1];
    for (int dy = 0; dy < kSides[level] && y + dy < grid_.height; dy += side)
      for (int dx = 0; dx < kSides[level] && x + dx < grid_.width; dx += side) {
        if (only_ != nullptr && !only_->any(x + dx, y + dy, side)) continue;
        const TileRectangle tile = area(x + dx, y + dy, side);
        to.entries.clear();
        to.blockers.clear();
        to.bodies.clear();
        to.general.clear();
        for (int i : from.bodies)
          if (touches(world_.boxes[static_cast<std::size_t>(i)], tile)) to.bodies.push_back(i);
        if (stays_dark(to, x + dx, y + dy, side)) continue;
        if (side == 64) events_.enter_64(x + dx, y + dy);
        for (std::size_t e = 0; e < from.entries.size(); e += from.entries[e].group) take(from, e, tile, to);
        for (int i : from.general)
          if (in_range(static_cast<std::size_t>(i), tile)) to.general.push_back(i);
        descend(level + 1, x + dx, y + dy);
      }
  }

  void leaf(const Level& level, int x0, int y0) {
    const TileRectangle tile = area(x0, y0, kTileSide);
    std::fill(std::begin(buffer_.red), std::end(buffer_.red), 0.0f);
    std::fill(std::begin(buffer_.green), std::end(buffer_.green), 0.0f);
    std::fill(std::begin(buffer_.blue), std::end(buffer_.blue), 0.0f);
    leaf_.enter(tile);
    const unsigned wanted = only_ == nullptr || only_->blocks.empty() ? kAllBlocks : only_->blocks_of(x0, y0);
    filling_.find(level.bodies, x0, y0, tile);
    if (lists_ != nullptr) lists_->begin_tile(x0, y0, tile.center);
    // If every pixel is filled, no light arrives from outside.
    const bool filled = filling_.all();
    for (const Entry& e : level.entries) {
      if (filled) break;
      if (e.group > 1) continue;  // some of its edges face away: they follow one by one
      if (e.within) {
        add_to_all(static_cast<Vec3f>(frame_.emitters[static_cast<std::size_t>(e.emitter)].radiance.a));
        continue;
      }
      const auto [light, visible] =
          leaf_.build(frame_.emitters[static_cast<std::size_t>(e.emitter)], level.blockers.index.data() + e.begin, e.end - e.begin);
      if (!visible) continue;
      if (lists_ != nullptr)
        lists_->add(light);
      else
        table_.add_light(light, buffer_, wanted);
      ++tile_lights_;
      tile_blockers_ += static_cast<std::uint64_t>(light.low_count + light.high_count + light.low_disk_count + light.high_disk_count +
                                                   light.disk_count + light.span_count + light.body_count + light.chord_count +
                                                   light.deep_count + light.round_count + light.lens_count);
    }
    if (!filled && lists_ != nullptr)
      events_.list_lights(x0, y0, tile, *lists_, leaf_);
    else if (!filled)
      events_.add_lights(x0, y0, tile, filling_.open_blocks() & wanted, buffer_, leaf_);
    if (lists_ != nullptr) lists_->end_tile(filling_.pixels());
    table_.write(buffer_, std::min(kTileSide, grid_.width - x0), std::min(kTileSide, grid_.height - y0), &picture_.at(x0, y0).x,
                 3 * static_cast<std::size_t>(grid_.width));
    filling_.draw(picture_);
    if (!level.general.empty()) add_general(level, tile, x0, y0);
  }

  void add_to_all(const Vec3f& light) {
    for (int i = 0; i < kTilePixels; ++i) {
      buffer_.red[i] += light.x;
      buffer_.green[i] += light.y;
      buffer_.blue[i] += light.z;
    }
  }

  // Lights without a special rule, one by one: the envelope of the curves that touch the hull of tile and light.
  void add_general(const Level& level, const TileRectangle& tile, int x0, int y0) {
    for (int light : level.general) {
      collect_general_curves(static_cast<std::size_t>(light), tile);
      for (int y = 0; y < kTileSide && y0 + y < grid_.height; ++y)
        for (int x = 0; x < kTileSide && x0 + x < grid_.width; ++x)
          if (filling_.is_open(x, y))
            picture_.at(x0 + x, y0 + y) += static_cast<Vec3f>(
                envelope_light_of(world_, general_curves_, grid_.at(x0 + x, y0 + y), light, EmissionParts::radiance).radiance);
    }
  }

  void collect_general_curves(std::size_t light, const TileRectangle& tile) {
    const Vec2d to = world_.boxes[light].center() - tile.center;
    const double size = world_.boxes[light].radius(), wide = std::max(size, tile.radius), l2 = dot(to, to);
    general_curves_.clear();
    for (std::size_t i = 0; i < world_.boxes.size(); ++i) {
      // A body counts within the wider of the two radii of the line between the two.
      const Vec2d at = world_.boxes[i].center() - tile.center;
      const double t = l2 > 0 ? std::clamp(dot(at, to) / l2, 0.0, 1.0) : 0, limit = wide + world_.boxes[i].radius();
      const Vec2d away = at - to * t;
      if (i != light && dot(away, away) > limit * limit) continue;
      for (std::size_t c = world_.first_curve[i]; c < world_.first_curve[i + 1]; ++c) general_curves_.push_back(&world_.curves[c]);
    }
  }

  const TileSet* only_;
  TileLists* lists_;
  const FrameScene& frame_;
  const World& world_;
  const PixelGrid& grid_;
  const TileTable& table_;
  Picture& picture_;
  LeafBuilder leaf_;
  Filling filling_;
  EventWalk events_;
  const BlockerCullTable& cull_ = cull_table_for(active_simd());
  std::vector<int> hiders_;
  Level levels_[kLevels];
  TileBuffer buffer_;
  std::uint64_t tile_lights_ = 0, tile_blockers_ = 0;
  std::vector<const Curve*> general_curves_;
};

}  // namespace

void TileSet::mark(int x, int y, int side) {
  for (int row = y / kTileSide; row < std::min((y + side) / kTileSide, rows); ++row)
    for (int column = x / kTileSide; column < std::min((x + side) / kTileSide, columns); ++column)
      marked[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)] = 1;
}

bool TileSet::any(int x, int y, int side) const {
  for (int row = y / kTileSide; row < std::min((y + side) / kTileSide, rows); ++row)
    for (int column = x / kTileSide; column < std::min((x + side) / kTileSide, columns); ++column)
      if (marked[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)] != 0) return true;
  return false;
}

namespace {

void work_on_squares(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, Picture& picture,
                     PlaneFrameStats& stats, const TileSet* only, ShareStore* store, const ListsOfSquare* lists) {
  const TileTable& table = tile_table_for(active_simd());
  const int columns = (grid.width + kSides[0] - 1) / kSides[0], rows = (grid.height + kSides[0] - 1) / kSides[0];
  std::atomic<std::uint64_t> done{0}, lights{0}, blockers{0};
  tbb::parallel_for(0, columns * rows, [&](int i) {
    const int x = i % columns * kSides[0], y = i / columns * kSides[0];
    if (only != nullptr && !only->any(x, y, kSides[0])) return;
    const FlushDenormals flush;
    TileLists* own = lists != nullptr ? &(*lists)(static_cast<std::size_t>(i)) : nullptr;
    const auto worker = std::make_unique<TileWorker>(frame, grid, table, picture, only, store, own);
    worker->run(x, y);
    lights += worker->tile_lights();
    blockers += worker->tile_blockers();
    if (options.progress) options.progress(++done, static_cast<std::uint64_t>(columns * rows));
  });
  stats.tile_lights = lights;
  stats.tile_blockers = blockers;
}

}  // namespace

std::size_t squares_of(const PixelGrid& grid) {
  const auto along = [](int pixels) { return static_cast<std::size_t>((pixels + kSides[0] - 1) / kSides[0]); };
  return along(grid.width) * along(grid.height);
}

void render_tiles(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, Picture& picture,
                  PlaneFrameStats& stats, const TileSet* only, ShareStore* store) {
  work_on_squares(frame, options, grid, picture, stats, only, store, nullptr);
}

void list_tiles(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, const ListsOfSquare& lists,
                Picture& picture, PlaneFrameStats& stats) {
  work_on_squares(frame, options, grid, picture, stats, nullptr, nullptr, &lists);
}

}  // namespace steradian::plane
