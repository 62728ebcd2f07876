// The exchange area of two plane elements that nothing obstructs: H = A1 F12 = A2 F21, with a bound of its error.
#pragma once

#include "exchange/pairs/plane_element.h"

namespace steradian::exchange {

// An exchange area [m2] and a bound of its error.
struct ExchangeArea {
  double value = 0, error = 0;
  int evaluations = 0;
};

// The exchange area between the fronts of two elements. Both are first cut to the parts in front of each other's planes.
//
//   eps  error that is enough, relative to the exchange area
ExchangeArea exchange_area(const PlaneElement& a, const PlaneElement& b, double eps);

// The same by one method, for elements wholly in front of each other's planes.
ExchangeArea exchange_by_contours(const PlaneElement& a, const PlaneElement& b, double eps);

// By products of Gauss rules, m nodes a side (1 to kMostProductNodes), for parallelograms and triangles. The error is a guaranteed bound.
inline constexpr int kMostProductNodes = 6;
ExchangeArea exchange_by_product(const PlaneElement& a, const PlaneElement& b, int m);

// The bound of the product rule relative to A1 A2 / (pi R^2) for the least distance R of two parallelograms, or of other elements by their
// radii.
double product_bound(const PlaneElement& a, const PlaneElement& b, double distance, int m);

}  // namespace steradian::exchange
