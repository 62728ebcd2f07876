#include "shadow/edges/edges.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include "core/box_tree.h"
#include "shadow/edges/bodies.h"

namespace steradian::shadow {
namespace {

// Key that orders positions by their bits; -0 and 0 are equal.
struct PositionKey {
  std::uint64_t x, y, z;
  auto operator<=>(const PositionKey&) const = default;
};
PositionKey key_of(Vec3d p) {
  return {std::bit_cast<std::uint64_t>(p.x + 0.0), std::bit_cast<std::uint64_t>(p.y + 0.0), std::bit_cast<std::uint64_t>(p.z + 0.0)};
}

// For every vertex i, the number of the first vertex at the same position.
std::vector<std::uint32_t> welded(const std::vector<Vec3d>& positions) {
  std::vector<std::pair<PositionKey, std::uint32_t>> order(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) order[i] = {key_of(positions[i]), i};
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> result(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool repeats = i > 0 && order[i].first == order[i - 1].first;
    result[order[i].second] = repeats ? result[order[i - 1].second] : order[i].second;
  }
  return result;
}

// Starts at the smallest corner, so that coincident triangles have the same plane bit for bit, whichever corner they list first.
Plane plane_of(const std::vector<Vec3d>& vertices, std::array<std::uint32_t, 3> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  const Vec3d a = vertices[t[0]];
  const Vec3d normal = cross(vertices[t[1]] - a, vertices[t[2]] - a);
  return {normal, dot(normal, a)};
}

// Reorders sorted edges by leaves.
void sort_into_leaves(EdgeMesh& mesh) {
  const auto twice_the_middle = [&](std::uint32_t edge) {
    const Vec3d sum = mesh.vertices[mesh.edges[edge].v0] + mesh.vertices[mesh.edges[edge].v1];
    return Box3d{sum, sum};
  };
  const BoxTree<Box3d> tree(mesh.edges.size(), twice_the_middle, Halving{kLeafEdges});
  std::vector<MeshEdge> edges;
  std::vector<EdgeTriangle> triangles;
  edges.reserve(mesh.edges.size());
  triangles.reserve(mesh.edge_triangles.size());
  std::vector<std::uint32_t> place(mesh.edges.size());
  for (const std::uint32_t number : tree.order()) {
    MeshEdge e = mesh.edges[number];
    const auto begin = mesh.edge_triangles.begin() + e.first;
    place[number] = static_cast<std::uint32_t>(edges.size());
    e.first = static_cast<std::uint32_t>(triangles.size());
    triangles.insert(triangles.end(), begin, begin + e.count);
    edges.push_back(e);
  }
  mesh.edges = std::move(edges);
  mesh.edge_triangles = std::move(triangles);
  for (auto& sides : mesh.triangle_edges)
    for (std::uint32_t& e : sides) e = place[e];
}

Around ball_around(const EdgeMesh& mesh) {
  Box3d box;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) box.add(box_of(mesh, t));
  if (box.is_empty()) return {};
  return {box.center(), length(box.half())};
}

// Triangles with the corners of an earlier one. They share all three edges.
std::vector<CoincidentTriangle> coincident_triangles(const EdgeMesh& mesh) {
  std::vector<CoincidentTriangle> result;
  const auto third = [&](std::uint32_t t, const MeshEdge& e) {
    const auto& c = mesh.triangles[t];
    return c[0] + c[1] + c[2] - e.v0 - e.v1;
  };
  for (const MeshEdge& e : mesh.edges)
    for (std::uint32_t i = e.first + 1; i < e.first + e.count; ++i) {
      const EdgeTriangle& t = mesh.edge_triangles[i];
      // Each triangle has three edges: the one between its two least corners reports it.
      if (third(t.triangle, e) < std::max(e.v0, e.v1)) continue;
      for (std::uint32_t k = e.first; k < i; ++k) {
        const EdgeTriangle& earlier = mesh.edge_triangles[k];
        if (third(earlier.triangle, e) != third(t.triangle, e) || earlier.triangle == t.triangle) continue;
        result.push_back({t.triangle, earlier.triangle, t.walks == earlier.walks});
        break;
      }
    }
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  return result;
}

struct TriangleSide {
  std::uint32_t v0, v1, triangle, corner;
  std::int32_t walks;
};

}  // namespace

Box3d box_of(const EdgeMesh& mesh, std::uint32_t triangle) {
  Box3d box;
  for (const std::uint32_t v : mesh.triangles[triangle]) box.add(mesh.vertices[v]);
  return box;
}

EdgeMesh build_edges(const std::vector<Vec3d>& positions, const std::vector<std::uint32_t>& indices, std::span<const Body> bodies) {
  EdgeMesh mesh;
  mesh.vertices = positions;
  const std::vector<std::uint32_t> weld = welded(positions);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const std::array<std::uint32_t, 3> t = {weld[indices[i]], weld[indices[i + 1]], weld[indices[i + 2]]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    if (!is_finite(positions[t[0]]) || !is_finite(positions[t[1]]) || !is_finite(positions[t[2]])) continue;
    mesh.triangles.push_back(t);
    mesh.planes.push_back(plane_of(positions, t));
  }
  cut_by_bodies(mesh, bodies);
  std::vector<TriangleSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t number = 0; number < mesh.triangles.size(); ++number) {
    const auto& t = mesh.triangles[number];
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t from = t[c], to = t[(c + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), number, c, from < to ? 1 : -1});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const TriangleSide& a, const TriangleSide& b) {
    return std::tie(a.v0, a.v1, a.triangle, a.corner) < std::tie(b.v0, b.v1, b.triangle, b.corner);
  });
  mesh.triangle_edges.resize(mesh.triangles.size());
  for (const TriangleSide& s : sides) {
    if (mesh.edges.empty() || mesh.edges.back().v0 != s.v0 || mesh.edges.back().v1 != s.v1)
      mesh.edges.push_back({s.v0, s.v1, static_cast<std::uint32_t>(mesh.edge_triangles.size()), 0});
    ++mesh.edges.back().count;
    mesh.edge_triangles.push_back({s.triangle, s.walks});
    mesh.triangle_edges[s.triangle][s.corner] = static_cast<std::uint32_t>(mesh.edges.size() - 1);
  }
  for (const std::vector<std::uint32_t>& triangles : mesh.inside)
    for (const std::uint32_t t : triangles)
      for (const std::uint32_t e : mesh.triangle_edges[t]) mesh.edges[e].at_body = true;
  sort_into_leaves(mesh);
  mesh.coincident = coincident_triangles(mesh);
  mesh.around = ball_around(mesh);
  return mesh;
}

BlockingTriangles blocking_triangles(const Scene& scene) {
  BlockingTriangles result;
  auto& [positions, indices] = result;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.is_light_shape || !mesh.casts_shadow || scene.materials[static_cast<std::size_t>(mesh.material)].alpha_mode == AlphaMode::mask)
      continue;
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const Vec3f p : mesh.positions) positions.push_back(static_cast<Vec3d>(p));
    for (const std::uint32_t i : mesh.indices) indices.push_back(first + i);
  }
  return result;
}

EdgeMesh build_edges(const Scene& scene) {
  const BlockingTriangles triangles = blocking_triangles(scene);
  return build_edges(triangles.positions, triangles.indices, bodies_of(scene.area_lights));
}

std::vector<Body> bodies_of(const std::vector<AreaLight>& lights) {
  std::vector<Body> bodies;
  for (const AreaLight& light : lights)
    if (const std::optional<Body> body = Body::of(light.shape)) bodies.push_back(*body);
  return bodies;
}

}  // namespace steradian::shadow
