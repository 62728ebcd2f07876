// The straight outlines of a world in a tree of lines, which any point can walk through from near to far.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/exact/world.h"

namespace steradian::plane {

// A part of a segment, from a to b along it.
struct Facet {
  Vec2d a, b;
  const Curve* curve;
};

// Binary space partition (Fuchs, Kedem, Naylor 1980): what lies on the point's side of a line can hide what lies on the line, and both can
// hide what is beyond. Lines are those of facets, or halve a set across its longer side.
class DepthOrder {
 public:
  DepthOrder() = default;
  explicit DepthOrder(const World& world);

  // Segments that cut each other into too many parts are left out, all of them.
  bool has_segments() const { return !nodes_.empty(); }

  // Calls add(facet), nearest first, of coincident ones the one that is seen first; subtrees are passed by of whose box skip(box) is true,
  // and the walk ends where done() is.
  template <class Add, class Skip, class Done>
  void walk(Vec2d from, Add add, Skip skip, Done done) const {
    if (nodes_.empty()) return;
    thread_local std::vector<std::uint32_t> stack;  // a node, times 2; odd: its own facets
    stack.assign(1, 0);
    while (!stack.empty() && !done()) {
      const std::uint32_t top = stack.back();
      stack.pop_back();
      const Node& node = nodes_[top / 2];
      if (top % 2 != 0) {
        for (std::uint32_t i = node.first; i < node.last; ++i) add(facets_[i]);
        continue;
      }
      if (node.facets >= kWorthABox && skip(node.box)) continue;
      const bool in_front = dot(node.normal, from) > node.offset;
      const std::int32_t near = in_front ? node.front : node.back, far = in_front ? node.back : node.front;
      if (far >= 0) stack.push_back(2 * static_cast<std::uint32_t>(far));
      if (node.first < node.last) stack.push_back(top + 1);
      if (near >= 0) stack.push_back(2 * static_cast<std::uint32_t>(near));
    }
  }

 private:
  static constexpr std::uint32_t kWorthABox = 3;
  struct Node {
    Vec2d normal;
    double offset = 0;
    std::int32_t front = -1, back = -1;
    std::uint32_t first = 0, last = 0, facets = 0;  // on the line; of the subtree
    Box box;                                        // of the subtree
  };
  std::vector<Node> nodes_;
  std::vector<Facet> facets_;
};

}  // namespace steradian::plane
