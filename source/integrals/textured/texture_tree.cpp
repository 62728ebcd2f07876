#include "integrals/textured/texture_tree.h"

#include <algorithm>
#include <cmath>

namespace steradian {
namespace {

constexpr int kMostCells = 128;                        // a side
double mean_square(Vec3d v) { return dot(v, v) / 3; }  // mean of the three channels
double length2(const std::array<double, 2>& v) { return v[0] * v[0] + v[1] * v[1]; }

// Sums over texels: coverage, radiance and their first moments, the coverage's second moments, and the mean square of the radiance.
struct TexelMoments {
  double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, square = 0;
  Vec3d power{}, power_x{}, power_y{};

  void add(const std::array<float, 4>& texel, double at_x, double at_y, double spacing) {
    const double w = static_cast<double>(texel[3]);
    if (!(w > 0)) return;
    const Vec3d p{static_cast<double>(texel[0]), static_cast<double>(texel[1]), static_cast<double>(texel[2])};
    const double own = spacing * spacing / 12;  // a texel's second moment
    area += w;
    x += w * at_x;
    y += w * at_y;
    xx += w * (at_x * at_x + own);
    xy += w * at_x * at_y;
    yy += w * (at_y * at_y + own);
    square += mean_square(p) / w;
    power += p;
    power_x += p * at_x;
    power_y += p * at_y;
  }
  void add(const TexelMoments& m) {
    area += m.area;
    x += m.x;
    y += m.y;
    xx += m.xx;
    xy += m.xy;
    yy += m.yy;
    square += m.square;
    power += m.power;
    power_x += m.power_x;
    power_y += m.power_y;
  }
};

struct Range {
  int left, right, bottom, top;
  int width() const { return right - left; }
  int height() const { return top - bottom; }
};

}  // namespace

TextureTree::TextureTree(const PlaneTexels& t) {
  const int least = std::max(1, std::max(t.width, t.height) / kMostCells);
  // Children are side by side, before their own children: the moments of a cell are known when its second child is complete.
  const auto build = [&](auto&& self, std::size_t index, const Range& r) -> TexelMoments {
    TexelMoments m;
    if (std::max(r.width(), r.height()) <= least) {
      for (int j = r.bottom; j < r.top; ++j)
        for (int i = r.left; i < r.right; ++i)
          m.add(t.texels[static_cast<std::size_t>(j * t.width + i)], t.left + i * t.spacing, t.bottom + j * t.spacing, t.spacing);
    } else {
      const bool wide = r.width() >= r.height();
      const int middle = wide ? (r.left + r.right) / 2 : (r.bottom + r.top) / 2;
      const std::size_t children = cells_.size();
      cells_.resize(children + 2);
      cells_[index].children = static_cast<int>(children);
      m = self(self, children, wide ? Range{r.left, middle, r.bottom, r.top} : Range{r.left, r.right, r.bottom, middle});
      m.add(self(self, children + 1, wide ? Range{middle, r.right, r.bottom, r.top} : Range{r.left, r.right, middle, r.top}));
    }
    TextureCell& cell = cells_[index];
    if (!(m.area > 0)) return m;
    cell.area = m.area;
    cell.mean = m.power / m.area;
    cell.deviation = std::sqrt(std::max(m.square / m.area - mean_square(cell.mean), 0.0));
    cell.center = {m.x / m.area, m.y / m.area};
    const double x = cell.center[0], y = cell.center[1];
    const double xx = m.xx / m.area - x * x, xy = m.xy / m.area - x * y, yy = m.yy / m.area - y * y;
    const double middle = (xx + yy) / 2, apart = std::hypot((xx - yy) / 2, xy), turn = 0.5 * std::atan2(2 * xy, xx - yy);
    const double a = std::sqrt(2 * (middle + apart)), b = std::sqrt(2 * std::max(middle - apart, 1e-6 * middle));
    cell.axis_a = {a * std::cos(turn), a * std::sin(turn)};
    cell.axis_b = {-b * std::sin(turn), b * std::cos(turn)};
    const Vec3d off_x = m.power_x - m.power * x, off_y = m.power_y - m.power * y;
    cell.along_a = (off_x * cell.axis_a[0] + off_y * cell.axis_a[1]) / (m.area * a * a);
    cell.along_b = (off_x * cell.axis_b[0] + off_y * cell.axis_b[1]) / (m.area * b * b);
    cell.radius = std::sqrt(3 * (xx + yy));
    return m;
  };
  cells_.reserve(static_cast<std::size_t>(2 * (t.width / least + 2) * (t.height / least + 2)));
  cells_.resize(1);
  build(build, 0, {0, t.width, 0, t.height});
  finest_ = least * t.spacing / std::sqrt(6.0);
  bounds_ = {t.left, t.left + t.width * t.spacing, t.bottom, t.bottom + t.height * t.spacing};
}

// Half of a smallest cell, or of a cell below one: one side of its long axis, as large as half of a uniform cell with its moments.
TextureCell TextureTree::half(const TextureCell& cell, int which, const TextureCell& smallest, const PlaneTexels& t) const {
  // Half a rectangle of deviation s has its centre at s sqrt(3) / 2, and half the deviation; the axes are s sqrt(2).
  TextureCell half = cell;
  const double shift = (2 * which - 1) * std::sqrt(3.0 / 8);
  half.center = {cell.center[0] + shift * cell.axis_a[0], cell.center[1] + shift * cell.axis_a[1]};
  half.axis_a = cell.axis_b;
  half.axis_b = {0.5 * cell.axis_a[0], 0.5 * cell.axis_a[1]};
  half.area = 0.5 * cell.area;
  half.radius = std::sqrt(1.5 * (length2(half.axis_a) + length2(half.axis_b)));
  half.children = 0;
  half.depth = cell.depth + 1;
  half.along_a = half.along_b = {};
  half.deviation *= 0.7;
  const double x = std::clamp((half.center[0] - t.left) / t.spacing, 0.0, t.width - 1.0),
               y = std::clamp((half.center[1] - t.bottom) / t.spacing, 0.0, t.height - 1.0);
  const int i = std::min(static_cast<int>(x), std::max(t.width - 2, 0)), j = std::min(static_cast<int>(y), std::max(t.height - 2, 0));
  std::array<double, 4> sum{};
  for (int b = 0; b < 2; ++b)
    for (int a = 0; a < 2; ++a) {
      const std::size_t at = static_cast<std::size_t>(std::min(j + b, t.height - 1) * t.width + std::min(i + a, t.width - 1));
      const double w = (a == 0 ? 1 - (x - i) : x - i) * (b == 0 ? 1 - (y - j) : y - j);
      for (std::size_t c = 0; c < 4; ++c) sum[c] += w * static_cast<double>(t.texels[at][c]);
    }
  half.mean = sum[3] > 0 ? Vec3d{sum[0], sum[1], sum[2]} / sum[3] : smallest.mean;
  return half;
}

}  // namespace steradian
