// A binary tree of boxes around numbered items.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/box.h"

namespace steradian {

// Volume: a Box, or a type derived from one with an add() that joins two of them.
template <class Volume>
class BoxTree {
 public:
  // Nodes stand in the order of a traversal, a node before its children. An additional node marks the end.
  struct Node {
    Volume volume;
    std::uint32_t first = 0;  // index of its first item in order(); the last one lies before the first item of node `next`
    std::uint32_t next = 0;   // index of the first node that is not below this one; for a leaf, the one behind it
  };
  struct Item {
    decltype(Volume{}.center()) middle;
    std::uint32_t number;
  };

  BoxTree() = default;
  // Sorts the items 0 to count - 1.
  //
  //   volume  volume(number) is an item's volume
  //   split   split(items) reorders the items of a node, and returns how many go to the first child. It returns 0 for a leaf.
  template <class VolumeOf, class Split>
  BoxTree(std::size_t count, VolumeOf volume, Split split) {
    std::vector<Item> items(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto number = static_cast<std::uint32_t>(i);
      items[i] = {volume(number).center(), number};
    }
    order_.reserve(count);
    build(std::span(items), volume, split);
    nodes_.push_back({{}, static_cast<std::uint32_t>(count), 0});
  }

  // Replaces every volume by change(volume).
  template <class Change>
  void change(Change change) {
    for (Node& node : nodes_) node.volume = change(node.volume);
  }

  const std::vector<Node>& nodes() const { return nodes_; }
  // The items' numbers, leaf after leaf.
  const std::vector<std::uint32_t>& order() const { return order_; }
  std::span<const std::uint32_t> items(const Node& node) const {
    return std::span(order_).subspan(node.first, nodes_[node.next].first - node.first);
  }

  // Traverses the nodes for which enter(node) is true, in order. Calls use(first, last) with the places in order() of each leaf's items,
  // until it returns true. Returns true if it did.
  template <class Enter, class Use>
  bool any_leaf(Enter enter, Use use) const {
    for (std::size_t n = 0; n + 1 < nodes_.size();) {
      const Node& node = nodes_[n];
      if (!enter(node))
        n = node.next;
      else if (++n == node.next && use(node.first, nodes_[n].first))
        return true;
    }
    return false;
  }

 private:
  template <class VolumeOf, class Split>
  void build(std::span<Item> items, const VolumeOf& volume, const Split& split) {
    const std::size_t node = nodes_.size(), half = split(items);
    nodes_.push_back({{}, static_cast<std::uint32_t>(order_.size()), 0});
    Volume all;
    if (half == 0) {
      for (const Item& item : items) {
        all.add(volume(item.number));
        order_.push_back(item.number);
      }
    } else {
      const std::size_t first = nodes_.size();
      build(items.first(half), volume, split);
      const std::size_t second = nodes_.size();
      build(items.subspan(half), volume, split);
      all.add(nodes_[first].volume);
      all.add(nodes_[second].volume);
    }
    nodes_[node].volume = all;
    nodes_[node].next = static_cast<std::uint32_t>(nodes_.size());
  }

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

// The items of all leaves that meet a box, in the tree's order.
template <class Volume>
std::vector<std::uint32_t> near_box(const BoxTree<Volume>& tree, const Volume& box) {
  std::vector<std::uint32_t> items;
  tree.any_leaf([&](const auto& node) { return node.volume.meets(box); },
                [&](std::uint32_t first, std::uint32_t last) {
                  items.insert(items.end(), tree.order().begin() + first, tree.order().begin() + last);
                  return false;
                });
  return items;
}

// Puts the `half` items with the least middles along an axis first. Numbers settle ties. Returns `half`.
template <class Item>
std::size_t halve(std::span<Item> items, std::size_t half, int axis) {
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(), [axis](const Item& a, const Item& b) {
    const auto x = coordinate(a.middle, axis), y = coordinate(b.middle, axis);
    return x != y ? x < y : a.number < b.number;
  });
  return half;
}

// Halves items by their middles, along the longest side of the box around these, down to leaves of `leaf` items; the last one may have
// fewer. Numbers ascend in a leaf, so that the order is unique.
struct Halving {
  std::size_t leaf;

  template <class Item>
  std::size_t operator()(std::span<Item> items) const {
    if (items.size() <= leaf) {
      std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.number < b.number; });
      return 0;
    }
    Box<decltype(Item::middle)> middles;
    for (const Item& item : items) middles.add(item.middle);
    const std::size_t half = (items.size() + 2 * leaf - 1) / (2 * leaf) * leaf;
    return halve(items, half, middles.longest_side());
  }
};

}  // namespace steradian
