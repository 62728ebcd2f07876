// Monte Carlo with two strategies, the light and the lobe, weighted by the balance heuristic.
#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "lobes/lobe.h"
#include "reference/azimuth_sampler.h"
#include "reference/sampled.h"
#include "reference/spherical_region.h"
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

  Random random(options.seed);
  const auto contribution = [&](Vec3d l, double light_pdf) -> lobes::LobeValue {
    const double pdf = light_pdf + lobe.pdf(l);
    if (!(light_pdf > 0) || !(pdf > 0) || (sees != nullptr && !(*sees)(frame.to_world(l)))) return {};
    const double emitted = options.emission ? options.emission(frame.to_world(l)) : 1;
    return lobe.evaluate(l) * (emitted / pdf);
  };
  Statistics statistics;
  for (int i = 0; i < options.spp; ++i) {
    const double u0 = random.uniform(), v0 = random.uniform(), u1 = random.uniform(), v1 = random.uniform();
    const Vec3d to_light = sampler.sample(u0, v0), by_lobe = lobe.sample(u1, v1);
    lobes::LobeValue sum = contribution(to_light, sampler.pdf_within(to_light));
    if (!(by_lobe == Vec3d{})) sum += contribution(by_lobe, sampler.pdf(by_lobe));
    statistics.add(lobe.radiance(sum) * light.radiance);
  }
  return {statistics.mean(), statistics.standard_error()};
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

}  // namespace steradian
