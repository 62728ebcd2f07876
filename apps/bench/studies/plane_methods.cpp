#include "bench/studies/plane_methods.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "bench/run.h"
#include "plane/exact/outline.h"
#include "plane/exact/random.h"
#include "plane/exact/world.h"
#include "plane/stage/drawing.h"

namespace steradian::plane {
namespace {

constexpr int kLights[] = {1, 4, 16, 64}, kOccluders[] = {0, 25, 100, 400};
constexpr int kLightsAmongOccluders = 4, kOccludersAmongLights = 100;

struct NamedMethod {
  const char* name;
  std::function<Vec3d(const PlaneWorld&, Vec2d)> radiance;
};

const std::vector<NamedMethod>& methods() {
  const auto query = [](PlaneMethod method) {
    return [method](const PlaneWorld& world, Vec2d p) { return world.query(p, method, {64, 1}).radiance; };
  };
  static const std::vector<NamedMethod> all = {{"exact", query(PlaneMethod::exact)},
                                               {"par", query(PlaneMethod::par)},
                                               {"par, intervals added",
                                                [](const PlaneWorld& world, Vec2d p) {
                                                  const double scale = world.impl().scale;
                                                  return par_light(world.impl(), p * scale, ParOverlaps::added).radiance;
                                                }},
                                               {"sampled, 64 rays", query(PlaneMethod::sampled)},
                                               {"marched, 64 rays", query(PlaneMethod::marched)}};
  return all;
}

std::vector<Vec2d> points_among(const PlaneScene& scene, int count) {
  SceneRandom random(2);
  std::vector<Vec2d> points;
  while (static_cast<int>(points.size()) < count) {
    const Vec2d p{random.uniform(0, scene.width), random.uniform(0, scene.height)};
    if (std::none_of(scene.bodies.begin(), scene.bodies.end(), [&](const PlaneBody& body) { return contains(body, p); }))
      points.push_back(p);
  }
  return points;
}

void plane_methods_measure(int lights, int occluders, const MethodCostOptions& options, std::vector<MethodCost>& out) {
  const PlaneScene scene = make_light_field({lights, occluders, std::numeric_limits<double>::infinity(), 6, 12, 512, 512}, 1);
  const PlaneWorld world(scene);
  const std::vector<Vec2d> points = points_among(scene, options.points);
  std::vector<double> exact;
  double mean = 0;
  for (const Vec2d p : points) exact.push_back(world.query(p).radiance.x), mean += exact.back() / static_cast<double>(points.size());
  for (const NamedMethod& method : methods()) {
    MethodCost cost{method.name, lights, occluders, 0, 0};
    for (std::size_t i = 0; i < points.size(); ++i)
      cost.error_percent += 100 * std::fabs(method.radiance(world, points[i]).x - exact[i]) / (mean * static_cast<double>(points.size()));
    if (options.min_time > 0) {
      const Bench body{method.name, points.size(), "scalar", [&] {
                         double sum = 0;
                         for (const Vec2d p : points) sum += method.radiance(world, p).x;
                         keep(sum);
                       }};
      cost.microseconds = run_bench(body, {.min_time = options.min_time, .min_runs = 3}).ns_per_item / 1e3;
    }
    out.push_back(cost);
  }
}

std::string plane_methods_format(const char* pattern, double x) {
  char text[32];
  std::snprintf(text, sizeof text, pattern, x);
  return text;
}

}  // namespace

std::vector<MethodCost> measure_plane_methods(const MethodCostOptions& options) {
  std::vector<MethodCost> costs;
  for (const int lights : kLights) plane_methods_measure(lights, kOccludersAmongLights, options, costs);
  for (const int occluders : kOccluders)
    if (occluders != kOccludersAmongLights) plane_methods_measure(kLightsAmongOccluders, occluders, options, costs);
  return costs;
}

std::string plane_methods_text(const std::vector<MethodCost>& costs) {
  std::string text;
  const auto table = [&](const std::string& head, const auto& columns, auto scene) {
    text += "| " + head + ": microseconds a point, error |";
    for (const int n : columns) text += " " + std::to_string(n) + " |";
    text += "\n|---|";
    for (std::size_t i = 0; i < std::size(columns); ++i) text += "---|";
    for (const NamedMethod& method : methods()) {
      text += std::string("\n| `") + method.name + "` |";
      for (const int n : columns)
        for (const MethodCost& c : costs)
          if (c.method == method.name && scene(n) == std::pair(c.lights, c.occluders))
            text += plane_methods_format(" %.3g us, ", c.microseconds) + plane_methods_format("%.2g %% |", c.error_percent);
    }
    text += "\n\n";
  };
  table("lights, among " + std::to_string(kOccludersAmongLights) + " boxes", kLights,
        [](int n) { return std::pair(n, kOccludersAmongLights); });
  table("boxes, " + std::to_string(kLightsAmongOccluders) + " lights", kOccluders,
        [](int n) { return std::pair(kLightsAmongOccluders, n); });
  return text;
}

}  // namespace steradian::plane
