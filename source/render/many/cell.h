// Receivers of many lights, and Cell, in which far lights light neighbouring receivers together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/simd.h"
#include "render/many/far_lights.h"
#include "render/tile/tile.h"
#include "steradian/vector.h"

namespace steradian::lights {

// ReceiverSet: surface points whose diffuse light is summed together, of one tile or of many.

struct Receiver {
  Vec3f position, normal, albedo;
  float loss = 0;           // Fresnel loss at the boundary above
  std::uint32_t place = 0;  // identifies the point: a slot of a tile, or a pixel of a picture
};
using ReceiverSpan = std::span<Receiver>;

// Light that a receiver gets, and the bound of its error.
struct Received {
  Vec3f radiance, bound;
};

struct ReceiverSet {
  std::vector<Receiver> points;    // in arbitrary order
  std::vector<Received> received;  // result for each point

  // Adds the tile's points that reflect diffusely; place_of(slot) is their place.
  template <class PlaceOf>
  void add(const SurfaceTile& tile, PlaceOf place_of) {
    const auto get = [](const TileVector& v, std::size_t i) { return Vec3f{v.x[i], v.y[i], v.z[i]}; };
    for (std::uint32_t i = 0; i < kTilePixels; ++i) {
      const Vec3f albedo = get(tile.albedo, i);
      if (tile.material[i] != nullptr && albedo.x + albedo.y + albedo.z > 0)
        points.push_back({get(tile.position, i), get(tile.normal, i), albedo, tile.fresnel_loss[i], place_of(i)});
    }
  }
};

// Cell: neighbouring receivers that are lit by far lights together, and the pack functions for it.

inline constexpr std::size_t kMostNodes = 64;

// Number of Chebyshev nodes of a polynomial along each axis of a box; their product is 16, 32 or 64.
struct NodeGrid {
  std::array<int, 3> count{4, 4, 1};
  std::size_t size() const { return static_cast<std::size_t>(count[0] * count[1] * count[2]); }
};

// A box about receivers, with its own axes and the cone of the receivers' normals.
struct ReceiverCell {
  Vec3f center, half;         // along the axes
  std::array<Vec3f, 3> axes;  // orthonormal
  Vec3f normal;               // unit: the cone's axis
  float turn = 0;             // largest |n - normal|
  float radius = 0;           // radius of the box
  Vec3f eye;                  // the point to which all receivers' views go
  float eye_distance = 0;     // least, from the box; 0: an eye may be inside
  float loss = 0;             // largest Fresnel loss of the receivers
  NodeGrid grid;
};

// Treatment of a light for a cell.
enum class Share : std::uint8_t {
  nothing,         // it sends nothing to any receiver
  one,             // one element in the polynomial
  four,            // four elements in the polynomial
  one_at_points,   // one element at every receiver
  four_at_points,  // four elements at every receiver
  exact,           // its outline
};

// For each light: its treatment, and the error of irradiance for radiance 1. `plain` is the base error, `grazing` is added for each unit
// of Fresnel loss. `most` is the largest irradiance in a polynomial. All three apply to elements: outlines only have rounding errors, and
// those differ from receiver to receiver.
struct Judged {
  Share* share;
  float *plain, *grazing, *most;
};

// Half a unit in the last place of 1. Rounding errors below are numbers of these.
inline constexpr float kUnit = 0x1p-24f;

// Rounding of a light's irradiance vector, as a fraction of the light's largest irradiance, for elements: arithmetic takes a few dozen
// roundings. A light's place is rounded by a unit of its coordinates, with the slope 2 of far_light.glsl over the least distance.
inline constexpr float kRoundings = 32, kRoundingsOfPlaces = 2;

// The same for an outline, as a fraction of the angle that it subtends along its edges. Round lights have formulas of their own.
inline constexpr float kRoundingsOfRound = 256;

// Sums of many numbers take parts of this many, so that N numbers are rounded 64 + N / 64 times.
inline constexpr std::size_t kPart = 64;

struct FarElements {
  std::vector<FarElement> ones, balls;
  std::vector<FourElements> fours;
  void clear() {
    ones.clear();
    balls.clear();
    fours.clear();
  }
  bool empty() const { return ones.empty() && balls.empty() && fours.empty(); }
};

// Contents of a polynomial: irradiance vectors of three channels, component by component. From kWeighted on, the same vectors are weighted
// by (1 - v.h)^5. The rows are values at the nodes of a cell, the first axis' nodes fastest, or factors of Chebyshev's polynomials in that
// order.
inline constexpr std::size_t kParts = 9, kWeighted = 16, kRow = 32;
struct Polynomial {
  alignas(64) std::array<std::array<float, kRow>, kMostNodes> rows;
};

// The receivers of a cell side by side, padded to a multiple of 16 by copies of the last one.
struct CellReceivers {
  std::size_t count = 0, filled = 0;
  TileVector position, normal, view;
  alignas(64) TilePlane loss;
  TileVector irradiance;  // the result
  TileVector rounding;    // of lights whose rounding differs from receiver to receiver
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
  // Judges `count` lights with those numbers (null: all of `lights`, in order). The allowed error is `error` times the most that a light
  // can send. The result has capacity for a multiple of 16 entries.
  void (*judge)(const FarLights& lights, const std::uint32_t* numbers, std::size_t count, const ReceiverCell& cell, float error,
                Judged result);
  // Fits a polynomial, as factors, to the light that elements send to a cell's nodes, plus an outer polynomial. The outer one belongs to a
  // cell with the same axes and grid that contains this one (null: none). Losses add the weighted vectors.
  void (*fit)(const FarElements& elements, const ReceiverCell& cell, const Polynomial* outer, const ReceiverCell* outer_cell,
              Polynomial& result);
  // Adds a polynomial to the irradiance of a cell's receivers.
  void (*add_polynomial)(const Polynomial& polynomial, const ReceiverCell& cell, CellReceivers& receivers);
  // Adds the light of one light by its outline, and the bound of its rounding. sent: its irradiance at every receiver for radiance 1.
  void (*add_outline)(const FarLights& lights, std::uint32_t number, const float* sent, CellReceivers& receivers);
  // Adds the light of elements at every receiver.
  void (*add_elements)(const FarElements& elements, CellReceivers& receivers);
};

// One axis with n nodes, n being 1, 2, 4 or 8: the nodes on [-1, 1], and the matrix from values there to factors. Factor i is the sum of
// to_factors[i][j] times value j.
struct NodeRow {
  std::array<float, 8> node{};
  std::array<std::array<float, 8>, 8> to_factors{};
};
const NodeRow& node_row(int nodes);

// Upper bound of the largest sum of absolute values of Lagrange's polynomials through n Chebyshev nodes: Rivlin's bound.
double lebesgue(int nodes);
inline double lebesgue(const NodeGrid& grid) { return lebesgue(grid.count[0]) * lebesgue(grid.count[1]) * lebesgue(grid.count[2]); }

}  // namespace steradian::lights

