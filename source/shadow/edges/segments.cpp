#include "shadow/edges/segments.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shadow/edges/gather.h"
#include "steradian/kernels.h"

namespace steradian::shadow {
namespace {

// Sebastiano Vigna's splitmix64.
std::uint64_t hashed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

std::int32_t odd(std::uint64_t bits) {
  const auto size = static_cast<std::int32_t>(bits & 0xfffff) | 1;
  return (bits & 0x100000) != 0 ? -size : size;
}

std::int32_t to_cell(double x, double box) {
  return static_cast<std::int32_t>(std::clamp(std::floor(x / box * kCells + 0.5), -double{kCells}, double{kCells}));
}

// Clips an edge and adds it.
template <class S>
void add_clipped(const LightFrame& frame, typename Kernels<S>::vec3 a, typename Kernels<S>::vec3 b, std::uint64_t id_a, std::uint64_t id_b,
                 std::int32_t weight, Source source, std::uint32_t index, SegmentSet& result) {
  Kernels<S> k;
  const auto clipped = k.shadow_clip(a, b, {static_cast<S>(frame.box_x), static_cast<S>(frame.box_y)});
  if (!clipped.inside.m) return;
  const auto cell = [](const auto& v) { return static_cast<std::int32_t>(v.v); };
  const int side_a = cell(clipped.sides.x), side_b = cell(clipped.sides.y);
  add_cells(result, cell_of(side_a != 0 ? clip_id(source, index, 0) : id_a, cell(clipped.start.x), cell(clipped.start.y)),
            cell_of(side_b != 0 ? clip_id(source, index, 1) : id_b, cell(clipped.end.x), cell(clipped.end.y)), side_a == 1, side_b == 1,
            weight, source, index);
}

}  // namespace

void add_outline(const LightFrame& frame, SegmentSet& result) {
  std::uint32_t number = 0;
  for (const std::vector<Corner>& contour : frame.contours) {
    const auto first = number;
    const auto corner = [&](std::size_t i) {
      const Corner& c = contour[i % contour.size()];
      return cell_of(kCornerId | (first + i % contour.size()), to_cell(c.x, frame.box_x), to_cell(c.y, frame.box_y));
    };
    for (std::size_t i = 0; i < contour.size(); ++i) {
      add_cells(result, corner(i), corner(i + 1), false, false, -kHidden, Source::outline, number++);
      result.segments.back().place_a = static_cast<std::int32_t>(first + i);
      result.segments.back().place_b = static_cast<std::int32_t>(first + (i + 1) % contour.size());
    }
  }
}

std::int32_t add_horizon(const LightFrame& frame, Vec3d eye, Vec3d normal, Source source, SegmentSet& result) {
  // Counter-clockwise from the lower left corner; side i runs from corner i to i + 1.
  const double xs[4] = {-frame.box_x, frame.box_x, frame.box_x, -frame.box_x};
  const double ys[4] = {-frame.box_y, -frame.box_y, frame.box_y, frame.box_y};
  double height[4];
  // The height is monotone in each corner's sign, so that rounding cannot make the line cross all four sides.
  const double middle = normal.z * eye.z - normal.x * eye.x - normal.y * eye.y;
  for (int i = 0; i < 4; ++i) height[i] = (middle + normal.x * xs[i]) + normal.y * ys[i];
  int enters = -1, leaves = -1;
  SnappedVertex cells[4];
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    const bool above_i = height[i] >= 0, above_j = height[j] >= 0;
    if (above_i == above_j) continue;
    const double t = height[i] / (height[i] - height[j]);
    const auto at = [&](double from, double to, double box) { return to_cell(from + t * (to - from), box); };
    // In counter-clockwise order, the line with the upper part on its left begins where that part ends.
    const int end = above_i ? 0 : 1;
    cells[i] = cell_of(clip_id(source, 0, end), at(xs[i], xs[j], frame.box_x), at(ys[i], ys[j], frame.box_y));
    (above_i ? enters : leaves) = i;
  }
  if (enters >= 0 && leaves >= 0) add_cells(result, cells[enters], cells[leaves], enters == 3, leaves == 3, -kHidden, source, 0);
  return height[0] >= 0 ? 0 : kHidden;
}

void add_horizons(const LightFrame& frame, const Viewpoint& from, Vec3d point, SegmentSet& result) {
  const Vec3d down{point.x, point.y, -point.z};
  result.layered = frame.layered;
  result.base =
      (frame.layered ? kLayer : kHidden) + add_horizon(frame, down, frame.axes.to_local(from.normal), Source::shading_horizon, result);
  if (from.geometric_normal)
    result.base += add_horizon(frame, down, frame.axes.to_local(*from.geometric_normal), Source::geometric_horizon, result);
}

