#include "render/radiosity/block_fit.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace steradian::radiosity {
namespace {

constexpr float kDeviations = 2;  // standard errors of an error

template <class Of>
Vec3f each_channel(Of of, Vec3f a, Vec3f b) {
  return {of(a.x, b.x), of(a.y, b.y), of(a.z, b.z)};
}

Vec3f root(Vec3f v) { return {std::sqrt(v.x), std::sqrt(v.y), std::sqrt(v.z)}; }

float x_of(std::size_t lane) { return static_cast<float>(lane % 4); }
float y_of(std::size_t lane) { return static_cast<float>(lane / 4); }

// True if two surfaces lie in one plane. same_direction: least cosine between their normals.
bool share_plane(const Surface& a, const Surface& b, float same_direction) {
  constexpr float kOff = 0.1f;  // distance from the plane over the distance
  const Vec3f way = b.position - a.position;
  return dot(a.normal, b.normal) > same_direction && std::fabs(dot(way, a.normal)) <= kOff * length(way);
}

}  // namespace

Gathered mean_of_quarters(const std::array<Vec3f, 4>& light, const std::array<float, 4>& weight) {
  const float whole = weight[0] + weight[1] + weight[2] + weight[3];
  const auto over = [](Vec3f sum, float by) { return by > 0 ? sum * (1 / by) : Vec3f{}; };
  Gathered result{};
  for (const Vec3f& quarter : light) result.value += over(quarter, whole);
  Vec3f squares{};
  for (std::size_t q = 0; q < 4; ++q) {
    const Vec3f off = over(light[q], weight[q]) - result.value;
    squares += off * off;
  }
  result.error = root(squares * (1.0f / 12));
  return result;
}

Vec3f spread(Vec3f squares, Vec3f light, Vec3f weight) {
  const Vec3f of_all = squares * weight - light * light;
  return root({std::max(of_all.x, 0.0f), std::max(of_all.y, 0.0f), std::max(of_all.z, 0.0f)});
}

// Coordinates about the mean: the two slopes and the mean are nearly independent.
LinearFit::LinearFit(std::span<const Point> points) : count_(static_cast<float>(points.size())) {
  const float over = 1 / count_;
  for (const Point& p : points) {
    middle_x_ += p.x * over;
    middle_y_ += p.y * over;
    mean_ += p.mean.value;
    of_rays_ += p.mean.error * p.mean.error;
  }
  mean_ = mean_ * over;
  of_rays_ = of_rays_ * over;
  float xy = 0;
  Vec3f vx{}, vy{};
  for (const Point& p : points) {
    const float x = p.x - middle_x_, y = p.y - middle_y_;
    xx_ += x * x;
    xy += x * y;
    yy_ += y * y;
    vx += p.mean.value * x;
    vy += p.mean.value * y;
  }
  const float determinant = xx_ * yy_ - xy * xy;
  if (determinant > 1) {
    slope_x_ = (vx * yy_ - vy * xy) * (1 / determinant);
    slope_y_ = (vy * xx_ - vx * xy) * (1 / determinant);
  }
  for (const Point& p : points) {
    const Vec3f d = p.mean.value - at(p.x, p.y);
    squares_ += d * d;
  }
}

Vec3f LinearFit::variance() const { return squares_ * (1 / (count_ - 3)); }

Vec3f LinearFit::standard_error(Vec3f variance) const { return root(variance * (3 / count_)); }

void LinearFit::shrink_slopes() {
  const auto shrunk = [&](Vec3f slope, float moment) {
    const auto kept = [&](float m, float v) { return m * m * moment > 0 ? std::max(1 - kDoubt * v / (m * m * moment), 0.0f) : 0.0f; };
    return slope * each_channel(kept, slope, variance());
  };
  slope_x_ = shrunk(slope_x_, xx_);
  slope_y_ = shrunk(slope_y_, yy_);
}

BlockFit::BlockFit(const SixteenSurfaces& surfaces, std::uint32_t asked, bool alone, float turn)
    : surfaces_(surfaces), asked_(asked), alone_(alone), same_direction_(std::cos(turn)) {}

