#include "shapes/triangulate.h"

#include <algorithm>
#include <cmath>

namespace steradian {
namespace {

// Twice the area of a triangle, positive where it runs counter-clockwise.
double turn(Vec2d a, Vec2d b, Vec2d c) { return cross(b - a, c - a); }

bool on_segment(Vec2d a, Vec2d b, Vec2d p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

bool meet(Vec2d a, Vec2d b, Vec2d c, Vec2d d) {
  // Rounding may see ends of two segments of one line on different sides of it.
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) || std::max(a.y, b.y) < std::min(c.y, d.y) ||
      std::max(c.y, d.y) < std::min(a.y, b.y))
    return false;
  const auto sign = [](double x) { return (x > 0) - (x < 0); };
  const int abc = sign(turn(a, b, c)), abd = sign(turn(a, b, d)), cda = sign(turn(c, d, a)), cdb = sign(turn(c, d, b));
  if (abc != abd && cda != cdb) return true;
  return (abc == 0 && on_segment(a, b, c)) || (abd == 0 && on_segment(a, b, d)) || (cda == 0 && on_segment(c, d, a)) ||
         (cdb == 0 && on_segment(c, d, b));
}

struct JoinedContours {
  std::vector<Vec2d> points;  // points of all contours
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
};

JoinedContours joined(const Contours& contours) {
  JoinedContours all;
  for (const auto& contour : contours) {
    const auto first = static_cast<std::uint32_t>(all.points.size()), n = static_cast<std::uint32_t>(contour.size());
    all.points.insert(all.points.end(), contour.begin(), contour.end());
    for (std::uint32_t i = 0; i < n; ++i) all.edges.push_back({first + i, first + (i + 1) % n});
  }
  return all;
}

// True if edges meet anywhere except neighbours in their common corner.
bool crosses_itself(const JoinedContours& p) {
  for (std::size_t i = 0; i < p.edges.size(); ++i)
    for (std::size_t j = i + 1; j < p.edges.size(); ++j) {
      auto [a, b] = p.edges[i];
      auto [c, d] = p.edges[j];
      if (b == c || a == d) {  // neighbours: they must not fold back onto each other
        const std::uint32_t shared = b == c ? b : a, from = b == c ? a : b, to = b == c ? d : c;
        const Vec2d u = p.points[from] - p.points[shared], v = p.points[to] - p.points[shared];
        if (cross(u, v) == 0 && dot(u, v) >= 0) return true;
      } else if (meet(p.points[a], p.points[b], p.points[c], p.points[d])) {
        return true;
      }
    }
  return false;
}

// Twice the area.
double area_of(const std::vector<Vec2d>& contour) {
  double sum = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) sum += cross(contour[i], contour[(i + 1) % contour.size()]);
  return sum;
}

// Cuts the hole into the outline along the shortest line that meets no edge.
bool bridge(const JoinedContours& p, std::vector<std::uint32_t>& outline, std::uint32_t first, std::uint32_t count) {
  constexpr double kFar = 1e300;
  double best = kFar;
  std::size_t from = 0;
  std::uint32_t to = 0;
  for (std::size_t o = 0; o < outline.size(); ++o)
    for (std::uint32_t h = first; h < first + count; ++h) {
      const Vec2d a = p.points[outline[o]], b = p.points[h];
      if (length(b - a) >= best) continue;
      const bool blocked = std::any_of(p.edges.begin(), p.edges.end(), [&](const auto& edge) {
        const bool touches = edge.first == outline[o] || edge.second == outline[o] || edge.first == h || edge.second == h;
        return !touches && meet(a, b, p.points[edge.first], p.points[edge.second]);
      });
      // Several corners of the outline share a place where two bridges meet. The right corner is the one that has the line on its inner
      // side.
      const Vec2d before = p.points[outline[(o + outline.size() - 1) % outline.size()]],
                  after = p.points[outline[(o + 1) % outline.size()]];
      const bool convex = turn(before, a, after) >= 0;
      const bool inside = convex ? turn(before, a, b) > 0 && turn(a, after, b) > 0 : turn(before, a, b) > 0 || turn(a, after, b) > 0;
      if (blocked || !inside) continue;
      best = length(b - a);
      from = o;
      to = h;
    }
  if (best == kFar) return false;
  std::vector<std::uint32_t> cut;
  for (std::uint32_t i = 0; i <= count; ++i) cut.push_back(first + (to - first + i) % count);
  cut.push_back(outline[from]);
  outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(from) + 1, cut.begin(), cut.end());
  return true;
}

// slack: twice the area up to which a corner beside the ear's edge counts as one on it. A corner that rounding put beside the edge on which
// it was made would otherwise be left alone behind the ear.
bool is_ear(const std::vector<Vec2d>& points, const std::vector<std::uint32_t>& outline, std::size_t i, double slack) {
  const std::size_t n = outline.size();
  const std::uint32_t ia = outline[(i + n - 1) % n], ib = outline[i], ic = outline[(i + 1) % n];
  const Vec2d a = points[ia], b = points[ib], c = points[ic];
  if (!(turn(a, b, c) > 0)) return false;
  return std::none_of(outline.begin(), outline.end(), [&](std::uint32_t k) {
    if (k == ia || k == ib || k == ic) return false;
    const Vec2d p = points[k];
    return turn(a, b, p) >= -slack && turn(b, c, p) >= -slack && turn(c, a, p) >= -slack;
  });
}

}  // namespace

std::optional<std::vector<std::array<std::uint32_t, 3>>> triangles_of(const Contours& contours) {
  if (contours.empty()) return {};
  for (std::size_t i = 0; i < contours.size(); ++i)
    if (contours[i].size() < 3 || !(i == 0 ? area_of(contours[i]) > 0 : area_of(contours[i]) < 0)) return {};
  const JoinedContours all = joined(contours);
  if (crosses_itself(all)) return {};

  std::vector<std::uint32_t> outline(contours[0].size());
  for (std::uint32_t i = 0; i < outline.size(); ++i) outline[i] = i;
  auto first = static_cast<std::uint32_t>(outline.size());
  for (std::size_t hole = 1; hole < contours.size(); ++hole) {
    const auto count = static_cast<std::uint32_t>(contours[hole].size());
    if (!bridge(all, outline, first, count)) return {};
    first += count;
  }

  double largest = 0;
  for (const Vec2d& p : all.points) largest = std::max({largest, std::fabs(p.x - all.points[0].x), std::fabs(p.y - all.points[0].y)});
  const double slack = 1e-13 * largest * largest;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (outline.size() > 3) {
    std::size_t ear = outline.size();
    for (const double allowed : {slack, 0.0})
      for (std::size_t i = 0; i < outline.size() && ear == outline.size(); ++i)
        if (is_ear(all.points, outline, i, allowed)) ear = i;
    if (ear == outline.size()) {
      std::vector<Vec2d> rest;
      for (const std::uint32_t k : outline) rest.push_back(all.points[k]);
      if (std::fabs(area_of(rest)) > slack * static_cast<double>(rest.size())) return {};
      return triangles;  // what is left lies on one line
    }
    const std::size_t n = outline.size();
    triangles.push_back({outline[(ear + n - 1) % n], outline[ear], outline[(ear + 1) % n]});
    outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  if (turn(all.points[outline[0]], all.points[outline[1]], all.points[outline[2]]) > 0)
    triangles.push_back({outline[0], outline[1], outline[2]});
  return triangles;
}

}  // namespace steradian
