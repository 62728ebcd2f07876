#include "render/bounce/receivers/blue_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"

namespace steradian::indirect {
namespace {

constexpr int kCount = kMaskSide * kMaskSide;
constexpr int kReach = 9;       // six standard deviations: values beyond are below float's precision
constexpr double kSigma = 1.5;  // Ulichney's value, for the Gaussian that measures crowding

// Points on a torus, and the crowding at every place.
class Crowd {
 public:
  Crowd() : taken_(kCount), energy_(kCount) {
    for (int dy = 0; dy < kWide; ++dy)
      for (int dx = 0; dx < kWide; ++dx)
        crowding_[dy][dx] = std::exp(-((dx - kReach) * (dx - kReach) + (dy - kReach) * (dy - kReach)) / (2 * kSigma * kSigma));
  }
  void set(int place, bool taken) {
    const int x = place % kMaskSide, y = place / kMaskSide;
    taken_[static_cast<std::size_t>(place)] = taken;
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const int at = (y + dy + kMaskSide) % kMaskSide * kMaskSide + (x + dx + kMaskSide) % kMaskSide;
        const double e = crowding_[dy + kReach][dx + kReach];
        energy_[static_cast<std::size_t>(at)] += taken ? e : -e;
      }
  }
  // The most crowded taken place, and the least crowded free one.
  int cluster() const { return extreme(true); }
  int gap() const { return extreme(false); }

 private:
  int extreme(bool taken) const {
    int best = -1;
    for (int i = 0; i < kCount; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (taken_[k] != taken) continue;
      if (best < 0 || (taken ? energy_[k] > energy_[static_cast<std::size_t>(best)] : energy_[k] < energy_[static_cast<std::size_t>(best)]))
        best = i;
    }
    return best;
  }
  static constexpr int kWide = 2 * kReach + 1;
  double crowding_[kWide][kWide];
  std::vector<char> taken_;
  std::vector<double> energy_;
};

Mask64 make() {
  constexpr int kSeeds = kCount / 10;
  Crowd start;
  reference::Random random(1);
  std::vector<char> used(kCount);
  for (int n = 0; n < kSeeds;) {
    const auto place = static_cast<int>(random.bits() % kCount);
    if (used[static_cast<std::size_t>(place)]) continue;
    used[static_cast<std::size_t>(place)] = 1;
    start.set(place, true);
    ++n;
  }
  for (int from = -1, to = -2; from != to;) {  // moves points from clusters into gaps until none moves
    from = start.cluster();
    start.set(from, false);
    to = start.gap();
    start.set(to, true);
  }
  Mask64 mask;
  const auto rank = [&](int place, int r) {
    mask[static_cast<std::size_t>(place / kMaskSide)][static_cast<std::size_t>(place % kMaskSide)] =
        (static_cast<float>(r) + 0.5f) / kCount;
  };
  Crowd falling = start;
  for (int r = kSeeds - 1; r >= 0; --r) {
    const int place = falling.cluster();
    falling.set(place, false);
    rank(place, r);
  }
  Crowd rising = start;
  for (int r = kSeeds; r < kCount; ++r) {
    const int place = rising.gap();
    rising.set(place, true);
    rank(place, r);
  }
  return mask;
}

}  // namespace

const Mask64& blue_noise() {
  static const Mask64 mask = make();
  return mask;
}

}  // namespace steradian::indirect
