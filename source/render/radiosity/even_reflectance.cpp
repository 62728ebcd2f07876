#include "render/radiosity/even_reflectance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lobes/ggx_energy.h"
#include "render/environment/environment_light.h"  // mean_grazing
#include "steradian/albedo.h"

namespace steradian::radiosity {
namespace {

// Mean of of(cosine of the view) over even light: 2 INT of cos dcos by midpoints.
constexpr int kViews = 16;
template <class Of>
double mean_over_views(Of of) {
  double sum = 0;
  for (int i = 0; i < kViews; ++i) {
    const double cosine = (i + 0.5) / kViews;
    sum += 2 * cosine / kViews * of(cosine);
  }
  return sum;
}

// Fraction of even light that a diffuse surface loses to a boundary above it that reflects Schlick's (1 - v.h)^5.
float lost_to_boundary() {
  static const auto lost = static_cast<float>(mean_over_views(environment::mean_grazing));
  return lost;
}

// The fraction of even light that a GGX lobe reflects, by linear steps of its roughness.
Vec3f reflected_by_ggx(float alpha_x, float alpha_y, Vec3f f0, Vec3f f90) {
  constexpr int kSteps = 32;
  static const std::array<lobes::LobeValue, kSteps + 1> table = [] {
    std::array<lobes::LobeValue, kSteps + 1> t;
    for (int k = 0; k <= kSteps; ++k) {
      const double roughness = static_cast<double>(k) / kSteps, alpha = std::max(roughness * roughness, 1e-3);
      t[static_cast<std::size_t>(k)] = {mean_over_views([&](double cosine) { return lobes::ggx_energy(alpha, cosine).plain; }),
                                        mean_over_views([&](double cosine) { return lobes::ggx_energy(alpha, cosine).fresnel; })};
    }
    return t;
  }();
  const double place = std::clamp(std::sqrt(std::sqrt(static_cast<double>(alpha_x * alpha_y))), 0.0, 1.0) * kSteps;
  const auto first = std::min(static_cast<std::size_t>(place), std::size_t{kSteps - 1});
  const double after = place - static_cast<double>(first);
  const lobes::LobeValue mean = table[first] * (1 - after) + table[first + 1] * after;
  return static_cast<Vec3f>(lobes::coloured(mean, static_cast<Vec3d>(f0), static_cast<Vec3d>(f90)));
}

Vec3f within_one(Vec3f c) { return {std::clamp(c.x, 0.0f, 1.0f), std::clamp(c.y, 0.0f, 1.0f), std::clamp(c.z, 0.0f, 1.0f)}; }

}  // namespace

Vec3f EvenReflectance::glossy_share() const {
  const auto ratio = [](float a, float b) { return b > 0 ? std::min(a / b, 1.0f) : 0; };
  return {ratio(glossy.x, all.x), ratio(glossy.y, all.y), ratio(glossy.z, all.z)};
}

EvenReflectance even_reflectance(const Surface& s) {
  if (s.material->unlit) return {};
  Vec3f glossy{};
  if (weighs(s.f0 + s.f90)) glossy = reflected_by_ggx(s.alpha_x, s.alpha_y, s.f0, s.f90);
  Vec3f others = s.albedo * (1 - s.fresnel_loss * lost_to_boundary());
  if (s.coat > 0) others += reflected_by_ggx(s.coat_alpha, s.coat_alpha, {kCoatF0, kCoatF0, kCoatF0}, {1, 1, 1}) * s.coat;
  if (weighs(s.sheen)) {
    const auto alpha = static_cast<double>(s.sheen_alpha);
    others += s.sheen * static_cast<float>(mean_over_views([&](double cosine) { return charlie_albedo(alpha, cosine); }));
  }
  return {within_one(others + glossy), within_one(glossy)};
}

}  // namespace steradian::radiosity
