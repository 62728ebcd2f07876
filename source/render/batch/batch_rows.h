// Copies rows of an array to and from the columns that packs read. Also holds the one integral that has packs of doubles.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd.h"
#include "render/tile/tile.h"
#include "steradian/polygon_light.h"

namespace steradian {

// Columns for a tile's worth of points.
template <class T>
struct Columns {
  alignas(64) std::array<T, kTilePixels + 16> x, y, z;
};

// The same as Rows of steradian/batch.h, starting at a first row.
template <class T>
struct RowsFrom {
  const T* first;
  std::ptrdiff_t row, column;
};

// Selects the points that the library's function for one point answers. They have a number that is not finite, or they may see an edge of a
// flat light under nearly half a turn: near its plane, within the reach of its edges.
template <class T>
struct Alone {
  bool of_flat = false;
  Vector3<T> centroid, normal;
  T reach2 = 0, height2 = 0;
};

template <class T>
struct BatchRowsTable {
  // Repeats the last row up to a multiple of 16.
  void (*load)(const RowsFrom<T>& rows, std::size_t count, Columns<T>& to);
  // Scales vectors to unit length. Vectors shorter than 1e-18 or longer than 1e18 become zero. count is a multiple of 16.
  void (*normalize)(Columns<T>& vectors, std::size_t count);
  // Marks these points and returns their number. Must run before the vectors are normalized.
  std::size_t (*mark_alone)(const Alone<T>& which, const Columns<T>& position, const Columns<T>& normal, const Columns<T>& view,
                            std::size_t count, std::uint8_t* alone);
  // Writes plain of_plain + fresnel of_fresnel as rows of three; 0 where the view is not above the surface. fresnel may be null.
  void (*store)(const T* plain, Vector3<T> of_plain, const T* fresnel, Vector3<T> of_fresnel, const Columns<T>& normal,
                const Columns<T>& view, std::size_t count, T* rows);
};

struct BatchTable {
  BatchRowsTable<float> in_float;
  BatchRowsTable<double> in_double;
  // Irradiance of radiance 1 in [0, pi], as polygon_irradiance; count is a multiple of 16.
  void (*polygon_irradiance)(const PreparedPolygon& light, const Columns<double>& position, const Columns<double>& normal,
                             std::size_t count, double* result);
};

STERADIAN_DECLARE_PACK_TABLE(BatchTable, batch_table)

}  // namespace steradian
