#include "render/environment/environment_light.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "core/lattices.h"
#include "lobes/ggx_energy.h"
#include "lobes/lobe.h"
#include "lobes/visible_facets.h"
#include "steradian/area_light.h"  // luminance

namespace steradian::environment {
namespace {

// Resolution of the map for integrals: the sun's disc is one and a half texels wide.
constexpr int kMostColumns = 1024;
// Distance of the spots' polygons over the scene's radius: across the scene they move by less than 1e-4 rad.
constexpr double kDistance = 1e4;

std::vector<AreaLight> lights_of(const Scene& scene, const std::vector<PolygonLight>& polygons) {
  const Vec3d center = (scene.bounds_min + scene.bounds_max) * 0.5;
  const double radius = length(scene.bounds_max - scene.bounds_min) / 2, distance = kDistance * (radius > 0 ? radius : 1);
  std::vector<AreaLight> lights;
  for (PolygonLight polygon : polygons) {
    for (Vec3d& v : polygon.vertices) v = center + v * distance;
    AreaLight light = area_light(std::move(polygon));
    light.name = scene.environment->name;
    lights.push_back(std::move(light));
  }
  return lights;
}

constexpr std::size_t kGrazingSteps = 64;

double integrate_mean_grazing(double cos_view) {
  constexpr int kSteps = 48;
  const Vec3d view{std::sqrt(1 - cos_view * cos_view), 0, cos_view};
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double square = (i + 0.5) / kSteps, phi = std::numbers::pi * (j + 0.5) / kSteps;  // uniform in the projected area of the sky
      const Vec3d l{std::sqrt(square) * std::cos(phi), std::sqrt(square) * std::sin(phi), std::sqrt(1 - square)};
      sum += std::pow(1 - dot(view, normalized(view + l)), 5);
    }
  return sum / (kSteps * kSteps);
}

std::vector<Vec2f> points_of_disc(int count) {
  std::vector<Vec2f> points;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const auto [u, v] = fibonacci_place(i, static_cast<std::size_t>(count), 0);
    const double r = std::sqrt(u), phi = 2 * std::numbers::pi * v;
    points.push_back({static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi))});
  }
  return points;
}

}  // namespace

double mean_grazing(double cos_view) {
  static const auto table = [] {
    std::array<double, kGrazingSteps + 1> t;
    for (std::size_t i = 0; i <= kGrazingSteps; ++i) t[i] = integrate_mean_grazing(static_cast<double>(i) / kGrazingSteps);
    return t;
  }();
  const double x = std::clamp(cos_view, 0.0, 1.0) * kGrazingSteps;
  const auto i = std::min(static_cast<std::size_t>(x), kGrazingSteps - 1);
  const double t = x - static_cast<double>(i);
  return table[i] * (1 - t) + table[i + 1] * t;
}

Vec3f LobeCones::sum() const {
  Vec3f all{};
  for (std::size_t i = 0; i < count; ++i) all += cones[i].reflected;
  return all;
}

EnvironmentLight::EnvironmentLight(const Scene& scene, const ClassicTable* fitted)
    : EnvironmentLight(scene, fitted, DirectionGrid::averaged(scene.environment->map, kMostColumns)) {}

EnvironmentLight::EnvironmentLight(const Scene& scene, const ClassicTable* fitted, const DirectionGrid& grid)
    : EnvironmentLight(scene, fitted, grid, scene.environment->irradiance ? SplitMap{grid, {}, 0} : split_bright_spots(grid)) {}

EnvironmentLight::EnvironmentLight(const Scene& scene, const ClassicTable* fitted, const DirectionGrid& grid, const SplitMap& split)
    : environment_(*scene.environment),
      fitted_(fitted),
      spots_(lights_of(scene, split.spots)),
      share_(split.share),
      harmonics_(split.rest),
      filtered_(split.rest),
      sampler_(grid) {
  specular_residual_ = measured_residual(grid, split.rest);
}

