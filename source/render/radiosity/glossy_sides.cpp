#include "render/radiosity/glossy_sides.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lobes/ggx_energy.h"
#include "steradian/area_light.h"  // luminance

namespace steradian::radiosity {
namespace {

constexpr float kNarrowest = 0.05f;  // alpha: narrower lobes are those of mirrors
constexpr float kForFewRays = 0.18f;
constexpr float kSmall = 0.5f;  // half radius of a cone over the lobe's width, or over that of a lobe seen by few rays

// Half vectors turn by half of the radius of a cone of directions.
float half_radius(float solid_angle) { return 0.5f * std::sqrt(solid_angle / std::numbers::pi_v<float>); }

// A lobe sends as much light of a direction to all views as it would send to a view there of a white sky.
lobes::LobeValue energy_of(float alpha_x, float alpha_y, float cosine) {
  return lobes::ggx_energy(std::sqrt(static_cast<double>(alpha_x * alpha_y)), static_cast<double>(cosine));
}
float ratio(double a, double b) { return b > 0 ? static_cast<float>(a / b) : 1.0f; }

}  // namespace

bool GlossySides::has_lobe(const Surface& surface) { return !surface.material->unlit && weighs(surface.f0 + surface.f90); }

std::uint32_t GlossySides::keep(const Surface& surface, const std::vector<IncidentLight>& incident, Vec3f irradiance, float turn,
                                std::uint32_t besides) {
  const Frame frame = Frame::from_normal_and_tangent(normalized(static_cast<Vec3d>(surface.normal)), static_cast<Vec3d>(surface.tangent));
  Vec3f sum{};
  for (const IncidentLight& light : incident) sum += light.irradiance;
  const double of_places = luminance(static_cast<Vec3d>(sum)), of_all = luminance(static_cast<Vec3d>(irradiance));
  if (!(of_places > 0) || !(of_all > 0)) return kNone;
  const auto scale = static_cast<float>(of_all / of_places);
  const float alpha_x = std::max(std::hypot(surface.alpha_x, turn), kNarrowest);
  const float alpha_y = std::max(std::hypot(surface.alpha_y, turn), kNarrowest);
  const float wider_for_few = std::sqrt(std::max(kForFewRays * kForFewRays - alpha_x * alpha_y, 0.0f));
  const std::size_t first = places_.x.size();
  if (besides != kNone) places_.repeat(lobes_[besides].first, lobes_[besides].count);
  // Adds the light of some places as that of one, a cone of their solid angle.
  const auto add = [&](std::size_t begin, std::size_t end) {
    Vec3f light{}, direction{};
    float solid_angle = 0;
    for (std::size_t i = begin; i < end; ++i) {
      light += incident[i].irradiance;
      direction += incident[i].direction * static_cast<float>(luminance(static_cast<Vec3d>(incident[i].irradiance)));
      solid_angle += incident[i].solid_angle;
    }
    const auto l = static_cast<Vec3f>(frame.to_local(static_cast<Vec3d>(normalized(direction))));
    if (!(l.z > 0)) return;
    const float wider = half_radius(solid_angle);
    const float width_x = std::hypot(alpha_x, wider), width_y = std::hypot(alpha_y, wider);
    const lobes::LobeValue own = energy_of(width_x, width_y, l.z);
    const lobes::LobeValue widened = energy_of(std::hypot(width_x, wider_for_few), std::hypot(width_y, wider_for_few), l.z);
    places_.add(l, light * (scale / l.z), width_x, width_y, ratio(own.plain, widened.plain), ratio(own.fresnel, widened.fresnel));
  };
  const float widest = kSmall * std::max(std::min(alpha_x, alpha_y), kForFewRays);
  for (std::size_t begin = 0, end; begin < incident.size(); begin = end) {
    float solid_angle = incident[begin].solid_angle;
    for (end = begin + 1; end < incident.size() && incident[end].light == incident[begin].light; ++end) {
      solid_angle += incident[end].solid_angle;
      if (half_radius(solid_angle) > widest || length(incident[end].direction - incident[begin].direction) > 4 * widest) break;
    }
    add(begin, end);
  }
  while ((places_.x.size() - first) % GlossyPlaces::kStep != 0) places_.add({0, 0, 1}, {}, 1, 1, 1, 1);
  lobes_.push_back({static_cast<Vec3f>(frame.x), static_cast<Vec3f>(frame.y), static_cast<Vec3f>(frame.z), surface.f0, surface.f90, first,
                    places_.x.size() - first, wider_for_few});
  return static_cast<std::uint32_t>(lobes_.size() - 1);
}

Vec3f GlossySides::sent(const KeptLobe& lobe, Vec3f to, float wider, bool keeps_energy) const {
  const Vec3f v = {dot(lobe.x, to), dot(lobe.y, to), dot(lobe.z, to)};
  if (!(v.z > 0)) return {};
  const GlossyTable::Sent sent = packs_->sent(places_, lobe.first, lobe.count, v, wider, keeps_energy);
  return lobe.f0 * (sent.all - sent.grazing) + lobe.f90 * sent.grazing;
}

}  // namespace steradian::radiosity
