// Triangles that obstruct, and which of them may lie between two elements.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/box_tree.h"
#include "exchange/pairs/plane_element.h"
#include "scene/emitters/merge_polygons.h"
#include "shadow/edges/edges.h"

namespace steradian::exchange {

using ObstacleTriangle = std::array<Vec3d, 3>;

// A face that obstructs: neighbouring triangles in one plane.
struct ObstacleFace {
  Vec3d normal, point;         // its plane
  double off_plane = 0;        // largest height of a corner above or below the plane
  std::vector<Vec3d> outline;  // empty: not one plane polygon without holes
};

// The mean plane of some triangles that face the same way.
ObstacleFace plane_of_triangles(const std::vector<ObstacleTriangle>& triangles, const std::vector<std::size_t>& numbers);

// Triangles that obstruct, with a tree over their boxes. Neighbours in one plane are merged to faces, which have fewer edges.
class Obstacles {
 public:
  Obstacles() = default;
  // between: all elements that will be asked for, if known; triangles that have all of them on one side are left out.
  explicit Obstacles(const std::vector<ObstacleTriangle>& triangles, const std::vector<PlaneElement>& between = {});
  bool is_empty() const { return triangles_.empty(); }

  // Triangles that may lie between the fronts of two elements, each in front of the other's plane; ascending.
  std::vector<std::uint32_t> between(const PlaneElement& a, const PlaneElement& b) const;
  // The same for some triangles only, in their order.
  std::vector<std::uint32_t> between(const PlaneElement& a, const PlaneElement& b, const std::vector<std::uint32_t>& among) const;
  // True if the face of a triangle is convex and cuts all ways from one element to the other.
  bool covers(std::uint32_t triangle, const PlaneElement& a, const PlaneElement& b) const;
  // Triangles that may hide a part of an element from a point in front of it; the element lies above the point's horizon.
  std::vector<std::uint32_t> before(Vec3d point, Vec3d normal, const PlaneElement& element) const;
  // The edges of some triangles.
  shadow::EdgeMesh mesh_of(const std::vector<std::uint32_t>& numbers) const;

 private:
  void drop_outer(const std::vector<PlaneElement>& elements);
  void add_face(const scene::MergedPolygon& polygon, const std::vector<ObstacleTriangle>& triangles);

  std::vector<ObstacleTriangle> triangles_;
  std::vector<std::uint32_t> face_of_;
  std::vector<ObstacleFace> faces_;
  BoxTree<Box3d> tree_;
};

}  // namespace steradian::exchange