double EnvironmentLight::measured_residual(const DirectionGrid& whole, const DirectionGrid& rest) const {
  constexpr int kColumns = 256, kViews = 24;
  const auto coarse = [](const DirectionGrid& g) { return DirectionGrid::repeated(DirectionGrid::averaged(g.map, kColumns), kColumns); };
  const DirectionGrid all = coarse(whole), left = coarse(rest);
  struct Texel {
    Vec3d direction;
    double all, left;  // luminance times solid angle
  };
  std::vector<Texel> texels;
  for (int j = 0; j < all.map.height; ++j)
    for (int i = 0; i < all.map.width; ++i)
      texels.push_back({all.center(i, j), luminance(static_cast<Vec3d>(all.map.at(i, j))) * all.solid_angle(j),
                        luminance(static_cast<Vec3d>(left.map.at(i, j))) * all.solid_angle(j)});
  double squares = 0, mean = 0;
  for (int i = 0; i < kViews; ++i) {
    const double golden = i * kGolden;
    const Vec3d normal = direction_of({golden - std::floor(golden), std::acos(1 - (2 * i + 1.0) / kViews) / std::numbers::pi});
    const Frame frame = Frame::from_normal(normal);
    const double tilt = 1.2 * (i % 4) / 4;
    const Vec3d view{std::sin(tilt), 0, std::cos(tilt)};
    for (const double roughness : {0.3, 0.6, 1.0}) {
      Material metal;
      metal.brdf = Brdf::ggx;
      metal.alpha_x = metal.alpha_y = roughness * roughness;
      metal.f0 = metal.f90 = {1, 1, 1};
      const lobes::Lobe lobe(lobes::in_frame(metal, frame), view);
      double of_all = 0, of_rest = 0;
      for (const Texel& t : texels) {
        const Vec3d l = frame.to_local(t.direction);
        if (!(l.z > 0)) continue;
        const double reflected = luminance(lobe.radiance(lobe.evaluate(l)));
        of_all += t.all * reflected;
        of_rest += t.left * reflected;
      }
      const auto alpha = static_cast<float>(metal.alpha_x);
      Vec3f sum{};
      each_ggx_cone(frame, static_cast<Vec3f>(view), alpha, alpha, LobeCones::kFew, 0,
                    [&](Vec3f, Vec3f radiance, float f0, float f90) { sum += radiance * (f0 + f90); });
      const double cones = luminance(static_cast<Vec3d>(sum));
      squares += (cones - of_rest) * (cones - of_rest);
      mean += of_all;
    }
  }
  constexpr double kCount = 3.0 * kViews;
  return mean > 0 ? std::sqrt(squares / kCount) / (mean / kCount) : 0;
}

// Irradiance times the fraction that passes the boundary above the surface under a uniform sky.
Vec3f EnvironmentLight::diffuse(const SurfaceLobe& of, Vec3f to_view) const {
  const Material& lobe = of.material;
  const Vec3d normal = normalized(static_cast<Vec3d>(of.normal)), view = normalized(static_cast<Vec3d>(to_view));
  const Vec3d irradiance = environment_.irradiance ? environment_.irradiance->at(normal) : harmonics_.at(normal);
  const double passed = lobe.fresnel_loss > 0 ? 1 - lobe.fresnel_loss * mean_grazing(dot(normal, view)) : 1;
  return static_cast<Vec3f>(lobe.albedo * irradiance * (passed / std::numbers::pi));
}

