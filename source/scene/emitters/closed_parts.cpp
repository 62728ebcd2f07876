#include "scene/emitters/closed_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace steradian::scene {
namespace {

using Key = std::array<std::int64_t, 3>;

struct KeyHash {
  std::size_t operator()(const Key& k) const {
    std::uint64_t h = 0;
    for (const std::int64_t x : k) h = (h ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u + (h >> 29);
    return static_cast<std::size_t>(h ^ (h >> 32));
  }
};

// A grid whose cells are a millionth (2^-20) of the extent. Corners that are equal up to rounding share a cell, unless they lie on the
// border of two. Then their mesh counts as open.
struct Grid {
  Vec3d low;
  double cell = 1;

  explicit Grid(const std::vector<Triangle>& triangles) {
    Box3d box;
    for (const Triangle& t : triangles)
      for (const Vec3d& v : t) box.add(v);
    low = box.low;
    const double extent = coordinate(box.size(), box.longest_side());
    if (extent > 0) cell = extent / 1048576;
  }
  Key key_of(Vec3d p) const {
    const Vec3d v = (p - low) / cell;
    return {std::llround(v.x), std::llround(v.y), std::llround(v.z)};
  }
};

using Corners = std::array<std::uint32_t, 3>;

// Numbers every distinct position.
std::vector<Corners> number_corners(const std::vector<Triangle>& triangles, std::size_t& count) {
  std::unordered_map<Key, std::uint32_t, KeyHash> numbers;
  const Grid grid(triangles);
  std::vector<Corners> result;
  result.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    Corners corners{};
    for (std::size_t c = 0; c < 3; ++c)
      corners[c] = numbers.try_emplace(grid.key_of(t[c]), static_cast<std::uint32_t>(numbers.size())).first->second;
    result.push_back(corners);
  }
  count = numbers.size();
  return result;
}

bool degenerate(const Corners& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; }

// Sets of connected corners: a union-find forest whose paths are shortened.
class Connected {
 public:
  explicit Connected(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

std::uint64_t directed_edge(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

bool is_closed(const MeshPart& part, const std::vector<Corners>& corners) {
  std::vector<std::uint64_t> edges, turned;
  for (const std::size_t t : part.triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = corners[t][c], b = corners[t][(c + 1) % 3];
      edges.push_back(directed_edge(a, b));
      turned.push_back(directed_edge(b, a));
    }
  std::sort(edges.begin(), edges.end());
  std::sort(turned.begin(), turned.end());
  return edges == turned && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

void measure(MeshPart& part, const std::vector<Triangle>& triangles) {
  const Vec3d origin = triangles[part.triangles.front()][0];  // avoids cancellation for a part far from the world's origin
  for (const std::size_t t : part.triangles) {
    const Triangle& p = triangles[t];
    part.volume += dot(p[0] - origin, cross(p[1] - origin, p[2] - origin)) / 6;
    for (const Vec3d& v : p) part.box.add(v);
  }
}

}  // namespace

std::vector<MeshPart> mesh_parts(const std::vector<Triangle>& triangles) {
  std::size_t corner_count = 0;
  const std::vector<Corners> corners = number_corners(triangles, corner_count);
  Connected connected(corner_count);
  for (const Corners& c : corners) {
    if (degenerate(c)) continue;
    connected.join(c[0], c[1]);
    connected.join(c[1], c[2]);
  }
  std::vector<MeshPart> parts;
  std::unordered_map<std::uint32_t, std::size_t> part_of_root;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (degenerate(corners[t])) continue;
    const auto [found, is_new] = part_of_root.try_emplace(connected.root(corners[t][0]), parts.size());
    if (is_new) parts.emplace_back();
    parts[found->second].triangles.push_back(t);
  }
  for (MeshPart& part : parts) {
    part.closed = is_closed(part, corners);
    measure(part, triangles);
  }
  return parts;
}

// For each mesh, the bounds of all other meshes, computed in one pass from either end.
std::vector<Box3d> bounds_of_the_others(const Scene& scene) {
  std::vector<Box3d> result(scene.meshes.size());
  const auto pass = [&](auto begin, auto end, auto out) {
    Box3d before;
    for (auto mesh = begin; mesh != end; ++mesh, ++out) {
      out->add(before);
      for (const Vec3f& p : mesh->positions) before.add(static_cast<Vec3d>(p));
    }
  };
  pass(scene.meshes.begin(), scene.meshes.end(), result.begin());
  pass(scene.meshes.rbegin(), scene.meshes.rend(), result.rbegin());
  return result;
}

namespace {

// True if the part is a dome around all other meshes, which it lights.
bool encloses(const MeshPart& part, const Box3d& others) {
  const Vec3d a = others.low - part.box.low, b = part.box.high - others.high;
  return !others.is_empty() && a.x > 0 && a.y > 0 && a.z > 0 && b.x > 0 && b.y > 0 && b.z > 0;
}

}  // namespace

Shines where_it_shines(const SurfaceMaterial& m, const MeshPart& part, const Box3d& others) {
  if (!part.closed || part.volume == 0) return Shines::as_the_file_says;
  if (!m.double_sided) return part.volume > 0 ? Shines::outwards : Shines::as_the_file_says;
  if (encloses(part, others)) return Shines::as_the_file_says;
  return part.volume > 0 ? Shines::outwards : Shines::outwards_and_faces_inwards;
}

void turn_over(MergedPolygon& polygon) {
  std::reverse(polygon.outline.begin(), polygon.outline.end());
  for (std::vector<Vec3d>& hole : polygon.holes) std::reverse(hole.begin(), hole.end());
}

}  // namespace steradian::scene
