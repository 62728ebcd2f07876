// kernel/ltc/quad, kernel/ltc-high/quad (Fresnel by a separate lobe), kernel/ltc-compact/quad: both lobes of one quad on 16,384 pixels of a
// floor that gets rougher away from the eye, decoding included. Most pixels see the whole quad. kernel/ltc/quad/specular: the glossy lobe
// alone; .../slopes: the same with its derivatives by all vertices. fit/ggx/64: the fitter.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "benches.h"
#include "fit/fit.h"
#include "render/direct/vertex_slopes.h"

namespace steradian::bench {
namespace {

using namespace fit;

constexpr std::size_t kLtcSide = 128;

struct GlossyFloor {
  std::vector<float> x, y, z, nx, ny, nz, vx, vy, vz, alpha, irradiance, specular, grazing;
  PackLight light;
  LtcPackTables tables;

  Points points() const {
    return {x.size(),    {x.data(), y.data(), z.data()}, {nx.data(), ny.data(), nz.data()}, {vx.data(), vy.data(), vz.data()}, {},
            alpha.data()};
  }
};

std::shared_ptr<GlossyFloor> ltc_make_floor(const LtcPackTables& tables) {
  auto floor = std::make_shared<GlossyFloor>();
  floor->tables = tables;
  const Vec3d eye = {0, 1.5, 9};
  for (std::size_t j = 0; j < kLtcSide; ++j)
    for (std::size_t i = 0; i < kLtcSide; ++i) {
      const Vec3d p = {8.0 * (static_cast<double>(i) + 0.5) / kLtcSide - 4.0, 0, 8.0 * (static_cast<double>(j) + 0.5) / kLtcSide};
      const Vec3d n = normalized(Vec3d{0.05 * std::sin(3 * p.x), 1.0, 0.05 * std::cos(2 * p.z)});
      const Vec3d v = normalized(eye - p);
      const auto push = [](std::vector<float>& to, double value) { to.push_back(static_cast<float>(value)); };
      push(floor->x, p.x), push(floor->y, p.y), push(floor->z, p.z);
      push(floor->nx, n.x), push(floor->ny, n.y), push(floor->nz, n.z);
      push(floor->vx, v.x), push(floor->vy, v.y), push(floor->vz, v.z);
      const double roughness = 0.1 + 0.8 * static_cast<double>(j) / kLtcSide;
      push(floor->alpha, roughness * roughness);
    }
  for (auto* out : {&floor->irradiance, &floor->specular, &floor->grazing}) out->resize(floor->x.size());
  PolygonLight quad;
  quad.vertices = {{-1, 0.3, -0.5}, {1, 0.3, -0.5}, {1, 1.5, -0.7}, {-1, 1.5, -0.7}};
  floor->light = prepare_light(prepare_polygon(quad));
  return floor;
}

Bench make(const std::string& name, Simd simd, Method method, Quality quality) {
  auto floor = ltc_make_floor(ltc_pack_tables(method, quality));
  const auto ltc = lobe_packs_for(simd)[methods::Procedure::ltc];
  return {name, floor->x.size(), name_of(simd), [=] {
            GlossyFloor& f = *floor;
            ltc(f.light, f.points(), {{}, {method, quality}, &f.tables}, {f.specular.data(), f.grazing.data(), f.irradiance.data()});
            keep(f.specular.front());
          }};
}

Bench ltc_specular(const std::string& name, Simd simd) {
  auto floor = ltc_make_floor(ltc_pack_tables(Method::ltc));
  const auto ltc = lobe_packs_for(simd)[methods::Procedure::ltc];
  return {name, floor->x.size(), name_of(simd), [=] {
            GlossyFloor& f = *floor;
            ltc(f.light, f.points(), {{}, {Method::ltc}, &f.tables}, {f.specular.data(), f.grazing.data()});
            keep(f.specular.front());
          }};
}

Bench ltc_slopes(const std::string& name, Simd simd) {
  auto floor = ltc_make_floor(ltc_pack_tables(Method::ltc));
  const auto walk = vertex_slope_packs_for(simd).ltc;
  auto slopes = std::make_shared<std::vector<float>>(12 * floor->x.size());
  return {name, floor->x.size(), name_of(simd), [=] {
            GlossyFloor& f = *floor;
            walk(f.light, f.points(), {{}, {Method::ltc}, &f.tables}, {{f.specular.data(), f.grazing.data()}, slopes->data()});
            keep(slopes->front());
          }};
}

void ltc_add(BenchList& list, const std::string& name, Method method, Quality quality) {
  list.add(name, [=](const BenchOptions& options) { return make(name, options.simd, method, quality); });
  for (const Simd simd : available_simd()) {
    const std::string one = name + "/" + name_of(simd);
    list.add(one, [=](const BenchOptions&) { return make(one, simd, method, quality); });
  }
}

// The whole fit of the shipped table's size; items are the table's cells.
Bench make_fit(int threads) {
  FitOptions fit;
  fit.threads = threads;
  Bench bench;
  bench.name = threads == 1 ? "fit/ggx/64" : "fit/ggx/64/threads=all";
  bench.items = static_cast<std::size_t>(fit.size * fit.size);
  bench.body = [fit] { keep(static_cast<float>(fit_table(lobe_family("ggx"), fit).cells.back().albedo)); };
  bench.one_core = threads == 1;
  bench.once = true;
  return bench;
}

}  // namespace

void add_ltc(BenchList& list) {
  ltc_add(list, "kernel/ltc/quad", Method::ltc, Quality::normal);
  ltc_add(list, "kernel/ltc-high/quad", Method::ltc, Quality::high);
  ltc_add(list, "kernel/ltc-compact/quad", Method::ltc_compact, Quality::normal);
  list.add("kernel/ltc/quad/specular", [](const BenchOptions& o) { return ltc_specular("kernel/ltc/quad/specular", o.simd); });
  list.add("kernel/ltc/quad/slopes", [](const BenchOptions& o) { return ltc_slopes("kernel/ltc/quad/slopes", o.simd); });
  list.add("fit/ggx/64", [](const BenchOptions&) { return make_fit(1); });
  list.add("fit/ggx/64/threads=all", [](const BenchOptions&) { return make_fit(0); });
}

}  // namespace steradian::bench
