// OpenLights: the lights before which nothing stands for a whole tile, found together. Section "Open shafts" of docs/shadows.md.
#pragma once

#include <cstdint>
#include <vector>

#include "render/cpu/light_list.h"
#include "render/cpu/shadow_viewpoints.h"
#include "shadow/open_shaft.h"

namespace steradian {

class OpenLights {
 public:
  // cut_outs: boxes of what blocks light in part, beside the mesh. Keeps the references.
  OpenLights(const std::vector<PackLight>& lights, const shadow::TriangleTree& triangles, const std::vector<shadow::Box>& cut_outs);

  // A thread's memory.
  struct Work {
    shadow::TriangleTree::Viewers viewers;
    std::vector<std::uint8_t> wanted;  // by node: whether a light below it is still asked for
    std::vector<std::uint8_t> open;    // by PackLight::index: the result
  };
  // work.open for some lights: 1 where every point of the tile sees all of the light that lies above its horizons.
  void find(const TilePoints& points, const std::vector<const PackLight*>& lights, Work& work) const;

 private:
  struct Node {
    shadow::Box box;
    double margin = INFINITY;  // least of the lights'
    std::uint32_t parent = 0, first = 0;
    std::uint32_t light = 0;  // of a leaf: PackLight::index
    bool is_leaf = false;     // else its children stand at first and next to it
  };
  void build(std::uint32_t node, std::vector<Node>& leaves, std::size_t begin, std::size_t end);
  // Lights of which some points of the group may see no more than what their triangles' horizons leave.
  bool is_above(const TilePoints& points, const std::vector<std::uint32_t>& slots, const Node& node) const;

  const shadow::TriangleTree& triangles_;
  const std::vector<shadow::Box>& cut_outs_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_of_;  // by PackLight::index; kNone: never open
};

}  // namespace steradian
