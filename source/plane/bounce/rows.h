// The sums that make up a solution, on packs of doubles: terms of the weights, and their sums.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/simd.h"

namespace steradian::plane {

// Values of the tangent t of an angle: its sine and cosine, and asinh t.
struct EndValues {
  double sine, cosine, area;
};

// The same for many, a column each, with capacity for a pack beyond the last.
struct EndColumns {
  static constexpr std::size_t kRoom = 8;
  std::vector<double> t, sine, cosine, area;
  std::size_t count = 0;
  void add(double tangent) {
    if (t.size() < count + 1 + kRoom)
      for (auto* column : {&t, &sine, &cosine, &area}) column->resize(2 * (count + kRoom));
    t[count++] = tangent;
  }
  EndValues operator[](std::size_t i) const { return {sine[i], cosine[i], area[i]}; }
};

// Weight of an element in a row.
struct ElementWeight {
  double constant, slope;
};

// An element's radiance: red, green, blue and one unused channel, its constant and its slope.
struct alignas(64) ElementLine {
  double constant[4]{}, slope[4]{};
};

struct RowsTable {
  // Fills the columns with the values that belong to t.
  void (*evaluate)(EndColumns& ends);
  // The sum over a row, channel by channel.
  std::array<double, 4> (*gather)(std::span<const std::uint32_t> elements, const ElementWeight* weights, const ElementLine* lines);
};

STERADIAN_DECLARE_PACK_TABLE(RowsTable, rows_table)

}  // namespace steradian::plane
