// Ranges of slopes that are still free, disjoint and rising.
#pragma once

#include <algorithm>
#include <vector>

namespace steradian::plane {

// The first range that ends after a slope.
template <class Gap>
typename std::vector<Gap>::iterator gap_after(std::vector<Gap>& gaps, double slope) {
  return std::partition_point(gaps.begin(), gaps.end(), [slope](const Gap& gap) { return gap.end <= slope; });
}

// Takes the free parts between two slopes.
//
//   Gap                     has begin and end
//   taken(gap, begin, end)  is called for each piece; returns the range that may remain above it, from +end+ to the range's end
template <class Gap, class Taken>
void take_between(std::vector<Gap>& gaps, double begin, double end, Taken taken) {
  auto gap = gap_after(gaps, begin);
  while (gap != gaps.end() && gap->begin < end) {
    const double low = std::max(gap->begin, begin), high = std::min(gap->end, end);
    const bool left = low > gap->begin, right = high < gap->end;
    const Gap above = taken(*gap, low, high);
    if (left && right) {
      gap->end = low;
      gaps.insert(gap + 1, above);
      return;
    }
    if (right) {
      *gap = above;
      return;
    }
    if (left) {
      gap->end = low;
      ++gap;
    } else {
      gap = gaps.erase(gap);
    }
  }
}

}  // namespace steradian::plane
