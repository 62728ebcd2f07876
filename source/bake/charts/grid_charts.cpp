#include "bake/charts/grid_charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numeric>

#include "bake/charts/atlas.h"

namespace steradian::bake {
namespace {

constexpr double kCoarsest = 0.2;       // of a doubling: texels may be 2^0.2 = 1.15 times as large as asked for
constexpr double kLeastStraight = 0.5;  // cosine between the sides of two quadrilaterals in a row
constexpr double kMostTurn = 0.7;       // of the normal along a texel: 40 degrees
constexpr double kLongestSide = 2048;   // texels of a chart
constexpr double kMostDoublings = 14;   // of the texels of an edge
constexpr std::uint32_t kNoQuad = UINT32_MAX;

// Two triangles. Corners and sides run counter-clockwise; side i begins at corner i.
struct MeshQuad {
  std::array<std::uint32_t, 4> sides;     // as 3 triangle + k of the edge
  std::array<std::uint32_t, 2> diagonal;  // the same
};

// A side of a quadrilateral.
struct QuadSide {
  std::uint32_t quad = kNoQuad;
  unsigned side = 0;
};

// A quadrilateral in a chart. Its corner 0 is at the chart's corner `turn`: 0 is the lower left one, 1 the lower right one.
struct PlacedQuad {
  std::uint32_t quad = kNoQuad;
  unsigned turn = 0;
  bool operator==(const PlacedQuad&) const = default;
};

class GridCharts {
 public:
  GridCharts(const Mesh& mesh, std::uint32_t number, const MeshNeighbours& neighbours, const std::vector<std::uint8_t>& curved,
             double texels)
      : mesh_(mesh), number_(number), neighbours_(neighbours), curved_(curved), texels_(texels), side_of_(mesh.indices.size()) {
    pair_triangles();
  }

  std::vector<Chart> found() {
    std::vector<Chart> charts;
    std::vector<std::uint32_t> order(quads_.size());  // the largest first, which want the most texels
    std::iota(order.begin(), order.end(), 0u);
    const auto size_of = [&](std::uint32_t q) {
      return length(across(mesh_, quads_[q].diagonal[0] / 3)) + length(across(mesh_, quads_[q].diagonal[1] / 3));
    };
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return size_of(a) > size_of(b); });
    for (const std::uint32_t q : order)
      if (taken_[q] == 0) charts.push_back(chart_of(grown_from(q)));
    for (const std::uint32_t t : alone_) charts.push_back(chart_of_triangle(t));
    return charts;
  }

 private:
  // The quadrilaterals of a chart by column and row, and the texels along the sides of each column and row.
  struct QuadGrid {
    std::deque<std::deque<PlacedQuad>> columns;
    std::deque<double> widths, heights;
  };

  Vec3d corner(std::uint32_t edge) const { return corner_of(mesh_, edge / 3, edge % 3); }
  static std::uint32_t next(std::uint32_t edge) { return edge - edge % 3 + (edge % 3 + 1) % 3; }
  double length_of(std::uint32_t edge) const { return length(corner(next(edge)) - corner(edge)); }

  // The edge of the other triangle, if it meets this one smoothly and is curved, too.
  std::uint32_t smooth_across(std::uint32_t edge) const {
    const std::uint32_t other = neighbours_.across(edge / 3, edge % 3);
    return other != MeshNeighbours::kNone && curved_[other / 3] != 0 && meet_smoothly(mesh_, edge, other) ? other : MeshNeighbours::kNone;
  }

  // The edge of a triangle that is longer than the others: its diagonal if it is half of a rectangle.
  std::uint32_t longest_edge_of(std::uint32_t t) const {
    std::uint32_t longest = 3 * t;
    for (std::uint32_t e = 3 * t + 1; e < 3 * t + 3; ++e)
      if (length_of(e) > length_of(longest) * (1 + 1e-5)) longest = e;
    return longest;
  }

  // The edge of a triangle at which the next one of the mesh begins. Programs that divide quadrilaterals store both halves together.
  std::uint32_t edge_to_next(std::uint32_t t) const {
    for (std::uint32_t e = 3 * t; e < 3 * t + 3; ++e)
      if (const std::uint32_t other = smooth_across(e); other != MeshNeighbours::kNone && other / 3 == t + 1) return e;
    return MeshNeighbours::kNone;
  }

