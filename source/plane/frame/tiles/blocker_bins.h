// Blockers by place: a grid of 33 x 33 bins over a window; bins at its border are open to the outside. A search finds them in an order that
// does not depend on other blockers. Blockers represent their parts.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "plane/frame/scene.h"

namespace steradian::plane {

class BlockerBins {
 public:
  BlockerBins() = default;
  BlockerBins(const std::vector<Blocker>& blockers, const Box2d& window) {
    for (const Blocker& b : blockers)
      if (b.level == 0) largest_ = std::max(largest_, b.bound);
    low_ = window.low;
    cell_ = std::max({window.high.x - window.low.x, window.high.y - window.low.y, 1e-6}) / 32;
    bins_.resize(33 * 33);
    for (std::size_t i = 0; i < blockers.size(); ++i)
      if (blockers[i].level == 0) bins_[bin(blockers[i].center)].push_back(static_cast<int>(i));
  }

  void remove(int index, const Blocker& b) { std::erase(bins_[bin(b.center)], index); }
  void insert(int index, const Blocker& b) {
    largest_ = std::max(largest_, b.bound);
    std::vector<int>& to = bins_[bin(b.center)];
    to.insert(std::upper_bound(to.begin(), to.end(), index), index);
  }

  // Calls f with the index of every blocker within `reach` of p.
  template <class F>
  void for_each_within(const std::vector<Blocker>& blockers, Vec2d p, double reach, F f) const {
    const double r = std::min(reach + largest_, 1e9);
    for (int y = cell(std::max(p.y - r - low_.y, 0.0)); y <= cell(std::clamp(p.y + r - low_.y, 0.0, 64 * cell_)); ++y)
      for (int x = cell(std::max(p.x - r - low_.x, 0.0)); x <= cell(std::clamp(p.x + r - low_.x, 0.0, 64 * cell_)); ++x)
        for (int i : bins_[static_cast<std::size_t>(y * 33 + x)]) {
          const Blocker& b = blockers[static_cast<std::size_t>(i)];
          const Vec2d away = b.center - p;
          const double limit = reach + b.bound;
          if (dot(away, away) < limit * limit) f(i);
        }
  }

 private:
  friend class BinCounts;
  int cell(double offset) const { return std::clamp(static_cast<int>(offset / cell_), 0, 32); }
  std::size_t bin(Vec2d p) const { return static_cast<std::size_t>(cell(p.y - low_.y) * 33 + cell(p.x - low_.x)); }

  std::vector<std::vector<int>> bins_;
  Vec2d low_;
  double cell_ = 1, largest_ = 0;
};

// Upper bounds of the number of blockers that for_each_within visits: sums over rectangles of bins.
class BinCounts {
 public:
  explicit BinCounts(const BlockerBins& bins) : bins_(bins), sum_(34 * 34, 0) {
    for (std::size_t y = 0; y < 33; ++y)
      for (std::size_t x = 0; x < 33; ++x)
        sum_[(y + 1) * 34 + x + 1] = bins.bins_[y * 33 + x].size() + sum_[y * 34 + x + 1] + sum_[(y + 1) * 34 + x] - sum_[y * 34 + x];
  }
  std::size_t within(Vec2d p, double reach) const {
    const double r = std::min(reach + bins_.largest_, 1e9);
    const auto low = [&](double at) { return static_cast<std::size_t>(bins_.cell(std::max(at - r, 0.0))); };
    const auto high = [&](double at) { return static_cast<std::size_t>(bins_.cell(std::clamp(at + r, 0.0, 64 * bins_.cell_))) + 1; };
    const Vec2d at = p - bins_.low_;
    const std::size_t x0 = low(at.x), x1 = high(at.x), y0 = low(at.y), y1 = high(at.y);
    return sum_[y1 * 34 + x1] - sum_[y0 * 34 + x1] - sum_[y1 * 34 + x0] + sum_[y0 * 34 + x0];
  }

 private:
  const BlockerBins& bins_;
  std::vector<std::size_t> sum_;
};

}  // namespace steradian::plane
