// The straight outlines of a world in a tree of lines, which any point can traverse from near to far.
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

// Binary space partition (Fuchs, Kedem, Naylor 1980). Facets on the point's side of a line can occlude facets on the line, and both can
// occlude facets beyond it. The lines are those of facets, or halve a set across its longer side.
class DepthOrder {
 public:
  DepthOrder() = default;
  explicit DepthOrder(const World& world);

  // If segments cut each other into too many parts, all of them are omitted.
  bool has_segments() const { return !nodes_.empty(); }

  // Calls add(facet), nearest first; of coincident facets the visible one comes first. Subtrees are skipped if skip(box) is true for their
  // box. The traversal ends when done() is true.
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
    std::uint32_t first = 0, last = 0, facets = 0;  // on the line; in the subtree
    Box2d box;                                      // around the subtree
  };
  std::vector<Node> nodes_;
  std::vector<Facet> facets_;
};

}  // namespace steradian::plane
