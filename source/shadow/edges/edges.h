// EdgeMesh: the triangles that can block light, and their edges, welded over all meshes. Built once per scene.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/box.h"
#include "shapes/body.h"
#include "steradian/scene.h"
#include "steradian/vector.h"

namespace steradian::shadow {

// dot(normal, x) = offset; the front is where the corners run counter-clockwise.
struct Plane {
  Vec3d normal;
  double offset = 0;
};

// A triangle at an edge. walks: +1 if it traverses the edge from v0 to v1, -1 in the other direction.
struct EdgeTriangle {
  std::uint32_t triangle = 0;
  std::int32_t walks = 1;
};

// v0 < v1. Its `count` triangles start at edge_triangles[first]: one at a border, two inside a surface, any number where surfaces meet.
struct MeshEdge {
  std::uint32_t v0 = 0, v1 = 0;
  std::uint32_t first = 0, count = 0;
  bool at_body = false;  // a triangle of it lies within a round light, and does not block that light
};

// A ball around the triangles.
struct Around {
  Vec3d middle;
  double radius = 0;
};

// A triangle with the corners of an earlier one. same_direction: it walks them in the same order.
struct CoincidentTriangle {
  std::uint32_t number = 0, first = 0;
  bool same_direction = true;
};

struct EdgeMesh {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Plane> planes;                                 // planes of the triangles
  std::vector<MeshEdge> edges;                               // in the order of EdgeTree's leaves: neighbours are stored together
  std::vector<EdgeTriangle> edge_triangles;                  // in the order of edges
  std::vector<std::array<std::uint32_t, 3>> triangle_edges;  // side i runs from corner i to corner i + 1
  std::vector<std::vector<std::uint32_t>> inside;            // for each body, the triangles inside it, ascending
  std::vector<CoincidentTriangle> coincident;                // ascending
  Around around;
};

// The box around a triangle.
Box3d box_of(const EdgeMesh& mesh, std::uint32_t triangle);

// Number of edges in a leaf of EdgeTree; the last leaf may have fewer.
inline constexpr std::uint32_t kLeafEdges = 16;

// Surfaces need not be closed, oriented or manifold. Equal positions become one vertex. Triangles with two equal corners or a coordinate
// that is not finite are dropped. Triangles that enter a body are cut along its surface.
EdgeMesh build_edges(const std::vector<Vec3d>& positions, const std::vector<std::uint32_t>& indices, std::span<const Body> bodies = {});

// Everything that blocks a scene's light exactly: no shapes that stand for lights, no cut-outs.
struct BlockingTriangles {
  std::vector<Vec3d> positions;
  std::vector<std::uint32_t> indices;  // three a triangle
};
BlockingTriangles blocking_triangles(const Scene& scene);

// Builds the edges of a scene's blocking triangles. The bodies are those of its area lights (bodies_of).
EdgeMesh build_edges(const Scene& scene);

// The bodies of the round lights among a scene's area lights, in their order.
std::vector<Body> bodies_of(const std::vector<AreaLight>& lights);

}  // namespace steradian::shadow
