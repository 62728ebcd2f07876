#include "steradian/plane_stage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <tbb/task_arena.h>

#include "core/budget.h"
#include "plane/extras/extras.h"
#include "plane/extras/frame.h"
#include "plane/frame/events/event_walk.h"
#include "plane/frame/runs/convex.h"
#include "plane/frame/tiles/tiles.h"
#include "plane/stage/preparation.h"
#include "steradian/error.h"

namespace steradian::plane {
namespace {

// A prepared scene, in the state in which it is drawn.
struct Ready {
  World world;
  Budget budget;
  Preparation prepared;
  Ready(const PlaneScene& scene, const PlaneFrameOptions& options)
      : world(scene, options.limits, World::Use::frames), budget(options.limits), prepared(world, budget, {}) {}
};

// Limits of a stage's cached shares: bytes, and the divisor of the memory limit.
constexpr std::uint64_t kMostShares = std::uint64_t{1} << 30, kShareOfMemory = 4;

// Marks the tiles that a body affects, in a frame that contains it.
class Marking {
 public:
  Marking(const FrameScene& frame, const PixelGrid& grid, TileSet& tiles, ShareStore& store)
      : frame_(frame), world_(*frame.world), grid_(grid), tiles_(tiles), store_(store) {}

  // Marks the tiles of a body that moves, is added or is removed.
  void mark(std::size_t body) {
    const Box2d& box = world_.boxes[body];
    // The pixels within bodies change, and the blocks that are filled entirely.
    for_each_tile(box.low, box.high, [&](int x, int y) {
      tiles_.mark(x, y, kTileSide);
      store_.at(x, y).kept = false;
    });
    const Vec2d middle = box.center();
    const double radius = box.radius() + kNear;
    for (std::size_t index = 0; index < frame_.emitters.size(); ++index) {
      const Emitter& e = frame_.emitters[index];
      const auto owner = static_cast<std::size_t>(e.body);
      if (owner == body) {
        mark_range(index);
        continue;
      }
      if (length(e.center - middle) > std::min(e.range, 1e8) + e.bound + radius) continue;
      // A body that overlaps a light changes its emitters, and the view from within.
      if (near(world_.boxes[owner], box))
        mark_range(index);
      else
        mark_pairs(index, static_cast<int>(body));
    }
  }

  // Marks the tiles of a light that changes its colour.
  void mark_lit(std::size_t body) {
    for (std::size_t index = 0; index < frame_.emitters.size(); ++index)
      if (static_cast<std::size_t>(frame_.emitters[index].body) == body)
        for_each_tile_in_range(frame_.emitters[index], [&](int x, int y) { tiles_.mark(x, y, kTileSide); });
  }

 private:
  static constexpr double kNear = 1e-3;
  static bool near(const Box2d& a, const Box2d& b) {
    return a.low.x <= b.high.x + kNear && b.low.x <= a.high.x + kNear && a.low.y <= b.high.y + kNear && b.low.y <= a.high.y + kNear;
  }

  TileRectangle area(int column, int row, int side) const {
    return {grid_.at(column, row) + grid_.step * (0.5 * (side - 1)), grid_.step * (0.5 * side), 0.5 * side * length(grid_.step)};
  }

  // Calls `call` for the tiles that a box comes near to.
  template <class F>
  void for_each_tile(Vec2d low, Vec2d high, F call) {
    if (!(low.x <= high.x)) return;
    const auto tile = [](double at, double step, int last) {
      return static_cast<int>(std::clamp(std::floor(at / (step * kTileSide)), -1.0, last + 1.0));
    };
    const Vec2d margin{kNear, kNear}, from = low - grid_.origin - margin, to = high - grid_.origin + margin;
    const int x1 = tile(to.x, grid_.step.x, tiles_.columns), y1 = tile(to.y, grid_.step.y, tiles_.rows);
    for (int y = std::max(tile(from.y, grid_.step.y, tiles_.rows), 0); y <= std::min(y1, tiles_.rows - 1); ++y)
      for (int x = std::max(tile(from.x, grid_.step.x, tiles_.columns), 0); x <= std::min(x1, tiles_.columns - 1); ++x)
        call(x * kTileSide, y * kTileSide);
  }

