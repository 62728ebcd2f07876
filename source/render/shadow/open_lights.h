// OpenLights: finds the lights that nothing occludes for a whole tile, all together. Section "Open shafts" of docs/theory/shadows.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/box_tree.h"
#include "render/lights/light_list.h"
#include "render/shadow/viewpoints.h"
#include "shadow/rays/shafts.h"

namespace steradian {

class OpenLights {
 public:
  // cut_outs: boxes of meshes that block light only in part, in addition to the mesh. Keeps the references.
  OpenLights(const std::vector<PackLight>& lights, const shadow::TriangleTree& triangles, const std::vector<Box3d>& cut_outs);

  // Memory of one thread.
  struct Work {
    shadow::TriangleTree::Viewers viewers;
    std::vector<std::uint8_t> open;  // result, by PackLight::index
  };
  // Sets work.open for some lights: 1 if every point of the tile sees all of the light that lies above its horizons.
  void find(const TilePoints& points, const std::vector<const PackLight*>& lights, Work& work) const;

 private:
  struct Volume : Box3d {
    double margin = INFINITY;  // least margin of the lights
    void add(const Volume& other) {
      Box3d::add(other);
      margin = std::min(margin, other.margin);
    }
  };
  // True if the lights lie above the horizons of the triangles of all points in the group.
  bool is_above(const TilePoints& points, const std::vector<std::uint32_t>& slots, const Box3d& lights) const;

  std::size_t count_;  // of all lights
  const shadow::TriangleTree& triangles_;
  const std::vector<Box3d>& cut_outs_;
  std::vector<std::uint32_t> lights_;  // PackLight::index by number in the tree, which has no directional lights
  BoxTree<Volume> tree_;
};

}  // namespace steradian
