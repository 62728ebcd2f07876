// A frame by tile recursion: 256, 128, 64, 32, 16 pixels. At every level a light keeps only the blockers that touch the
// hull of tile and light, and is dropped where one of them hides it from all of the tile.
#include "plane/frame/tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include "core/float_mode.h"
#include "plane/frame/event_walk.h"
#include "plane/frame/hull.h"
#include "plane/frame/leaf.h"
#include "plane/frame/runs.h"

namespace steradian::plane {
namespace {

constexpr int kSides[] = {256, 128, 64, 32, kTileSide};
constexpr int kLevels = 5;

// Does the convex blocker hide the emitter from all of the tile? Its chord between the vertices furthest to either side
// must separate the two, and its ends lie beyond every line from the tile to the light.
bool hides(const Vec2d* v, std::size_t count, const Emitter& e, const TileArea& tile) {
  const Vec2d axis = e.center - tile.center;
  Vec2d left = v[0], right = v[0];
  for (std::size_t k = 1; k < count; ++k) {
    if (cross(axis, v[k]) > cross(axis, left)) left = v[k];
    if (cross(axis, v[k]) < cross(axis, right)) right = v[k];
  }
  const Vec2d chord = right - left;
  const double size = length(chord);
  if (size == 0) return false;
  for (Vec2d end : {e.a, e.b})
    // The light beyond the chord, not on it: of coincident edges the light's is seen.
    if (cross(chord, end - left) <= (e.radius + 1e-9) * size) return false;
  for (double sx : {-1.0, 1.0})
    for (double sy : {-1.0, 1.0}) {
      const Vec2d corner{tile.center.x + sx * tile.half.x, tile.center.y + sy * tile.half.y};
      if (cross(chord, corner - left) >= 0) return false;
      const Vec2d to_left = left - corner, to_right = right - corner;
      for (Vec2d end : {e.a, e.b}) {
        const double past_left = -cross(to_left, end - corner), past_right = cross(to_right, end - corner);
        if (past_left <= 0 || past_left * past_left < e.radius * e.radius * dot(to_left, to_left)) return false;
        if (past_right <= 0 || past_right * past_right < e.radius * e.radius * dot(to_right, to_right)) return false;
      }
    }
  return true;
}

struct Entry {
  int emitter;
  std::size_t begin, end;  // its blockers in the level's list
  std::size_t group = 1;   // with the entries of what it stands for, which follow it; a run without them faces all of the tile
};

struct Level {
  std::vector<Entry> entries;
  BlockerList blockers;
  std::vector<int> bodies;   // whose boxes touch the tile
  std::vector<int> general;  // general lights in range
};

// One thread's work.
class Worker {
 public:
  // lists: null for the packs.
  Worker(const FrameScene& frame, const PixelGrid& grid, const TileTable& table, Picture& picture, const TileSet* only, ShareStore* store,
         TileLists* lists)
      : only_(only),
        lists_(lists),
        frame_(frame),
        world_(*frame.world),
        grid_(grid),
        table_(table),
        picture_(picture),
        leaf_(frame),
        events_(frame, grid, only, store) {
    if (lists != nullptr && lists->elsewhere() != nullptr) events_.leave_out(*lists->elsewhere());
    std::fill(std::begin(inside_), std::end(inside_), kOutside);
    for (int y = 0; y < kTileSide; ++y)
      for (int x = 0; x < kTileSide; ++x) {
        buffer_.x[TileBuffer::slot(x, y)] = static_cast<float>((x - 0.5 * (kTileSide - 1)) * grid_.step.x);
        buffer_.y[TileBuffer::slot(x, y)] = static_cast<float>((y - 0.5 * (kTileSide - 1)) * grid_.step.y);
      }
  }

  void run(int x, int y) {
    Level& top = levels_[0];
    top.entries.clear();
    top.blockers.clear();
    top.bodies.clear();
    top.general.clear();
    const TileArea tile = area(x, y, kSides[0]);
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
    tile_lights += events_.tile_lights;
    tile_blockers += events_.tile_blockers;
  }

  std::uint64_t tile_lights = 0, tile_blockers = 0;

 private:
  TileArea area(int x, int y, int side) const {
    return {grid_.at(x, y) + grid_.step * (0.5 * (side - 1)), grid_.step * (0.5 * side), 0.5 * side * length(grid_.step)};
  }