  // Calls `call` for all tiles that an emitter may light.
  template <class F>
  void for_each_tile_in_range(const Emitter& e, F call) {
    const double reach = std::min(e.range + e.bound, 1e9);
    for_each_tile(e.center - Vec2d{reach, reach}, e.center + Vec2d{reach, reach}, [&](int x, int y) {
      const TileRectangle tile = area(x, y, kTileSide);
      if (length(tile.center - e.center) <= reach + tile.radius) call(x, y);
    });
  }

  void mark_changed(std::size_t emitter, int x0, int y0, int side) {
    tiles_.mark(x0, y0, side);
    for (int y = y0; y < std::min(y0 + side, grid_.height); y += kTileSide)
      for (int x = x0; x < std::min(x0 + side, grid_.width); x += kTileSide) {
        TileShares& tile = store_.at(x, y);
        if (tile.kept) tile.changed.push_back(static_cast<int>(emitter));
      }
  }

  void mark_range(std::size_t index) {
    for_each_tile_in_range(frame_.emitters[index], [&](int x, int y) { mark_changed(index, x, y, kTileSide); });
  }

  void mark_pairs(std::size_t index, int body) {
    const Emitter& e = frame_.emitters[index];
    const bool disk = e.kind == Emitter::Kind::disk;
    for (std::size_t k = frame_.first_nearby[index]; k < frame_.first_nearby[index] + frame_.nearby_count[index]; ++k) {
      const int at = frame_.nearby.index[k];
      const int blocker = disk ? frame_.pairs[static_cast<std::size_t>(at)].blocker : at;
      if (frame_.blockers[static_cast<std::size_t>(blocker)].body != body) continue;
      if (disk)
        mark_touched(frame_, grid_, e, at, [&](int x, int y, int side) { mark_changed(index, x, y, side); });
      else
        mark_hulls(e, k, 0, 0, 256);
    }
  }

  // Marks by the hull of a square and the emitter, like the lists on the way down.
  void mark_hulls(const Emitter& e, std::size_t nearby, int x0, int y0, int side) {
    const int last = side == 256 ? 1 << 30 : 4;
    for (int j = 0; j < last && y0 + j * side < grid_.height; ++j)
      for (int i = 0; i < last && x0 + i * side < grid_.width; ++i) {
        const int x = x0 + i * side, y = y0 + j * side;
        const TileRectangle tile = area(x, y, side);
        const Vec2d axis = e.center - tile.center;
        const double reach = e.range + e.bound + tile.radius;
        if (dot(axis, axis) >= reach * reach) continue;
        found_.clear();
        found_.reserve_more(1);
        int hider = 0;
        cull_.cull(hull_of(tile, e, world_.scene.origin), frame_.nearby, nearby, nearby + 1, found_, &hider);
        if (found_.size == 0) continue;
        if (side == kTileSide)
          tiles_.mark(x, y, side);
        else
          mark_hulls(e, nearby, x, y, side / 4);
      }
  }

  const FrameScene& frame_;
  const World& world_;
  const PixelGrid& grid_;
  TileSet& tiles_;
  ShareStore& store_;
  const BlockerCullTable& cull_ = cull_table_for(active_simd());
  BlockerList found_;
};

}  // namespace
}  // namespace steradian::plane

namespace steradian {

struct PlaneStage::Impl {
  PlaneScene scene;
  PlaneFrameOptions options;
  std::unique_ptr<plane::Ready> ready;  // the prepared scene that is drawn
  // State of each body: its place in the prepared scene, -1 for a new one; its number in the scene seen last; and its changes since.
  struct State {
    int place = -1, seen = -1;
    bool changed = true, recoloured = false;
  };
  std::vector<State> states;
  std::vector<std::size_t> gone;  // places
  // Suns, mirrors and absorbing bodies add to the result of packs; clear bodies and fog change all of it.
  enum class Extras { none, added, all };
  Extras extras = Extras::none;
  std::unique_ptr<PlaneWorld> seen;    // the world as it was drawn last, if it has extras
  std::vector<std::size_t> gone_seen;  // its bodies
  bool other_sky = false;              // the scene's suns and fog differ from those drawn last
  Picture packs, added;                // the picture is their sum, if extras are added
  std::unique_ptr<plane::ShareStore> store;
  Picture picture;
  PlaneStageStats stats;

