#include "plane/svg/clip.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "plane/exact/edge_rows.h"
#include "plane/svg/stroke.h"

namespace steradian::plane::svg {
namespace {

using std::numbers::pi;
using Contour = std::vector<Vec2d>;

struct Shape {
  EdgeRows rows;
  bool even_odd;
  explicit Shape(const PlaneBody& body) : rows(body.contours), even_odd(body.even_odd) {}
  bool holds(Vec2d p) const { return rows.contains(p, even_odd); }
};

std::vector<PlaneEdge> edges_of(const std::vector<Contour>& contours, bool closed) {
  std::vector<PlaneEdge> edges;
  for (const Contour& c : contours)
    for (std::size_t i = 0; i + (closed ? 0 : 1) < c.size(); ++i)
      if (const Vec2d next = c[i + 1 < c.size() ? i + 1 : 0]; !(c[i] == next)) edges.push_back({c[i], next});
  return edges;
}

// Places at which each edge meets others, as fractions of its length: calls found(i, s) for edges[i].
template <class Found>
void for_each_meeting(const std::vector<PlaneEdge>& edges, double touch, const std::function<void(std::uint64_t)>& spend, Found found) {
  std::vector<std::size_t> order(edges.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto low = [&](std::size_t i) { return std::min(edges[i].a.x, edges[i].b.x); };
  const auto high = [&](std::size_t i) { return std::max(edges[i].a.x, edges[i].b.x); };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) { return low(i) < low(k); });
  std::vector<std::size_t> open;
  for (const std::size_t i : order) {
    std::erase_if(open, [&](std::size_t k) { return high(k) < low(i) - touch; });
    spend(open.size());
    for (const std::size_t k : open) {
      const Vec2d p = edges[i].a, d = edges[i].b - p, q = edges[k].a, e = edges[k].b - q;
      if (std::min(p.y, edges[i].b.y) > std::max(q.y, edges[k].b.y) + touch ||
          std::max(p.y, edges[i].b.y) < std::min(q.y, edges[k].b.y) - touch)
        continue;
      const double det = cross(d, e), ld = length(d), le = length(e);
      if (std::fabs(det) > 1e-12 * ld * le) {
        const double s = cross(q - p, e) / det, t = cross(q - p, d) / det;
        if (s * ld > -touch && (s - 1) * ld < touch && t * le > -touch && (t - 1) * le < touch) found(i, s), found(k, t);
      }
      // Ends of one that lie on the other, especially of collinear edges.
      const auto on = [&](std::size_t edge, Vec2d start, Vec2d along, double size, Vec2d point) {
        const Vec2d v = point - start;
        const double at = dot(v, along) / (size * size);
        if (std::fabs(cross(along, v)) <= touch * size && at > 0 && at < 1) found(edge, at);
      };
      on(i, p, d, ld, q);
      on(i, p, d, ld, edges[k].b);
      on(k, q, e, le, p);
      on(k, q, e, le, edges[i].b);
    }
    open.push_back(i);
  }
}

// Closed loops along edges that each lead from one point to the next.
std::vector<Contour> loops(const std::vector<Vec2d>& points, std::map<int, std::vector<int>> next) {
  std::vector<Contour> result;
  for (auto& [start, ways] : next)
    while (!ways.empty()) {
      Contour loop;
      int at = start;
      do {
        const auto out = next.find(at);
        if (out == next.end() || out->second.empty()) break;
        loop.push_back(points[static_cast<std::size_t>(at)]);
        at = out->second.back();
        out->second.pop_back();
      } while (at != start);
      if (at == start && loop.size() > 2) result.push_back(std::move(loop));
    }
  return result;
}

// Points that are the same on the grid have one number.
class NumberedPoints {
 public:
  explicit NumberedPoints(double grid) : grid_(grid) {}
  int number(Vec2d p) {
    const auto [found, is_new] = numbers_.try_emplace({std::llround(p.x / grid_), std::llround(p.y / grid_)}, static_cast<int>(at.size()));
    if (is_new) at.push_back(p);
    return found->second;
  }
  std::vector<Vec2d> at;

