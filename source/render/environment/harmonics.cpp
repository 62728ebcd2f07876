#include "render/environment/harmonics.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "steradian/area_light.h"  // luminance

namespace steradian::environment {
namespace {

constexpr int kDegree = HarmonicIrradiance::kDegree;
// Columns of the map that the integrals use. An average over 1/256 of the circle changes a coefficient of degree l by (l / 256 * 2 pi)^2 /
// 24, against whole texels. That is 0.16 % at l = 8, whose fraction of the irradiance is under 1 %.
constexpr int kColumns = 256;
constexpr int kNormals = 256;  // a Fibonacci lattice on the sphere, for the residual

// sqrt((2l + 1) / (4 pi) (l - m)! / (l + m)!), with sqrt 2 for m > 0.
struct Norms {
  double of[kDegree + 1][kDegree + 1] = {};
  Norms() {
    for (int l = 0; l <= kDegree; ++l)
      for (int m = 0; m <= l; ++m) {
        double ratio = 1;
        for (int k = l - m + 1; k <= l + m; ++k) ratio /= k;
        of[l][m] = std::sqrt((2 * l + 1) / (4 * std::numbers::pi) * ratio * (m > 0 ? 2 : 1));
      }
  }
};

}  // namespace

std::array<double, 81> harmonics_at(Vec3d d) {
  static const Norms norms;
  std::array<double, 81> values;
  const auto put = [&](int l, int m, double legendre, double cosine, double sine) {
    const double value = norms.of[l][m] * legendre;
    const auto middle = static_cast<std::size_t>(l * l + l), offset = static_cast<std::size_t>(m);
    values[middle + offset] = value * cosine;
    if (m > 0) values[middle - offset] = value * sine;
  };
  // cosine, sine: those of m phi, times sin(theta)^m. diagonal: Legendre's P(m, m) over that power.
  double cosine = 1, sine = 0, diagonal = 1;
  for (int m = 0; m <= kDegree; ++m) {
    double before = diagonal, at = d.y * (2 * m + 1) * diagonal;
    put(m, m, before, cosine, sine);
    if (m < kDegree) put(m + 1, m, at, cosine, sine);
    for (int l = m + 2; l <= kDegree; ++l) {
      const double next = ((2 * l - 1) * d.y * at - (l + m - 1) * before) / (l - m);
      put(l, m, next, cosine, sine);
      before = at;
      at = next;
    }
    diagonal *= 2 * m + 1;
    const double turned = cosine * d.x - sine * d.z;
    sine = cosine * d.z + sine * d.x;
    cosine = turned;
  }
  return values;
}

double cosine_coefficient(int degree) {
  if (degree == 1) return 2 * std::numbers::pi / 3;
  if (degree % 2 == 1) return 0;
  double binomial = 1;  // binomial coefficient (degree, degree / 2) over 2^degree
  for (int k = 1; k <= degree / 2; ++k) binomial *= (degree / 2.0 + k) / k / 4;
  const double sign = degree % 4 == 2 ? 1 : -1;
  return degree == 0 ? std::numbers::pi : sign * 2 * std::numbers::pi / ((degree + 2.0) * (degree - 1.0)) * binomial;
}

HarmonicIrradiance::HarmonicIrradiance(const DirectionGrid& whole) {
  const DirectionGrid grid = DirectionGrid::repeated(DirectionGrid::averaged(whole.map, kColumns), kColumns);
  std::vector<Vec3d> centers;
  std::vector<double> luminances;
  for (int j = 0; j < grid.map.height; ++j)
    for (int i = 0; i < grid.map.width; ++i) {
      const Vec3d center = grid.center(i, j);
      centers.push_back(center);
      luminances.push_back(luminance(static_cast<Vec3d>(grid.map.at(i, j))));
      const std::array<double, 81> y = harmonics_at(center);
      const Vec3d radiance = static_cast<Vec3d>(grid.map.at(i, j)) * grid.solid_angle(j);
      for (std::size_t k = 0; k < y.size(); ++k) coefficients_[k] += radiance * y[k];
    }

  for (int l = 0; l <= kDegree; ++l)
    for (int k = l * l; k < (l + 1) * (l + 1); ++k) coefficients_[static_cast<std::size_t>(k)] *= cosine_coefficient(l);

  double squares = 0, mean = 0;
  for (int i = 0; i < kNormals; ++i) {
    const Vec3d normal = direction_of(
        {i * 0.61803398874989485 - std::floor(i * 0.61803398874989485), std::acos(1 - (2 * i + 1.0) / kNormals) / std::numbers::pi});
    double exact = 0;
    for (int j = 0; j < grid.map.height; ++j) {
      double row = 0;
      for (int k = 0; k < grid.map.width; ++k) {
        const double cosine = dot(normal, centers[static_cast<std::size_t>(j * grid.map.width + k)]);
        if (cosine > 0) row += cosine * luminances[static_cast<std::size_t>(j * grid.map.width + k)];
      }
      exact += row * grid.solid_angle(j);
    }
    const double difference = luminance(sum_at(normal)) - exact;
    squares += difference * difference / kNormals;
    mean += exact / kNormals;
  }
  residual_ = mean > 0 ? std::sqrt(squares) / mean : 0;
}

Vec3d HarmonicIrradiance::sum_at(Vec3d normal) const {
  const std::array<double, 81> y = harmonics_at(normal);
  Vec3d sum{};
  for (std::size_t k = 0; k < y.size(); ++k) sum += coefficients_[k] * y[k];
  return sum;
}

Vec3d HarmonicIrradiance::at(Vec3d normal) const {
  const Vec3d sum = sum_at(normal);
  return {std::max(sum.x, 0.0), std::max(sum.y, 0.0), std::max(sum.z, 0.0)};
}

}  // namespace steradian::environment