SnappedVertex cell_of(std::uint64_t id, std::int32_t x, std::int32_t y) {
  const std::uint64_t h = hashed(id);
  return {x, y, odd(h), odd(h >> 32), id};
}

void SegmentSet::clear() {
  segments.clear();
  events.clear();
  base = 0;
  occluders = 0;
  layered = false;
}

double offset_from_surface(Vec3d p, double reach, double rounding) { return rounding * (64 * largest_coordinate(p) + 32 * reach); }

std::vector<std::uint32_t> crossing_triangles(const EdgeMesh& mesh, const LightFrame& frame, std::span<const std::uint32_t> inside) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (std::binary_search(inside.begin(), inside.end(), t)) continue;
    if (crosses(mesh, frame, t)) result.push_back(t);
  }
  return result;
}

bool crosses(const EdgeMesh& mesh, const LightFrame& frame, std::uint32_t triangle) {
  int below = 0;
  for (const std::uint32_t v : mesh.triangles[triangle]) below += frame.to_local(mesh.vertices[v]).z < -frame.eta;
  return below == 1 || below == 2;
}

void add_incidences(const EdgeMesh& mesh, const MeshEdge& edge, std::span<const std::uint32_t> inside, std::vector<EdgeTriangle>& to) {
  const std::size_t before = to.size();
  for (std::uint32_t i = edge.first; i < edge.first + edge.count; ++i) {
    const EdgeTriangle& t = mesh.edge_triangles[i];
    if (!edge.at_body || !std::binary_search(inside.begin(), inside.end(), t.triangle)) to.push_back(t);
  }
  if (!edge.at_body || to.size() != before + 2) return;
  // Two parts of one triangle: the count never changes across their edge.
  const Plane &a = mesh.planes[to[before].triangle], &b = mesh.planes[to[before + 1].triangle];
  if (to[before].walks != to[before + 1].walks && a.normal == b.normal && a.offset == b.offset) to.resize(before);
}