 private:
  double grid_;
  std::map<std::pair<long long, long long>, int> numbers_;
};

enum class Keep { common, rest };

// The common part of two filled outlines, or the part of the first outside the second. All edges are cut where they meet. The result has
// the pieces with the kept region on one side only, with that side to their left.
std::vector<Contour> part_of(const PlaneBody& a, const PlaneBody& b, Keep keep, double grid,
                             const std::function<void(std::uint64_t)>& spend) {
  std::vector<PlaneEdge> edges = edges_of(a.contours, true);
  const std::vector<PlaneEdge> others = edges_of(b.contours, true);
  edges.insert(edges.end(), others.begin(), others.end());
  std::vector<std::vector<double>> cuts(edges.size(), {0, 1});
  for_each_meeting(edges, grid, spend, [&](std::size_t i, double at) {
    if (at > 0 && at < 1) cuts[i].push_back(at);
  });
  const Shape in_a(a), in_b(b);
  const auto kept = [&](Vec2d p) { return in_a.holds(p) && in_b.holds(p) == (keep == Keep::common); };
  NumberedPoints points(grid);
  std::set<std::pair<int, int>> seen;
  std::map<int, std::vector<int>> next;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    std::sort(cuts[i].begin(), cuts[i].end());
    const Vec2d along = edges[i].b - edges[i].a, left = Vec2d{-along.y, along.x} * (4 * grid / length(along));
    for (std::size_t k = 0; k + 1 < cuts[i].size(); ++k) {
      const auto place = [&](double at) { return at == 1 ? edges[i].b : edges[i].a + along * at; };
      const int from = points.number(place(cuts[i][k])), to = points.number(place(cuts[i][k + 1]));
      if (from == to || !seen.insert(std::minmax(from, to)).second) continue;
      const Vec2d middle = place(0.5 * (cuts[i][k] + cuts[i][k + 1]));
      const bool in_left = kept(middle + left), in_right = kept(middle - left);
      if (in_left == in_right) continue;
      next[in_left ? from : to].push_back(in_left ? to : from);
    }
  }
  return loops(points.at, std::move(next));
}

// The parts of open lines within the region.
std::vector<Contour> lines_within(const std::vector<Contour>& lines, const ClipRegion& region, double grid,
                                  const std::function<void(std::uint64_t)>& spend) {
  std::vector<PlaneEdge> edges = edges_of(lines, false);
  const std::size_t own = edges.size();
  std::vector<Shape> shapes;
  for (const PlaneBody& part : region) {
    shapes.emplace_back(part);
    const std::vector<PlaneEdge> others = edges_of(part.contours, true);
    edges.insert(edges.end(), others.begin(), others.end());
  }
  std::vector<std::vector<double>> cuts(own, {0, 1});
  for_each_meeting(edges, grid, spend, [&](std::size_t i, double at) {
    if (i < own && at > 0 && at < 1) cuts[i].push_back(at);
  });
  std::vector<Contour> result;
  for (std::size_t i = 0; i < own; ++i) {
    std::sort(cuts[i].begin(), cuts[i].end());
    const Vec2d along = edges[i].b - edges[i].a;
    for (std::size_t k = 0; k + 1 < cuts[i].size(); ++k) {
      const Vec2d from = edges[i].a + along * cuts[i][k], to = edges[i].a + along * cuts[i][k + 1], middle = (from + to) * 0.5;
      if (from == to || std::none_of(shapes.begin(), shapes.end(), [&](const Shape& s) { return s.holds(middle); })) continue;
      if (!result.empty() && length(result.back().back() - from) <= grid)
        result.back().push_back(to);
      else
        result.push_back({from, to});
    }
  }
  return result;
}

