#include "render/environment/filtered_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace steradian::environment {
namespace {

constexpr double kLargestWidth = 0.3;  // 32 cones of the roughest lobe need no larger width
constexpr int kFinestSide = 512, kCoarsestSide = 32, kLevels = 10;

// The octahedron |x| + |y| + |z| = 1. Its upper half (y > 0) is the middle of the square [-1, 1]^2, the lower half is folded outwards.
struct SquarePlace {
  float s, t;
};
SquarePlace square_from_direction(Vec3f d) {
  const float scale = 1 / (std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z));
  const float s = d.x * scale, t = d.z * scale;
  if (d.y >= 0) return {s, t};
  return {std::copysign(1 - std::fabs(t), s), std::copysign(1 - std::fabs(s), t)};
}
Vec3d direction_from_square(double s, double t) {
  const double y = 1 - std::fabs(s) - std::fabs(t);
  if (y >= 0) return normalized(Vec3d{s, y, t});
  return normalized(Vec3d{std::copysign(1 - std::fabs(t), s), y, std::copysign(1 - std::fabs(s), t)});
}

Vec3d texel_direction(double x, double y, int side) { return direction_from_square(2 * x / side - 1, 2 * y / side - 1); }

// Standard deviation of a level's blur, in terms of the finest level's texels. The first level has about half a texel, unfiltered. From
// the second on it is 0.6 times a power of two, including the blur of interpolation. Texels have half of that power of two (the coarsest
// are smaller), so that linear interpolation does not show.
float width_of_level(int level, float finest_texel) { return level == 0 ? 0.5f * finest_texel : std::ldexp(0.6f * finest_texel, level); }

}  // namespace

void FilteredMap::Level::fill_border() {
  for (int i = 0; i < side; ++i) {
    const int mirrored = side - 1 - i;  // the neighbour across an edge of the square is the same edge in reverse
    at(i, -1) = at(mirrored, 0);
    at(i, side) = at(mirrored, side - 1);
    at(-1, i) = at(0, mirrored);
    at(side, i) = at(side - 1, mirrored);
  }
  at(-1, -1) = at(side - 1, side - 1);
  at(side, side) = at(0, 0);
  at(-1, side) = at(side - 1, 0);
  at(side, -1) = at(0, side - 1);
}

Vec3f FilteredMap::Level::linear(Vec3f direction) const {
  const SquarePlace p = square_from_direction(direction);
  const auto half = static_cast<float>(side) * 0.5f;
  const float x = (p.s + 1) * half - 0.5f, y = (p.t + 1) * half - 0.5f;
  const float x0 = std::floor(x), y0 = std::floor(y);
  const int i = std::clamp(static_cast<int>(x0), -1, side - 1), j = std::clamp(static_cast<int>(y0), -1, side - 1);
  const float fx = x - x0, fy = y - y0;
  const Vec3f* row = &at(i, j);
  const Vec3f* next = &at(i, j + 1);
  return (row[0] * (1 - fx) + row[1] * fx) * (1 - fy) + (next[0] * (1 - fx) + next[1] * fx) * fy;
}

// Blurs the finer level about every texel by a grid of 7 x 7 positions a standard deviation apart. This is the trapezoidal rule, which is
// practically exact for a Gaussian of that spacing.
FilteredMap::Level FilteredMap::blurred(const Level& finer, int side, double width) {
  struct Node {
    double x, y, weight;  // unit vector in total: sine of the angle, along the directions of the tangent plane
  };
  constexpr int kReach = 3;
  std::vector<Node> nodes;
  double sum = 0;
  for (int i = -kReach; i <= kReach; ++i)
    for (int j = -kReach; j <= kReach; ++j) {
      const double angle = std::min(width * std::hypot(i, j), std::numbers::pi);
      const double sine_over_angle = angle > 0 ? std::sin(angle) / angle : 1;  // ratio of the areas of the sphere's cell and the plane's
      nodes.push_back({width * i, width * j, std::exp(-0.5 * (i * i + j * j)) * sine_over_angle});
      sum += nodes.back().weight;
    }
  Level level;
  level.side = side;
  level.texels.resize(static_cast<std::size_t>((side + 2) * (side + 2)));
  tbb::parallel_for(0, side, [&](int y) {
    for (int x = 0; x < side; ++x) {
      const Frame frame = Frame::from_normal(texel_direction(x + 0.5, y + 0.5, side));
      Vec3d mean{};
      for (const Node& node : nodes) {
        const double angle = std::min(std::hypot(node.x, node.y), std::numbers::pi), s = angle > 0 ? std::sin(angle) / angle : 1;
        const Vec3d d = frame.to_world({node.x * s, node.y * s, std::cos(angle)});
        mean += static_cast<Vec3d>(finer.linear(static_cast<Vec3f>(d))) * (node.weight / sum);
      }
      level.at(x, y) = static_cast<Vec3f>(mean);
    }
  });
  level.fill_border();
  return level;
}

FilteredMap::FilteredMap(const DirectionGrid& grid) {
  int side = kCoarsestSide;
  while (side < kFinestSide && side < grid.map.width) side *= 2;
  finest_texel_ = static_cast<float>(std::sqrt(4 * std::numbers::pi) / side);

  // Average four map texels, one in the middle of each quarter of a texel of the finest level.
  Level finest;
  finest.side = side;
  finest.texels.resize(static_cast<std::size_t>((side + 2) * (side + 2)));
  tbb::parallel_for(0, side, [&](int y) {
    for (int x = 0; x < side; ++x) {
      Vec3f sum{};
      for (const double dx : {0.25, 0.75})
        for (const double dy : {0.25, 0.75}) sum += radiance_from(grid.map, texel_direction(x + dx, y + dy, side));
      finest.at(x, y) = sum * 0.25f;
    }
  });
  finest.fill_border();
  levels_.push_back(std::move(finest));

  double width = width_of_level(0, finest_texel_);
  for (int level = 1; level <= kLevels && width < kLargestWidth; ++level) {
    const double wanted = width_of_level(level, finest_texel_);
    if (level > 1) side = std::max(side / 2, kCoarsestSide);
    const double texel = std::sqrt(4 * std::numbers::pi) / side, by_interpolation = texel * texel / 6;
    levels_.push_back(blurred(levels_.back(), side, std::sqrt(wanted * wanted - width * width - by_interpolation)));
    width = wanted;
  }
}

Vec3f FilteredMap::mean(Vec3f direction, float width) const {
  const float first = width_of_level(0, finest_texel_), second = width_of_level(1, finest_texel_);
  const float level = width <= first    ? 0.0f
                      : width <= second ? std::log2(width / first) / std::log2(second / first)
                                        : 1 + std::log2(width / second);
  if (!(level < static_cast<float>(levels_.size() - 1))) return levels_.back().linear(direction);
  const auto below = static_cast<std::size_t>(level);
  const float t = level - static_cast<float>(below);
  return levels_[below].linear(direction) * (1 - t) + levels_[below + 1].linear(direction) * t;
}

}  // namespace steradian::environment
