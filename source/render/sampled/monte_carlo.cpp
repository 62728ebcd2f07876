#include "render/sampled/monte_carlo.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lobes/lobe.h"
#include "reference/azimuth_sampler.h"
#include "reference/spherical_region.h"
#include "shadow/edges/segments.h"
#include "shadow/region/light_frame.h"
#include "shapes/polygon.h"
#include "shapes/punctual.h"
#include "steradian/capsule_light.h"

namespace steradian {
namespace {

using lobes::Lobe;
using reference::AzimuthSampler;

// Running mean of samples, and its variance.
//
// Source: Welford 1962.
class RunningMean {
 public:
  void add(Vec3d x) {
    const Vec3d delta = x - mean_;
    mean_ += delta / static_cast<double>(++count_);
    squares_ += delta * (x - mean_);
  }
  Estimate estimate() const {
    const auto n = static_cast<double>(count_);
    return {mean_, count_ > 1 ? squares_ / (n * (n - 1)) : Vec3d{}};
  }

 private:
  Vec3d mean_{}, squares_{};
  int count_ = 0;
};

// Sum over the lobes: radiance per unit of incident radiance.
Vec3d evaluate(const std::vector<Lobe>& lobes, Vec3d l) {
  Vec3d sum{};
  for (const Lobe& lobe : lobes) sum += lobe.radiance(lobe.evaluate(l));
  return sum;
}

}  // namespace

struct DirectSampler::Light {
  const AreaLight* area;
  std::optional<PreparedPolygon> flat;  // empty for a sphere or capsule, whose outline depends on the point
};

struct DirectSampler::Scratch {
  reference::SphericalRegion region;
  AzimuthSampler sampler;
  std::vector<Lobe> lobes;
};

DirectSampler::DirectSampler(const Scene& scene, const RayScene* shadows, const environment::EnvironmentSampler* around,
                             Terminator terminator)
    : scene_(scene), shadows_(shadows), around_(around), terminator_(terminator), scratch_(std::make_unique<Scratch>()) {
  for (const AreaLight& area : scene.area_lights) {
    Light light{&area, std::nullopt};
    if (area.is_flat()) {
      light.flat = prepare_polygon(flat_polygon(area));
      if (light.flat->vertices.empty()) continue;
    }
    lights_.push_back(std::move(light));
  }
}

DirectSampler::~DirectSampler() = default;

Estimate DirectSampler::estimate(const Surface& surface, Vec3f view, LobeChoice choice, int spp, reference::Random& random) {
  std::vector<SurfaceLobe> rest = lobes_of(surface);
  if (choice == LobeChoice::specular) std::erase_if(rest, [](const SurfaceLobe& l) { return l.diffuse; });
  Estimate sum;
  while (!rest.empty()) {  // lobes about one normal share their samples; a coat may have a normal of its own
    const Vec3f normal = rest.front().normal;
    const Frame frame = Frame::from_normal_and_tangent(normalized(static_cast<Vec3d>(normal)), static_cast<Vec3d>(surface.tangent));
    const Vec3d v = normalized(frame.to_local(static_cast<Vec3d>(view)));
    scratch_->lobes.clear();
    std::erase_if(rest, [&](const SurfaceLobe& l) {
      if (!(l.normal == normal)) return false;
      const Lobe lobe(lobes::in_frame(l.material, frame), v);
      if (lobe.above_surface()) scratch_->lobes.push_back(lobe);
      return true;
    });
    if (scratch_->lobes.empty()) continue;
    sum += estimate_in(frame, surface, spp, random);
  }
  return sum;
}

// Estimates the environment as an area light: by the map's density and those of scratch_->lobes, with the balance heuristic.
Estimate DirectSampler::estimate_environment(const Frame& frame, Vec3d p, Vec3d geometric, int spp, reference::Random& random) const {
  const std::vector<Lobe>& lobes = scratch_->lobes;
  const auto contribution = [&](Vec3d l, Vec3d direction) -> Vec3d {
    if (!(l.z > 0)) return {};
    double pdf = around_->pdf(direction);
    for (const Lobe& lobe : lobes) pdf += lobe.pdf(l);
    if (!(pdf > 0) || (shadows_ != nullptr && (!above(geometric, direction) || shadows_->blocked_towards(p, direction)))) return {};
    return evaluate(lobes, l) * around_->radiance(direction) / pdf;
  };
  RunningMean mean;
  for (int i = 0; i < spp; ++i) {
    const double u = random.uniform(), v = random.uniform();
    const Vec3d from_map = around_->sample(u, v);
    Vec3d x = contribution(frame.to_local(from_map), from_map);
    for (const Lobe& lobe : lobes) {
      const double a = random.uniform(), b = random.uniform();
      const Vec3d by_lobe = lobe.sample(a, b);
      x += contribution(by_lobe, frame.to_world(by_lobe));
    }
    mean.add(x);
  }
  return mean.estimate();
}

Estimate DirectSampler::estimate_in(const Frame& frame, const Surface& surface, int spp, reference::Random& random) {
  Scratch& scratch = *scratch_;
  const std::vector<Lobe>& lobes = scratch.lobes;
  // With shadows, the point is where closed forms look from (shadow::Viewpoint): off the triangle, and never below it.
  const auto geometric = static_cast<Vec3d>(surface.geometric_normal);
  auto p = static_cast<Vec3d>(surface.position);
  if (shadows_ != nullptr) p += geometric * shadow::offset_from_surface(p);
  Estimate result;

  for (const PunctualLight& light : scene_.punctual_lights) {
    const auto incident = shapes::incident<double>(packed::prepare(light), shapes::to_kernel<double>(p));
    const Vec3d to = {incident.direction.x.v, incident.direction.y.v, incident.direction.z.v}, l = frame.to_local(to);
    if (l.z <= 0) continue;
    if (shadows_ != nullptr) {
      if (!above(geometric, to)) continue;
      if (light.kind == PunctualKind::directional ? shadows_->blocked_towards(p, to) : shadows_->between(p, light.position, Casters::all))
        continue;
    }
    result.mean += light.intensity * incident.irradiance.v * evaluate(lobes, l);
  }

  for (const Light& light : lights_) {
    PreparedPolygon outline;
    if (!light.flat) {
      const PolygonLight seen = polygon_seen_from(*light.area, p);
      if (seen.vertices.empty()) continue;
      outline = prepare_polygon(seen);
    }
    const PreparedPolygon& polygon = light.flat ? *light.flat : outline;
    if (polygon.vertices.empty()) continue;
    scratch.region.assign_above_horizon(polygon, p, frame);
    AzimuthSampler& sampler = scratch.sampler;
    sampler.prepare(scratch.region, reference::SphericalMeasure::solid_angle);
    if (!(sampler.measure() > 0)) continue;

    const double plane_height = dot(polygon.centroid - p, polygon.normal), eta = shadow::margin_of_plane(polygon);
    const auto* capsule = std::get_if<Capsule>(&light.area->shape);
    const LightTexture* texture = light.area->texture ? &*light.area->texture : nullptr;
    const LightEmission* emission = light.area->emission ? &*light.area->emission : nullptr;
    // Radiance that arrives from the light's point in direction l.
    const auto incident = [&](Vec3d l) -> Vec3d {
      if (shadows_ == nullptr && texture == nullptr && emission == nullptr) return polygon.radiance;
      const Vec3d direction = frame.to_world(l);
      // A tube is too long to be represented by one plane.
      const double distance = capsule != nullptr ? distance_along(*capsule, p, direction) : plane_height / dot(direction, polygon.normal);
      const Vec3d there = p + direction * distance;
      if (shadows_ != nullptr) {
        if (!above(geometric, direction)) return {};
        const double height = std::fabs(capsule != nullptr ? distance : plane_height);
        if (shadows_->between(p, p + (there - p) * std::max(1 - eta / height, 0.0), Casters::all)) return {};
      }
      if (emission != nullptr) return emitted_radiance(*emission, -direction);
      return texture != nullptr ? texture_radiance(*texture, scene_.images, there) : polygon.radiance;
    };
    const auto contribution = [&](Vec3d l, double light_pdf) -> Vec3d {
      double pdf = light_pdf;
      for (const Lobe& lobe : lobes) pdf += lobe.pdf(l);
      if (!(light_pdf > 0) || !(pdf > 0)) return {};
      const Vec3d f = evaluate(lobes, l) * (1 / pdf);
      return f.x > 0 || f.y > 0 || f.z > 0 ? f * incident(l) : Vec3d{};
    };

    RunningMean mean;
    for (int i = 0; i < spp; ++i) {
      const double u = random.uniform(), w = random.uniform();
      const Vec3d to_light = sampler.sample(u, w);
      Vec3d x = contribution(to_light, sampler.pdf_within(to_light));
      for (const Lobe& lobe : lobes) {
        const double a = random.uniform(), b = random.uniform();
        const Vec3d by_lobe = lobe.sample(a, b);
        if (by_lobe.z > 0) x += contribution(by_lobe, sampler.pdf(by_lobe));
      }
      mean.add(x);
    }
    result += mean.estimate();
  }
  if (around_ != nullptr) result += estimate_environment(frame, p, geometric, spp, random);
  return result;
}

}  // namespace steradian
