#include "bench/studies/shadow_clipping.h"

#include <algorithm>
#include <cmath>

#include "shadow/region/light_frame.h"

namespace steradian::studies {
namespace {

struct ContourPoint {
  float x = 0, y = 0;
};
using Contour = std::vector<ContourPoint>;

float cross_of(ContourPoint a, ContourPoint b, ContourPoint c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

float area_of(const Contour& c) {
  float twice = 0;
  for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++) twice += c[j].x * c[i].y - c[j].y * c[i].x;
  return twice / 2;
}

bool contains(const Contour& c, ContourPoint p) {
  bool inside = false;
  for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++)
    if ((c[i].y > p.y) != (c[j].y > p.y) && p.x < (c[j].x - c[i].x) * (p.y - c[i].y) / (c[j].y - c[i].y) + c[i].x) inside = !inside;
  return inside;
}

bool apart(const Contour& a, const Contour& b) {
  const auto range = [](const Contour& c, float ContourPoint::*of) {
    const auto [low, high] = std::minmax_element(c.begin(), c.end(), [of](ContourPoint p, ContourPoint q) { return p.*of < q.*of; });
    return std::pair{*low.*of, *high.*of};
  };
  for (const auto of : {&ContourPoint::x, &ContourPoint::y}) {
    const auto [a_low, a_high] = range(a, of);
    const auto [b_low, b_high] = range(b, of);
    if (a_high < b_low || b_high < a_low) return true;
  }
  return false;
}

// A corner of one of two polygons, or a crossing of their edges, which is in both polygons.
struct ContourNode {
  ContourPoint at;
  float along = 0;  // for crossings: position along the edge
  int other = -1;   // index in the other polygon; -1: a corner
  bool enters = false, visited = false;
};

// Corners and crossings of a polygon in order. `other` counts crossings until link() has found them.
struct Ring {
  std::vector<ContourNode> nodes;
  std::size_t next(std::size_t i) const { return i + 1 == nodes.size() ? 0 : i + 1; }
  std::size_t previous(std::size_t i) const { return i == 0 ? nodes.size() - 1 : i - 1; }
};

struct ContourCrossing {
  std::size_t edge_a, edge_b;
  float along_a, along_b;
  ContourPoint at;
};

std::vector<ContourCrossing> crossings_of(const Contour& a, const Contour& b) {
  std::vector<ContourCrossing> result;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const ContourPoint a0 = a[i], a1 = a[(i + 1) % a.size()];
    for (std::size_t j = 0; j < b.size(); ++j) {
      const ContourPoint b0 = b[j], b1 = b[(j + 1) % b.size()];
      const float s0 = cross_of(b0, b1, a0), s1 = cross_of(b0, b1, a1), t0 = cross_of(a0, a1, b0), t1 = cross_of(a0, a1, b1);
      if ((s0 > 0) == (s1 > 0) || (t0 > 0) == (t1 > 0)) continue;
      const float s = s0 / (s0 - s1), t = t0 / (t0 - t1);
      result.push_back({i, j, s, t, {a0.x + s * (a1.x - a0.x), a0.y + s * (a1.y - a0.y)}});
    }
  }
  return result;
}

template <class EdgeOf, class AlongOf>
Ring ring_of(const Contour& c, const std::vector<ContourCrossing>& crossings, const Contour& other, EdgeOf edge_of, AlongOf along_of) {
  Ring ring;
  bool inside = contains(other, c[0]);
  for (std::size_t i = 0; i < c.size(); ++i) {
    ring.nodes.push_back({c[i]});
    std::vector<ContourNode> on_edge;
    for (std::size_t k = 0; k < crossings.size(); ++k)
      if (edge_of(crossings[k]) == i) on_edge.push_back({crossings[k].at, along_of(crossings[k]), static_cast<int>(k)});
    std::sort(on_edge.begin(), on_edge.end(), [](const ContourNode& p, const ContourNode& q) { return p.along < q.along; });
    for (ContourNode& n : on_edge) {
      n.enters = !inside;
      inside = !inside;
      ring.nodes.push_back(n);
    }
  }
  return ring;
}

void link(Ring& a, Ring& b, std::size_t crossings) {
  std::vector<int> in_a(crossings, -1), in_b(crossings, -1);
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    if (a.nodes[i].other >= 0) in_a[static_cast<std::size_t>(a.nodes[i].other)] = static_cast<int>(i);
  for (std::size_t i = 0; i < b.nodes.size(); ++i)
    if (b.nodes[i].other >= 0) in_b[static_cast<std::size_t>(b.nodes[i].other)] = static_cast<int>(i);
  for (ContourNode& n : a.nodes)
    if (n.other >= 0) n.other = in_b[static_cast<std::size_t>(n.other)];
  for (ContourNode& n : b.nodes)
    if (n.other >= 0) n.other = in_a[static_cast<std::size_t>(n.other)];
}

// The remaining polygons, and their holes.
struct Left {
  std::vector<Contour> polygons, holes;
};