  bool touches(const Box& box, const TileArea& t) const {
    return box.low.x <= t.center.x + t.half.x && box.high.x >= t.center.x - t.half.x && box.low.y <= t.center.y + t.half.y &&
           box.high.y >= t.center.y - t.half.y;
  }
  bool in_range(std::size_t body, const TileArea& t) const {
    const Box& b = world_.boxes[body];
    const Vec2d gap{std::max({b.low.x - t.center.x - t.half.x, 0.0, t.center.x - t.half.x - b.high.x}),
                    std::max({b.low.y - t.center.y - t.half.y, 0.0, t.center.y - t.half.y - b.high.y})};
    return length(gap) < world_.scene.bodies[body].light->range;
  }

  // Appends an emitter; of a run that does not face all of the tile, what it stands for, too.
  void take_first(std::size_t index, const TileArea& tile, Level& to) {
    const Emitter& e = frame_.emitters[index];
    const bool whole = frame_.whole_run[index] != 0;
    const Facing faces = is_run(e) ? facing(&e, tile) : Facing::all;
    if (faces == Facing::none) return;
    const std::size_t at = to.entries.size();
    if (!is_run(e) || whole) {
      if (!filter(static_cast<int>(index), frame_.nearby, frame_.first_nearby[index],
                  frame_.first_nearby[index] + frame_.nearby_count[index], tile, to))
        return;
      if (faces == Facing::all) return;
    }
    for (std::size_t k = index + 1; k < index + e.group; k += frame_.emitters[k].group) take_first(k, tile, to);
    if (whole) close_group(at, to);
  }

  // The same of entries of the level above, the first one and what it stands for.
  void take(const Level& from, std::size_t first, const TileArea& tile, Level& to) {
    const Entry& entry = from.entries[first];
    const Facing faces = entry.group > 1 ? facing(&frame_.emitters[static_cast<std::size_t>(entry.emitter)], tile) : Facing::all;
    if (faces == Facing::none) return;
    const std::size_t at = to.entries.size();
    if (!filter(entry.emitter, from.blockers, entry.begin, entry.end, tile, to) || faces == Facing::all) return;
    for (std::size_t k = first + 1; k < first + entry.group; k += from.entries[k].group) take(from, k, tile, to);
    close_group(at, to);
  }

  // A run of which nothing else is left goes, too.
  static void close_group(std::size_t at, Level& to) {
    const std::size_t group = to.entries.size() - at;
    if (group == 1)
      to.entries.pop_back();
    else
      to.entries[at].group = group;
  }