template <class S>
void LocalEdges<S>::assign(const EdgeMesh& mesh, const LightFrame& frame, const std::vector<std::uint32_t>& edges,
                           const std::vector<std::uint32_t>& crossing, std::span<const std::uint32_t> inside) {
  vertex_numbers_.clear();
  incidences_.clear();
  edges_.clear();
  crossing_.clear();
  std::vector<std::uint32_t>& triangles = plane_numbers_;
  triangles = crossing;
  for (const std::uint32_t e : edges) {
    vertex_numbers_.push_back(mesh.edges[e].v0);
    vertex_numbers_.push_back(mesh.edges[e].v1);
    for (std::uint32_t i = 0; i < mesh.edges[e].count; ++i) triangles.push_back(mesh.edge_triangles[mesh.edges[e].first + i].triangle);
  }
  for (const std::uint32_t t : crossing) vertex_numbers_.insert(vertex_numbers_.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  const auto unique = [](std::vector<std::uint32_t>& v) {
    std::sort(v.begin(), v.end());
    v.erase(std::unique(v.begin(), v.end()), v.end());
  };
  unique(vertex_numbers_);
  unique(triangles);
  const auto place = [](const std::vector<std::uint32_t>& v, std::uint32_t number) {
    return static_cast<std::uint32_t>(std::lower_bound(v.begin(), v.end(), number) - v.begin());
  };
  move_to(mesh, frame);
  std::vector<EdgeTriangle> blocking;
  for (const std::uint32_t e : edges) {
    const MeshEdge& edge = mesh.edges[e];
    blocking.clear();
    add_incidences(mesh, edge, inside, blocking);
    if (blocking.empty()) continue;
    edges_.push_back({place(vertex_numbers_, edge.v0), place(vertex_numbers_, edge.v1), static_cast<std::uint32_t>(incidences_.size()),
                      static_cast<std::uint32_t>(blocking.size()), e});
    for (const EdgeTriangle& t : blocking) incidences_.push_back({place(triangles, t.triangle), t.walks});
  }
  for (const std::uint32_t t : crossing) {
    LocalTriangle local{place(triangles, t), t, {}, {}};
    for (std::size_t c = 0; c < 3; ++c) {
      local.corners[c] = place(vertex_numbers_, mesh.triangles[t][c]);
      local.edges[c] = mesh.triangle_edges[t][c];
    }
    crossing_.push_back(local);
  }
}

template <class S>
void LocalEdges<S>::move_to(const EdgeMesh& mesh, const LightFrame& frame) {
  frame_ = &frame;
  vertices_.clear();
  planes_.clear();
  for (const std::uint32_t v : vertex_numbers_) {
    const Vec3d p = frame.to_local(mesh.vertices[v]);
    vertices_.push_back({static_cast<S>(p.x), static_cast<S>(p.y), static_cast<S>(p.z)});
  }
  for (const std::uint32_t t : plane_numbers_) {
    const Plane& plane = mesh.planes[t];
    const Vec3d n = frame.axes.to_local(plane.normal);
    // A plane far from the light's origin keeps its digits only if the offset is taken there.
    const double offset = plane.offset - dot(plane.normal, frame.origin);
    planes_.push_back({{static_cast<S>(n.x), static_cast<S>(n.y), static_cast<S>(n.z)}, static_cast<S>(offset)});
  }
}

template <class S>
void LocalEdges<S>::assign_all(const EdgeMesh& mesh, const LightFrame& frame, std::span<const std::uint32_t> inside) {
  std::vector<std::uint32_t> all(mesh.edges.size());
  std::iota(all.begin(), all.end(), 0u);
  assign(mesh, frame, all, crossing_triangles(mesh, frame, inside), inside);
}

template <class S>
void LocalEdges<S>::see(const Viewpoint& from, SegmentSet& result) const {
  using K = Kernels<S>;
  using vec3 = typename K::vec3;
  K k;
  result.clear();
  const Vec3d point = frame_->to_local(from.position);
  const vec3 at = {static_cast<S>(point.x), static_cast<S>(point.y), static_cast<S>(point.z)};
  const vec3 eye = {at.x, at.y, -at.z}, shift = {S(0), S(0), eye.z.v};
  const auto height = static_cast<S>(-frame_->eta);
  const auto vertex = [&](std::uint32_t i) { return vec3(vertices_[i].x, vertices_[i].y, vertices_[i].z); };
  const auto below = [&](std::uint32_t i) { return vertices_[i].z < height; };

  const auto facing = [&](std::uint32_t plane) {
    const LocalPlane& p = planes_[plane];
    return k.shadow_facing({p.normal.x, p.normal.y, p.normal.z}, p.offset, at).v > 0 ? 1 : -1;
  };
  for (const LocalEdge& edge : edges_) {
    const bool below0 = below(edge.v0), below1 = below(edge.v1);
    if (!below0 && !below1) continue;
    std::int32_t weight = 0;
    for (std::uint32_t i = edge.first; i < edge.first + edge.count; ++i) weight -= incidences_[i].walks * facing(incidences_[i].plane);
    if (weight == 0) continue;
    vec3 a = vertex(edge.v0), b = vertex(edge.v1);
    std::uint64_t id_a = vertex_numbers_[edge.v0], id_b = vertex_numbers_[edge.v1];
    if (below0 != below1) {
      const vec3 cut = k.shadow_cut(a, b, height);
      (below0 ? b : a) = cut;
      (below0 ? id_b : id_a) = kCutId | edge.number;
    }
    add_clipped<S>(*frame_, k.shadow_project(eye, shift, a), k.shadow_project(eye, shift, b), id_a, id_b, weight, Source::edge, edge.number,
                   result);
  }

  const std::size_t sections = result.segments.size();
  for (const LocalTriangle& t : crossing_) {
    // The section runs from where the triangle's outline leaves the space below the plane to where it comes back.
    int leaving = -1, returning = -1;
    for (int c = 0; c < 3; ++c) {
      const bool here = below(t.corners[c]), there = below(t.corners[(c + 1) % 3]);
      if (here && !there) leaving = c;
      if (!here && there) returning = c;
    }
    if (leaving < 0 || returning < 0) continue;
    const auto cut = [&](int side) {
      const std::uint32_t from_v = t.corners[side], to_v = t.corners[(side + 1) % 3];
      return k.shadow_project(
          eye, shift,
          from_v < to_v ? k.shadow_cut(vertex(from_v), vertex(to_v), height) : k.shadow_cut(vertex(to_v), vertex(from_v), height));
    };
    const std::uint64_t id_a = kCutId | t.edges[leaving], id_b = kCutId | t.edges[returning];
    add_section(result, sections, [&] {
      add_clipped<S>(*frame_, cut(leaving), cut(returning), id_a, id_b, -facing(t.plane), Source::section, t.number, result);
    });
  }
  result.occluders = result.segments.size();

  add_outline(*frame_, result);
  add_horizons(*frame_, from, point, result);
}

template class LocalEdges<double>;
template class LocalEdges<float>;

}  // namespace steradian::shadow
