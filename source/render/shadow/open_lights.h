// OpenLights: finds the lights that nothing occludes for a whole tile, all together. Section "Open shafts" of docs/theory/shadows.md.
#pragma once

#include <cstdint>
#include <vector>

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
    std::vector<std::uint8_t> wanted;  // by node: 1 if a light below it is still asked for
    std::vector<std::uint8_t> open;    // result, by PackLight::index
  };
  // Sets work.open for some lights: 1 if every point of the tile sees all of the light that lies above its horizons.
  void find(const TilePoints& points, const std::vector<const PackLight*>& lights, Work& work) const;

 private:
  struct Node {
    Box3d box;
    double margin = INFINITY;  // least margin of the lights
    std::uint32_t parent = 0, first = 0;
    std::uint32_t light = 0;  // PackLight::index, for a leaf
    bool is_leaf = false;     // false: its children are nodes first and first + 1
  };
  void build(std::uint32_t node, std::vector<Node>& leaves, std::size_t begin, std::size_t end);
  // True if the node's lights lie above the horizons of the triangles of all points in the group.
  bool is_above(const TilePoints& points, const std::vector<std::uint32_t>& slots, const Node& node) const;

  const shadow::TriangleTree& triangles_;
  const std::vector<Box3d>& cut_outs_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_of_;  // node by PackLight::index; kNone: never open
};

}  // namespace steradian
