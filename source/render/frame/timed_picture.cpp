#include "render/frame/timed_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/float_mode.h"
#include "render/frame/frame_surfaces.h"  // clear_area, copy_area
#include "render/shadow/few_rays.h"
#include "steradian/area_light.h"  // luminance

namespace steradian {
namespace {

constexpr std::size_t kFirstRays = 4;

}  // namespace

TimedPicture::TimedPicture(Picture& picture, double limit, Tiles tiles)
    : picture_(picture),
      limit_(limit),
      tiles_(std::move(tiles)),
      scratch_(picture),
      errors_(static_cast<std::size_t>(tiles_.count)),
      exact_(static_cast<std::size_t>(tiles_.count)) {}

void TimedPicture::render(int threads) {
  constexpr double kForRays = 0.6;  // fraction of the time that rays may take
  constexpr std::size_t kMore = 4;  // factor from step to step
  std::vector<int> order(errors_.size());
  std::iota(order.begin(), order.end(), 0);
  double expected = 0, last = 0;  // seconds of a step; the time grows by the same amount a ray
  for (std::size_t rays = kFirstRays; rays <= FewRays::kMost; rays *= kMore) {
    const bool first = rays == kFirstRays;
    const double begun = tiles_.seconds(), end = kForRays * limit_;
    if (!first && begun + expected > end) break;
    improve(order, {ShadowsBy::rays, rays}, first ? std::numeric_limits<double>::infinity() : end, threads);
    const double took = tiles_.seconds() - begun;
    expected = first ? kMore / 2 * took : took + kMore * (took - last);
    last = took;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](int i, int j) { return errors_[static_cast<std::size_t>(i)] > errors_[static_cast<std::size_t>(j)]; });
  improve(order, {}, limit_, threads);
}

// Renders tiles again, in an order, as long as the next one is likely to end in time.
void TimedPicture::improve(const std::vector<int>& order, ShadowWork work, double until, int threads) {
  std::atomic<std::size_t> next = 0;
  std::atomic<double> longest = 0;  // seconds of a tile
  tbb::parallel_for(0, threads, [&](int) {
    const FlushDenormals flush;
    while (!tiles_.stopped() && tiles_.seconds() + longest < until) {
      const std::size_t place = next++;
      if (place >= order.size()) break;
      const int index = order[place];
      const auto tile = static_cast<std::size_t>(index);
      const double begun = tiles_.seconds();
      // No limit holds for the first picture, but its last tiles go without shadows.
      const bool late = begun > limit_;
      clear_area(tiles_.area(index), scratch_);
      const double error = tiles_.render(index, late ? ShadowWork{ShadowsBy::nothing} : work, scratch_);
      if (work.by == ShadowsBy::edges && tiles_.seconds() >= limit_) break;  // the tile may have given up
      errors_[tile] = error;
      copy_area(tiles_.area(index), scratch_, picture_);
      exact_[tile] = work.by == ShadowsBy::edges;
      const double took = tiles_.seconds() - begun;
      for (double before = longest; before < took && !longest.compare_exchange_weak(before, took);) {
      }
      if (work.by == ShadowsBy::edges || work.rays == kFirstRays) tiles_.advance();
    }
  });
}

double TimedPicture::exact_tiles() const {
  return exact_.empty() ? 1 : static_cast<double>(std::count(exact_.begin(), exact_.end(), 1)) / static_cast<double>(exact_.size());
}

double TimedPicture::estimated_error() const {
  double light = 0;
  for (const Vec3f& p : picture_.pixels) light += luminance(static_cast<Vec3d>(p));
  const auto pixels = static_cast<double>(picture_.pixels.size());
  return light > 0 ? std::sqrt(std::accumulate(errors_.begin(), errors_.end(), 0.0) / pixels) / (light / pixels) : 0;
}

}  // namespace steradian