namespace steradian {

STERADIAN_DECLARE_PACK_TABLE(lights::CellTable, cell_table)

}  // namespace steradian

// Cells about surface points, and their subdivision.

namespace steradian::lights {

// The tightest cell with the given axes about points, at least one.
ReceiverCell cell_about(ReceiverSpan points, const std::array<Vec3f, 3>& axes, Vec3f eye);

// A cell along the mean normal and the directions in which the points spread.
ReceiverCell cell_about(ReceiverSpan points, Vec3f eye);

// Detects points of more than one surface, or of one that turns too far for one cone. The value says by what to divide them first.
enum class Disorder { none, normals, places };
Disorder disorder_of(ReceiverSpan points, const ReceiverCell& cell);

// Splits the points into a front and a back part: by the normals' most varied coordinate, or across the cell's longest axis. Neither part
// is empty if the points differ in that coordinate.
std::pair<ReceiverSpan, ReceiverSpan> divided_by_normals(ReceiverSpan points);
std::pair<ReceiverSpan, ReceiverSpan> divided_by_place(ReceiverSpan points, const ReceiverCell& cell);

// The nodes that a cell needs for lights at about that distance. The error is at most `error`, as far as 64 nodes allow.
NodeGrid grid_for(Vec3f half, float distance, float error);

}  // namespace steradian::lights
