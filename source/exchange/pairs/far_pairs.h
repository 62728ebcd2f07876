// Far pairs in bulk: which method serves each pair of a row, and the product rule on packs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/simd.h"
#include "exchange/pairs/plane_element.h"

namespace steradian::exchange {

// Methods of a pair: 0, a product rule with 1 to 6 nodes a side, or one pair at a time.
inline constexpr std::uint8_t kNoExchange = 0, kLargestProduct = 6, kOneByOne = 7;

enum class ElementKind : std::uint8_t { parallelogram, triangle, other };

// Elements side by side. `at(name, i)` is one number of the element i.
struct ElementArrays {
  enum Name : std::size_t {
    center_x,
    center_y,
    center_z,
    normal_x,
    normal_y,
    normal_z,
    // A node is the origin + a s + b t of a parallelogram, and the origin + a s + b s t of a triangle, for s and t in [0, 1].
    origin_x,
    origin_y,
    origin_z,
    a_x,
    a_y,
    a_z,
    b_x,
    b_y,
    b_z,
    // Two vectors from the centre that span the element's extent along any direction (classify_pairs).
    reach_x,
    reach_y,
    reach_z,
    span_x,
    span_y,
    span_z,
    area,
    radius,
    off_plane,  // what its corners are off its plane
    skew,       // what keeps it from being a parallelogram
    kind,
    remainder_1,  // coefficients of the product rule's error, for 1 to 6 nodes
    name_count = remainder_1 + 6
  };
  static constexpr std::size_t kPad = 8;

  explicit ElementArrays(const std::vector<PlaneElement>& elements);
  const double* values(std::size_t name) const { return numbers.data() + name * stride; }

  std::size_t count = 0, stride = 0;
  std::vector<double> numbers;
  std::vector<ElementKind> kinds;
};

struct FarPairs {
  // Sets method[j] and error[j] for the columns j below `columns`: the method that is enough for a relative error eps, and the bound of its
  // error. numbers, stride: of ElementArrays. Arrays hold a multiple of kPad entries.
  void (*classify)(const double* numbers, std::size_t stride, std::size_t row, std::size_t columns, double eps, std::uint8_t* method,
                   double* error);
  // Exchange areas of a row with listed columns, all of one kind, by product rules with n nodes a side.
  void (*integrate)(const double* numbers, std::size_t stride, std::size_t row, bool row_is_triangle, const std::uint32_t* columns,
                    std::size_t count, bool triangles, std::size_t n, const double* nodes, const double* weights, double* values);
};

}  // namespace steradian::exchange

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(exchange::FarPairs, far_pairs)
}