  void check(std::size_t body) const {
    if (body >= scene.bodies.size()) throw Error("body", "there is no body " + std::to_string(body));
  }
  void change(std::size_t body) {
    check(body);
    states[body].changed = true;
  }
  bool is_same() const {
    return !other_sky && gone.empty() && gone_seen.empty() &&
           std::none_of(states.begin(), states.end(), [](const State& s) { return s.changed || s.recoloured; });
  }
  void draw();
  void forget();
  void draw_by_packs(Picture& target, plane::TileSet& tiles);
  void draw_with_extras(plane::TileSet& tiles);
  plane::TileSet tiles_to_see(const PlaneWorld& now, const plane::PixelGrid& grid) const;
  void redraw(const plane::PixelGrid& grid, Picture& target, plane::TileSet& tiles);
  bool follow();
};

void PlaneStage::Impl::draw() {
  if ((ready || seen) && is_same()) {
    stats.drawn = 0;
    stats.anew = false;
    return;
  }
  const auto known = plane::extras_of(scene);
  const Extras kind = !known ? Extras::none : known->changes_frames(scene) ? Extras::all : Extras::added;
  if (kind != extras) forget();
  extras = kind;
  plane::TileSet tiles(plane::grid_of(scene, picture.width, picture.height));
  // If a scene is rejected half way, nothing is cached.
  try {
    if (kind == Extras::none)
      draw_by_packs(picture, tiles);
    else
      draw_with_extras(tiles);
  } catch (...) {
    forget();
    throw;
  }
  gone.clear();
  gone_seen.clear();
  other_sky = false;
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].changed = states[i].recoloured = false;
    states[i].seen = seen ? static_cast<int>(i) : -1;
  }
  stats.tiles = tiles.marked.size();
  stats.drawn = static_cast<std::size_t>(std::count(tiles.marked.begin(), tiles.marked.end(), 1));
}

void PlaneStage::Impl::forget() {
  ready.reset();
  seen.reset();
}

void PlaneStage::Impl::draw_by_packs(Picture& target, plane::TileSet& tiles) {
  if (!store) store = std::make_unique<plane::ShareStore>(tiles.columns, tiles.rows);
  stats.anew = !ready;
  if (!ready) {
    ready = std::make_unique<plane::Ready>(scene, options);
    std::fill(tiles.marked.begin(), tiles.marked.end(), 1);
    store->forget();
  }
  redraw(plane::grid_of(ready->world.scene, target.width, target.height), target, tiles);
}

// Tiles to which a changed body matters, in its old or its new state.
plane::TileSet PlaneStage::Impl::tiles_to_see(const PlaneWorld& now, const plane::PixelGrid& grid) const {
  plane::TileSet tiles(grid);
  const auto of = [](const PlaneWorld& world) -> const plane::Extras& { return *world.impl().extras; };
  if (!seen || other_sky || of(*seen).clear != of(now).clear || of(*seen).deep != of(now).deep ||
      of(*seen).mirrors.empty() != of(now).mirrors.empty()) {
    std::fill(tiles.marked.begin(), tiles.marked.end(), 1);
    return tiles;
  }
  std::vector<std::size_t> before = gone_seen, after;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!states[i].changed && !states[i].recoloured) continue;
    if (states[i].seen >= 0) before.push_back(static_cast<std::size_t>(states[i].seen));
    after.push_back(i);
  }
  mark_with_extras(seen->impl(), before, grid, tiles);
  mark_with_extras(now.impl(), after, grid, tiles);
  return tiles;
}

void PlaneStage::Impl::draw_with_extras(plane::TileSet& tiles) {
  auto now = std::make_unique<PlaneWorld>(scene, options.limits);
  const plane::PixelGrid grid = plane::grid_of(now->impl().scene, picture.width, picture.height);
  plane::TileSet changed = tiles_to_see(*now, grid);
  Budget budget(options.limits);
  if (extras == Extras::all) {
    stats.anew = !seen;
    plane::draw_with_extras(now->impl(), options, grid, budget, picture, &changed);
    tiles = changed;
  } else {
    for (Picture* part : {&packs, &added})
      if (part->pixels.empty()) {
        budget.take_memory(scene.name, "the parts of a stage's picture", picture.pixels.size() * sizeof(Vec3f));
        *part = Picture(picture.width, picture.height);
      }
    draw_by_packs(packs, tiles);
    clear_tiles(changed, added);
    add_extras(now->impl(), grid, budget, added, &changed);
    for (std::size_t i = 0; i < tiles.marked.size(); ++i) tiles.marked[i] |= changed.marked[i];
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        if (tiles.any(x / plane::kTileSide * plane::kTileSide, y / plane::kTileSide * plane::kTileSide, plane::kTileSide))
          picture.at(x, y) = packs.at(x, y) + added.at(x, y);
  }
  seen = std::move(now);
}