  // Appends the emitter with those of from[begin, end) that touch the hull of it and the tile, unless it cannot be seen: then false.
  bool filter(int index, const BlockerList& from, std::size_t begin, std::size_t end, const TileArea& tile, Level& to) {
    const Emitter& e = frame_.emitters[static_cast<std::size_t>(index)];
    const double half = tile.radius, bound = e.bound;
    const Vec2d axis = e.center - tile.center;
    const double length2 = dot(axis, axis), reach = e.range + bound + half;
    if (e.hidden || length2 >= reach * reach) return false;
    if (e.kind == Emitter::Kind::arc && !e.whole && faces_away(e, tile)) return false;
    if (e.kind == Emitter::Kind::edge && !is_run(e)) {
      const Vec2d n = e.normal;
      if (dot(n, tile.center - e.a) + std::fabs(n.x) * tile.half.x + std::fabs(n.y) * tile.half.y <= 0) return false;
    }
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

  // Is the arc on the far side of its ellipse for all of the tile? Seen are the places n of the unit circle with n . p > 1:
  // some of an arc if one of its ends, or, from its middle's side, others.
  static bool faces_away(const Emitter& arc, const TileArea& tile) {
    const double det = cross(arc.ellipse.x, arc.ellipse.y);
    const Vec2d center = arc.ellipse.to_unit(tile.center);
    const auto most = [&](double tau) {
      const Vec2d n{std::cos(tau), std::sin(tau)};
      const Vec2d along{n.x * arc.ellipse.y.y - n.y * arc.ellipse.x.y, n.y * arc.ellipse.x.x - n.x * arc.ellipse.y.x};
      return dot(n, center) + (std::fabs(along.x) * tile.half.x + std::fabs(along.y) * tile.half.y) / det;
    };
    return most(arc.tau0) <= 1 && most(arc.tau0 + arc.tau_span) <= 1 && most(arc.tau0 + 0.5 * arc.tau_span) <= 0;
  }

  bool hides(int blocker, const Emitter& e, const TileArea& tile) const {
    const Blocker& b = frame_.blockers[static_cast<std::size_t>(blocker)];
    // Within a chain's hull, its edges are seen, or not.
    if (b.edges != 0 && length(b.center - tile.center) < b.bound + tile.radius) return false;
    return plane::hides(&frame_.vertices[b.first], b.count, e, tile);
  }

  // Fills a tile that one convex occluder holds all of.
  bool stays_dark(const Level& level, int x0, int y0, int side) {
    const int x1 = std::min(x0 + side, grid_.width) - 1, y1 = std::min(y0 + side, grid_.height) - 1;
    for (int i : level.bodies) {
      const std::size_t k = static_cast<std::size_t>(i);
      const auto holds = [&](int x, int y) { return world_.boxes[k].holds(grid_.at(x, y)) && world_.contains(k, grid_.at(x, y)); };
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
        const TileArea tile = area(x + dx, y + dy, side);
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
    const TileArea tile = area(x0, y0, kTileSide);
    tile_ = tile;
    interior_body_ = -1;
    std::fill(std::begin(buffer_.red), std::end(buffer_.red), 0.0f);
    std::fill(std::begin(buffer_.green), std::end(buffer_.green), 0.0f);
    std::fill(std::begin(buffer_.blue), std::end(buffer_.blue), 0.0f);
    leaf_.enter(tile);
    const unsigned wanted = only_ == nullptr || only_->blocks.empty() ? kAllBlocks : only_->blocks_of(x0, y0);
    mark_inside(level, x0, y0);
    if (lists_ != nullptr) lists_->begin_tile(x0, y0, tile.center);
    // Where something fills every pixel, no light arrives from outside.
    const bool filled =
        marked_.size() == static_cast<std::size_t>(std::min(kTileSide, grid_.width - x0) * std::min(kTileSide, grid_.height - y0));
    for (const Entry& e : level.entries) {
      if (filled) break;
      if (e.group > 1) continue;  // some of its edges face away: they follow one by one
      const auto [light, visible] =
          leaf_.build(frame_.emitters[static_cast<std::size_t>(e.emitter)], level.blockers.index.data() + e.begin, e.end - e.begin);
      if (!visible) continue;
      if (lists_ != nullptr)
        lists_->add(light);
      else
        table_.add_light(light, buffer_, wanted);
      ++tile_lights;
      tile_blockers += static_cast<std::uint64_t>(light.low_count + light.high_count + light.low_disk_count + light.high_disk_count +
                                                  light.disk_count + light.span_count + light.body_count + light.chord_count +
                                                  light.deep_count + light.round_count + light.lens_count);
    }
    if (!filled && lists_ != nullptr)
      events_.list_lights(x0, y0, tile, *lists_, leaf_);
    else if (!filled)
      events_.add_lights(x0, y0, tile, open_blocks() & wanted, buffer_, leaf_);
    if (lists_ != nullptr) lists_->end_tile(filled_pixels());
    table_.write(buffer_, std::min(kTileSide, grid_.width - x0), std::min(kTileSide, grid_.height - y0), &picture_.at(x0, y0).x,
                 3 * static_cast<std::size_t>(grid_.width));
    for (int i : marked_) {
      const int x = x0 + i % kTileSide, y = y0 + i / kTileSide, inside = inside_[i];
      picture_.at(x, y) = inside == kDark ? Vec3f{} : static_cast<Vec3f>(interior(static_cast<std::size_t>(inside), grid_.at(x, y)));
    }
    if (!level.general.empty()) add_general(level, tile, x0, y0);
    for (int i : marked_) inside_[i] = kOutside;
    marked_.clear();
  }

  std::bitset<kTilePixels> filled_pixels() const {
    std::bitset<kTilePixels> filled;
    for (int i : marked_) filled.set(static_cast<std::size_t>(i));
    return filled;
  }

  // Blocks of which something is not filled.
  std::uint32_t open_blocks() const {
    int filled[16] = {};
    for (int i : marked_) ++filled[i / kTileSide / 4 * 4 + i % kTileSide / 4];
    std::uint32_t open = 0;
    for (int b = 0; b < 16; ++b) open |= std::uint32_t{filled[b] < 16} << b;
    return open;
  }

  // Lights without a rule of their own, one by one: the envelope of what touches the hull of tile and light.
  void add_general(const Level& level, const TileArea& tile, int x0, int y0) {
    for (int light : level.general) {
      collect_general_curves(static_cast<std::size_t>(light), tile);
      for (int y = 0; y < kTileSide && y0 + y < grid_.height; ++y)
        for (int x = 0; x < kTileSide && x0 + x < grid_.width; ++x)
          if (inside_[y * kTileSide + x] == kOutside)
            picture_.at(x0 + x, y0 + y) += static_cast<Vec3f>(
                envelope_light_of(world_, general_curves_, grid_.at(x0 + x, y0 + y), light, EmissionParts::radiance).radiance);
    }
  }

  Vec3d interior(std::size_t body, Vec2d p) {
    if (!frame_.shines_within) return {};
    const LightInterior& inside = frame_.interior[body];
    if (inside.curves.empty()) return radiance_at(*world_.scene.bodies[body].light, p);
    if (inside.by_chords) return radiance_at(*world_.scene.bodies[body].light, p) * open_share(inside.chords, p);
    if (inside.by_parts) return light_between(world_, inside.parts, p, static_cast<int>(body));
    if (inside.in_polygon) return interior_of_polygon(inside, body, p);
    if (static_cast<int>(body) != interior_body_) {
      interior_body_ = static_cast<int>(body);
      interior_curves_ = curves_that_matter_within(inside.curves, inside.own, tile_.center, tile_.radius);
    }
    const std::size_t own = interior_curves_.size() - (inside.curves.size() - inside.own);
    return envelope_light(world_, curves_that_matter_within(interior_curves_, own, p, 0), p, static_cast<int>(body),
                          EmissionParts::radiance)
        .radiance;
  }

  Vec3d interior_of_polygon(const LightInterior& inside, std::size_t body, Vec2d p) {
    if (static_cast<int>(body) != interior_body_) {
      interior_body_ = static_cast<int>(body);
      seen_within_ = seen_within(inside, tile_.center, tile_.radius);
    }
    const auto own = [&] { return radiance_at(*world_.scene.bodies[body].light, p); };
    if (seen_within_.curves.empty()) return own();
    keep_seen_from(seen_within_, p, seen_from_);
    if (seen_from_.curves.size() == seen_from_.own) return own();
    // Dark and not hidden from the point: what they take needs no depth.
    const auto is_dark = [&](const Curve* c) {
      return c->kind == Curve::Kind::segment && !world_.scene.bodies[static_cast<std::size_t>(c->body)].light;
    };
    if (seen_from_.own == 0 && std::all_of(seen_from_.curves.begin(), seen_from_.curves.end(), is_dark))
      return own() * open_share(seen_from_.curves, p);
    return envelope_light(world_, seen_from_.curves, p, static_cast<int>(body), EmissionParts::radiance).radiance;
  }

  // Which body fills each pixel: in double and by the same test as a query.
  void mark_inside(const Level& level, int x0, int y0) {
    const int columns = std::min(kTileSide, grid_.width - x0), rows = std::min(kTileSide, grid_.height - y0);
    int dark = 0;
    for (int index : level.bodies) {
      if (dark == columns * rows) return;
      const PlaneBody& body = world_.scene.bodies[static_cast<std::size_t>(index)];
      const Box& box = world_.boxes[static_cast<std::size_t>(index)];
      const Vec2d first = grid_.at(x0, y0);
      const auto low = [](double at, double origin, double step) {
        return static_cast<int>(std::ceil(std::clamp((at - origin) / step - 1e-9, 0.0, 1.0 * kTileSide)));
      };
      const auto high = [](double at, double origin, double step, int count) {
        return static_cast<int>(std::floor(std::min((at - origin) / step + 1e-9, count - 1.0)));
      };
      const int x0_box = low(box.low.x, first.x, grid_.step.x), x1_box = high(box.high.x, first.x, grid_.step.x, columns);
      for (int y = low(box.low.y, first.y, grid_.step.y); y <= high(box.high.y, first.y, grid_.step.y, rows); ++y) {
        const auto within = [&](int x) { return world_.contains(static_cast<std::size_t>(index), grid_.at(x0 + x, y0 + y)); };
        const auto mark = [&](int x) {
          int& inside = inside_[y * kTileSide + x];
          if (inside == kOutside) marked_.push_back(y * kTileSide + x);
          if (inside == kDark) return;
          inside = body.light ? index : kDark;
          dark += inside == kDark ? 1 : 0;
        };
        int begin = x0_box, end = x1_box;
        if (frame_.convex[static_cast<std::size_t>(index)] != 0) {
          guess_row(body, grid_.at(x0, y0 + y).y, first.x, begin, end);
          while (begin <= end && !within(begin)) ++begin;
          while (end > begin && !within(end)) --end;
          for (int x = begin; x <= end; ++x) mark(x);
        } else {
          for (int x = begin; x <= end; ++x)
            if (within(x)) mark(x);
        }
      }
    }
  }

  // Narrows a row of a convex polygon to a pixel beyond where its edges cross it: the exact test decides what is left.
  void guess_row(const PlaneBody& body, double y, double first, int& begin, int& end) const {
    if (body.shape != PlaneBody::Shape::polygon) return;
    const std::vector<Vec2d>& contour = body.contours[0];
    double low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2d a = contour[i], b = contour[i + 1 < contour.size() ? i + 1 : 0];
      if ((a.y < y && b.y < y) || (a.y > y && b.y > y)) continue;
      const double t = a.y == b.y ? 0 : (y - a.y) / (b.y - a.y), x = a.x + t * (b.x - a.x);
      low = std::min({low, x, a.y == b.y ? b.x : x});
      high = std::max({high, x, a.y == b.y ? b.x : x});
    }
    if (low > high) return;
    begin = std::max(begin, static_cast<int>(std::ceil(std::max(low - first, -1e6) / grid_.step.x - 1e-6)));
    end = std::min(end, static_cast<int>(std::floor(std::min(high - first, 1e6) / grid_.step.x + 1e-6)));
  }

  void collect_general_curves(std::size_t light, const TileArea& tile) {
    const auto middle = [](const Box& b) { return (b.low + b.high) * 0.5; };
    const auto radius = [](const Box& b) { return 0.5 * length(b.high - b.low); };
    const Vec2d to = middle(world_.boxes[light]) - tile.center;
    const double size = radius(world_.boxes[light]), wide = std::max(size, tile.radius), l2 = dot(to, to);
    general_curves_.clear();
    for (std::size_t i = 0; i < world_.boxes.size(); ++i) {
      // Within the wider of the two radii of the line between the two.
      const Vec2d at = middle(world_.boxes[i]) - tile.center;
      const double t = l2 > 0 ? std::clamp(dot(at, to) / l2, 0.0, 1.0) : 0, limit = wide + radius(world_.boxes[i]);
      const Vec2d away = at - to * t;
      if (i != light && dot(away, away) > limit * limit) continue;
      for (std::size_t c = world_.first_curve[i]; c < world_.first_curve[i + 1]; ++c) general_curves_.push_back(&world_.curves[c]);
    }
  }

  static constexpr int kOutside = -1, kDark = -2;
  const TileSet* only_;
  TileLists* lists_;
  const FrameScene& frame_;
  const World& world_;
  const PixelGrid& grid_;
  const TileTable& table_;
  Picture& picture_;
  LeafBuilder leaf_;
  EventWalk events_;
  const CullTable& cull_ = cull_table_for(active_simd());
  std::vector<int> hiders_;
  Level levels_[kLevels];
  TileBuffer buffer_;
  int inside_[kTilePixels];  // what fills each pixel, row by row
  std::vector<int> marked_;  // those that something fills
  std::vector<const Curve*> general_curves_;
  TileArea tile_;
  int interior_body_ = -1;  // whose curves these are, of those that matter to the tile
  std::vector<const Curve*> interior_curves_;
  SeenWithin seen_within_, seen_from_;  // of a polygon: the tile, a pixel
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
    if (only != nullptr && !only->any(i % columns * kSides[0], i / columns * kSides[0], kSides[0])) return;
    const FlushDenormals flush;
    TileLists* own = lists != nullptr ? &(*lists)(static_cast<std::size_t>(i)) : nullptr;
    const auto worker = std::make_unique<Worker>(frame, grid, table, picture, only, store, own);
    worker->run(i % columns * kSides[0], i / columns * kSides[0]);
    lights += worker->tile_lights;
    blockers += worker->tile_blockers;
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
