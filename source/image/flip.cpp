#include "image/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steradian/error.h"

namespace steradian::image {
namespace {

// Conversion from linear sRGB to XYZ, and the white of the primaries: the sums of the rows.
constexpr double kToXyz[3][3] = {
    {0.41238656, 0.35759149, 0.18045049}, {0.21263682, 0.71518298, 0.0721802}, {0.01933062, 0.11919716, 0.95037259}};
constexpr double kWhite[3] = {0.95042854, 1.0, 1.08890037};

using Planes = std::vector<Vec3d>;

// XYZ relative to the white.
Vec3d xyz_of(Vec3d rgb) {
  const auto row = [&](int i) { return (kToXyz[i][0] * rgb.x + kToXyz[i][1] * rgb.y + kToXyz[i][2] * rgb.z) / kWhite[i]; };
  return {row(0), row(1), row(2)};
}

// Luminance and two opponent colours, linear in the light. Section 3.1.
Vec3d ycc_of(Vec3d rgb) {
  const Vec3d n = xyz_of(rgb);
  return {116 * n.y - 16, 500 * (n.x - n.y), 200 * (n.y - n.z)};
}
Vec3d xyz_of_ycc(Vec3d ycc) {
  const double y = (ycc.x + 16) / 116;
  return {y + ycc.y / 500, y, y - ycc.z / 200};
}

Vec3d rgb_of_xyz(Vec3d n) {
  const double x = n.x * kWhite[0], y = n.y * kWhite[1], z = n.z * kWhite[2];
  return {3.24100326 * x - 1.53739899 * y - 0.49861587 * z, -0.96922426 * x + 1.87592999 * y + 0.04155422 * z,
          0.05563942 * x - 0.20401120 * y + 1.05714897 * z};
}

// CIELAB whose colours fade with the luminance (Hunt's effect). Section 3.3.
Vec3d hunt_lab_of(Vec3d rgb) {
  const auto f = [](double t) {
    constexpr double delta = 6.0 / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  };
  const Vec3d n = xyz_of(rgb);
  const double l = 116 * f(n.y) - 16;
  return {l, 0.01 * l * 500 * (f(n.x) - f(n.y)), 0.01 * l * 200 * (f(n.y) - f(n.z))};
}

double hyab(Vec3d a, Vec3d b) { return std::fabs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

// A kernel that is the product of one kernel along rows and one along columns.
struct Separable {
  std::vector<double> along_x, along_y;  // of odd length
};

// Values beyond the border equal those at the border.
std::vector<double> convolved(const std::vector<double>& plane, int width, int height, const Separable& kernel) {
  std::vector<double> rows(plane.size()), result(plane.size());
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x); };
  const int rx = static_cast<int>(kernel.along_x.size() / 2), ry = static_cast<int>(kernel.along_y.size() / 2);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int k = -rx; k <= rx; ++k)
        sum += kernel.along_x[static_cast<std::size_t>(k + rx)] * plane[at(std::clamp(x + k, 0, width - 1), y)];
      rows[at(x, y)] = sum;
    }
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int k = -ry; k <= ry; ++k)
        sum += kernel.along_y[static_cast<std::size_t>(k + ry)] * rows[at(x, std::clamp(y + k, 0, height - 1))];
      result[at(x, y)] = sum;
    }
  return result;
}

std::vector<double> samples(int radius, auto f) {
  std::vector<double> values;
  for (int k = -radius; k <= radius; ++k) values.push_back(f(static_cast<double>(k)));
  return values;
}

void scale_to_sum_1(std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  for (double& v : values) v /= sum;
}

// Contrast sensitivity of the eye to a plane (table 1): a sum of two Gaussians of weight a and width b each.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kAchromatic{1, 0.0047, 0, 1e-5}, kRedGreen{1, 0.0053, 0, 1e-5}, kBlueYellow{34.1, 0.04, 13.5, 0.025};

