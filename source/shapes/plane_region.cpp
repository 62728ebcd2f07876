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

// As area_in, with the integrals of x and y over the region. An edge is cut where its x leaves the rectangle, so that the clamped x is
// linear in y along each stretch. Coordinates are relative to the rectangle's middle.
PlaneRegion::Part PlaneRegion::part_in(const Box2d& box) const {
  const Vec2d middle = {0.5 * (box.low.x + box.high.x), 0.5 * (box.low.y + box.high.y)};
  const double half_x = 0.5 * (box.high.x - box.low.x), half_y = 0.5 * (box.high.y - box.low.y);
  double area = 0, sum_x = 0, sum_y = 0;
  // From (x0, y0) to (x1, y1): Simpson's rule is exact for products of two linear functions.
  const auto add = [&](double x0, double y0, double x1, double y1) {
    const double height = y1 - y0, x = 0.5 * (x0 + x1), y = 0.5 * (y0 + y1);
    const auto of = [&](double a, double b, double c) { return height * (a + 4 * b + c) / 6; };
    area += height * (x + half_x);
    sum_x += 0.5 * of(x0 * x0 - half_x * half_x, x * x - half_x * half_x, x1 * x1 - half_x * half_x);
    sum_y += of(y0 * (x0 + half_x), y * (x + half_x), y1 * (x1 + half_x));
  };
  for (const BoundaryEdge& e : edges_) {
    const bool up = e.b.y > e.a.y;
    const Vec2d a = up ? e.a : e.b, b = up ? e.b : e.a;
    const double low = std::max(a.y - middle.y, -half_y), high = std::min(b.y - middle.y, half_y);
    if (!(low < high)) continue;
    if (std::max(a.x, b.x) <= box.low.x) continue;  // nothing lies between the rectangle's left side and the edge
    if (std::min(a.x, b.x) >= box.high.x) {         // the rectangle's whole width does
      const double height = up ? high - low : low - high;
      area += height * 2 * half_x;
      sum_y += height * half_x * (low + high);
      continue;
    }
    const double slope = (b.x - a.x) / (b.y - a.y);
    const auto x_at = [&](double y) { return a.x - middle.x + (y - (a.y - middle.y)) * slope; };
    double cuts[4] = {low, low, high, high};
    if (slope != 0)
      for (int i = 1; i < 3; ++i) {
        const double side = (i == 1) == (slope > 0) ? -half_x : half_x;
        cuts[i] = std::clamp(low + (side - x_at(low)) / slope, low, high);
      }
    for (int i = 0; i < 3; ++i) {
      if (!(cuts[i] < cuts[i + 1])) continue;
      const double x0 = std::clamp(x_at(cuts[i]), -half_x, half_x), x1 = std::clamp(x_at(cuts[i + 1]), -half_x, half_x);
      if (up)
        add(x0, cuts[i], x1, cuts[i + 1]);
      else
        add(x1, cuts[i + 1], x0, cuts[i]);
    }
  }
  if (area == 0) return {0, middle};
  return {area, {middle.x + sum_x / area, middle.y + sum_y / area}};
}

void PlaneRegion::cut_row(double low, double high, PlaneRegion& row) const {
  row.clear();
  for (const BoundaryEdge& e : edges_)
    if (std::max(e.a.y, e.b.y) > low && std::min(e.a.y, e.b.y) < high) row.add(e.a, e.b);
}

PlaneRegion PlaneRegion::turned(Vec2d x) const {
  PlaneRegion result;
  result.edges_.reserve(edges_.size());
  const auto turn = [&](Vec2d p) { return Vec2d{p.x * x.x + p.y * x.y, p.y * x.x - p.x * x.y}; };
  for (const BoundaryEdge& e : edges_) result.add(turn(e.a), turn(e.b));
  return result;
}

Box2d PlaneRegion::bounds() const {
  Box2d box;
  for (const BoundaryEdge& e : edges_) {
    box.add(e.a);
    box.add(e.b);
  }
  return box;
}

}  // namespace steradian
