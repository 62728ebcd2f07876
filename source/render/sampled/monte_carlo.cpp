#include "render/sampled/monte_carlo.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/lattices.h"
#include "lobes/lobe.h"
#include "reference/azimuth_sampler.h"
#include "reference/balanced_mean.h"
#include "reference/spherical_region.h"
#include "reference/surface_sampler.h"
#include "shadow/region/light_frame.h"
#include "shapes/polygon.h"
#include "shapes/punctual.h"

namespace steradian {
namespace {

using lobes::Lobe;
using reference::AzimuthSampler;
using reference::BalancedMean;

// Fraction of the way to a surface that is left out: the rays are in float.
constexpr double kBeforeTheLight = 1e-6;

// Distance of the sun, in distances of the point from the origin and 1 more: only clear meshes before it count.
constexpr double kBeyond = 1e4;

// Sum over the lobes: radiance per unit of incident radiance.
Vec3d evaluate(const std::vector<Lobe>& lobes, Vec3d l) {
  Vec3d sum{};
  for (const Lobe& lobe : lobes) sum += lobe.radiance(lobe.evaluate(l));
  return sum;
}

}  // namespace

struct DirectSampler::Light {
  const AreaLight* area;
  std::optional<PreparedPolygon> polygon;  // none: a disk, an ellipsoid or a tube, which is sampled on its surface
};

struct DirectSampler::Scratch {
  reference::SphericalRegion region;
  AzimuthSampler sampler;
  std::vector<Lobe> lobes;
  std::vector<double> densities;  // of the light, and of each lobe

