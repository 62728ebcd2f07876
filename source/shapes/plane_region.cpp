#include "shapes/plane_region.h"

#include <algorithm>
#include <cmath>

namespace steradian {
namespace {

// Mean of clamp(x, low, high) while x runs from a to b.
double clamped_mean(double a, double b, double low, double high) {
  if (a > b) std::swap(a, b);
  if (b <= low) return low;
  if (a >= high) return high;
  if (a >= low && b <= high) return 0.5 * (a + b);
  // Three stretches: below, within and above.
  const double from = std::max(a, low), to = std::min(b, high);
  return (low * (from - a) + 0.5 * (from + to) * (to - from) + high * (b - to)) / (b - a);
}

}  // namespace

// Green's theorem: a row y of the rectangle holds the sum over the edges that cross it of the clamped x, upward edges minus downward ones,
// if the region lies on the left of an upward edge.
double PlaneRegion::area_in(const Box2d& box) const {
  double area = 0;
  for (const BoundaryEdge& e : edges_) {
    const double low = std::max(std::min(e.a.y, e.b.y), box.low.y), high = std::min(std::max(e.a.y, e.b.y), box.high.y);
    if (!(low < high)) continue;
    const double slope = (e.b.x - e.a.x) / (e.b.y - e.a.y);
    const double mean = clamped_mean(e.a.x + (low - e.a.y) * slope, e.a.x + (high - e.a.y) * slope, box.low.x, box.high.x) - box.low.x;
    area += e.b.y > e.a.y ? mean * (high - low) : -mean * (high - low);
  }
  return area;
}

}  // namespace steradian
