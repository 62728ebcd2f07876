// Elements: parts of outlines, on each of which what the wall sends on is linear.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "plane/exact/envelope.h"
#include "plane/exact/world.h"

namespace steradian::plane {

struct Element {
  std::size_t curve = 0;        // in World::curves
  bool back = false;            // of a line of no thickness: the other side
  double from = 0, to = 1;      // shares of the curve
  Vec2d middle, along, normal;  // of its chord; along and normal are units, the normal points to the lit side
  double half = 0;              // of the chord's length
  Vec3d albedo;
  // Radiance constant + slope u at the place u = dot(p - middle, along) / half, and what it is off by, as far as is known.
  Vec3d constant, slope, error;
};

// A place on an element: a point of the curve, its normal there, and u.
struct ElementPlace {
  Vec2d at, normal;
  double u;
};
// Its first and its last point: the same numbers as its neighbours'.
std::pair<Vec2d, Vec2d> ends_of(const World& world, const Element& element);
ElementPlace place_on(const World& world, const Element& element, double share);

// Does it lie in no other body?
bool is_open(const World& world, const ElementPlace& place);

// What a body reflects; none where that is nothing.
std::optional<Vec3d> albedo_of(const PlaneBody& body, double most);

// Where an element lies on its curve: what rows ask for, without the rest of it.
struct ElementSpan {
  double from, to, per_share;  // 1 / (to - from)
};

// All of the elements, by curve and side and by rising place, no longer than `size`; cut where other outlines cross.
class Elements {
 public:
  Elements() = default;
  Elements(const World& world, double size, double most_albedo);

  const std::vector<Element>& all() const { return all_; }
  const std::vector<ElementSpan>& spans() const { return spans_; }
  std::vector<Element>& all() { return all_; }
  // Halves those that are marked.
  void halve(const World& world, const std::vector<char>& marked);

  // Those of a curve's side: [first, second).
  std::pair<std::size_t, std::size_t> of(std::size_t curve, bool back) const {
    const std::size_t k = 2 * curve + (back ? 1 : 0);
    return {first_[k], first_[k + 1]};
  }
  // Of a part of a curve, seen as a point or as a wall sees it.
  template <class Part>
  std::pair<std::size_t, std::size_t> of(const Part& part, const World& world) const {
    return of(static_cast<std::size_t>(part.curve - world.curves.data()), part.back);
  }
  template <class Part>
  bool reflects(const Part& part, const World& world) const {
    const auto [first, last] = of(part, world);
    return first < last;
  }

 private:
  void index(const World& world);
  std::vector<Element> all_;
  std::vector<ElementSpan> spans_;
  std::vector<std::size_t> first_;
};

}  // namespace steradian::plane
