// Patches: the triangles of a scene cut into small ones. Each side of a patch carries one reflected radiance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "steradian/scene.h"

namespace steradian::radiosity {

inline constexpr std::uint32_t kNoSide = UINT32_MAX;
inline constexpr std::size_t kPatchParts = 16;  // equal parts of a patch

// A place on the patches, to a part of a side.
struct PatchPlace {
  std::uint32_t side = kNoSide;
  std::uint32_t part = 0;
};

class Patches {
 public:
  // Cuts triangles with long edges into a grid, so that there are about `wanted` patches, or half as many more than triangles.
  Patches(const Scene& scene, std::size_t wanted);

  std::size_t side_count() const { return 2 * sites_.size(); }
  // The place that a ray meets at a triangle's barycentric coordinates. front: on the side of the triangle's winding.
  PatchPlace place_at(std::size_t mesh, std::size_t triangle, float u, float v, bool front) const;

  // True if light goes through a mesh, which then neither meets bounced light nor sends any.
  bool lets_through(std::size_t mesh) const { return lets_through_[mesh] != 0; }

  // The middle of a side's patch, as barycentric coordinates of its triangle.
  struct Site {
    std::uint32_t mesh, triangle;
    float u, v;
    float step;  // side of the grid's cells in these coordinates
  };
  const Site& site(std::uint32_t side) const { return sites_[side / 2]; }
  // The middle of a part.
  Site site(PatchPlace place) const;
  // The group of up to eight neighbouring sides of a triangle that a side belongs to, by its first side.
  std::uint32_t group_of(std::uint32_t side) const;
  static bool is_front(std::uint32_t side) { return side % 2 == 0; }

 private:
  struct Grid {
    std::uint32_t first;  // patch
    std::uint32_t cells;  // along a side: cells * cells patches
  };
  std::vector<std::vector<Grid>> grids_;  // by mesh and triangle
  std::vector<Site> sites_;
  std::vector<std::uint8_t> lets_through_;  // by mesh
};

}  // namespace steradian::radiosity
