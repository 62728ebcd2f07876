#include "bake/samples.h"

#include <algorithm>
#include <cmath>

namespace steradian::bake {
namespace {

constexpr double kCell = 1.0 / kCellsPerTexel;
constexpr double kLeast = 0.01;   // of the largest part of a cell: smaller parts lie in creases and hardly count
constexpr double kWhole = 0.999;  // of a cell's area

using Outline = std::vector<Vec2d>;

// The part of a convex outline where (x or y) * sign >= limit * sign.
void clip(Outline& outline, Outline& work, bool along_x, double limit, double sign) {
  work.clear();
  const auto inside = [&](Vec2d p) { return ((along_x ? p.x : p.y) - limit) * sign; };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2d a = outline[i], b = outline[(i + 1) % outline.size()];
    const double da = inside(a), db = inside(b);
    if (da >= 0) work.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) work.push_back(a + (b - a) * (da / (da - db)));
  }
  outline.swap(work);
}

struct OutlineMoments {
  double area = 0;
  Vec2d middle;
};
OutlineMoments moments_of(const Outline& outline) {
  OutlineMoments m;
  if (outline.size() < 3) return m;
  Vec2d sum;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    const double a = cross(outline[i] - outline[0], outline[i + 1] - outline[0]) / 2;
    m.area += a;
    sum = sum + (outline[0] + outline[i] + outline[i + 1]) * (a / 3);
  }
  m.middle = m.area != 0 ? sum / m.area : outline[0];
  m.area = std::fabs(m.area);
  return m;
}

// The part of a chart in a cell of the grid.
struct SampleCell {
  double area = 0, square_metres = 0;
  double largest = 0;  // area of its largest part
  Vec2d middle;        // of that part
  std::uint32_t number = 0;
  bool has_center = false;  // a part holds the cell's centre
  std::uint32_t at_center = 0;
};
static_assert(sizeof(SampleCell) <= kBytesPerCell);

}  // namespace

std::vector<SampleBlock> samples_of(const Chart& chart, const Mesh& mesh) {
  const int columns = chart.width * kCellsPerTexel, rows = chart.height * kCellsPerTexel;
  std::vector<SampleCell> cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  Outline part, work;
  const auto add = [&](std::uint32_t number, const Outline& outline) {
    const ChartTriangle& t = chart.triangles[number];
    const double doubled = std::fabs(doubled_area(t.at));
    if (!(doubled > 0)) return;
    const double metres = length(across(mesh, t.triangle)) / doubled;
    Box2d box;
    for (const Vec2d p : outline) box.add(p);
    const auto index = [](double x, int origin, int most) {
      return std::clamp(static_cast<int>(std::floor((x - origin) / kCell)), 0, most - 1);
    };
    for (int y = index(box.low.y, chart.y, rows); y <= index(box.high.y, chart.y, rows); ++y)
      for (int x = index(box.low.x, chart.x, columns); x <= index(box.high.x, chart.x, columns); ++x) {
        const Vec2d low{chart.x + x * kCell, chart.y + y * kCell}, high{low.x + kCell, low.y + kCell}, center = (low + high) * 0.5;
        part = outline;
        clip(part, work, true, low.x, 1);
        clip(part, work, true, high.x, -1);
        clip(part, work, false, low.y, 1);
        clip(part, work, false, high.y, -1);
        const OutlineMoments m = moments_of(part);
        if (!(m.area > 0)) continue;
        SampleCell& cell = cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x)];
        cell.area += m.area;
        cell.square_metres += m.area * metres;
        if (m.area > cell.largest) cell.largest = m.area, cell.middle = m.middle, cell.number = number;
        bool left = true, right = true;
        for (std::size_t i = 0; i < part.size(); ++i) {
          const double side = cross(part[(i + 1) % part.size()] - part[i], center - part[i]);
          left &= side >= 0;
          right &= side <= 0;
        }
        if (left || right) cell.has_center = true, cell.at_center = number;
      }
  };
  if (chart.pieces.empty())
    for (std::uint32_t n = 0; n < chart.triangles.size(); ++n) add(n, {chart.triangles[n].at.begin(), chart.triangles[n].at.end()});
  for (const ChartPiece& piece : chart.pieces) add(piece.number, piece.outline);

  double largest = 0;
  for (const SampleCell& cell : cells) largest = std::max(largest, cell.area);
  std::vector<SampleBlock> blocks;
  // A chart begins half a texel, which is one cell, inside its texels.
  for (int y0 = 1; y0 < rows; y0 += 4)
    for (int x0 = 1; x0 < columns; x0 += 4) {
      SampleBlock block;
      bool any = false;
      for (int k = 0; k < 16; ++k) {
        const int x = x0 + k % 4, y = y0 + k / 4;
        if (x >= columns || y >= rows) continue;
        const SampleCell& cell = cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x)];
        if (!(cell.area > kLeast * largest)) continue;
        const bool whole = cell.area >= kWhole * kCell * kCell && cell.has_center;
        Sample& sample = block[static_cast<std::size_t>(k)];
        sample.at = whole ? Vec2d{chart.x + (x + 0.5) * kCell, chart.y + (y + 0.5) * kCell} : cell.middle;
        const ChartTriangle& t = chart.triangles[whole ? cell.at_center : cell.number];
        sample.triangle = t.triangle;
        const double doubled = doubled_area(t.at);
        sample.u = static_cast<float>(cross(sample.at - t.at[0], t.at[2] - t.at[0]) / doubled);
        sample.v = static_cast<float>(cross(t.at[1] - t.at[0], sample.at - t.at[0]) / doubled);
        sample.area = cell.square_metres;
        any = true;
      }
      if (any) blocks.push_back(block);
    }
  return blocks;
}

}  // namespace steradian::bake