// The error of the fit's value has the distance from the pixel's own value, too.
FittedValue BlockFit::at(std::size_t lane, const std::array<Gathered, kLanes>& means, Keeps keeps) const {
  constexpr int kFewest = 6;  // pixels of a fit
  const auto own_alone = [&] { return FittedValue{means[lane].value, means[lane].error * kDeviations, means[lane].error}; };
  if (alone_) return own_alone();
  std::array<LinearFit::Point, kLanes> points;
  std::size_t count = 0;
  Vec3f low = means[lane].value, high = low;
  SixteenSurfaces::each(asked_, [&](std::size_t i) {
    if (i != lane && !share_plane(surfaces_.surface[lane], surfaces_.surface[i], same_direction_)) return;
    points[count++] = {x_of(i), y_of(i), means[i]};
    low = each_channel([](float a, float b) { return std::min(a, b); }, low, means[i].value);
    high = each_channel([](float a, float b) { return std::max(a, b); }, high, means[i].value);
  });
  if (count < kFewest) return own_alone();
  LinearFit fit({points.data(), count});
  const Vec3f variance = fit.variance(), of_rays = fit.of_rays();
  fit.shrink_slopes();
  const Vec3f own = means[lane].value, value = fit.at(x_of(lane), y_of(lane));
  const Vec3f fit_error = fit.standard_error(variance);
  FittedValue result;
  const auto join = [&](float Vec3f::*c) {
    constexpr float kDoubt = LinearFit::kDoubt;
    const bool keep = keeps == Keeps::own_values && variance.*c > kDoubt * of_rays.*c;
    const float kept = keep ? 1 - kDoubt * of_rays.*c / variance.*c : 0;  // of the own value
    const float fitted = std::clamp(value.*c, low.*c, high.*c);
    result.value.*c = fitted + (own.*c - fitted) * kept;
    result.standard.*c = std::sqrt((1 - kept) * (1 - kept) * fit_error.*c * fit_error.*c + kept * kept * kDoubt * of_rays.*c);
    result.error.*c = kDeviations * result.standard.*c + (1 - kept) * std::fabs(own.*c - fitted);
  };
  join(&Vec3f::x);
  join(&Vec3f::y);
  join(&Vec3f::z);
  return result;
}

bool in_one_plane(const FourBlocks& blocks) {
  const float same_direction = std::cos(BlockFit::kFlat);
  for (const SixteenSurfaces& block : blocks) {
    for (const Surface& s : block.surface)
      if (&s != &blocks[0].surface[0] && !share_plane(blocks[0].surface[0], s, same_direction)) return false;
  }
  return true;
}

bool fit_square(const std::array<std::array<Gathered, BlockFit::kLanes>, 4>& means,
                std::array<std::array<FittedValue, BlockFit::kLanes>, 4>& fitted) {
  // One fit takes away 3 of the 64 degrees of freedom, four fits 12. What four explain more than one is chance where the mean square of
  // the 9 is at most so many times that of the 52: in a thousandth of all cases it is more.
  constexpr float kBetter = 3.6f;
  // Noise of a pixel over the light. Where few directions meet what shines, those that meet none would be served, and the others asked
  // again: the mean would be too dark. It also bounds the steps from square to square.
  constexpr float kNoise = 0.15f;
  std::array<LinearFit::Point, 4 * BlockFit::kLanes> points;
  std::array<std::array<Vec3f, BlockFit::kLanes>, 4> of_blocks;
  Vec3f squares_of_blocks{};
  for (std::size_t b = 0; b < 4; ++b) {
    const std::span<LinearFit::Point> block(points.data() + b * BlockFit::kLanes, BlockFit::kLanes);
    for (std::size_t i = 0; i < BlockFit::kLanes; ++i)
      block[i] = {x_of(i) + static_cast<float>(b % 2 * 4), y_of(i) + static_cast<float>(b / 2 * 4), means[b][i]};
    const LinearFit fit(block);
    squares_of_blocks += fit.squares();
    for (std::size_t i = 0; i < BlockFit::kLanes; ++i) of_blocks[b][i] = fit.at(block[i].x, block[i].y);
  }
  LinearFit fit(points);
  const Vec3f variance = fit.variance(), of_rays = fit.of_rays(), explained = fit.squares() - squares_of_blocks;
  const Vec3f mean = fit.at(3.5f, 3.5f);
  if (!weighs(mean)) return false;
  const auto is_plane = [&](float Vec3f::*c) {
    return variance.*c <= kNoise * kNoise * mean.*c * mean.*c && explained.*c / 9 <= kBetter * squares_of_blocks.*c / 52 &&
           variance.*c <= LinearFit::kDoubt * of_rays.*c;
  };
  if (!is_plane(&Vec3f::x) || !is_plane(&Vec3f::y) || !is_plane(&Vec3f::z)) return false;
  fit.shrink_slopes();
  const Vec3f standard = fit.standard_error(variance);
  // Differences between the pixels beyond their errors count as error.
  const Vec3f beyond = root(each_channel([](float v, float r) { return std::max(v - r, 0.0f); }, variance, of_rays));
  for (std::size_t b = 0; b < 4; ++b)
    for (std::size_t i = 0; i < BlockFit::kLanes; ++i) {
      const LinearFit::Point& p = points[b * BlockFit::kLanes + i];
      const Vec3f value = fit.at(p.x, p.y), apart = of_blocks[b][i] - value;
      fitted[b][i] = {value, standard * kDeviations + beyond + Vec3f{std::fabs(apart.x), std::fabs(apart.y), std::fabs(apart.z)}, standard};
    }
  return true;
}

FittedValue between_even_pixels(const std::array<FittedValue, BlockFit::kLanes>& even, std::size_t x, std::size_t y) {
  FittedValue sum{};
  for (const std::size_t down : {y / 2, std::min((y + 1) / 2, std::size_t{3})})
    for (const std::size_t across : {x / 2, std::min((x + 1) / 2, std::size_t{3})}) {
      const FittedValue& near = even[4 * down + across];
      sum.value += near.value * 0.25f;
      sum.error += near.error * 0.25f;
      sum.standard += near.standard * 0.25f;
    }
  return sum;
}

}  // namespace steradian::radiosity
