#include "shadow/region/derivatives.h"

#include <algorithm>
#include <cmath>

#include "reference/gauss_kronrod.h"
#include "shadow/region/visible.h"

namespace steradian::shadow {
namespace {

using Density = std::function<Vec3d(Vec3d)>;

ByChannel operator+(const ByChannel& a, const ByChannel& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
ByChannel operator*(const ByChannel& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
void add(ByChannel& to, const ByChannel& v) { to = to + v; }
template <class Change>
ByChannel each(const ByChannel& a, Change change) {
  return {change(a[0]), change(a[1]), change(a[2])};
}
double largest(const ByChannel& a) { return std::max({length(a[0]), length(a[1]), length(a[2])}); }

// Integral of density times direction along an arc of a great circle.
class ArcMoment {
 public:
  ArcMoment(const Density& density, Vec3d from, Vec3d to) : density_(density), start_(normalized(from)) {
    const Vec3d end = normalized(to);
    // The angle is computed from its sine, since arcs may be short.
    const Vec3d across = end - start_ * dot(start_, end);
    side_ = normalized(across);
    angle_ = std::atan2(length(across), dot(start_, end));
  }
  ByChannel value() const {
    constexpr double kLongest = 0.2;  // no lobe of a relevant width lies between the nodes of a first interval
    const int count = 1 + static_cast<int>(angle_ / kLongest);
    ByChannel sum{};
    for (int i = 0; i < count; ++i) add(sum, within(angle_ * i / count, angle_ * (i + 1) / count, 0));
    return sum;
  }

 private:
  ByChannel within(double from, double to, int depth) const {
    constexpr int kDepth = 14;
    constexpr double kPrecision = 1e-9;
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    ByChannel kronrod{}, gauss{};
    for (const reference::KronrodNode& node : reference::kKronrodNodes) {
      const double s = middle + half * node.x;
      const Vec3d w = start_ * std::cos(s) + side_ * std::sin(s), f = density_(w);
      const ByChannel value = {w * f.x, w * f.y, w * f.z};
      add(kronrod, value * (node.kronrod * half));
      add(gauss, value * (node.gauss * half));
    }
    if (depth == kDepth || largest(kronrod + gauss * -1.0) <= kPrecision * largest(kronrod)) return kronrod;
    return within(from, middle, depth + 1) + within(middle, to, depth + 1);
  }

  const Density& density_;
  Vec3d start_, side_;
  double angle_ = 0;
};

// Index of the light's vertex at a corner of a frame.
std::size_t vertex_of_corner(const PreparedPolygon& light, int side, std::size_t corner) {
  const auto next = std::upper_bound(light.contours.begin(), light.contours.end(), corner);
  const std::size_t first = *(next - 1), end = *next;
  return side < 0 ? first + end - 1 - corner : corner;  // a frame behind the light has the corners in reverse order
}

std::size_t next_corner(const PreparedPolygon& light, std::size_t corner) {
  const auto next = std::upper_bound(light.contours.begin(), light.contours.end(), corner);
  return corner + 1 == *next ? *(next - 1) : corner + 1;
}

// Position where an edge cuts the plane at which blockers end, and the heights of its ends above that plane.
struct EdgeCut {
  std::uint32_t v0, v1;
  Vec3d place, along;
  double height0, height1;
};

class Boundaries {
 public:
  Boundaries(const PreparedPolygon& light, int side, const Occluders& occluders, const LightFrame& frame, const Viewpoint& from,
             BoundaryDerivatives& result)
      : light_(light), side_(side), mesh_(occluders.mesh), frame_(frame), from_(from), result_(result) {}

  // Adds a piece of the segment. along: the visible part lies on the left of the segment's direction, else on its right.
  void add_piece(const Segment& segment, bool along, const ByChannel& moment) {
    switch (segment.source) {
      case Source::shading_horizon:
      case Source::geometric_horizon: break;
      case Source::edge: {
        const MeshEdge& e = mesh_.edges[segment.index];
        const Ends ends = move(mesh_.vertices[e.v0], mesh_.vertices[e.v1], along, moment);
        add(result_.occluders[e.v0], ends.a);
        add(result_.occluders[e.v1], ends.b);
        break;
      }
      case Source::outline: {
        const std::size_t a = vertex_of_corner(light_, side_, segment.index);
        const std::size_t b = vertex_of_corner(light_, side_, next_corner(light_, segment.index));
        const Ends ends = move(light_.vertices[a], light_.vertices[b], along, moment);
        add(result_.light[a], ends.a);
        add(result_.light[b], ends.b);
        break;
      }
      case Source::section: add_section(segment.index, along, moment); break;
    }
  }

 private:
  struct Ends {
    ByChannel a, b;
  };
  // Derivatives by the ends of an edge that runs from a to b with the part on its left: (B x K)/|A x B| and (K x A)/|A x B|. The
  // derivative by the point is minus their sum.
  Ends move(Vec3d a, Vec3d b, bool along, const ByChannel& moment) {
    if (!along) std::swap(a, b);
    a -= from_.position;
    b -= from_.position;
    const double size = length(cross(a, b));
    if (!(size > 0)) return {};
    Ends ends = {each(moment, [&](Vec3d k) { return cross(b, k) / size; }), each(moment, [&](Vec3d k) { return cross(k, a) / size; })};
    add(result_.position, (ends.a + ends.b) * -1.0);
    if (!along) std::swap(ends.a, ends.b);
    return ends;
  }

  double height(std::uint32_t v) const { return frame_.to_local(mesh_.vertices[v]).z + frame_.eta; }
  EdgeCut cut(std::uint32_t edge) const {
    const MeshEdge& e = mesh_.edges[edge];
    const double h0 = height(e.v0), h1 = height(e.v1);
    const Vec3d along = mesh_.vertices[e.v1] - mesh_.vertices[e.v0];
    return {e.v0, e.v1, mesh_.vertices[e.v0] + along * (h0 / (h0 - h1)), along, h0, h1};
  }
  // The cut also slides along its edge.
  void add_cut(const EdgeCut& c, const ByChannel& by_place) {
    const double apart = c.height0 - c.height1, t = c.height0 / apart;
    const auto slide = [&](double change) {
      return each(by_place, [&](Vec3d g) { return frame_.axes.z * (dot(c.along, g) * change / (apart * apart)); });
    };
    add(result_.occluders[c.v0], by_place * (1 - t) + slide(-c.height1));
    add(result_.occluders[c.v1], by_place * t + slide(c.height0));
  }
  void add_section(std::uint32_t triangle, bool along, const ByChannel& moment) {
    const auto& corners = mesh_.triangles[triangle];
    int leaving = -1, returning = -1;
    for (int i = 0; i < 3; ++i) {
      const bool here = height(corners[static_cast<std::size_t>(i)]) < 0,
                 there = height(corners[static_cast<std::size_t>((i + 1) % 3)]) < 0;
      if (here && !there) leaving = i;
      if (!here && there) returning = i;
    }
    if (leaving < 0 || returning < 0) return;
    const EdgeCut a = cut(mesh_.triangle_edges[triangle][static_cast<std::size_t>(leaving)]);
    const EdgeCut b = cut(mesh_.triangle_edges[triangle][static_cast<std::size_t>(returning)]);
    const Ends ends = move(a.place, b.place, along, moment);
    add_cut(a, ends.a);
    add_cut(b, ends.b);
  }

  const PreparedPolygon& light_;
  const int side_;
  const EdgeMesh& mesh_;
  const LightFrame& frame_;
  const Viewpoint& from_;
  BoundaryDerivatives& result_;
};

}  // namespace

BoundaryDerivatives boundary_derivatives(const PreparedPolygon& light, const Occluders& occluders, const Viewpoint& from,
                                         const Density& density) {
  BoundaryDerivatives result;
  result.light.resize(light.vertices.size());
  result.occluders.resize(occluders.mesh.vertices.size());
  const int side = light.side_of(from.position);
  if (side == 0 || (side < 0 && !light.two_sided)) return result;
  const LightFrame frame = light_frame(light, side);
  LocalEdges<double> edges;
  edges.assign_all(occluders.mesh, frame);
  Scratch scratch;
  VisibleRegion region;
  edges.see(from, scratch.set);
  find_visible(frame, from.position, occluders.rays, scratch, region);
  Boundaries boundaries(light, side, occluders, frame, from, result);
  for (const Boundary& piece : region.boundary) {
    const Segment& segment = scratch.set.segments[piece.segment];
    const double along = (piece.bx - piece.ax) * (segment.b.x - segment.a.x) + (piece.by - piece.ay) * (segment.b.y - segment.a.y);
    const WorldPiece ends = relative_to(from.position, frame, piece);
    boundaries.add_piece(segment, along > 0, ArcMoment(density, ends.a, ends.b).value());
  }
  return result;
}

}  // namespace steradian::shadow
