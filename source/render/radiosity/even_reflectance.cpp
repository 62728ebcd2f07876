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

// Fractions of even light that a GGX lobe reflects with F = 1, and with F = (1 - v.h)^5.
struct GgxFractions {
  float all, grazing;
};

// The same by linear steps of the roughness.
GgxFractions ggx_fractions(float alpha_x, float alpha_y) {
  constexpr int kSteps = 32;
  static const std::array<GgxFractions, kSteps + 1> table = [] {
    std::array<GgxFractions, kSteps + 1> t;
    for (int k = 0; k <= kSteps; ++k) {
      const double roughness = static_cast<double>(k) / kSteps;
      GgxFractions& f = t[static_cast<std::size_t>(k)];
      const double alpha = std::max(roughness * roughness, 1e-3);
      f.all = static_cast<float>(mean_over_views([&](double cosine) { return lobes::ggx_energy(alpha, cosine).plain; }));
      f.grazing = static_cast<float>(mean_over_views([&](double cosine) { return lobes::ggx_energy(alpha, cosine).fresnel; }));
    }
    return t;
  }();
  const float place = std::clamp(std::sqrt(std::sqrt(alpha_x * alpha_y)), 0.0f, 1.0f) * kSteps;
  const auto first = std::min(static_cast<std::size_t>(place), std::size_t{kSteps - 1});
  const float after = place - static_cast<float>(first);
  const GgxFractions a = table[first], b = table[first + 1];
  return {a.all + (b.all - a.all) * after, a.grazing + (b.grazing - a.grazing) * after};
}

Vec3f reflected(Vec3f f0, Vec3f f90, GgxFractions by) { return f0 * (by.all - by.grazing) + f90 * by.grazing; }

Vec3f within_one(Vec3f c) { return {std::clamp(c.x, 0.0f, 1.0f), std::clamp(c.y, 0.0f, 1.0f), std::clamp(c.z, 0.0f, 1.0f)}; }

}  // namespace

Vec3f EvenReflectance::glossy_share() const {
  const auto ratio = [](float a, float b) { return b > 0 ? std::min(a / b, 1.0f) : 0; };
  return {ratio(glossy.x, all.x), ratio(glossy.y, all.y), ratio(glossy.z, all.z)};
}

EvenReflectance even_reflectance(const Surface& s) {
  if (s.material->unlit) return {};
  Vec3f glossy{};
  if (weighs(s.f0 + s.f90)) glossy = reflected(s.f0, s.f90, ggx_fractions(s.alpha_x, s.alpha_y));
  Vec3f others = s.albedo * (1 - s.fresnel_loss * lost_to_boundary());
  if (s.coat > 0) others += reflected({kCoatF0, kCoatF0, kCoatF0}, {1, 1, 1}, ggx_fractions(s.coat_alpha, s.coat_alpha)) * s.coat;
  if (weighs(s.sheen)) {
    const auto alpha = static_cast<double>(s.sheen_alpha);
    others += s.sheen * static_cast<float>(mean_over_views([&](double cosine) { return charlie_albedo(alpha, cosine); }));
  }
  return {within_one(others + glossy), within_one(glossy)};
}

}  // namespace steradian::radiosity
