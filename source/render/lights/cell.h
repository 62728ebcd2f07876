// Cell: neighbouring receivers that look at far lights together, and what packs do with it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/simd.h"
#include "render/cpu/points.h"
#include "render/lights/far_lights.h"

namespace steradian::lights {

inline constexpr std::size_t kMostNodes = 64;

// How many of Chebyshev's nodes a polynomial has along each axis of a box; their product is 16, 32 or 64.
struct NodeGrid {
  std::array<int, 3> count{4, 4, 1};
  std::size_t size() const { return static_cast<std::size_t>(count[0] * count[1] * count[2]); }
};

// A box about receivers, along axes of its own, with the cone of their normals.
struct Cell {
  Vec3f center, half;         // along the axes
  std::array<Vec3f, 3> axes;  // orthonormal
  Vec3f normal;               // unit: the cone's axis
  float turn = 0;             // largest |n - normal|
  float radius = 0;           // of the box
  Vec3f eye;                  // to which all receivers' views go
  float eye_distance = 0;     // least, of the box; 0: an eye may be inside
  float loss = 0;             // largest Fresnel loss of the receivers
  NodeGrid grid;
};

// What becomes of a light for a cell.
enum class Share : std::uint8_t {
  nothing,         // it sends nothing to any receiver
  one,             // one element, in the polynomial
  four,            // four
  one_at_points,   // one element, at every receiver by itself
  four_at_points,  // four
  exact,           // its outline
};

// For each light: what becomes of it, and the error of irradiance of radiance 1: `plain`, and `grazing` for each unit of Fresnel loss
// besides. Of elements; outlines have none.
struct Judged {
  Share* share;
  float *plain, *grazing;
};

struct Elements {
  std::vector<Element> ones, balls;
  std::vector<FourElements> fours;
  void clear() {
    ones.clear();
    balls.clear();
    fours.clear();
  }
  bool empty() const { return ones.empty() && balls.empty() && fours.empty(); }
};

// What a polynomial stands for: irradiance vectors of three channels, component by component, and from kWeighted on the same weighted by
// (1 - v.h)^5. At the nodes of a cell, of which the first axis' run fastest, or as factors of Chebyshev's polynomials in that order.
inline constexpr std::size_t kParts = 9, kWeighted = 16, kRow = 32;
struct Polynomial {
  alignas(64) std::array<std::array<float, kRow>, kMostNodes> rows;
};

// The receivers of a cell side by side, their number filled up to a multiple of 16 by copies of the last.
struct Receivers {
  std::size_t count = 0, filled = 0;
  TileVector position, normal, view;
  alignas(64) TilePlane loss;
  TileVector irradiance;  // the result
  Points points() const {
    Points p;
    p.count = filled;
    p.position = arrays_of(position);
    p.normal = arrays_of(normal);
    p.view = arrays_of(view);
    p.fresnel_loss = loss.data();
    return p;
  }
};

struct CellTable {
  // Judges the lights of those numbers (count of them; null: all of `lights`, in order), where an error of `error` times what a light
  // sends at most is allowed. There is room for a multiple of 16 results.
  void (*judge)(const FarLights& lights, const std::uint32_t* numbers, std::size_t count, const Cell& cell, float error, Judged result);
  // The polynomial, as factors, of what elements send to the nodes of a cell, and of a polynomial around it: of a cell with the same axes
  // and grid that holds this one; null: none. With losses, the weighted vectors, too.
  void (*fit)(const Elements& elements, const Cell& cell, const Polynomial* outer, const Cell* outer_cell, Polynomial& result);
  // Adds a polynomial to the irradiance of a cell's receivers.
  void (*add_polynomial)(const Polynomial& polynomial, const Cell& cell, Receivers& receivers);
  // Adds elements at every receiver.
  void (*add_elements)(const Elements& elements, Receivers& receivers);
};

// Along an axis of n nodes, 1, 2, 4 or 8 of them: the nodes on [-1, 1], and what takes values there to factors: factor i is the sum of
// to_factors[i][j] times value j.
struct NodeRow {
  std::array<float, 8> node{};
  std::array<std::array<float, 8>, 8> to_factors{};
};
const NodeRow& node_row(int nodes);

// The largest sum of the absolute values of Lagrange's polynomials through n nodes of Chebyshev, at most: Rivlin's bound.
double lebesgue(int nodes);

}  // namespace steradian::lights

namespace steradian {

STERADIAN_DECLARE_PACK_TABLE(lights::CellTable, cell_table)

}  // namespace steradian
