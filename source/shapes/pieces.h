// Pieces: for each point of a tile, edges of its own, which bound the visible part of a light behind occluders.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "shapes/outline.h"
#include "steradian/polygon_light.h"

namespace steradian::packed {

// Vectors are relative to the point, in the world's frame. Points come in blocks of 16; shorter lists are padded with edges of no length.
// Every point faces the light's front.
class Pieces {
 public:
  static constexpr std::size_t kBlock = 16;
  static constexpr std::size_t kEdgePlanes = 6, kElementPlanes = 13;

  void clear() {
    edges_.clear();
    elements_.clear();
    blocks_.clear();
  }
  // Adds the next 16 points with capacity for `edge_count` edges each. Returns the edges' planes: kEdgePlanes of 16 numbers an edge.
  float* add_block(std::size_t edge_count) {
    blocks_.push_back({edges_.size(), edge_count});
    edges_.resize(edges_.size() + edge_count * kEdgePlanes * kBlock, 0.0f);
    elements_.resize(elements_.size() + kElementPlanes * kBlock, 0.0f);
    float* e = &elements_[elements_.size() - kElementPlanes * kBlock];
    // Placeholder elements that are never used: too wide to serve in a pack of which another point has elements.
    std::fill_n(e, kBlock, 1.0f);
    std::fill_n(e + 3 * kBlock, kBlock, kTooWide);
    std::fill_n(e + (kElementPlanes - 1) * kBlock, kBlock, kNoElements);
    return edges_.data() + blocks_.back().first;
  }
  void set_edge(std::size_t point, std::size_t edge, Vec3f a, Vec3f b) {
    float* e = &edges_[blocks_[point / kBlock].first + edge * kEdgePlanes * kBlock + point % kBlock];
    for (const float x : {a.x, a.y, a.z, b.x, b.y, b.z}) {
      *e = x;
      e += kBlock;
    }
  }
  // Sets the elements of the point's part of the light, so that small parts retain their digits.
  //
  //   q     relative to the point
  //   area  along the normal to the point's side
  void set_elements(std::size_t point, const LightQuarters& q, Vec3d area) {
    float* e = &elements_[point / kBlock * kElementPlanes * kBlock + point % kBlock];
    for (const Vec3d v : {q.center, q.reach_a, q.reach_b, area})
      for (const double x : {v.x, v.y, v.z}) {
        *e = static_cast<float>(x);
        e += kBlock;
      }
    *e = static_cast<float>((dot(q.reach_a, q.reach_a) + dot(q.reach_b, q.reach_b)) / 2);
  }

  // Points beyond this count see no light.
  STERADIAN_INLINE std::size_t point_count() const { return static_cast<std::size_t>(blocks_.end() - blocks_.begin()) * kBlock; }
  STERADIAN_INLINE std::size_t edge_count(std::size_t point) const { return blocks_.data()[point / kBlock].count; }
  // Start of an edge's planes for a point: kEdgePlanes of them, kBlock apart.
  STERADIAN_INLINE const float* edge(std::size_t point, std::size_t number) const {
    return edges_.data() + blocks_.data()[point / kBlock].first + number * kEdgePlanes * kBlock + point % kBlock;
  }
  STERADIAN_INLINE const float* elements(std::size_t point) const {
    return elements_.data() + point / kBlock * kElementPlanes * kBlock + point % kBlock;
  }

  // The pieces of one point as a light whose contours are edges; `at` is the point's position.
  PreparedPolygon light_of(std::size_t point, Vec3d at, Vec3d up) const {
    PreparedPolygon light;
    light.normal = up;
    light.centroid = at - up;  // the point sees its front
    light.contours.push_back(0);
    for (std::size_t k = 0; k < edge_count(point); ++k) {
      const float* e = edge(point, k);
      const auto corner = [&](std::size_t c) {
        return Vec3d{static_cast<double>(e[c * kBlock]), static_cast<double>(e[(c + 1) * kBlock]),
                     static_cast<double>(e[(c + 2) * kBlock])};
      };
      if (corner(0) == corner(3)) continue;
      light.vertices.push_back(at + corner(0));
      light.vertices.push_back(at + corner(3));
      light.contours.push_back(light.vertices.size());
    }
    return light;
  }

  template <class Use>
  bool any_bound(Use) const {
    return true;
  }

 private:
  static constexpr float kNoElements = 1e30f;  // a deviation that no distance exceeds
  static constexpr float kTooWide = 1e6f;      // a reach before the distance 1
  struct Block {
    std::size_t first, count;
  };
  std::vector<Block> blocks_;
  std::vector<float> edges_, elements_;
};

}  // namespace steradian::packed
