// Patches: the triangles of a scene cut into small ones. Each side of a patch carries one reflected radiance. A side that a wall crosses
// becomes several, so that none lies on both sides of the wall. Shapes of lamps reflect nothing, and have none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/surface/clear_meshes.h"
#include "render/surface/ray_scene.h"
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
  // Splits sides into the groups of their parts that see each other along the surface.
  void split(const Scene& scene, const RayScene& rays);

  std::size_t side_count() const { return 2 * sites_.size(); }
  // The place that a ray meets at a triangle's barycentric coordinates; no side if the triangle has no patches. front: on the side of the
  // triangle's winding.
  PatchPlace place_at(std::size_t mesh, std::size_t triangle, float u, float v, bool front) const;

  // The same where the side is split: the first of its sides whose own place the place on the surface sees along the surface. A part may
  // lie on both sides of a wall.
  PatchPlace seen_along(PatchPlace at, Vec3f place, const RayScene& rays) const;

  // True if light goes through a mesh, which then neither meets bounced light nor sends any.
  bool lets_through(std::size_t mesh) const { return lets_through_[mesh] != 0; }
  const ClearMeshes& clear_meshes() const { return clear_; }

  // The middle of a side's patch, or of a part that stands for a split side, as barycentric coordinates of its triangle.
  struct Site {
    std::uint32_t mesh, triangle;
    float u, v;
    float step;  // side of the grid's cells in these coordinates
  };
  const Site& site(std::uint32_t side) const { return sites_[side / 2]; }
  // The middle of a part.
  Site site(PatchPlace place) const;
  // True if a part belongs to the side. All do, unless the side is split.
  bool holds(PatchPlace place) const;
  // Area of a side, as a fraction of its triangle's area.
  float area(std::uint32_t side) const;
  // The group of up to eight neighbouring sides of a triangle that a side belongs to, by its first side.
  std::uint32_t group_of(std::uint32_t side) const;
  static bool is_front(std::uint32_t side) { return side % 2 == 0; }

 private:
  struct Split {
    std::array<std::uint32_t, kPatchParts> of_parts;  // side of each part
    std::vector<std::uint32_t> sides;
    std::vector<Vec3d> places;  // of the sides, a little above the surface
    Vec3d lift;                 // from the surface
  };
  // The patch that a patch was split from, or itself.
  std::uint32_t whole(std::uint32_t patch) const { return patch < grid_patches_ ? patch : wholes_[patch - grid_patches_]; }
  const Split* split_of(std::uint32_t side) const {
    const std::uint32_t of_grid = 2 * whole(side / 2) + side % 2;
    return split_of_.empty() || split_of_[of_grid] == kNoSide ? nullptr : &splits_[split_of_[of_grid]];
  }
  // Groups of a side's parts, from 0 on. All parts that the middle sees are group 0.
  std::array<std::uint8_t, kPatchParts> groups_of_parts(std::uint32_t side, const Scene& scene, const RayScene& rays) const;

  struct Grid {
    std::uint32_t first;  // patch
    std::uint32_t cells;  // along a side: cells * cells patches; 0: none
  };
  const Grid& grid_of(std::size_t mesh, std::size_t triangle) const { return grids_[first_grid_[mesh] + triangle]; }
  std::vector<Grid> grids_;              // of the triangles of all meshes
  std::vector<std::size_t> first_grid_;  // by mesh
  std::vector<Site> sites_;
  std::vector<std::uint8_t> lets_through_;  // by mesh
  ClearMeshes clear_;
  float size_ = 0;                       // of the patches that large triangles are cut into
  std::size_t grid_patches_ = 0;         // those of the grids come first
  std::vector<std::uint32_t> wholes_;    // of the patches after them: the patch that each was split from
  std::vector<std::uint32_t> split_of_;  // by side of the grids: index below, or kNoSide; empty: no side is split
  std::vector<Split> splits_;
};

}  // namespace steradian::radiosity
