// kernel/{arvo,lorentzian,pearson,ellipsoid,series}/quad/n=N: a Phong plane under one upright quad, 16,384 pixels of
// the published comparison's scene (`steradian bench --table2` has the whole of it).
// vulkan/kernel/METHOD/{quad,star,triangle}/n=N: all of its 1280 x 720 pixels on a Vulkan device, one item an edge of a point; passes are
// the device's own time, of all and of one edge.
#include <algorithm>
#include <memory>

#include "benches.h"
#include "core/float_mode.h"
#include "bench/phong_methods.h"
#include "bench/phong_on_device.h"
#include "bench/phong_plane.h"

namespace steradian::bench {
namespace {

struct Scene {
  moment::PhongPlane plane = moment::make_phong_plane(160, 144);
  PreparedPolygon light = moment::comparison_lights()[0].light;
  PackLight pack_light = prepare_light(light);
  std::vector<float> result;
};

Bench packs(const std::string& name, PhongOptions options, double n, Simd simd) {
  auto scene = std::make_shared<Scene>();
  scene->result.resize(scene->plane.x.size());
  const auto radiance = phong_table_for(simd).radiance;
  return {name, scene->result.size(), name_of(simd), [=] {
            const FlushDenormals flush;
            radiance(scene->pack_light, scene->plane.points(), n, options, scene->result.data());
            keep(scene->result.front());
          }};
}

// The library's float function, one point after the other.
Bench scalar(const std::string& name, PhongOptions options, double n) {
  auto scene = std::make_shared<Scene>();
  Material material;
  material.brdf = Brdf::phong;
  material.exponent = n;
  const std::size_t count = scene->plane.count / 16;  // scalar is slow
  return {name, count, "scalar", [=] {
            const FlushDenormals flush;
            float sum = 0;
            for (std::size_t i = 0; i < count; ++i) sum += phong_radiance_float(scene->light, scene->plane.at(i * 16), material, options).x;
            keep(sum);
          }};
}

Bench on_device(const std::string& name, const std::string& light_name, const PhongOptions& options, int n, const std::string& device) {
  const moment::PhongPlane plane = moment::make_phong_plane(1280, 720);
  const std::vector<moment::NamedLight> lights = moment::comparison_lights();
  const auto light = std::find_if(lights.begin(), lights.end(), [&](const moment::NamedLight& l) { return l.name == light_name; });
  auto work = std::make_shared<PhongOnDevice>(plane, *light, n, options, device);
  const auto edges = static_cast<double>(light->edges);
  return {name,
          plane.count * light->edges,
          name_of(active_simd()),
          [work] { work->run(); },
          false,
          [work, edges] {
            return std::vector<BenchPass>{{"device", work->device_ms()}, {"an edge", work->device_ms() / edges}};
          }};
}

}  // namespace

void add_phong_on_device(BenchList& list, const std::string& device) {
  for (const PhongVariant& v : phong_variants())
    for (const char* light : {"quad", "star", "triangle"})
      for (const int n : kPhongExponents) {
        const std::string name = "vulkan/kernel/" + v.name + "/" + light + "/n=" + std::to_string(n);
        list.add(name, [=](const BenchOptions&) { return on_device(name, light, v.options, n, device); });
      }
}

void add_phong(BenchList& list) {
  for (const PhongVariant& v : phong_variants())
    for (const int n : kPhongExponents) {
      const std::string name = "kernel/" + v.name + "/quad/n=" + std::to_string(n);
      list.add(name, [=](const BenchOptions& options) { return packs(name, v.options, n, options.simd); });
      list.add(name + "/scalar", [=](const BenchOptions&) { return scalar(name + "/scalar", v.options, n); });
    }
}

}  // namespace steradian::bench