// The difference of two polygons. Source: Greiner, Hormann, "Efficient clipping of arbitrary polygons", 1998.
void subtract(const Contour& polygon, const Contour& triangle, Left& result) {
  if (apart(polygon, triangle)) return result.polygons.push_back(polygon);
  const std::vector<ContourCrossing> crossings = crossings_of(polygon, triangle);
  if (crossings.empty()) {
    if (contains(triangle, polygon[0])) return;
    if (contains(polygon, triangle[0])) result.holes.push_back(triangle);
    return result.polygons.push_back(polygon);
  }
  Ring a = ring_of(
      polygon, crossings, triangle, [](const ContourCrossing& c) { return c.edge_a; }, [](const ContourCrossing& c) { return c.along_a; });
  Ring b = ring_of(
      triangle, crossings, polygon, [](const ContourCrossing& c) { return c.edge_b; }, [](const ContourCrossing& c) { return c.along_b; });
  link(a, b, crossings.size());
  const float sign = area_of(polygon);
  for (std::size_t start = 0; start < a.nodes.size(); ++start) {
    if (a.nodes[start].other < 0 || a.nodes[start].visited) continue;
    Contour piece;
    Ring* ring = &a;
    std::size_t at = start;
    for (std::size_t steps = 0; steps < 2 * (a.nodes.size() + b.nodes.size()); ++steps) {
      ContourNode& n = ring->nodes[at];
      if (n.visited) break;
      const bool forward = ring == &a ? !n.enters : n.enters;  // outside the triangle, inside the polygon
      n.visited = true;
      do {
        piece.push_back(ring->nodes[at].at);
        at = forward ? ring->next(at) : ring->previous(at);
      } while (ring->nodes[at].other < 0);
      ring->nodes[at].visited = true;
      at = static_cast<std::size_t>(ring->nodes[at].other);
      ring = ring == &a ? &b : &a;
    }
    if (piece.size() < 3) continue;
    if ((area_of(piece) > 0) != (sign > 0)) std::reverse(piece.begin(), piece.end());
    result.polygons.push_back(std::move(piece));
  }
}

// The part of a polygon where dot(normal, p) >= least.
std::vector<Vec3d> above(const std::vector<Vec3d>& polygon, Vec3d normal, double least) {
  std::vector<Vec3d> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double ha = dot(normal, a) - least, hb = dot(normal, b) - least;
    if (ha >= 0) result.push_back(a);
    if ((ha >= 0) != (hb >= 0)) result.push_back(a + (b - a) * (ha / (ha - hb)));
  }
  return result;
}

// Projects the polygon to the plane z = 1 of the shading frame.
Contour projected(const std::vector<Vec3d>& polygon, const Frame& frame) {
  Contour result;
  for (const Vec3d v : polygon) {
    const Vec3d u = frame.to_local(v);
    result.push_back({static_cast<float>(u.x / u.z), static_cast<float>(u.y / u.z)});
  }
  return result;
}

std::vector<Vec3d> off_horizon(std::vector<Vec3d> polygon, const shadow::Viewpoint& from) {
  constexpr double kOff = 1e-3;
  for (Vec3d& v : polygon) v = v - from.position;
  polygon = above(polygon, from.normal, kOff);
  return from.geometric_normal ? above(polygon, *from.geometric_normal, 0) : polygon;
}

}  // namespace

PreparedPolygon clipped_light(const PreparedPolygon& light, const shadow::EdgeMesh& mesh, const shadow::Viewpoint& from,
                              CountedTriangles facing, Degenerate degenerate, reference::Random& random) {
  const int side = light.side_of(from.position);
  const Frame frame = Frame::from_normal(from.normal);
  PreparedPolygon result = light;
  result.vertices.clear();
  result.contours = {0};
  result.quarters = {};
  std::vector<Vec3d> outline(light.vertices.begin(), light.vertices.begin() + static_cast<std::ptrdiff_t>(light.contours[1]));
  Contour whole = projected(off_horizon(outline, from), frame);
  if (whole.size() < 3) return result;
  if (area_of(whole) < 0) std::reverse(whole.begin(), whole.end());
  Left left{{whole}, {}};
  // The direction from the light to the point, and the distance of the light's plane.
  const Vec3d to_light = light.normal * (side > 0 ? -1.0 : 1.0);
  const double height = dot(light.centroid - from.position, to_light) - shadow::margin_of_plane(light);
  for (std::size_t t = 0; t < mesh.triangles.size() && !left.polygons.empty(); ++t) {
    if (facing == CountedTriangles::front && !(dot(mesh.planes[t].normal, from.position) > mesh.planes[t].offset)) continue;
    std::vector<Vec3d> corners;
    for (const std::uint32_t v : mesh.triangles[t]) corners.push_back(mesh.vertices[v]);
    Contour triangle = projected(above(off_horizon(corners, from), -to_light, -height), frame);
    if (triangle.size() < 3 || apart(triangle, whole)) continue;
    if (area_of(triangle) < 0) std::reverse(triangle.begin(), triangle.end());
    if (degenerate == Degenerate::scaled) {
      const auto factor = static_cast<float>(1 + random.uniform(-0.01, 0.01));
      ContourPoint middle;
      for (const ContourPoint c : triangle)
        middle = {middle.x + c.x / static_cast<float>(triangle.size()), middle.y + c.y / static_cast<float>(triangle.size())};
      for (ContourPoint& c : triangle) c = {middle.x + factor * (c.x - middle.x), middle.y + factor * (c.y - middle.y)};
    }
    Left next;
    next.holes = std::move(left.holes);
    for (const Contour& polygon : left.polygons) subtract(polygon, triangle, next);
    left = std::move(next);
  }
  const auto add = [&](Contour contour, bool hole) {
    if (hole != (side < 0)) std::reverse(contour.begin(), contour.end());
    for (const ContourPoint c : contour)
      result.vertices.push_back(from.position + frame.to_world({static_cast<double>(c.x), static_cast<double>(c.y), 1}));
    result.contours.push_back(result.vertices.size());
  };
  for (const Contour& c : left.polygons) add(c, false);
  for (const Contour& c : left.holes) add(c, true);
  return result;
}

}  // namespace steradian::studies