std::vector<double> filtered(const std::vector<double>& plane, int width, int height, const Sensitivity& s, double pixels_per_degree) {
  const int radius =
      static_cast<int>(std::ceil(3 * std::sqrt(kBlueYellow.b1 / (2 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree));
  const auto gauss = [&](double b) {
    return samples(radius, [&](double k) {
      const double d = k / pixels_per_degree;
      return std::exp(-std::numbers::pi * std::numbers::pi * d * d / b);
    });
  };
  std::vector<double> result(plane.size());
  double total = 0;
  for (const auto& [a, b] : {std::pair{s.a1, s.b1}, std::pair{s.a2, s.b2}}) {
    if (a == 0) continue;
    std::vector<double> g = gauss(b);
    double sum = 0;
    for (const double v : g) sum += v;
    const double weight = a * std::sqrt(std::numbers::pi / b) * sum * sum;  // of the whole two-dimensional Gaussian
    scale_to_sum_1(g);
    const std::vector<double> part = convolved(plane, width, height, {g, g});
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += weight * part[i];
    total += weight;
  }
  for (double& v : result) v /= total;
  return result;
}

std::vector<double> plane_of(const Planes& picture, double Vec3d::*channel) {
  std::vector<double> plane;
  plane.reserve(picture.size());
  for (const Vec3d& p : picture) plane.push_back(p.*channel);
  return plane;
}

// Sections 3.1 to 3.3: the picture as the eye resolves it.
Planes perceived(const Planes& ycc, int width, int height, double pixels_per_degree) {
  const auto y = filtered(plane_of(ycc, &Vec3d::x), width, height, kAchromatic, pixels_per_degree);
  const auto cx = filtered(plane_of(ycc, &Vec3d::y), width, height, kRedGreen, pixels_per_degree);
  const auto cz = filtered(plane_of(ycc, &Vec3d::z), width, height, kBlueYellow, pixels_per_degree);
  Planes lab(ycc.size());
  for (std::size_t i = 0; i < lab.size(); ++i) {
    const Vec3d rgb = rgb_of_xyz(xyz_of_ycc({y[i], cx[i], cz[i]}));
    lab[i] = hunt_lab_of({std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0), std::clamp(rgb.z, 0.0, 1.0)});
  }
  return lab;
}

// Section 4: strength of edges and of points in the luminance.
struct Features {
  std::vector<double> edges, points;
};

// Scales the values so that positive ones sum to 1 and negative ones to -1.
void scale_to_sides(std::vector<double>& values) {
  double positive = 0, negative = 0;
  for (const double v : values) (v > 0 ? positive : negative) += v;
  for (double& v : values) v /= v > 0 ? positive : -negative;
}

Features features_of(const Planes& ycc, int width, int height, double pixels_per_degree) {
  const double deviation = 0.5 * 0.082 * pixels_per_degree, v2 = deviation * deviation;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  const auto g = [&](double k) { return std::exp(-k * k / (2 * v2)); };
  std::vector<double> smooth = samples(radius, g), first = samples(radius, [&](double k) { return -k * g(k); }),
                      second = samples(radius, [&](double k) { return (k * k / v2 - 1) * g(k); });
  scale_to_sum_1(smooth);
  scale_to_sides(first);
  scale_to_sides(second);
  std::vector<double> y = plane_of(ycc, &Vec3d::x);
  for (double& v : y) v = (v + 16) / 116;
  const auto strength = [&](const std::vector<double>& kernel) {
    const auto dx = convolved(y, width, height, {kernel, smooth}), dy = convolved(y, width, height, {smooth, kernel});
    std::vector<double> result(y.size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::hypot(dx[i], dy[i]);
    return result;
  };
  return {strength(first), strength(second)};
}

// Section 3.4: large colour differences take the last twentieth of the scale.
double colour_error(Vec3d a, Vec3d b) {
  static const double largest = std::pow(hyab(hunt_lab_of({0, 1, 0}), hunt_lab_of({0, 0, 1})), 0.7);
  constexpr double knee = 0.4, at_knee = 0.95;
  const double error = std::pow(hyab(a, b), 0.7), bend = knee * largest;
  return error < bend ? at_knee / bend * error : at_knee + (error - bend) / (largest - bend) * (1 - at_knee);
}

Planes shown(const Picture& picture, float exposure_stops) {
  Planes ycc;
  ycc.reserve(picture.pixels.size());
  for (const Vec3f& p : picture.pixels) {
    const Vec3f c = tone_map(p, exposure_stops);
    ycc.push_back(ycc_of(static_cast<Vec3d>(Vec3f{srgb_decode(c.x), srgb_decode(c.y), srgb_decode(c.z)})));
  }
  return ycc;
}

}  // namespace

Flip flip(const Picture& picture, const Picture& reference, float exposure_stops, double pixels_per_degree) {
  const int width = reference.width, height = reference.height;
  if (picture.width != width || picture.height != height)
    throw Error("", "the pictures differ in size: " + std::to_string(picture.width) + " x " + std::to_string(picture.height) + " and " +
                        std::to_string(width) + " x " + std::to_string(height));
  const Planes a = shown(picture, exposure_stops), b = shown(reference, exposure_stops);
  const Planes seen_a = perceived(a, width, height, pixels_per_degree), seen_b = perceived(b, width, height, pixels_per_degree);
  const Features of_a = features_of(a, width, height, pixels_per_degree), of_b = features_of(b, width, height, pixels_per_degree);
  Flip result;
  result.error.resize(a.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double feature = std::max(std::fabs(of_a.edges[i] - of_b.edges[i]), std::fabs(of_a.points[i] - of_b.points[i]));
    const double error = std::pow(colour_error(seen_a[i], seen_b[i]), 1 - std::sqrt(std::min(feature / std::numbers::sqrt2, 1.0)));
    result.error[i] = static_cast<float>(std::clamp(error, 0.0, 1.0));
    sum += static_cast<double>(result.error[i]);
  }
  result.mean = a.empty() ? 0 : sum / static_cast<double>(a.size());
  return result;
}

}  // namespace steradian::image
