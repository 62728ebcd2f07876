// Exchange areas of pairs with triangles between them: the closed form less the integral of what the triangles hide.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/box_tree.h"
#include "exchange/pair.h"
#include "scene/emitters/merge_polygons.h"

namespace steradian::exchange {

using ObstacleTriangle = std::array<Vec3d, 3>;

// Triangles that obstruct, with a tree over their boxes. Neighbours in one plane are merged to faces, which have fewer edges.
class Obstacles {
 public:
  Obstacles() = default;
  // between: all elements that will be asked for, if known; triangles that have all of them on one side are left out.
  explicit Obstacles(const std::vector<ObstacleTriangle>& triangles, const std::vector<PlaneElement>& between = {});
  bool is_empty() const { return triangles_.empty(); }

  // Triangles that may lie between the fronts of two elements, each in front of the other's plane; ascending.
  std::vector<std::uint32_t> between(const PlaneElement& a, const PlaneElement& b) const;
  // True if the face of a triangle is convex and cuts all ways from one element to the other.
  bool covers(std::uint32_t triangle, const PlaneElement& a, const PlaneElement& b) const;
  const ObstacleTriangle& triangle(std::uint32_t number) const { return triangles_[number]; }

 private:
  void drop_outer(const std::vector<PlaneElement>& elements);
  void add_face(const scene::MergedPolygon& polygon, const std::vector<ObstacleTriangle>& triangles);

  std::vector<ObstacleTriangle> triangles_;
  std::vector<std::uint32_t> face_of_;
  std::vector<std::vector<Vec3d>> faces_;  // outlines of faces without holes; empty: not one plane polygon
  BoxTree<Box3d> tree_;
};

// The visible exchange area of two elements: never below 0, never above the unobstructed one.
struct VisibleExchange {
  ExchangeArea visible;
  ExchangeArea unobstructed;
  bool is_obstructed = false;  // some triangle may lie between
};
// The hidden part is integrated over the first element; exchanging the elements is a check.
VisibleExchange visible_exchange(const PlaneElement& a, const PlaneElement& b, const Obstacles& obstacles, double eps);
// The same where the unobstructed exchange area is known.
VisibleExchange visible_exchange(const PlaneElement& a, const PlaneElement& b, const Obstacles& obstacles, double eps,
                                 const ExchangeArea& unobstructed);

}  // namespace steradian::exchange