void PlaneStage::Impl::redraw(const plane::PixelGrid& grid, Picture& target, plane::TileSet& tiles) {
  const bool everything = tiles.any(0, 0, 1 << 30);
  if (!everything) {
    const double slack = ready->prepared.frame().slack;
    const bool general = ready->prepared.frame().any_general;
    plane::Marking before(ready->prepared.frame(), grid, tiles, *store);
    for (std::size_t place : gone) before.mark(place);
    for (const State& s : states)
      if (s.changed && s.place >= 0)
        before.mark(static_cast<std::size_t>(s.place));
      else if (s.recoloured && s.place >= 0)
        before.mark_lit(static_cast<std::size_t>(s.place));
    if (general || !follow()) {
      // Places and numbers are different now.
      stats.anew = true;
      ready = std::make_unique<plane::Ready>(scene, options);
      store->forget();
      for (std::size_t i = 0; i < states.size(); ++i) states[i].place = static_cast<int>(i);
    }
    const plane::FrameScene& frame = ready->prepared.frame();
    // If thresholds have moved, or lights are evaluated for every pixel, all tiles are drawn.
    if (general || frame.any_general || frame.slack != slack) std::fill(tiles.marked.begin(), tiles.marked.end(), 1);
    plane::Marking after(frame, grid, tiles, *store);
    for (const State& s : states)
      if (s.changed) after.mark(static_cast<std::size_t>(s.place));
  } else {
    for (std::size_t i = 0; i < states.size(); ++i) states[i].place = static_cast<int>(i);
  }
  PlaneFrameStats unused;
  render_tiles(ready->prepared.frame(), options, grid, target, unused, &tiles, store.get());
  store->keep_below(std::min(plane::kMostShares, options.limits.memory / plane::kShareOfMemory));
}

// Applies the scene's changes to the prepared scene. Returns false if it must be prepared anew.
bool PlaneStage::Impl::follow() {
  plane::World& world = ready->world;
  plane::Preparation& prepared = ready->prepared;
  for (std::size_t place : gone) prepared.forget(place);
  for (const State& s : states)
    if (s.changed && s.place >= 0) prepared.forget(static_cast<std::size_t>(s.place));
  for (std::size_t place : gone) {
    world.drop(place);
    prepared.drop(place);
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    State& s = states[i];
    if (!s.changed && !s.recoloured) continue;
    if (s.place < 0) {
      s.place = static_cast<int>(world.scene.bodies.size());
      if (!world.append(scene.bodies[i])) return false;
    } else if (!world.set_body(static_cast<std::size_t>(s.place), scene.bodies[i])) {
      return false;
    }
    const auto place = static_cast<std::size_t>(s.place);
    if (s.changed ? !prepared.take(place) : !prepared.recolour(place)) return false;
  }
  return prepared.finish();
}

PlaneStage::PlaneStage(PlaneScene scene, const PlaneFrameOptions& options) : impl_(std::make_unique<Impl>()) {
  if (options.method != PlaneMethod::exact || options.moments || options.bounces != nullptr || options.aa > 1 ||
      options.occluders != PlaneOccluders::black)
    throw Error("options", "a stage draws exact light alone, one value a pixel", "leave moments, bounces, aa and occluders out");
  impl_->options = options;
  impl_->states.resize(scene.bodies.size());
  impl_->picture.width = options.width > 0 ? options.width : std::max(static_cast<int>(std::lround(scene.width)), 1);
  impl_->picture.height = options.height > 0 ? options.height : std::max(static_cast<int>(std::lround(scene.height)), 1);
  if (impl_->picture.width > 65536 || impl_->picture.height > 65536)
    throw Error("size", "the picture would have more than 65536 pixels a side", "set a smaller size");
  const auto pixels = static_cast<std::uint64_t>(impl_->picture.width) * static_cast<std::uint64_t>(impl_->picture.height);
  Budget(options.limits).take_memory(scene.name, "the picture of a stage", pixels * sizeof(Vec3f));
  impl_->picture.pixels.resize(pixels);
  impl_->scene = std::move(scene);
}

PlaneStage::~PlaneStage() = default;
PlaneStage::PlaneStage(PlaneStage&&) noexcept = default;
PlaneStage& PlaneStage::operator=(PlaneStage&&) noexcept = default;

const PlaneScene& PlaneStage::scene() const { return impl_->scene; }
const PlaneStageStats& PlaneStage::stats() const { return impl_->stats; }

