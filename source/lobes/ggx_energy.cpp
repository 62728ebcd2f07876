#include "lobes/ggx_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/lattices.h"
#include "lobes/visible_facets.h"

namespace steradian::lobes {
namespace {

constexpr std::size_t kCells = 48;     // between the nodes, for each of the two coordinates
constexpr std::size_t kFacets = 2048;  // of a node
constexpr double kLeastCosine = 1e-3;  // of a view

// Values by the cube root of alpha and the square root of the cosine.
using Table = std::array<std::array<LobeValue, kCells + 1>, kCells + 1>;

Table made_table() {
  std::vector<Vec2f> half_disc;  // the lobe is even across the plane of the view
  for (std::size_t i = 0; i < kFacets; ++i) {
    const auto [u, v] = fibonacci_place(i, kFacets, 0);
    const double r = std::sqrt(u), angle = std::numbers::pi * v;
    half_disc.push_back({static_cast<float>(r * std::sin(angle)), static_cast<float>(r * std::cos(angle))});
  }
  Table table;
  for (std::size_t i = 0; i <= kCells; ++i)
    for (std::size_t j = 0; j <= kCells; ++j) {
      const double x = static_cast<double>(i) / kCells, y = static_cast<double>(j) / kCells;
      const double cosine = std::max(y * y, kLeastCosine);
      LobeValue& value = table[i][j];
      if (i == 0) {  // a mirror
        value = {1, std::pow(1 - cosine, 5)};
        continue;
      }
      const Vec3f view{static_cast<float>(std::sqrt(1 - cosine * cosine)), 0, static_cast<float>(cosine)};
      const auto alpha = static_cast<float>(x * x * x);
      each_visible_facet(
          view, alpha, alpha, kFacets, [&](std::size_t k) { return half_disc[k]; },
          [&](const FacetDirection& d) {
            const auto weight = static_cast<double>(d.weight) / kFacets;
            value += {weight, weight * static_cast<double>(d.grazing)};
          });
    }
  return table;
}

}  // namespace

LobeValue ggx_energy(double alpha, double cosine) {
  static const Table table = made_table();
  const auto place = [](double t) {
    const double at = std::clamp(t, 0.0, 1.0) * kCells;
    const std::size_t cell = std::min(static_cast<std::size_t>(at), kCells - 1);
    return std::pair{cell, at - static_cast<double>(cell)};
  };
  const auto [i, x] = place(std::cbrt(alpha));
  const auto [j, y] = place(std::sqrt(std::max(cosine, 0.0)));
  const auto row = [&, j = j, y = y](std::size_t k) { return table[k][j] * (1 - y) + table[k][j + 1] * y; };
  return row(i) * (1 - x) + row(i + 1) * x;
}

std::optional<Vec3d> known_albedo(const Material& m, double cosine) {
  if (m.brdf != Brdf::ggx || m.alpha_x != m.alpha_y || !m.shadowing || m.multiple_scattering || m.fitted != nullptr) return {};
  return coloured(ggx_energy(m.alpha_x, cosine), m.f0, m.f90);
}

}  // namespace steradian::lobes
