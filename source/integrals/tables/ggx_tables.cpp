#include "integrals/tables/ggx_tables.h"

#include "integrals/tables/table.h"
#include "steradian/ltc.h"

// steradian fit --lobe ggx --layout classic -o tables/ggx_classic.h
// steradian fit --lobe ggx --layout classic --fresnel-lobe -o tables/ggx_classic.h, moved from tables/ggx_classic_fresnel.h
// steradian fit --lobe ggx --layout compact -o tables/ggx_compact.h
// steradian fit --lobe charlie --layout compact -o tables/charlie_compact.h
#include "tables/ggx_classic.h"
#include "tables/charlie_compact.h"
#include "tables/ggx_compact.h"
#include "tables/ggx_fresnel.h"

namespace steradian {
namespace {

template <std::size_t N>
std::vector<std::array<float, N>> grouped(const float* values, std::size_t count) {
  std::vector<std::array<float, N>> result(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < N; ++c) result[i][c] = values[i * N + c];
  return result;
}

template <std::size_t N>
std::vector<std::array<float, N>> unpacked(const unsigned* words, std::size_t count) {
  std::vector<std::array<float, N>> result(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < N; ++c) {
      const unsigned word = words[(i * N + c) / 2];
      result[i][c] = float_from_half(static_cast<std::uint16_t>(c % 2 ? word >> 16 : word & 0xffffu));
    }
  return result;
}

}  // namespace

const ClassicTable& ggx_classic_table() {
  static const ClassicTable table = {ltc_ggx_size, grouped<4>(ltc_ggx_matrix, ltc_ggx_size * ltc_ggx_size),
                                     grouped<4>(ltc_ggx_magnitude, ltc_ggx_size * ltc_ggx_size), ClassicNormalisation::middle};
  return table;
}

const ClassicTable& ggx_fresnel_table() {
  constexpr std::size_t kNodes = ltc_ggx_fresnel_size * ltc_ggx_fresnel_size;
  static const ClassicTable table = {ltc_ggx_fresnel_size, grouped<4>(ltc_ggx_fresnel_matrix, kNodes),
                                     grouped<4>(ltc_ggx_fresnel_magnitude, kNodes), ClassicNormalisation::middle};
  return table;
}

const CompactTable& ggx_compact_table() {
  static const CompactTable table = {
      LobeFrame::mirror, ltc_ggx_shape_size, ltc_ggx_compact_magnitude_size,
      unpacked<4>(ltc_ggx_shape, ltc_ggx_shape_size * ltc_ggx_shape_size),
      unpacked<2>(ltc_ggx_compact_magnitude, ltc_ggx_compact_magnitude_size * ltc_ggx_compact_magnitude_size)};
  return table;
}

const CompactTable& charlie_compact_table() {
  static const CompactTable table = {
      LobeFrame::normal, ltc_charlie_shape_size, ltc_charlie_compact_magnitude_size,
      unpacked<4>(ltc_charlie_shape, ltc_charlie_shape_size * ltc_charlie_shape_size),
      unpacked<2>(ltc_charlie_compact_magnitude, ltc_charlie_compact_magnitude_size * ltc_charlie_compact_magnitude_size)};
  return table;
}

LtcTableView ltc_ggx_tables() {
  const CompactTable& compact = ggx_compact_table();
  return {ltc_ggx_size,
          ltc_ggx_matrix,
          ltc_ggx_magnitude,
          compact.shape_size,
          compact.shapes.data()->data(),
          compact.magnitude_size,
          compact.magnitudes.data()->data(),
          ltc_ggx_fresnel_matrix,
          ltc_ggx_fresnel_magnitude};
}

}  // namespace steradian
