#include "render/many/cell.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/box.h"
#include "steradian/kernels.h"

namespace steradian::lights {
namespace {

double chebyshev(int degree, double x) { return std::cos(degree * std::acos(x)); }

NodeRow make_row(int n) {
  NodeRow row;
  for (int j = 0; j < n; ++j) {
    const double x = std::cos(std::numbers::pi * (j + 0.5) / n);
    const auto column = static_cast<std::size_t>(j);
    row.node[column] = static_cast<float>(x);
    for (int i = 0; i < n; ++i)
      row.to_factors[static_cast<std::size_t>(i)][column] = static_cast<float>((i == 0 ? 1.0 : 2.0) / n * chebyshev(i, x));
  }
  return row;
}

}  // namespace

double lebesgue(int nodes) { return 2 * std::numbers::inv_pi * std::log(nodes) + 1; }

const NodeRow& node_row(int nodes) {
  static const std::array<NodeRow, 4> rows = {make_row(1), make_row(2), make_row(4), make_row(8)};
  return rows[nodes >= 8 ? 3 : static_cast<std::size_t>(nodes) / 2];
}

namespace {

Vec3f mean_normal(ReceiverSpan points) {
  Vec3f sum{};
  for (const Receiver& q : points) sum = sum + q.normal;
  return dot(sum, sum) > 1e-12f ? normalized(sum) : points.front().normal;
}

template <class Key>
std::pair<ReceiverSpan, ReceiverSpan> divided(ReceiverSpan points, float at, Key key) {
  const auto middle = std::partition(points.begin(), points.end(), [&](const Receiver& q) { return key(q) < at; });
  const auto count = static_cast<std::size_t>(middle - points.begin());
  return {points.first(count), points.subspan(count)};
}

constexpr float kTurn = 0.6f;        // largest turn of a cone that is worth a cell [rad, as a chord]
constexpr float kThick = 0.25f;      // ratio of a surface's depth to its width
constexpr std::size_t kWorthy = 64;  // smaller sets are not divided for the sake of order

}  // namespace

ReceiverCell cell_about(ReceiverSpan points, const std::array<Vec3f, 3>& axes, Vec3f eye) {
  ReceiverCell cell;
  cell.axes = axes;
  cell.normal = mean_normal(points);
  cell.eye = eye;
  // Positions are relative to the first point: products of coordinates far from the origin would lose digits.
  const Vec3f origin = points.front().position;
  std::array<Interval<float>, 3> along;
  for (const Receiver& q : points) {
    const Vec3f p = q.position - origin, off = q.normal - cell.normal;
    for (std::size_t k = 0; k < 3; ++k) along[k].add(dot(p, axes[k]));
    cell.turn = std::max(cell.turn, dot(off, off));
    cell.loss = std::max(cell.loss, q.loss);
  }
  cell.turn = std::sqrt(cell.turn) + 1e-6f;
  cell.center = origin;
  for (std::size_t k = 0; k < 3; ++k) cell.center = cell.center + axes[k] * along[k].middle();
  constexpr float kRounding = 1 + 1e-5f;
  cell.half = Vec3f{along[0].half(), along[1].half(), along[2].half()} * kRounding;
  cell.radius = length(cell.half);
  cell.eye_distance = std::max(length(eye - cell.center) - cell.radius, 0.0f);
  return cell;
}

ReceiverCell cell_about(ReceiverSpan points, Vec3f eye) {
  const Vec3f normal = mean_normal(points), origin = points.front().position;
  const Vec3f aside = std::abs(normal.x) < 0.7f ? Vec3f{1, 0, 0} : Vec3f{0, 1, 0};
  const Vec3f x = normalized(cross(aside, normal)), y = cross(normal, x);
  // Covariances in the plane, and the angle of the longer axis.
  float sx = 0, sy = 0, xx = 0, xy = 0, yy = 0;
  for (const Receiver& q : points) {
    const Vec3f p = q.position - origin;
    const float a = dot(p, x), b = dot(p, y);
    sx += a;
    sy += b;
    xx += a * a;
    xy += a * b;
    yy += b * b;
  }
  const auto count = static_cast<float>(points.size());
  xx -= sx * sx / count;
  xy -= sx * sy / count;
  yy -= sy * sy / count;
  const float angle = std::atan2(2 * xy, xx - yy) / 2, c = std::cos(angle), s = std::sin(angle);
  return cell_about(points, {x * c + y * s, y * c - x * s, normal}, eye);
}

Disorder disorder_of(ReceiverSpan points, const ReceiverCell& cell) {
  if (points.size() < kWorthy) return Disorder::none;
  if (cell.turn > kTurn && divided_by_normals(points).first.size() > 0) return Disorder::normals;
  if (cell.half.z > kThick * std::max(cell.half.x, cell.half.y)) return Disorder::places;
  return Disorder::none;
}

std::pair<ReceiverSpan, ReceiverSpan> divided_by_normals(ReceiverSpan points) {
  Box3f normals;
  for (const Receiver& q : points) normals.add(q.normal);
  const int axis = normals.longest_side();
  return divided(points, coordinate(normals.center(), axis), [&](const Receiver& q) { return coordinate(q.normal, axis); });
}

std::pair<ReceiverSpan, ReceiverSpan> divided_by_place(ReceiverSpan points, const ReceiverCell& cell) {
  const Vec3f axis = cell.axes[static_cast<std::size_t>(longest_axis(cell.half))];
  return divided(points, 0, [&](const Receiver& q) { return dot(q.position - cell.center, axis); });
}

NodeGrid grid_for(Vec3f half, float distance, float error) {
  using K = Kernels<float>;
  NodeGrid grid;
  grid.count = {1, 1, 1};
  const std::array<float, 3> reach{half.x, half.y, half.z};
  const auto error_along = [&](std::size_t k) {
    return K().far_error_of_nodes(grid.count[k], K::real(static_cast<double>(reach[k])), K::real(static_cast<double>(distance))).v;
  };
  while (grid.size() < kMostNodes) {
    if (grid.size() >= 16 && error_along(0) + error_along(1) + error_along(2) < error) break;
    std::size_t worst = kMostNodes;
    for (std::size_t k = 0; k < 3; ++k)
      if (grid.count[k] < 8 && (worst == kMostNodes || error_along(k) > error_along(worst))) worst = k;
    grid.count[worst] *= 2;
  }
  return grid;
}

}  // namespace steradian::lights
