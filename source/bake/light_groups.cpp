#include "bake/light_groups.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "steradian/error.h"

namespace steradian::bake {
namespace {

template <class Lights>
bool take_named(const Lights& lights, const std::string& name, std::vector<std::uint8_t>& free, std::vector<std::uint8_t>& taken) {
  taken.assign(lights.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (free[i] == 0 || !lights[i].name.starts_with(name)) continue;
    free[i] = 0;
    taken[i] = 1;
    any = true;
  }
  return any;
}

std::string names_of_lights(const Scene& scene) {
  std::set<std::string> names;
  for (const AreaLight& light : scene.area_lights) names.insert(light.name);
  for (const PunctualLight& light : scene.punctual_lights) names.insert(light.name);
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + (name.empty() ? "(no name)" : name);
  return text;
}

}  // namespace

std::vector<NamedLights> light_groups(const Scene& scene, const std::vector<std::string>& names, const std::string& place) {
  std::vector<std::uint8_t> area(scene.area_lights.size(), 1), punctual(scene.punctual_lights.size(), 1);
  std::vector<NamedLights> groups;
  for (const std::string& name : names) {
    NamedLights& group = groups.emplace_back(NamedLights{name, {}, {}});
    const bool any = take_named(scene.area_lights, name, area, group.area);
    if (!take_named(scene.punctual_lights, name, punctual, group.punctual) && !any)
      throw Error(place, "has no light whose name begins with '" + name + "', or an earlier group has it",
                  "the lights are " + names_of_lights(scene));
  }
  const auto any = [](const std::vector<std::uint8_t>& left) { return std::find(left.begin(), left.end(), 1) != left.end(); };
  if (any(area) || any(punctual) || scene.environment) groups.push_back({kOtherLights, area, punctual, scene.environment != nullptr});
  return groups;
}

Scene in_light_of(const Scene& scene, const NamedLights& group) {
  Scene own = scene;
  for (std::size_t i = 0; i < own.area_lights.size(); ++i)
    if (group.area[i] == 0) {
      own.area_lights[i].radiance = {};
      own.area_lights[i].texture.reset();
      own.area_lights[i].emission.reset();
    }
  for (std::size_t i = 0; i < own.punctual_lights.size(); ++i)
    if (group.punctual[i] == 0) own.punctual_lights[i].intensity = {};
  if (!group.environment) own.environment.reset();
  return own;
}

LightMap bake_light_groups(const Scene& scene, const std::vector<NamedLights>& groups, const BakeOptions& options, const std::string& place,
                           Budget& budget, BakeStats& stats) {
  LightMap all;
  double mean = 0, residual = 0, error = 0;  // the last two are squares
  BakeOptions of_group = options;
  const auto count = static_cast<double>(groups.size());
  for (const NamedLights& group : groups) {
    BakeStats own;
    Budget left = budget;
    of_group.progress = part_of(options.progress, of_group.run / count, (of_group.run + 1) / count);
    LightMap map = bake_map(in_light_of(scene, group), of_group, place, left, &own);
    ++of_group.run;
    mean += own.mean;
    residual += std::pow(own.rms_residual * own.mean, 2);
    error += std::pow(own.rms_error * own.mean, 2);
    own.solve_ms += stats.solve_ms;
    own.sample_ms += stats.sample_ms;
    own.fit_ms += stats.fit_ms;
    own.largest_seam = std::max(own.largest_seam, stats.largest_seam);
    stats = own;
    std::vector<Vec3f> irradiance = map.irradiance;
    if (all.charts.empty()) {
      all = std::move(map);
    } else {
      for (std::size_t i = 0; i < irradiance.size(); ++i) {
        all.irradiance[i] += irradiance[i];
        all.error[i] += map.error[i];
      }
    }
    all.groups.push_back({group.name, std::move(irradiance)});
  }
  stats.mean = mean;
  stats.rms_residual = mean > 0 ? std::sqrt(residual) / mean : 0;
  stats.rms_error = mean > 0 ? std::sqrt(error) / mean : 0;
  return all;
}

}  // namespace steradian::bake
