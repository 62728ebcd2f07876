#include "render/radiosity/glossy_sides.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lobes/lobe_parts.h"
#include "steradian/area_light.h"  // luminance

namespace steradian::radiosity {
namespace {

constexpr float kLeastWidth = 0.1f;  // alpha: few rays would meet the light of a narrower lobe

Kernels<float>::vec3 in_kernel(Vec3f v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }

}  // namespace

bool GlossySides::has_lobe(const Surface& surface) { return !surface.material->unlit && weighs(surface.f0 + surface.f90); }

bool GlossySides::keep(std::uint32_t side, const Surface& surface, const std::vector<IncidentLight>& incident, Vec3f irradiance,
                       float turn) {
  const Frame frame =
      Frame::from_normal_and_tangent(normalized(static_cast<Vec3d>(surface.normal)), static_cast<Vec3d>(surface.tangent));
  Vec3f sum{};
  for (const IncidentLight& light : incident) sum += light.irradiance;
  const double of_places = luminance(static_cast<Vec3d>(sum)), of_all = luminance(static_cast<Vec3d>(irradiance));
  if (!(of_places > 0) || !(of_all > 0)) return false;
  const auto scale = static_cast<float>(of_all / of_places);
  KeptLobe lobe{static_cast<Vec3f>(frame.x),
                static_cast<Vec3f>(frame.y),
                static_cast<Vec3f>(frame.z),
                surface.f0,
                surface.f90,
                std::max(std::hypot(surface.alpha_x, turn), kLeastWidth),
                std::max(std::hypot(surface.alpha_y, turn), kLeastWidth),
                static_cast<std::uint32_t>(places_.size()),
                0};
  for (const IncidentLight& light : incident) {
    const auto l = static_cast<Vec3f>(frame.to_local(static_cast<Vec3d>(light.direction)));
    if (!(l.z > 0)) continue;
    // A cone of that solid angle; half vectors turn by half of its radius.
    const float widening = light.solid_angle / std::numbers::pi_v<float> / 4;
    places_.push_back({l, light.irradiance * (scale / l.z), widening});
  }
  lobe.count = static_cast<std::uint32_t>(places_.size()) - lobe.first;
  of_side_[side] = static_cast<std::uint32_t>(lobes_.size());
  lobes_.push_back(lobe);
  return true;
}

Vec3f GlossySides::sent(const KeptLobe& lobe, Vec3f to) const {
  const Vec3f v = {dot(lobe.x, to), dot(lobe.y, to), dot(lobe.z, to)};
  if (!(v.z > 0)) return {};
  Kernels<float> k;
  const auto view = in_kernel(v);
  Vec3f sum{};
  for (std::uint32_t i = lobe.first; i < lobe.first + lobe.count; ++i) {
    const Place& place = places_[i];
    const auto l = in_kernel(place.direction), h = k.microfacet_half_vector(l, view);
    const float ax = std::sqrt(lobe.alpha_x * lobe.alpha_x + place.widening), ay = std::sqrt(lobe.alpha_y * lobe.alpha_y + place.widening);
    const auto shape = k.ggx_lobe(l, view, ax, ay);
    const float grazing = k.fresnel_schlick(0.0f, 1.0f, dot(view, h)).v;
    sum += place.light * (lobe.f0 * (1 - grazing) + lobe.f90 * grazing) * shape.v;
  }
  return sum;
}

}  // namespace steradian::radiosity
