#include "steradian/plane_stage.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "core/budget.h"
#include "plane/frame/event_walk.h"
#include "plane/frame/hull.h"
#include "plane/frame/tiles.h"
#include "steradian/error.h"

namespace steradian::plane {
namespace {

// A scene made ready, and its frame.
struct Ready {
  PlaneWorld world;
  FrameScene frame;
  Ready(const PlaneScene& scene, const PlaneFrameOptions& options) : world(scene, options.limits) {
    Budget budget(options.limits);
    frame = prepare_frame(world.impl(), budget);
  }
};

// Marks what a body has to do with in a frame of which it is part.
class Marking {
 public:
  Marking(const FrameScene& frame, const PixelGrid& grid, TileSet& tiles)
      : frame_(frame), world_(*frame.world), grid_(grid), tiles_(tiles) {}

  void mark(std::size_t body) {
    const Box& box = world_.boxes[body];
    mark_box(box.low, box.high);
    for (std::size_t index = 0; index < frame_.emitters.size(); ++index) {
      const Emitter& e = frame_.emitters[index];
      const auto owner = static_cast<std::size_t>(e.body);
      // What overlaps a light changes how it is taken apart, and what is seen from within.
      if (owner == body || near(world_.boxes[owner], box))
        mark_range(e);
      else
        mark_pairs(index, static_cast<int>(body));
    }
  }

 private:
  static constexpr double kNear = 1e-3;
  static bool near(const Box& a, const Box& b) {
    return a.low.x <= b.high.x + kNear && b.low.x <= a.high.x + kNear && a.low.y <= b.high.y + kNear && b.low.y <= a.high.y + kNear;
  }

  TileArea area(int column, int row, int side) const {
    return {grid_.at(column, row) + grid_.step * (0.5 * (side - 1)), grid_.step * (0.5 * side), 0.5 * side * length(grid_.step)};
  }

  // Tiles that a box touches, and those around them.
  void mark_box(Vec2d low, Vec2d high) {
    const auto tile = [](double at, double step, int last) {
      return static_cast<int>(std::clamp(std::floor(at / (step * kTileSide)), -1.0, last + 1.0));
    };
    const Vec2d from = low - grid_.origin, to = high - grid_.origin;
    const int x1 = tile(to.x, grid_.step.x, tiles_.columns) + 1, y1 = tile(to.y, grid_.step.y, tiles_.rows) + 1;
    for (int y = std::max(tile(from.y, grid_.step.y, tiles_.rows) - 1, 0); y <= std::min(y1, tiles_.rows - 1); ++y)
      for (int x = std::max(tile(from.x, grid_.step.x, tiles_.columns) - 1, 0); x <= std::min(x1, tiles_.columns - 1); ++x)
        tiles_.mark(x * kTileSide, y * kTileSide, kTileSide);
  }

  void mark_range(const Emitter& e) {
    const double reach = std::min(e.range + e.bound, 1e9);
    mark_box(e.center - Vec2d{reach, reach}, e.center + Vec2d{reach, reach});
  }

  void mark_pairs(std::size_t index, int body) {
    const Emitter& e = frame_.emitters[index];
    const bool disk = e.kind == Emitter::Kind::disk;
    for (std::size_t k = frame_.first_nearby[index]; k < frame_.first_nearby[index + 1]; ++k) {
      const int at = frame_.nearby.index[k];
      const int blocker = disk ? frame_.pairs[static_cast<std::size_t>(at)].blocker : at;
      if (frame_.blockers[static_cast<std::size_t>(blocker)].body != body) continue;
      if (disk)
        mark_touched(frame_, grid_, e, at, tiles_);
      else
        mark_hulls(e, k, 0, 0, 256);
    }
  }

