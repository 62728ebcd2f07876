#include "integrals/ltc/texture_tree.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace steradian {
namespace {

constexpr int kMostCells = 128;   // a side
constexpr int kMostSplits = 600;  // of one look
// Of what the bounds of all cells sum to, as a share of the mean. They add up as if every cell were off by all of its bound, and the same
// way: measured, the mean is off by less than a tenth of it (docs/ltc.md, "Textured lights").
constexpr double kTolerance = 0.15;
constexpr int kDeepest = 6;  // halvings below the smallest cells: an eighth of their side

double luminance(Vec3d v) { return (v.x + v.y + v.z) / 3; }
double length2(const std::array<double, 2>& v) { return v[0] * v[0] + v[1] * v[1]; }

// Sums over texels: of coverage, of radiance, their first moments, the coverage's second ones, and the radiance's square.
struct Moments {
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
    square += luminance(p) * luminance(p) / w;
    power += p;
    power_x += p * at_x;
    power_y += p * at_y;
  }
  void add(const Moments& m) {
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
  // Children are side by side, before their own children: the moments of a cell are known when its second child is done.
  const auto build = [&](auto&& self, std::size_t index, const Range& r) -> Moments {
    Moments m;
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
    Cell& cell = cells_[index];
    if (!(m.area > 0)) return m;
    cell.area = m.area;
    cell.mean = m.power / m.area;
    cell.deviation = std::sqrt(std::max(m.square / m.area - luminance(cell.mean) * luminance(cell.mean), 0.0));
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

// The half of a smallest cell on one side (1 or -1) of its long axis, as large as an even cell of its moments would be cut.
TextureTree::Cell TextureTree::half_of(const Cell& cell, double side, const PlaneTexels& t) {
  // Half a rectangle of the deviation s has its centre at s sqrt(3) / 2, and half the deviation; the axes are s sqrt(2).
  Cell half = cell;
  const double shift = side * std::sqrt(3.0 / 8);
  half.center = {cell.center[0] + shift * cell.axis_a[0], cell.center[1] + shift * cell.axis_a[1]};
  half.axis_a = cell.axis_b;
  half.axis_b = {0.5 * cell.axis_a[0], 0.5 * cell.axis_a[1]};
  half.area = 0.5 * cell.area;
  half.radius = std::sqrt(1.5 * (length2(half.axis_a) + length2(half.axis_b)));
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
  if (sum[3] > 0) half.mean = Vec3d{sum[0], sum[1], sum[2]} / sum[3];
  return half;
}

// What a view makes of a cell.
struct TextureTree::Seen {
  double weight = 0;  // the integral of the lobe
  Vec3d radiance{};   // of the lobe times the texture
  double error = 0;   // of what the quotient of the sums may be off, times the sum of the weights
  const Cell* cell;
  bool operator<(const Seen& other) const { return error < other.error; }
};

// What all cells ask of a view.
struct TextureTree::Prepared {
  const View& view;
  Kernels<double>::vec3 normal;  // of the plane, unit
  double height;                 // of the point over it
  double least_length;           // |M^-1 l| in the lobe's own direction
  double determinant;            // of M^-1

  explicit Prepared(const View& v) : view(v), normal(cross(v.x, v.y)) {
    Kernels<double> k;
    height = std::fabs(dot(normal, v.origin).v);
    const auto peak = k.ltc_texture_transform_back(v.matrix, Kernels<double>::vec3(0.0, 0.0, 1.0));
    const auto under = k.ltc_transform(v.matrix, peak * inversesqrt(dot(peak, peak)));
    least_length = std::sqrt(dot(under, under).v);
    determinant = (v.matrix.yy * (v.matrix.xx * v.matrix.zz - v.matrix.xz * v.matrix.zx)).v;
  }
};

// Whether the smallest cells are small against the lobe, where its peak is on the light.
bool TextureTree::resolves(const View& view) const {
  using K = Kernels<double>;
  K k;
  const K::vec3 normal = cross(view.x, view.y), peak = k.ltc_texture_transform_back(view.matrix, K::vec3(0.0, 0.0, 1.0));
  const double along = dot(normal, peak).v, height = dot(normal, view.origin).v;
  if (!(along * height > 0)) return true;
  const K::vec3 hit = peak * K::real(height / along);
  const double x = dot(hit - view.origin, view.x).v, y = dot(hit - view.origin, view.y).v, distance = std::sqrt(dot(hit, hit).v);
  const double size = finest_ * k.ltc_sharpness(view.matrix, hit).v / distance, margin = 2 * distance / k.ltc_sharpness(view.matrix, hit).v;
  const bool on_light = x > bounds_[0] - margin && x < bounds_[1] + margin && y > bounds_[2] - margin && y < bounds_[3] + margin;
  return !on_light || size < 1.5;
}

TextureTree::Seen TextureTree::seen(const Cell& cell, const Prepared& prepared, Vec3d expected) {
  using K = Kernels<double>;
  K k;
  Seen s;
  s.cell = &cell;
  if (!(cell.area > 0)) return s;
  const View& view = prepared.view;
  const auto in_frame = [&](const std::array<double, 2>& v) { return view.x * K::real(v[0]) + view.y * K::real(v[1]); };
  const K::vec3 center = view.origin + in_frame(cell.center), a = in_frame(cell.axis_a), b = in_frame(cell.axis_b);
  const auto value = [&](const K::vec3& r) {
    if (!(r.z.v > 0)) return 0.0;
    const double inverse2 = 1 / dot(r, r).v, inverse = std::sqrt(inverse2);
    const K::vec3 l = r * K::real(inverse);
    const double lobe = view.ggx ? k.ggx_lobe_and_fresnel(*view.ggx, l, 1.0).x.v : k.ltc_lobe(view.matrix, l).v;
    return lobe * inverse * inverse2;
  };
  const double at_a = value(center + a), from_a = value(center - a), at_b = value(center + b), from_b = value(center - b);
  const double area = cell.area * prepared.height;  // times the cosine at the light, which is the height over the distance
  const double mean = 0.25 * (at_a + from_a + at_b + from_b);
  s.weight = area * mean;
  s.radiance = (cell.mean * mean + cell.along_a * (0.5 * (at_a - from_a)) + cell.along_b * (0.5 * (at_b - from_b))) * area;
  s.radiance = {std::max(s.radiance.x, 0.0), std::max(s.radiance.y, 0.0), std::max(s.radiance.z, 0.0)};

  // t as kernels/outline/light_elements.glsl has it. The lobe is at most det / (pi |M^-1 l|^3), whose denominator falls by no more than the
  // cell reaches, and not below its least.
  const double inverse_distance = 1 / std::sqrt(dot(center, center).v), distance = 1 / inverse_distance;
  const double steepness = k.ltc_sharpness(view.matrix, center).v, sharpness = k.light_elements_diffuse_sharpness().v + steepness;
  const double t = std::sqrt(0.5 * (length2(cell.axis_a) + length2(cell.axis_b))) * inverse_distance * sharpness;
  const K::vec3 under = k.ltc_transform(view.matrix, center * K::real(inverse_distance));
  const double reach = std::min(cell.radius * inverse_distance * steepness, 1.0);
  const double m = std::max(std::sqrt(dot(under, under).v) * (1 - reach), prepared.least_length);
  const double nearest = std::max(distance - cell.radius, prepared.height);
  const double steep = std::min(prepared.height + cell.radius, nearest) / (nearest * nearest * nearest);
  const double highest = prepared.determinant / (3.14159265358979324 * m * m * m) * steep;
  const double off = std::fabs(luminance(cell.mean) - luminance(expected));
  const double small = std::min(t, 2.0);
  s.error = cell.area * highest * (off * small * small * small / 8 + 0.5 * cell.deviation * small * small);
  return s;
}

std::optional<Vec3f> TextureTree::mean_under(const View& view, const PlaneTexels& texels) const {
  if (!resolves(view)) return std::nullopt;
  const Prepared prepared(view);
  std::vector<Seen> open;
  open.reserve(128);
  std::deque<Cell> halves;  // of smallest cells: a deque leaves them where they are
  Vec3d expected = cells_.front().mean;
  open.push_back(seen(cells_.front(), prepared, expected));
  double weight = open[0].weight, error = open[0].error;
  Vec3d radiance = open[0].radiance;
  for (int i = 0; i < kMostSplits && error > kTolerance * luminance(radiance); ++i) {
    std::pop_heap(open.begin(), open.end());
    const Seen worst = open.back();
    const Cell& cell = *worst.cell;
    if (cell.depth == kDeepest) return std::nullopt;
    open.pop_back();
    weight -= worst.weight;
    radiance = radiance - worst.radiance;
    error -= worst.error;
    for (int c = 0; c < 2; ++c) {
      const Cell& child =
          cell.children > 0 ? cells_[static_cast<std::size_t>(cell.children + c)] : halves.emplace_back(half_of(cell, 2 * c - 1, texels));
      open.push_back(seen(child, prepared, expected));
      const Seen& part = open.back();
      weight += part.weight;
      radiance += part.radiance;
      error += part.error;
      std::push_heap(open.begin(), open.end());
    }
    if (weight > 0) expected = radiance / weight;
  }
  // Afresh: differences have left their rounding in the sums.
  weight = 0;
  radiance = {};
  for (const Seen& part : open) {
    weight += part.weight;
    radiance += part.radiance;
  }
  if (!(weight > 0)) return std::nullopt;
  return static_cast<Vec3f>(radiance / weight);
}

}  // namespace steradian
