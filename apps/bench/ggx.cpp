// kernel/closed-form/quad and its draft and high qualities, and the other methods for GGX, Beckmann and Blinn-Phong lobes: one quad on
// 16,384 pixels of a floor viewed at a slant. kernel/closed-form/quad/slopes: with the derivatives by all vertices.
#include <cmath>
#include <memory>
#include <tuple>
#include <vector>

#include "benches.h"
#include "integrals/methods.h"
#include "render/direct/vertex_slopes.h"

namespace steradian::bench {
namespace {

constexpr int kGgxSide = 128;

struct GgxFloor {
  std::vector<float> x, y, z, nx, ny, nz, vx, vy, vz, zero, alpha, plain, fresnel;
  PackLight light;

  Points points() const {
    return {x.size(),
            {x.data(), y.data(), z.data()},
            {nx.data(), ny.data(), nz.data()},
            {vx.data(), vy.data(), vz.data()},
            {zero.data(), zero.data(), zero.data()},
            alpha.data(),
            alpha.data()};
  }
};

// A floor of 8 by 8 m with gentle waves in its normals, and an upright quad that dips below it. The eye is 2 m above the floor's edge. The
// roughness rises from 0.1 to 0.85 from left to right. Pixels come in blocks of 4 by 4, as in the renderer's tiles.
std::shared_ptr<GgxFloor> ggx_make_floor() {
  auto floor = std::make_shared<GgxFloor>();
  for (int slot = 0; slot < kGgxSide * kGgxSide; ++slot) {
    const int block = slot / 16, within = slot % 16;
    const double i = block % (kGgxSide / 4) * 4 + within % 4, j = block / (kGgxSide / 4) * 4 + within / 4;
    const Vec3d p{8 * (i + 0.5) / kGgxSide - 4, 0, 8 * (j + 0.5) / kGgxSide};
    const Vec3d n = normalized(Vec3d{0.1 * std::sin(3 * p.x), 1.0, 0.1 * std::cos(2 * p.z)});
    const Vec3d v = normalized(Vec3d{0, 2, 9} - p);
    const double roughness = 0.1 + 0.75 * i / kGgxSide;
    const auto put = [](std::vector<float>& a, std::vector<float>& b, std::vector<float>& c, Vec3d w) {
      a.push_back(static_cast<float>(w.x));
      b.push_back(static_cast<float>(w.y));
      c.push_back(static_cast<float>(w.z));
    };
    put(floor->x, floor->y, floor->z, p);
    put(floor->nx, floor->ny, floor->nz, n);
    put(floor->vx, floor->vy, floor->vz, v);
    floor->alpha.push_back(static_cast<float>(roughness * roughness));
  }
  floor->zero.resize(floor->x.size());
  floor->plain.resize(floor->x.size());
  floor->fresnel.resize(floor->x.size());
  PolygonLight quad;
  quad.vertices = {{-1, -0.3, -0.5}, {1, -0.3, -0.5}, {1, 1.5, -0.7}, {-1, 1.5, -0.7}};
  floor->light = prepare_light(prepare_polygon(quad));
  return floor;
}

Bench ggx_packs(const std::string& name, Method method, Quality quality, const Material& lobe, Simd simd) {
  auto floor = ggx_make_floor();
  const auto run = lobe_packs_for(simd)[methods::procedure_of(method, lobe.brdf)];
  const auto tables = std::make_shared<LtcPackTables>(ltc_pack_tables(method, quality));
  return {name, floor->x.size(), name_of(simd), [=] {
            run(floor->light, floor->points(), {lobe, {method, quality}, tables.get()}, {floor->plain.data(), floor->fresnel.data()});
            keep(floor->plain.front());
          }};
}

Bench ggx_slopes(const std::string& name, Simd simd) {
  auto floor = ggx_make_floor();
  const auto walk = vertex_slope_packs_for(simd).closed_form;
  auto slopes = std::make_shared<std::vector<float>>(24 * floor->x.size());
  return {name, floor->x.size(), name_of(simd), [=] {
            GgxFloor& f = *floor;
            float* fresnel = slopes->data() + 12 * f.x.size();
            walk(f.light, f.points(), {{}, {Method::closed_form}}, {{f.plain.data(), f.fresnel.data()}, slopes->data(), fresnel});
            keep(slopes->front());
          }};
}

Material ggx() {
  Material m;
  m.brdf = Brdf::ggx;
  return m;
}

Material beckmann() {
  Material m;
  m.brdf = Brdf::beckmann;
  m.alpha_x = m.alpha_y = 0.25;
  return m;
}

Material blinn_phong() {
  Material m;
  m.brdf = Brdf::blinn_phong;
  m.exponent = 32;
  return m;
}

}  // namespace

void add_ggx(BenchList& list) {
  const std::tuple<const char*, Method, Quality, Material> named[] = {
      {"kernel/closed-form/quad", Method::closed_form, Quality::normal, ggx()},
      {"kernel/closed-form-draft/quad", Method::closed_form, Quality::draft, ggx()},
      {"kernel/closed-form-high/quad", Method::closed_form, Quality::high, ggx()},
      {"kernel/half-vector/ggx/quad", Method::half_vector, Quality::normal, ggx()},
      {"kernel/half-vector/beckmann/quad", Method::half_vector, Quality::normal, beckmann()},
      {"kernel/half-vector/blinn-phong/quad", Method::half_vector, Quality::normal, blinn_phong()},
      {"kernel/ltc-clipless/quad", Method::ltc_clipless, Quality::normal, ggx()},
      {"kernel/representative-point/quad", Method::representative_point, Quality::normal, ggx()},
  };
  for (const auto& [title, method, quality, lobe] : named) {
    const std::string name = title;
    list.add(name, [=](const BenchOptions& options) { return ggx_packs(name, method, quality, lobe, options.simd); });
    for (const Simd simd : available_simd()) {
      const std::string one = name + "/" + name_of(simd);
      list.add(one, [=](const BenchOptions&) { return ggx_packs(one, method, quality, lobe, simd); });
    }
  }
  const std::string slopes = "kernel/closed-form/quad/slopes";
  list.add(slopes, [=](const BenchOptions& options) { return ggx_slopes(slopes, options.simd); });
}

}  // namespace steradian::bench