  // Finds the densities in a direction, and returns their sum.
  double find_densities(double of_light, Vec3d l) {
    densities.assign(1, of_light);
    double sum = of_light;
    for (const Lobe& lobe : lobes) sum += densities.emplace_back(lobe.pdf(l));
    return sum;
  }
};

DirectSampler::DirectSampler(const Scene& scene, const RayScene* shadows, const environment::EnvironmentSampler* around,
                             Terminator terminator, const ClassicTable* fitted)
    : scene_(scene),
      shadows_(shadows),
      clear_(scene),
      around_(around),
      terminator_(terminator),
      fitted_(fitted),
      scratch_(std::make_unique<Scratch>()) {
  for (const AreaLight& area : scene.area_lights) {
    Light light{&area, std::nullopt};
    if (std::holds_alternative<Line>(area.shape)) continue;
    if (std::holds_alternative<Polygon>(area.shape)) {
      light.polygon = prepare_polygon(flat_polygon(area));
      if (light.polygon->vertices.empty()) continue;
    }
    lights_.push_back(std::move(light));
  }
}

DirectSampler::~DirectSampler() = default;

Vec3d DirectSampler::beyond(Vec3d from, Vec3d direction) { return from + direction * kBeyond * (1 + length(from)); }

std::size_t DirectSampler::light_count() const { return lights_.size() + scene_.punctual_lights.size(); }

Estimate DirectSampler::estimate(const Surface& surface, Vec3f view, LobeChoice choice, int spp, reference::Random& random) {
  std::vector<SurfaceLobe> rest = lobes_of(surface, fitted_);
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
  BalancedMean mean(1 + lobes.size());
  const auto add = [&](Vec3d l, Vec3d direction) {
    if (!(l.z > 0)) return;
    const double pdf = scratch_->find_densities(around_->pdf(direction), l);
    if (!(pdf > 0) || (shadows_ != nullptr && (!above(geometric, direction) || shadows_->blocked_towards(p, direction)))) return;
    mean.add(evaluate(lobes, l) * around_->radiance(direction) * through(p, beyond(p, direction)) / pdf, scratch_->densities);
  };
  for (int i = 0; i < spp; ++i) {
    const double u = random.uniform(), v = random.uniform();
    const Vec3d from_map = around_->sample(u, v);
    add(frame.to_local(from_map), from_map);
    for (const Lobe& lobe : lobes) {
      const double a = random.uniform(), b = random.uniform();
      const Vec3d by_lobe = lobe.sample(a, b);
      add(by_lobe, frame.to_world(by_lobe));
    }
    mean.end_round();
  }
  return {mean.mean(), mean.variance()};
}

template <class Punctual, class Area>
Vec3d DirectSampler::visit_lights(const Frame& frame, const Surface& surface, Punctual punctual, Area area) {
  Scratch& scratch = *scratch_;
  // With shadows, the point is where closed forms look from (shadow::Viewpoint): off the triangle, and never below it.
  const auto geometric = static_cast<Vec3d>(surface.geometric_normal);
  auto p = static_cast<Vec3d>(surface.position);
  if (shadows_ != nullptr) p = shadows_->off_surface(p, geometric);

  for (const PunctualLight& light : scene_.punctual_lights) {
    const auto incident = shapes::incident<double>(packed::prepare(light), shapes::to_kernel<double>(p));
    const Vec3d to = {incident.direction.x.v, incident.direction.y.v, incident.direction.z.v}, l = frame.to_local(to);
    if (l.z <= 0) continue;
    if (shadows_ != nullptr) {
      if (!above(geometric, to)) continue;
      if (light.kind == PunctualKind::directional ? shadows_->blocked_towards(p, to) : shadows_->between(p, light.position, Casters::all))
        continue;
    }
    const Vec3d there = light.kind == PunctualKind::directional ? beyond(p, to) : light.position;
    punctual(l, light.intensity * incident.irradiance.v * through(p, there));
  }

  for (const Light& light : lights_) {
    const LightEmission* emission = light.area->emission ? &*light.area->emission : nullptr;
    if (!light.polygon) {
      const reference::SurfaceSampler sampler(*light.area, p);
      const auto incident = [&](const reference::SurfaceSampler::Place& place) -> Incident {
        if (!(place.density > 0)) return {};
        const Vec3d l = frame.to_local(place.direction);
        if (!(l.z > 0)) return {};
        if (shadows_ != nullptr && (!above(geometric, place.direction) ||
                                    shadows_->between(p, p + place.direction * (place.distance * (1 - kBeforeTheLight)), Casters::all)))
          return {};
        const Vec3d radiance = emission != nullptr ? emitted_radiance(*emission, -place.direction) : light.area->radiance;
        return {l, place.density, radiance * through(p, p + place.direction * (place.distance * (1 - kBeforeTheLight)))};
      };
      area([&](double u, double w) { return incident(sampler.sample(u, w)); },
           [&](Vec3d l) { return incident(sampler.towards(frame.to_world(l))); });
      continue;
    }
    const PreparedPolygon& polygon = *light.polygon;
    scratch.region.assign_above_horizon(polygon, p, frame);
    AzimuthSampler& sampler = scratch.sampler;
    sampler.prepare(scratch.region, reference::SphericalMeasure::solid_angle);
    if (!(sampler.measure() > 0)) continue;

    const double plane_height = dot(polygon.centroid - p, polygon.normal), eta = shadow::margin_of_plane(polygon);
    const LightTexture* texture = light.area->texture ? &*light.area->texture : nullptr;
    // Radiance that arrives from the light's point in direction l.
    const auto incident = [&](Vec3d l) -> Vec3d {
      if (shadows_ == nullptr && texture == nullptr && emission == nullptr) return polygon.radiance;
      const Vec3d direction = frame.to_world(l);
      const double distance = plane_height / dot(direction, polygon.normal);
      const Vec3d there = p + direction * distance;
      if (shadows_ != nullptr) {
        if (!above(geometric, direction)) return {};
        const double height = std::fabs(plane_height);
        if (shadows_->between(p, p + (there - p) * std::max(1 - eta / height, 0.0), Casters::all)) return {};
      }
      const Vec3d passes = through(p, there);
      if (emission != nullptr) return emitted_radiance(*emission, -direction) * passes;
      return (texture != nullptr ? texture_radiance(*texture, scene_.images, there) : polygon.radiance) * passes;
    };
    const auto with_density = [&](Vec3d l, double density) -> Incident {
      if (!(density > 0)) return {};
      return {l, density, incident(l)};
    };
    area(
        [&](double u, double w) {
          const Vec3d l = sampler.sample(u, w);
          return with_density(l, sampler.pdf_within(l));
        },
        [&](Vec3d l) { return with_density(l, sampler.pdf(l)); });
  }
  return p;
}

Estimate DirectSampler::estimate_in(const Frame& frame, const Surface& surface, int spp, reference::Random& random) {
  const std::vector<Lobe>& lobes = scratch_->lobes;
  Estimate result;
  const auto add = [&](BalancedMean& mean, const Incident& to) {
    if (!(to.density > 0)) return;
    const double pdf = scratch_->find_densities(to.density, to.direction);
    if (pdf > 0) mean.add(evaluate(lobes, to.direction) * (1 / pdf) * to.radiance, scratch_->densities);
  };
  const Vec3d p = visit_lights(
      frame, surface, [&](Vec3d l, Vec3d irradiance) { result.mean += irradiance * evaluate(lobes, l); },
      [&](auto sample, auto towards) {
        BalancedMean mean(1 + lobes.size());
        for (int i = 0; i < spp; ++i) {
          const double u = random.uniform(), w = random.uniform();
          add(mean, sample(u, w));
          for (const Lobe& lobe : lobes) {
            const double a = random.uniform(), b = random.uniform();
            const Vec3d by_lobe = lobe.sample(a, b);
            if (by_lobe.z > 0) add(mean, towards(by_lobe));
          }
          mean.end_round();
        }
        result += {mean.mean(), mean.variance()};
      });
  if (around_ != nullptr) result += estimate_environment(frame, p, static_cast<Vec3d>(surface.geometric_normal), spp, random);
  return result;
}

void DirectSampler::find_incident(const Surface& surface, int places, reference::Random& random, std::vector<IncidentLight>& found) {
  const auto geometric = static_cast<Vec3d>(surface.geometric_normal);
  const Frame frame = Frame::from_normal_and_tangent(normalized(static_cast<Vec3d>(surface.normal)), static_cast<Vec3d>(surface.tangent));
  const double shift = random.uniform() * 4096;
  std::uint32_t number = 0;  // of the light
  const auto add = [&](const Incident& x) {
    if (!(x.density > 0) || !(x.direction.z > 0)) return;
    const double solid_angle = 1 / (x.density * places);
    found.push_back({static_cast<Vec3f>(frame.to_world(x.direction)), static_cast<Vec3f>(x.radiance * (x.direction.z * solid_angle)),
                     static_cast<float>(solid_angle), number});
  };
  const Vec3d p = visit_lights(
      frame, surface,
      [&](Vec3d l, Vec3d irradiance) {
        found.push_back({static_cast<Vec3f>(frame.to_world(l)), static_cast<Vec3f>(irradiance * l.z), 0, number++});
      },
      [&](auto sample, auto) {
        for (int i = 0; i < places; ++i) {
          const auto [u, v] = r2_place(shift + i);
          add(sample(u, v));
        }
        ++number;
      });
  for (int i = 0; i < places && around_ != nullptr; ++i) {
    const auto [u, v] = r2_place(shift + i);
    const Vec3d to = around_->sample(u, v);
    if (shadows_ != nullptr && (!above(geometric, to) || shadows_->blocked_towards(p, to))) continue;
    add({frame.to_local(to), around_->pdf(to), around_->radiance(to) * through(p, beyond(p, to))});
  }
  std::erase_if(found, [](const IncidentLight& light) { return !weighs(light.irradiance); });
}

}  // namespace steradian
