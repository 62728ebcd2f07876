#include "integrals/textured/filtered_texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/box.h"

namespace steradian {
namespace {

using Texel = std::array<float, 4>;

constexpr int kMostTexels = 512;   // a side of the finest level: larger lights in the picture are rare
constexpr int kCoverageSteps = 4;  // points per texel side that are tested for lying on the light
// The finest level is blurred by the texel's own box: variance 1/12, and 1/6 from bilinear look-up.
constexpr double kTexelSigma = 0.5;
constexpr double kTexelsPerSigma = 2;  // of the blurred levels
constexpr double kReach = 3;           // standard deviations that a blur reaches
// Standard deviation of the coarsest level over the light's largest extent. There, weights over the light differ by exp(-1/8) at most.
constexpr double kCoarsest = 2;

// Crossing number over all contours: true inside the outline and outside the holes.
bool covers(const std::vector<std::array<double, 2>>& v, const std::vector<std::size_t>& contours, double x, double y) {
  bool inside = false;
  for (std::size_t c = 0; c + 1 < contours.size(); ++c)
    for (std::size_t i = contours[c], j = contours[c + 1] - 1; i < contours[c + 1]; j = i++)
      if ((v[i][1] > y) != (v[j][1] > y) && x < (v[j][0] - v[i][0]) * (y - v[i][1]) / (v[j][1] - v[i][1]) + v[i][0]) inside = !inside;
  return inside;
}

int texels_for(double length, double spacing) { return std::max(1, static_cast<int>(std::ceil(length / spacing - 1e-6))); }

}  // namespace

FilteredTexture::FilteredTexture(const AreaLight& light, const PreparedPolygon& polygon, const std::vector<Image>& images)
    : origin_(polygon.centroid) {
  // The axes lie along the texture's u, so that these texels are parallel to those of most textures.
  const Frame frame = Frame::from_normal_and_tangent(polygon.normal, light.texture->du);
  x_ = frame.x;
  y_ = frame.y;
  levels_.push_back(rastered(light, polygon, images));
  measure_light();
  const double extent = std::max(levels_[0].width, levels_[0].height) * levels_[0].spacing;
  while (levels_.back().sigma < kCoarsest * extent) levels_.push_back(blurred(levels_.front(), levels_.back()));
}

// Computes the mean radiance, and centroid and covariance of the area.
void FilteredTexture::measure_light() {
  const Level& level = levels_.front();
  std::array<double, 4> sum{};
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (int j = 0; j < level.height; ++j)
    for (int i = 0; i < level.width; ++i) {
      const Texel& t = level.texels[static_cast<std::size_t>(j * level.width + i)];
      for (std::size_t c = 0; c < 4; ++c) sum[c] += static_cast<double>(t[c]);
      const double w = static_cast<double>(t[3]), a = level.left + i * level.spacing, b = level.bottom + j * level.spacing;
      x += w * a;
      y += w * b;
      xx += w * a * a;
      xy += w * a * b;
      yy += w * b * b;
    }
  if (!(sum[3] > 0)) return;
  mean_ = {static_cast<float>(sum[0] / sum[3]), static_cast<float>(sum[1] / sum[3]), static_cast<float>(sum[2] / sum[3])};
  x /= sum[3];
  y /= sum[3];
  centroid_ = {x, y};
  covariance_ = {xx / sum[3] - x * x, xy / sum[3] - x * y, yy / sum[3] - y * y};
}

// Computes the next level from the last one: a Gaussian of the variance that is missing, one axis after the other.
FilteredTexture::Level FilteredTexture::blurred(const Level& fine, const Level& last) {
  Level next;
  next.sigma = 2 * last.sigma;
  next.spacing = next.sigma / kTexelsPerSigma;
  const double width = fine.width * fine.spacing, height = fine.height * fine.spacing, margin = kReach * next.sigma;
  next.width = texels_for(width + 2 * margin, next.spacing);
  next.height = texels_for(height + 2 * margin, next.spacing);
  next.left = fine.left - fine.spacing / 2 + (width - (next.width - 1) * next.spacing) / 2;
  next.bottom = fine.bottom - fine.spacing / 2 + (height - (next.height - 1) * next.spacing) / 2;

  const double sigma2 = next.sigma * next.sigma - last.sigma * last.sigma, reach = kReach * std::sqrt(sigma2) / last.spacing;
  const double height_of_gaussian = last.spacing / std::sqrt(2 * std::numbers::pi * sigma2);
  // One axis of `from`: texel i of a line is from[i * stride], the lines are line_stride apart.
  struct Axis {
    double first;
    int count, stride, line_stride;
  };
  const auto blur = [&](const std::vector<Texel>& from, Axis a, int lines, std::vector<Texel>& to, Axis b) {
    for (int j = 0; j < b.count; ++j) {
      const double center = (b.first + j * next.spacing - a.first) / last.spacing;
      const int begin = std::max(0, static_cast<int>(std::ceil(center - reach)));
      const int end = std::min(a.count, static_cast<int>(std::floor(center + reach)) + 1);
      for (int i = begin; i < end; ++i) {
        const double d = (i - center) * last.spacing;
        const auto w = static_cast<float>(height_of_gaussian * std::exp(-d * d / (2 * sigma2)));
        for (int l = 0; l < lines; ++l) {
          const Texel& t = from[static_cast<std::size_t>(i * a.stride + l * a.line_stride)];
          Texel& sum = to[static_cast<std::size_t>(j * b.stride + l * b.line_stride)];
          for (std::size_t c = 0; c < 4; ++c) sum[c] += w * t[c];
        }
      }
    }
  };
  std::vector<Texel> rows(static_cast<std::size_t>(next.width) * static_cast<std::size_t>(last.height));
  blur(last.texels, {last.left, last.width, 1, last.width}, last.height, rows, {next.left, next.width, 1, next.width});
  next.texels.resize(static_cast<std::size_t>(next.width) * static_cast<std::size_t>(next.height));
  blur(rows, {last.bottom, last.height, next.width, 1}, next.width, next.texels, {next.bottom, next.height, next.width, 1});
  return next;
}

// Computes the finest level: the light's bounds in texels of the texture's own size, or larger ones.
FilteredTexture::Level FilteredTexture::rastered(const AreaLight& light, const PreparedPolygon& polygon,
                                                 const std::vector<Image>& images) const {
  const LightTexture& texture = *light.texture;
  const Image& image = images[static_cast<std::size_t>(texture.use.image)];
  Box2d box;
  std::vector<std::array<double, 2>> outline;
  for (const Vec3d& v : polygon.vertices) {
    outline.push_back({dot(v - origin_, x_), dot(v - origin_, y_)});
    box.add(Vec2d{outline.back()[0], outline.back()[1]});
  }
  const Vec2d size = box.size();
  const double extent = std::max(size.x, size.y);
  // Texels per metre, from the steeper of the two coordinates (KHR_texture_transform included).
  const float* t = texture.use.uv;
  const auto row = [&](int i) { return texture.du * static_cast<double>(t[i]) + texture.dv * static_cast<double>(t[i + 1]); };
  const double density = std::max({length(row(0)) * image.width, length(row(3)) * image.height, 1e-6});
  Level level;
  level.spacing = std::max(1 / density, extent / kMostTexels);
  level.spacing = std::min(level.spacing, extent / 8);  // at least 8 texels, to resolve the outline
  level.width = texels_for(size.x, level.spacing);
  level.height = texels_for(size.y, level.spacing);
  level.left = (box.low.x + box.high.x - (level.width - 1) * level.spacing) / 2;
  level.bottom = (box.low.y + box.high.y - (level.height - 1) * level.spacing) / 2;
  level.sigma = kTexelSigma * level.spacing;
  // Enough points to reach all of the texture's texels.
  const int steps = std::clamp(static_cast<int>(std::ceil(level.spacing * density)), kCoverageSteps, 16);
  const float share = 1.0f / static_cast<float>(steps * steps);
  for (int j = 0; j < level.height; ++j)
    for (int i = 0; i < level.width; ++i) {
      Texel sum{};
      for (int b = 0; b < steps; ++b)
        for (int a = 0; a < steps; ++a) {
          const double x = level.left + (i + (a + 0.5) / steps - 0.5) * level.spacing;
          const double y = level.bottom + (j + (b + 0.5) / steps - 0.5) * level.spacing;
          if (!covers(outline, polygon.contours, x, y)) continue;
          const auto r = static_cast<Vec3f>(texture_radiance(texture, images, origin_ + x_ * x + y_ * y));
          sum[0] += r.x * share;
          sum[1] += r.y * share;
          sum[2] += r.z * share;
          sum[3] += share;
        }
      level.texels.push_back(sum);
    }
  return level;
}

FilteredTexture::Sum FilteredTexture::Level::at(double px, double py) const {
  const double x = (px - left) / spacing, y = (py - bottom) / spacing;
  Sum sum;
  if (!(x > -1 && y > -1 && x < width && y < height)) return sum;  // off the raster: nothing of the light
  const double fi = std::floor(x), fj = std::floor(y);
  const int i = static_cast<int>(fi), j = static_cast<int>(fj);
  const auto s = static_cast<float>(x - fi), t = static_cast<float>(y - fj);
  const auto add = [&](int a, int b, float w) {
    if (a < 0 || b < 0 || a >= width || b >= height) return;
    const Texel& texel = texels[static_cast<std::size_t>(b) * static_cast<std::size_t>(width) + static_cast<std::size_t>(a)];
    for (std::size_t c = 0; c < 4; ++c) sum.rgbw[c] += w * texel[c];
  };
  add(i, j, (1 - s) * (1 - t));
  add(i + 1, j, s * (1 - t));
  add(i, j + 1, (1 - s) * t);
  add(i + 1, j + 1, s * t);
  return sum;
}

// Interpolates between two levels in proportion to the variance.
FilteredTexture::Sum FilteredTexture::at(double x, double y, double sigma) const {
  const double finest = levels_.front().sigma;
  const double level = std::clamp(std::log2(std::max(sigma, finest) / finest), 0.0, static_cast<double>(levels_.size() - 1));
  const std::size_t k = std::min(static_cast<std::size_t>(level), levels_.size() - 2);
  const double ratio2 = std::exp2(2 * (level - static_cast<double>(k)));
  const auto t = static_cast<float>((ratio2 - 1) / 3);
  return Sum{}.add(levels_[k].at(x, y), 1 - t).add(levels_[k + 1].at(x, y), t);
}

FilteredTexture::Sum FilteredTexture::under(const PlaneGaussian& g) const {
  const double major = std::hypot(g.major_x, g.major_y);
  const double sigma = std::max({g.minor, major / static_cast<double>(kTextureAnisotropy), levels_.front().sigma});
  if (major < 1.1 * sigma) return at(g.x, g.y, std::max(sigma, major));
  const double spread2 = (major * major - sigma * sigma) / (major * major);  // of the probes, of major squared
  const double step = static_cast<double>(kTextureProbeSpacing) * sigma / major;
  const int side = static_cast<int>(std::ceil(2 * std::sqrt(spread2) / step));
  Sum sum;
  float total = 0;
  for (int i = -side; i <= side; ++i) {
    const double u = i * step;
    const auto w = static_cast<float>(std::exp(-u * u / (2 * spread2)));
    sum.add(at(g.x + u * g.major_x, g.y + u * g.major_y, sigma), w);
    total += w;
  }
  return Sum{}.add(sum, 1 / total);
}

Vec3f FilteredTexture::radiance(const Sum& sum) const {
  if (!(sum.rgbw[3] > kTextureLeastCoverage)) return mean_;
  return {sum.rgbw[0] / sum.rgbw[3], sum.rgbw[1] / sum.rgbw[3], sum.rgbw[2] / sum.rgbw[3]};
}

}  // namespace steradian