  // By the hull of a square and the emitter, as lists are made on the way down.
  void mark_hulls(const Emitter& e, std::size_t nearby, int x0, int y0, int side) {
    const int last = side == 256 ? 1 << 30 : 4;
    for (int j = 0; j < last && y0 + j * side < grid_.height; ++j)
      for (int i = 0; i < last && x0 + i * side < grid_.width; ++i) {
        const int x = x0 + i * side, y = y0 + j * side;
        const TileArea tile = area(x, y, side);
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
  const CullTable& cull_ = cull_table_for(active_simd());
  BlockerList found_;
};

}  // namespace
}  // namespace steradian::plane

namespace steradian {

struct PlaneStage::Impl {
  PlaneScene scene;
  PlaneFrameOptions options;
  std::unique_ptr<plane::Ready> ready;  // what is drawn
  // Of the bodies: where each was when it was drawn; -1: it is new, or has changed. Those that are gone.
  std::vector<int> drawn_as;
  std::vector<std::size_t> gone;
  Picture picture;
  PlaneStageStats stats;

  void check(std::size_t body) const {
    if (body >= scene.bodies.size()) throw Error("body", "there is no body " + std::to_string(body));
  }
  void change(std::size_t body) {
    check(body);
    if (drawn_as[body] >= 0) gone.push_back(static_cast<std::size_t>(drawn_as[body]));
    drawn_as[body] = -1;
  }
  void draw();
};

void PlaneStage::Impl::draw() {
  const bool same = std::all_of(drawn_as.begin(), drawn_as.end(), [](int i) { return i >= 0; }) && gone.empty();
  if (ready && same) {
    stats.drawn = 0;
    return;
  }
  auto next = std::make_unique<plane::Ready>(scene, options);
  const plane::World& world = next->world.impl();
  const plane::PixelGrid grid = plane::grid_of(world.scene, picture.width, picture.height);
  plane::TileSet tiles(grid);
  // Thresholds that have moved, and lights that are asked of every pixel, spare no tile.
  const bool anew = !ready || next->frame.slack != ready->frame.slack || next->frame.any_general || ready->frame.any_general;
  if (anew) {
    std::fill(tiles.marked.begin(), tiles.marked.end(), 1);
  } else {
    plane::Marking before(ready->frame, grid, tiles), after(next->frame, grid, tiles);
    for (std::size_t body : gone) before.mark(body);
    for (std::size_t body = 0; body < drawn_as.size(); ++body)
      if (drawn_as[body] < 0) after.mark(body);
  }
  PlaneFrameStats unused;
  render_tiles(next->frame, options, grid, picture, unused, &tiles);
  ready = std::move(next);
  gone.clear();
  for (std::size_t i = 0; i < drawn_as.size(); ++i) drawn_as[i] = static_cast<int>(i);
  stats.tiles = tiles.marked.size();
  stats.drawn = static_cast<std::size_t>(std::count(tiles.marked.begin(), tiles.marked.end(), 1));
}

PlaneStage::PlaneStage(PlaneScene scene, const PlaneFrameOptions& options) : impl_(std::make_unique<Impl>()) {
  if (options.method != PlaneMethod::exact || options.moments || options.bounces != nullptr || options.aa > 1 ||
      options.occluders != PlaneOccluders::black)
    throw Error("options", "a stage draws exact light alone, one value a pixel", "leave moments, bounces, aa and occluders out");
  impl_->options = options;
  impl_->drawn_as.assign(scene.bodies.size(), -1);
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
  impl_->drawn_as.push_back(-1);
  return impl_->scene.bodies.size() - 1;
}

void PlaneStage::remove(std::size_t body) {
  impl_->change(body);
  impl_->scene.bodies.erase(impl_->scene.bodies.begin() + static_cast<std::ptrdiff_t>(body));
  impl_->drawn_as.erase(impl_->drawn_as.begin() + static_cast<std::ptrdiff_t>(body));
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
  impl_->change(light);
  impl_->scene.bodies[light].light->radiance = radiance;
}

const Picture& PlaneStage::draw() {
  const auto start = std::chrono::steady_clock::now();
  tbb::task_arena arena(impl_->options.threads > 0 ? impl_->options.threads : tbb::task_arena::automatic);
  arena.execute([&] { impl_->draw(); });
  impl_->stats.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return impl_->picture;
}

}  // namespace steradian
