// Monte Carlo with two strategies, the light and the lobe, weighted by the balance heuristic.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "lobes/lobe.h"
#include "reference/azimuth_sampler.h"
#include "reference/balanced_mean.h"
#include "reference/sampled.h"
#include "reference/spherical_region.h"
#include "reference/surface_sampler.h"
#include "steradian/reference.h"

namespace steradian {
namespace {

using Sees = std::function<bool(Vec3d)>;

// A sampled direction in the shading frame, the density of the light there, and its radiance over the light's. Density 0: no light.
struct Incident {
  Vec3d direction;
  double density = 0, emitted = 1;
  bool occluded = false;
};

// The standard error of the largest channel.
double standard_error_of(Vec3d mean, Vec3d variance) {
  double largest = std::fabs(mean.x), of_it = variance.x;
  if (std::fabs(mean.y) > largest) largest = std::fabs(mean.y), of_it = variance.y;
  if (std::fabs(mean.z) > largest) of_it = variance.z;
  return std::sqrt(of_it);
}

// from_light(u, v) samples the light; in(direction) looks in a direction of the lobe.
template <class FromLight, class In>
SampledResult by_both(const lobes::Lobe& lobe, Vec3d radiance, const SampledOptions& options, FromLight from_light, In in) {
  reference::Random random(options.seed);
  reference::BalancedMean statistics(2);
  bool seen = false;
  double occluded_squares = 0;  // of the largest channel of what samples would add if nothing occluded them
  const auto add = [&](const Incident& to) {
    const std::array densities = {to.density, to.density > 0 ? lobe.pdf(to.direction) : 0.0};
    const double pdf = densities[0] + densities[1];
    if (!(to.density > 0) || !(pdf > 0)) return;
    const Vec3d value = lobe.radiance(lobe.evaluate(to.direction) * (to.emitted / pdf)) * radiance;
    if (to.occluded) {
      const double largest = std::max({value.x, value.y, value.z});
      occluded_squares += largest * largest;
    } else {
      seen = true;
      statistics.add(value, densities);
    }
  };
  for (int i = 0; i < options.spp; ++i) {
    const double u0 = random.uniform(), v0 = random.uniform(), u1 = random.uniform(), v1 = random.uniform();
    const Incident to_light = from_light(u0, v0);
    const Vec3d by_lobe = lobe.sample(u1, v1);
    add(to_light);
    if (!(by_lobe == Vec3d{})) add(in(by_lobe));
    statistics.end_round();
  }
  if (seen) return {statistics.mean(), standard_error_of(statistics.mean(), statistics.larger_variance())};
  // All samples are occluded. One more pair may see the light, and would then be the only one of its mean.
  return {{}, std::sqrt(occluded_squares / options.spp) / (options.spp + 1.0)};
}

SampledResult estimate(const Sees* sees, const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                       const SampledOptions& options) {
  using namespace reference;
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  const lobes::Lobe lobe(lobes::in_frame(material, frame), frame.to_local(at.view));
  if (!lobe.above_surface()) return {};
  SphericalRegion region;
  region.assign_above_horizon(light, at.position, frame);
  AzimuthSampler sampler;
  // For Lambert the projected solid angle is the integrand. Phong has no foreshortening: uniform directions suit any lobe.
  sampler.prepare(region, material.brdf == Brdf::lambert ? SphericalMeasure::projected_solid_angle : SphericalMeasure::solid_angle);
  if (!(sampler.measure() > 0)) return {};

  const auto incident = [&](Vec3d l, double density) -> Incident {
    if (!(density > 0)) return {};
    const Vec3d to = frame.to_world(l);
    return {l, density, options.emission ? options.emission(to) : 1, sees != nullptr && !(*sees)(to)};
  };
  return by_both(
      lobe, light.radiance, options,
      [&](double u, double v) {
        const Vec3d l = sampler.sample(u, v);
        return incident(l, sampler.pdf_within(l));
      },
      [&](Vec3d l) { return incident(l, sampler.pdf(l)); });
}

}  // namespace

SampledResult sampled_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                               const SampledOptions& options) {
  return estimate(nullptr, light, at, material, options);
}

SampledResult reference::sampled_radiance_past(const std::function<bool(Vec3d)>& sees, const PreparedPolygon& light, const ShadingPoint& at,
                                               const Material& material, const SampledOptions& options) {
  return estimate(&sees, light, at, material, options);
}

SampledResult reference::sampled_on_surface(const std::function<bool(Vec3d)>& open, const AreaLight& light, const ShadingPoint& at,
                                            const Material& material, const SampledOptions& options) {
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  const lobes::Lobe lobe(lobes::in_frame(material, frame), frame.to_local(at.view));
  if (!lobe.above_surface()) return {};
  const SurfaceSampler sampler(light, at.position);
  const auto incident = [&](const SurfaceSampler::Place& place) -> Incident {
    const Vec3d l = frame.to_local(place.direction);
    if (!(place.density > 0) || !(l.z > 0)) return {};
    return {l, place.density, options.emission ? options.emission(place.direction) : 1, !open(place.direction * place.distance)};
  };
  return by_both(
      lobe, light.radiance, options, [&](double u, double v) { return incident(sampler.sample(u, v)); },
      [&](Vec3d l) { return incident(sampler.towards(frame.to_world(l))); });
}

}  // namespace steradian