  void pair_triangles() {
    std::vector<std::uint8_t> paired(curved_.size(), 0);
    const auto pair_at = [&](std::uint32_t one, std::uint32_t other) {
      paired[one / 3] = paired[other / 3] = 1;
      const MeshQuad quad{{next(other), next(next(other)), next(one), next(next(one))}, {one, other}};
      for (unsigned side = 0; side < 4; ++side) side_of_[quad.sides[side]] = {static_cast<std::uint32_t>(quads_.size()), side};
      quads_.push_back(quad);
    };
    for (std::uint32_t t = 0; t + 1 < curved_.size(); ++t)
      if (curved_[t] != 0 && paired[t] == 0)
        if (const std::uint32_t edge = edge_to_next(t); edge != MeshNeighbours::kNone) pair_at(edge, smooth_across(edge));
    for (std::uint32_t t = 0; t < curved_.size(); ++t) {
      if (curved_[t] == 0) continue;
      if (paired[t] != 0) continue;
      const std::uint32_t one = longest_edge_of(t), other = smooth_across(one);
      if (other != MeshNeighbours::kNone && paired[other / 3] == 0 && longest_edge_of(other / 3) == other)
        pair_at(one, other);
      else
        alone_.push_back(t);
    }
    std::erase_if(alone_, [&](std::uint32_t t) { return paired[t] != 0; });
    taken_.assign(quads_.size(), 0);
  }

  // Texels along an edge: a power of two.
  double texels_along(std::uint32_t edge) const {
    const auto normal = [&](std::uint32_t e) { return static_cast<Vec3d>(mesh_.normals[mesh_.indices[e]]); };
    const double turn = std::acos(std::clamp(dot(normal(edge), normal(next(edge))), -1.0, 1.0));
    const auto doublings = [](double wanted) { return std::ceil(std::log2(std::max(wanted, 1e-9)) - kCoarsest); };
    return std::exp2(
        std::clamp(std::max(doublings(length_of(edge) * texels_), doublings(turn / kMostTurn)), -kMostDoublings, kMostDoublings));
  }
  // The texels that the sides of a placed quadrilateral want. The sides of the chart are: 0 below, 1 on the right, 2 above, 3 on the left.
  double width_of(PlacedQuad p) const { return std::max(texels_along(side_edge(p, 0)), texels_along(side_edge(p, 2))); }
  double height_of(PlacedQuad p) const { return std::max(texels_along(side_edge(p, 1)), texels_along(side_edge(p, 3))); }
  std::uint32_t side_edge(PlacedQuad p, unsigned side) const { return quads_[p.quad].sides[(side + 4 - p.turn) % 4]; }

  // The free quadrilateral beyond a side.
  PlacedQuad beyond(PlacedQuad p, unsigned side) const {
    const std::uint32_t other = smooth_across(side_edge(p, side));
    if (other == MeshNeighbours::kNone) return {};
    const QuadSide there = side_of_[other];
    if (there.quad == kNoQuad || taken_[there.quad] != 0) return {};
    return {there.quad, (side + 2 + 4 - there.side) % 4};
  }

  // True if the lines across a side go on beyond it, so that texels may be larger than quadrilaterals. They turn back at a pole.
  bool goes_straight(PlacedQuad here, PlacedQuad there, unsigned side) const {
    for (const unsigned line : {(side + 1) % 4, (side + 3) % 4}) {
      const std::uint32_t one = side_edge(here, line), other = side_edge(there, line);
      if (dot(normalized(corner(next(one)) - corner(one)), normalized(corner(next(other)) - corner(other))) < kLeastStraight) return false;
    }
    return true;
  }

  QuadGrid grown_from(std::uint32_t quad) {
    const PlacedQuad first{quad, 0};
    QuadGrid grid{{{first}}, {width_of(first)}, {height_of(first)}};
    taken_[quad] = 1;
    for (bool grew = true; grew;) {
      grew = false;
      for (unsigned side = 0; side < 4; ++side) grew |= grow(grid, side);
    }
    return grid;
  }

  // Adds a column or a row beyond a side, if all its quadrilaterals are there and want about as many texels as the chart has.
  bool grow(QuadGrid& grid, unsigned side) {
    const bool is_column = side % 2 == 1, at_end = side == 1 || side == 2;
    std::deque<double>&across = is_column ? grid.widths : grid.heights, &along = is_column ? grid.heights : grid.widths;
    std::vector<PlacedQuad> line;
    double most = 0, sum = 0, sum_along = 0;
    for (std::size_t i = 0; i < along.size(); ++i) {
      const std::deque<PlacedQuad>& column = is_column ? (at_end ? grid.columns.back() : grid.columns.front()) : grid.columns[i];
      const PlacedQuad last_of = is_column ? column[i] : at_end ? column.back() : column.front(), found = beyond(last_of, side);
      if (found.quad == kNoQuad || std::find(line.begin(), line.end(), found) != line.end()) return false;
      if (!goes_straight(last_of, found, side)) return false;
      // It lies beside the one before.
      if (i > 0 && !(beyond(line.back(), is_column ? 2 : 1) == found)) return false;
      line.push_back(found);
      const double wide = is_column ? width_of(found) : height_of(found), high = is_column ? height_of(found) : width_of(found);
      if (high > along[i]) return false;
      most = std::max(most, wide);
      sum += wide;
      sum_along += high;
    }
    const double all_along = std::accumulate(along.begin(), along.end(), 0.0),
                 all_across = std::accumulate(across.begin(), across.end(), 0.0);
    // A chart of its own would have a border more.
    const double added = most * all_along, alone = (std::ceil(most) + 1) * (std::ceil(sum_along) + 1);
    if (added > alone || 4 * sum < most * static_cast<double>(line.size()) || all_across + most > kLongestSide) return false;
    for (const PlacedQuad& p : line) taken_[p.quad] = 1;
    if (at_end)
      across.push_back(most);
    else
      across.push_front(most);
    if (is_column && at_end)
      grid.columns.emplace_back(line.begin(), line.end());
    else if (is_column)
      grid.columns.emplace_front(line.begin(), line.end());
    for (std::size_t i = 0; i < line.size() && !is_column; ++i) {
      if (at_end)
        grid.columns[i].push_back(line[i]);
      else
        grid.columns[i].push_front(line[i]);
    }
    return true;
  }

