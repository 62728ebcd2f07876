// kernel/{arvo,lorentzian,pearson,ellipsoid,series}/quad/n=N: a Phong plane under one upright quad, 16,384 pixels of the published
// comparison's scene (`steradian bench --table2` runs the whole comparison). kernel/series/slopes/n=N: with the derivatives by its
// vertices.
#include <memory>

#include "bench/phong_methods.h"
#include "bench/phong_plane.h"
#include "benches.h"
#include "core/float_mode.h"
#include "render/direct/vertex_slopes.h"

namespace steradian::bench {
namespace {

struct PhongScene {
  moment::PhongPlane plane = moment::make_phong_plane(160, 144);
  PreparedPolygon light = moment::comparison_lights()[0].light;
  PackLight pack_light = prepare_light(light);
  std::vector<float> result;
};

Bench phong_packs(const std::string& name, PhongOptions options, double n, Simd simd) {
  auto scene = std::make_shared<PhongScene>();
  scene->result.resize(scene->plane.x.size());
  const auto radiance = lobe_packs_for(simd)[methods::Procedure::phong_lobe];
  const PackLobe lobe = {moment::phong(n), options};
  return {name, scene->result.size(), name_of(simd), [=] {
            const FlushDenormals flush;
            radiance(scene->pack_light, scene->plane.points(), lobe, {scene->result.data()});
            keep(scene->result.front());
          }};
}

// The library's float function, one point after the other.
Bench phong_scalar(const std::string& name, PhongOptions options, double n) {
  auto scene = std::make_shared<PhongScene>();
  const Material material = moment::phong(n);
  const std::size_t count = scene->plane.count / 16;  // scalar is slow
  return {name, count, "scalar", [=] {
            const FlushDenormals flush;
            float sum = 0;
            for (std::size_t i = 0; i < count; ++i) sum += phong_radiance_float(scene->light, scene->plane.at(i * 16), material, options).x;
            keep(sum);
          }};
}

// All derivatives by vertices and the value, from one walk.
Bench phong_slopes(const std::string& name, double n, Simd simd) {
  auto scene = std::make_shared<PhongScene>();
  scene->result.resize(scene->plane.x.size());
  const auto walk = vertex_slope_packs_for(simd).phong;
  auto slopes = std::make_shared<std::vector<float>>(12 * scene->result.size());
  return {name, scene->result.size(), name_of(simd), [=] {
            const FlushDenormals flush;
            walk(scene->pack_light, scene->plane.points(), {moment::phong(n), {}}, {{scene->result.data()}, slopes->data()});
            keep(slopes->front());
          }};
}

}  // namespace

void add_phong(BenchList& list) {
  for (const int n : kPhongExponents) {
    const std::string name = "kernel/series/slopes/n=" + std::to_string(n);
    list.add(name, [=](const BenchOptions& options) { return phong_slopes(name, n, options.simd); });
  }
  for (const PhongVariant& v : phong_variants())
    for (const int n : kPhongExponents) {
      const std::string name = "kernel/" + v.name + "/quad/n=" + std::to_string(n);
      list.add(name, [=](const BenchOptions& options) { return phong_packs(name, v.options, n, options.simd); });
      list.add(name + "/scalar", [=](const BenchOptions&) { return phong_scalar(name + "/scalar", v.options, n); });
    }
}

}  // namespace steradian::bench
