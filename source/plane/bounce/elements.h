// Elements: parts of outlines, on each of which the reflected radiance is linear.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "plane/exact/envelope.h"
#include "plane/exact/world.h"

namespace steradian::plane {

struct BoundaryElement {
  std::size_t curve = 0;        // in World::curves
  bool back = false;            // is it the other side of a line without thickness?
  double from = 0, to = 1;      // fractions of the curve
  Vec2d middle, along, normal;  // middle of its chord; along and normal are unit vectors, the normal points to the lit side
  double half = 0;              // half of the chord's length
  Vec3d albedo;
  // Radiance constant + slope u at the place u = dot(p - middle, along) / half, and its estimated error.
  Vec3d constant, slope, error;
};

// A place on an element: a point of the curve, its normal there, and u.
struct ElementPlace {
  Vec2d at, normal;
  double u;
};
// Its first and its last point: identical to its neighbours' numbers.
std::pair<Vec2d, Vec2d> ends_of(const World& world, const BoundaryElement& element);
ElementPlace place_on(const World& world, const BoundaryElement& element, double share);

// Is the place outside of all other bodies?
bool is_open(const World& world, const ElementPlace& place);

// Albedo of a body; empty if it reflects nothing.
std::optional<Vec3d> albedo_of(const PlaneBody& body, double most);

// Position of an element on its curve: the data that rows need, without the rest.
struct ElementSpan {
  double from, to, per_share;  // 1 / (to - from)
};

// All elements, by curve and side and by rising place, no longer than `size`; cut where other outlines cross.
class BoundaryElements {
 public:
  BoundaryElements() = default;
  BoundaryElements(const World& world, double size, double most_albedo);

  const std::vector<BoundaryElement>& all() const { return all_; }
  const std::vector<ElementSpan>& spans() const { return spans_; }
  std::vector<BoundaryElement>& all() { return all_; }
  // Halves the marked elements.
  void halve(const World& world, const std::vector<char>& marked);

  // The elements of a curve's side: [first, second).
  std::pair<std::size_t, std::size_t> of(std::size_t curve, bool back) const {
    const std::size_t k = 2 * curve + (back ? 1 : 0);
    return {first_[k], first_[k + 1]};
  }
  // The elements of a part of a curve, from the view of a point or of a wall.
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
  std::vector<BoundaryElement> all_;
  std::vector<ElementSpan> spans_;
  std::vector<std::size_t> first_;
};

}  // namespace steradian::plane