// Finds the cones of a GGX lobe by facets that are visible from the view, in float. Those of an isotropic lobe add up to its directional
// albedo.
//
//   view   in the lobe's frame, above its surface
//   use    use(axis, the map's mean in the cone, weight of F0, weight of F90)
template <class Use>
void EnvironmentLight::each_ggx_cone(const Frame& frame, Vec3f view, float ax, float ay, int count, double turn, Use use) const {
  static const std::vector<Vec2f> few = points_of_disc(LobeCones::kFew), most = points_of_disc(LobeCones::kMost);
  const std::vector<Vec2f>& points = count == LobeCones::kFew ? few : most;
  const auto turn_x = static_cast<float>(std::cos(2 * std::numbers::pi * turn)),
             turn_y = static_cast<float>(std::sin(2 * std::numbers::pi * turn));
  const auto turned = [&](std::size_t i) {
    return Vec2f{points[i].x * turn_x - points[i].y * turn_y, points[i].x * turn_y + points[i].y * turn_x};
  };
  std::array<lobes::FacetDirection, LobeCones::kMost> facets;
  std::size_t found = 0;
  lobes::LobeValue sum{};
  lobes::each_visible_facet(view, ax, ay, points.size(), turned, [&](const lobes::FacetDirection& facet) {
    facets[found++] = facet;
    sum += {static_cast<double>(facet.weight), static_cast<double>(facet.weight * facet.grazing)};
  });
  const double over = 1.0 / count;
  const lobes::LobeValue energy = ax == ay ? lobes::ggx_energy(static_cast<double>(ax), static_cast<double>(view.z)) : sum * over;
  const auto ratio = [](double whole, double part) { return part > 0 ? static_cast<float>(whole / part) : 0.0f; };
  const float of_f0 = ratio(energy.plain - energy.fresnel, sum.plain - sum.fresnel), of_f90 = ratio(energy.fresnel, sum.fresnel);
  const Vec3f fx = static_cast<Vec3f>(frame.x), fy = static_cast<Vec3f>(frame.y), fz = static_cast<Vec3f>(frame.z);
  for (std::size_t i = 0; i < found; ++i) {
    const lobes::FacetDirection& facet = facets[i];
    // A disc of solid angle 1 / (n density) varies by a quarter of its radius' square in each direction.
    const float width = 0.5f / std::sqrt(static_cast<float>(count) * facet.density * static_cast<float>(std::numbers::pi));
    const Vec3f axis = fx * facet.to.x + fy * facet.to.y + fz * facet.to.z;
    use(axis, filtered_.mean(axis, width), facet.weight * (1 - facet.grazing) * of_f0, facet.weight * facet.grazing * of_f90);
  }
}

// Finds the cones of any lobe: directions of equal probability, each with a cone of the sky as large as it represents.
LobeCones EnvironmentLight::cones_of(const SurfaceLobe& of, const Surface& surface, Vec3f to_view, int count, double turn) const {
  LobeCones result;
  const Material& material = of.material;
  const Vec3d tangent = material.tangent == Vec3d{} ? static_cast<Vec3d>(surface.tangent) : material.tangent;
  const Frame frame = Frame::from_normal_and_tangent(normalized(static_cast<Vec3d>(of.normal)), tangent);
  const Vec3d local_view = normalized(frame.to_local(normalized(static_cast<Vec3d>(to_view))));
  if (!(local_view.z > 0)) return result;
  if (material.brdf == Brdf::ggx && material.shadowing && !material.multiple_scattering && material.fitted == nullptr) {
    const Vec3f f0 = static_cast<Vec3f>(material.f0), f90 = static_cast<Vec3f>(material.f90);
    each_ggx_cone(frame, static_cast<Vec3f>(local_view), static_cast<float>(material.alpha_x), static_cast<float>(material.alpha_y), count,
                  turn,
                  [&](Vec3f axis, Vec3f radiance, float of_f0, float of_f90) { result.add(axis, radiance * (f0 * of_f0 + f90 * of_f90)); });
    return result;
  }
  const lobes::Lobe lobe(lobes::in_frame(material, frame), local_view);
  if (!lobe.above_surface()) return result;
  for (int i = 0; i < count; ++i) {
    const auto [u, v] = fibonacci_place(static_cast<std::size_t>(i), static_cast<std::size_t>(count), turn);
    const Vec3d l = lobe.sample(u, v);
    if (!(l.z > 0)) continue;
    const double pdf = lobe.pdf(l);
    if (!(pdf > 0)) continue;
    // A disc of solid angle 1 / (n pdf) varies by a quarter of its radius' square in each direction.
    const double width = 0.5 * std::sqrt(1 / (count * pdf * std::numbers::pi));
    const Vec3f axis = static_cast<Vec3f>(frame.to_world(l));
    const auto radiance = static_cast<Vec3d>(filtered_.mean(axis, static_cast<float>(width)));
    result.add(axis, static_cast<Vec3f>(lobe.radiance(lobe.evaluate(l)) * radiance * (1 / (count * pdf))));
  }
  return result;
}

Vec3f EnvironmentLight::reflected(const Surface& surface, Vec3f view) const {
  Vec3f sum{};
  for (const SurfaceLobe& lobe : lobes_of(surface, fitted_))
    sum += lobe.material.brdf == Brdf::lambert ? diffuse(lobe, view) : cones_of(lobe, surface, view, LobeCones::kFew, 0).sum();
  return sum;
}

}  // namespace steradian::environment