std::size_t PlaneStage::add(PlaneBody body) {
  impl_->scene.bodies.push_back(std::move(body));
  impl_->states.emplace_back();
  return impl_->scene.bodies.size() - 1;
}

void PlaneStage::remove(std::size_t body) {
  impl_->check(body);
  if (impl_->states[body].place >= 0) impl_->gone.push_back(static_cast<std::size_t>(impl_->states[body].place));
  if (impl_->states[body].seen >= 0) impl_->gone_seen.push_back(static_cast<std::size_t>(impl_->states[body].seen));
  impl_->scene.bodies.erase(impl_->scene.bodies.begin() + static_cast<std::ptrdiff_t>(body));
  impl_->states.erase(impl_->states.begin() + static_cast<std::ptrdiff_t>(body));
}

void PlaneStage::replace(std::size_t body, PlaneBody with) {
  impl_->change(body);
  impl_->scene.bodies[body] = std::move(with);
}

void PlaneStage::move(std::size_t body, Vec2d by) {
  impl_->change(body);
  PlaneBody& b = impl_->scene.bodies[body];
  for (auto& contour : b.contours)
    for (Vec2d& p : contour) p = p + by;
  b.center = b.center + by;
  if (b.light && b.light->gradient)
    b.light->gradient->from = b.light->gradient->from + by, b.light->gradient->to = b.light->gradient->to + by;
}

void PlaneStage::recolour(std::size_t light, Vec3d radiance) {
  impl_->check(light);
  if (!impl_->scene.bodies[light].light) throw Error("body", "is no light");
  impl_->states[light].recoloured = true;
  impl_->scene.bodies[light].light->radiance = radiance;
}

namespace {

bool alike(const PlaneGradient& a, const PlaneGradient& b) {
  const auto stops_alike = [](const PlaneStop& s, const PlaneStop& t) { return s.offset == t.offset && s.radiance == t.radiance; };
  return a.from == b.from && a.to == b.to && std::equal(a.stops.begin(), a.stops.end(), b.stops.begin(), b.stops.end(), stops_alike);
}

bool alike(const PlaneSun& a, const PlaneSun& b) {
  return a.radiance == b.radiance && a.direction == b.direction && a.half_width == b.half_width;
}

bool alike(const PlaneEmission& a, const PlaneEmission& b) {
  return a.radiance == b.radiance && a.gradient.has_value() == b.gradient.has_value() && (!a.gradient || alike(*a.gradient, *b.gradient)) &&
         a.profile == b.profile && a.range == b.range && a.spot_axis == b.spot_axis && a.spot_half_angle == b.spot_half_angle;
}

}  // namespace

bool looks_alike(const PlaneBody& a, const PlaneBody& b) {
  return a.shape == b.shape && a.contours == b.contours && a.even_odd == b.even_odd && a.center == b.center && a.x_axis == b.x_axis &&
         a.y_axis == b.y_axis && a.radius == b.radius && a.light.has_value() == b.light.has_value() &&
         (!a.light || alike(*a.light, *b.light)) && a.transmittance == b.transmittance && a.mirror == b.mirror &&
         a.light_depth == b.light_depth;
}

void PlaneStage::follow(const PlaneScene& next) {
  PlaneScene& now = impl_->scene;
  if (now.fog_density != next.fog_density || !std::equal(now.suns.begin(), now.suns.end(), next.suns.begin(), next.suns.end(),
                                                         [](const auto& a, const auto& b) { return alike(a, b); })) {
    now.fog_density = next.fog_density;
    now.suns = next.suns;
    impl_->other_sky = true;
  }
  const std::size_t kept = std::min(next.bodies.size(), scene().bodies.size());
  for (std::size_t i = 0; i < kept; ++i)
    if (!looks_alike(scene().bodies[i], next.bodies[i])) replace(i, next.bodies[i]);
  while (scene().bodies.size() > next.bodies.size()) remove(scene().bodies.size() - 1);
  for (std::size_t i = kept; i < next.bodies.size(); ++i) add(next.bodies[i]);
}

const Picture& PlaneStage::draw() {
  const auto start = std::chrono::steady_clock::now();
  tbb::task_arena arena(impl_->options.threads > 0 ? impl_->options.threads : tbb::task_arena::automatic);
  arena.execute([&] { impl_->draw(); });
  impl_->stats.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return impl_->picture;
}

}  // namespace steradian
