// Monte Carlo with two strategies, the light and the lobe, weighted by the balance heuristic.
#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "lobes/lobe.h"
#include "reference/azimuth_sampler.h"
#include "reference/sampled.h"
#include "reference/spherical_region.h"
#include "reference/surface_sampler.h"
#include "steradian/reference.h"

namespace steradian {
namespace {

// Mean and variance in one pass. Source: Welford 1962.
class Statistics {
 public:
  void add(Vec3d x) {
    ++count_;
    const Vec3d delta = x - mean_;
    mean_ += delta / static_cast<double>(count_);
    squares_ += delta * (x - mean_);
  }
  Vec3d mean() const { return mean_; }
  // Standard error of the mean of the largest channel.
  double standard_error() const {
    if (count_ < 2) return 0;
    double squares = squares_.x, largest = std::fabs(mean_.x);
    if (std::fabs(mean_.y) > largest) squares = squares_.y, largest = std::fabs(mean_.y);
    if (std::fabs(mean_.z) > largest) squares = squares_.z;
    const auto n = static_cast<double>(count_);
    return std::sqrt(squares / (n * (n - 1)));
  }

 private:
  int count_ = 0;
  Vec3d mean_, squares_;
};

using Sees = std::function<bool(Vec3d)>;

// A sampled direction in the shading frame, the density of the light there, and its radiance over the light's. Density 0: no light.
struct Incident {
  Vec3d direction;
  double density = 0, emitted = 1;
};

// from_light(u, v) samples the light; in(direction) looks in a direction of the lobe.
template <class FromLight, class In>
SampledResult by_both(const lobes::Lobe& lobe, Vec3d radiance, const SampledOptions& options, FromLight from_light, In in) {
  reference::Random random(options.seed);
  const auto contribution = [&](const Incident& to) -> lobes::LobeValue {
    const double pdf = to.density + lobe.pdf(to.direction);
    if (!(to.density > 0) || !(pdf > 0)) return {};
    return lobe.evaluate(to.direction) * (to.emitted / pdf);
  };
  Statistics statistics;
  for (int i = 0; i < options.spp; ++i) {
    const double u0 = random.uniform(), v0 = random.uniform(), u1 = random.uniform(), v1 = random.uniform();
    const Incident to_light = from_light(u0, v0);
    const Vec3d by_lobe = lobe.sample(u1, v1);
    lobes::LobeValue sum = contribution(to_light);
    if (!(by_lobe == Vec3d{})) sum += contribution(in(by_lobe));
    statistics.add(lobe.radiance(sum) * radiance);
  }
  return {statistics.mean(), statistics.standard_error()};
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
    if (!(density > 0) || (sees != nullptr && !(*sees)(frame.to_world(l)))) return {};
    return {l, density, options.emission ? options.emission(frame.to_world(l)) : 1};
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
    if (!(place.density > 0) || !(l.z > 0) || !open(place.direction * place.distance)) return {};
    return {l, place.density, options.emission ? options.emission(place.direction) : 1};
  };
  return by_both(
      lobe, light.radiance, options, [&](double u, double v) { return incident(sampler.sample(u, v)); },
      [&](Vec3d l) { return incident(sampler.towards(frame.to_world(l))); });
}

}  // namespace steradian