// Does no edge of `body` meet an edge of `part`, and are all its points within?
bool lies_within(const PlaneBody& body, const PlaneBody& part, double grid, const std::function<void(std::uint64_t)>& spend) {
  const bool closed = body.shape == PlaneBody::Shape::polygon;
  std::vector<PlaneEdge> edges = edges_of(body.contours, closed);
  const std::size_t own = edges.size();
  const std::vector<PlaneEdge> others = edges_of(part.contours, true);
  edges.insert(edges.end(), others.begin(), others.end());
  std::vector<char> mine(edges.size(), 0);
  for (std::size_t i = 0; i < own; ++i) mine[i] = 1;
  const Shape shape(part);
  for (const Contour& contour : body.contours)
    for (Vec2d p : contour)
      if (!shape.holds(p)) return false;
  bool meets = false;
  std::size_t first = 0;
  bool second = false;
  for_each_meeting(edges, -grid, spend, [&](std::size_t i, double) {
    // Meetings come in pairs; ends that touch do not count.
    if (second) meets = meets || mine[first] != mine[i];
    first = i;
    second = !second;
  });
  if (meets) return false;
  // A hole of the part may lie in the body.
  const Shape own_shape(body);
  return !closed || std::none_of(part.contours.begin(), part.contours.end(),
                                 [&](const Contour& c) { return !c.empty() && own_shape.holds(c.front()); });
}

}  // namespace

PlaneBody flattened(const PlaneBody& body, double tolerance) {
  if (body.shape == PlaneBody::Shape::polygon || body.shape == PlaneBody::Shape::polyline) return body;
  PlaneBody result = body;
  result.shape = PlaneBody::Shape::polygon;
  result.contours.clear();
  result.radius = 0;
  result.even_odd = false;
  Contour outline;
  if (body.shape == PlaneBody::Shape::ellipse) {
    const double size = std::hypot(length(body.x_axis), length(body.y_axis));
    const int n = std::clamp(static_cast<int>(std::ceil(pi * std::sqrt(0.5 * size / tolerance))), 16, 10'000);
    for (int i = 0; i < n; ++i) {
      const double tau = 2 * pi * i / n;
      outline.push_back(body.center + body.x_axis * std::cos(tau) + body.y_axis * std::sin(tau));
    }
  } else {
    const Vec2d p = body.contours[0][0], q = body.contours[0][1];
    const double angle = p == q ? 0 : std::atan2(q.y - p.y, q.x - p.x);
    const int n = std::clamp(static_cast<int>(std::ceil(0.5 * pi * std::sqrt(0.5 * body.radius / tolerance))), 8, 10'000);
    for (int i = 0; i <= 2 * n + 1; ++i) {
      const int step = i <= n ? i : i - 1;
      const double tau = angle - 0.5 * pi + pi * step / n;
      outline.push_back((i <= n ? q : p) + Vec2d{std::cos(tau), std::sin(tau)} * body.radius);
    }
  }
  result.contours.push_back(std::move(outline));
  return result;
}

namespace {

std::uint64_t count_points(const PlaneBody& body) {
  std::uint64_t points = 0;
  for (const Contour& contour : body.contours) points += contour.size();
  return points;
}

// Fraction of the largest error of a curve: points nearer to each other are merged.
double grid_of(double tolerance) { return 1e-3 * tolerance; }

}  // namespace

PlaneBody without(const PlaneBody& body, const PlaneBody& part, double tolerance, const std::function<void(std::uint64_t)>& spend) {
  spend(40 * (count_points(body) + count_points(part)));
  PlaneBody result = body;
  result.even_odd = false;
  result.contours = part_of(body, part, Keep::rest, grid_of(tolerance), spend);
  return result;
}

PlaneBody clipped(const PlaneBody& body, const ClipRegion& region, double tolerance, const std::function<void(std::uint64_t)>& spend) {
  const double grid = grid_of(tolerance);
  const PlaneBody flat = flattened(body, tolerance);
  std::uint64_t points = count_points(flat);
  for (const PlaneBody& part : region) points += count_points(part);
  spend(40 * points);
  for (const PlaneBody& part : region)
    if (lies_within(flat, part, grid, spend)) return body;
  PlaneBody result = flat;
  if (flat.shape == PlaneBody::Shape::polyline) {
    result.contours = lines_within(flat.contours, region, grid, spend);
    return result;
  }
  result.contours.clear();
  result.even_odd = false;
  for (const PlaneBody& part : region)
    for (Contour& contour : part_of(flat, part, Keep::common, grid, spend)) result.contours.push_back(std::move(contour));
  return result;
}

}  // namespace steradian::plane::svg