  Chart empty_chart() const {
    Chart chart;
    chart.mesh = number_;
    return chart;
  }

  Chart chart_of(const QuadGrid& grid) const {
    Chart chart = empty_chart();
    const std::vector<double> x = places_of(grid.widths), y = places_of(grid.heights);
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
      for (std::size_t j = 0; j + 1 < y.size(); ++j)
        add_quad(chart, grid.columns[i][j], Vec2d{x[i], y[j]} / texels_, Vec2d{x[i + 1], y[j + 1]} / texels_);
    return chart;
  }

  // The borders of columns, or of rows [texels]. Sizes below a texel share one, which ends where they do. Inner borders are at the middles
  // of texels, as those of other charts, and outer ones where place_charts leaves them.
  static std::vector<double> places_of(const std::deque<double>& sizes) {
    std::vector<double> places{kInside};
    double whole = 0;
    for (std::size_t first = 0; first < sizes.size();) {
      const double size = sizes[first];
      std::size_t last = first + 1;
      while (last < sizes.size() && sizes[last] == size && static_cast<double>(last - first) * size < 1) ++last;
      whole += std::max(size, 1.0);
      const double begin = places.back(), end = last < sizes.size() ? whole : whole - kInside;
      for (std::size_t i = first; i < last; ++i)
        places.push_back(begin + (end - begin) * static_cast<double>(i + 1 - first) / static_cast<double>(last - first));
      first = last;
    }
    return places;
  }

  void add_quad(Chart& chart, PlacedQuad p, Vec2d low, Vec2d high) const {
    const std::array<Vec2d, 4> corners{low, Vec2d{high.x, low.y}, high, Vec2d{low.x, high.y}};
    const MeshQuad& quad = quads_[p.quad];
    // The diagonal of the first triangle runs from corner 0 to corner 2, and its third corner is 3.
    for (const auto& [edge, own] : {std::pair(quad.diagonal[0], std::array<unsigned, 3>{0, 2, 3}), {quad.diagonal[1], {2, 0, 1}}}) {
      ChartTriangle t{edge / 3, {}};
      for (unsigned k = 0; k < 3; ++k) t.at[(edge % 3 + k) % 3] = corners[(own[k] + p.turn) % 4];
      chart.triangles.push_back(t);
    }
  }

  // Half of a square, with as many texels on its diagonal as on its other sides.
  Chart chart_of_triangle(std::uint32_t t) const {
    Chart chart = empty_chart();
    const std::uint32_t diagonal = longest_edge_of(t);
    const double n = std::max(texels_along(diagonal), 1.0);
    const double side = n / texels_;
    ChartTriangle half{t, {}};
    half.at[diagonal % 3] = {side, 0};
    half.at[(diagonal + 1) % 3] = {0, side};
    half.at[(diagonal + 2) % 3] = {0, 0};
    chart.triangles.push_back(half);
    return chart;
  }

  const Mesh& mesh_;
  const std::uint32_t number_;
  const MeshNeighbours& neighbours_;
  const std::vector<std::uint8_t>& curved_;
  const double texels_;
  std::vector<QuadSide> side_of_;  // by edge
  std::vector<MeshQuad> quads_;
  std::vector<std::uint8_t> taken_;  // by quadrilateral
  std::vector<std::uint32_t> alone_;
};

}  // namespace

std::vector<Chart> grid_charts(const Mesh& mesh, std::uint32_t number, const MeshNeighbours& neighbours,
                               const std::vector<std::uint8_t>& curved, double texels) {
  return GridCharts(mesh, number, neighbours, curved, texels).found();
}

}  // namespace steradian::bake
