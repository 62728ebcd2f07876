// kernel/lambert/quad: irradiance of one quad on 16,384 pixels of a floor, all of which see the quad only in part; .../slopes: with its
// derivatives by all vertices. The same for a sphere and a capsule.
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "benches.h"
#include "render/direct/vertex_slopes.h"

namespace steradian::bench {
namespace {

constexpr std::size_t kLambertSide = 128;

struct LambertFloor {
  std::vector<float> x, y, z, nx, ny, nz, result;
  PreparedPolygon light;
  PackLight pack_light;

  Points points() const { return {x.size(), {x.data(), y.data(), z.data()}, {nx.data(), ny.data(), nz.data()}, {}}; }
};

// A floor of 8 by 8 m with gentle waves in its normals, and an upright quad that dips below it.
std::shared_ptr<LambertFloor> lambert_make_floor() {
  auto floor = std::make_shared<LambertFloor>();
  for (std::size_t j = 0; j < kLambertSide; ++j)
    for (std::size_t i = 0; i < kLambertSide; ++i) {
      const double x = 8.0 * (static_cast<double>(i) + 0.5) / kLambertSide - 4.0;
      const double z = 8.0 * (static_cast<double>(j) + 0.5) / kLambertSide;
      const Vec3d n = normalized(Vec3d{0.1 * std::sin(3 * x), 1.0, 0.1 * std::cos(2 * z)});
      floor->x.push_back(static_cast<float>(x));
      floor->y.push_back(0.0f);
      floor->z.push_back(static_cast<float>(z));
      floor->nx.push_back(static_cast<float>(n.x));
      floor->ny.push_back(static_cast<float>(n.y));
      floor->nz.push_back(static_cast<float>(n.z));
    }
  floor->result.resize(floor->x.size());
  PolygonLight quad;
  quad.vertices = {{-1, -0.3, -0.5}, {1, -0.3, -0.5}, {1.2, 1.5, -0.7}, {-1.1, 1.4, -0.7}};
  quad.vertices[3] = quad.vertices[0] + (quad.vertices[2] - quad.vertices[1]);  // flat: a parallelogram
  floor->light = prepare_polygon(quad);
  floor->pack_light = prepare_light(floor->light);
  return floor;
}

// A ball and a tube at the quad's place.
const Vec3d kCenter{0, 0.5, -0.6}, kHalf{1, 0.1, 0};
const Ellipsoid kBall = {kCenter, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}};
const Capsule kTube = {kCenter - kHalf, kCenter + kHalf, 0.1};

PackLight pack_light(const Shape& shape) {
  Scene scene;
  scene.area_lights = {AreaLight{shape}};
  PackLight result = prepare_lights(scene).front();
  result.area = nullptr;  // belongs to the scene; the irradiance does not need it
  return result;
}

Bench lambert_packs(const std::string& name, Simd simd, std::optional<Shape> shape = {}) {
  auto floor = lambert_make_floor();
  if (shape) floor->pack_light = pack_light(*shape);
  const auto irradiance = lobe_packs_for(simd)[methods::Procedure::diffuse];
  return {name, floor->x.size(), name_of(simd), [floor, irradiance] {
            irradiance(floor->pack_light, floor->points(), {}, {floor->result.data()});
            keep(floor->result.front());
          }};
}

Bench lambert_slopes(const std::string& name, Simd simd) {
  auto floor = lambert_make_floor();
  const auto walk = vertex_slope_packs_for(simd).diffuse;
  auto slopes = std::make_shared<std::vector<float>>(12 * floor->x.size());
  return {name, floor->x.size(), name_of(simd), [floor, walk, slopes] {
            walk(floor->pack_light, floor->points(), {}, {{floor->result.data()}, slopes->data()});
            keep(slopes->front());
          }};
}

// The library's float function, one point after the other.
Bench lambert_scalar(const std::string& name) {
  auto floor = lambert_make_floor();
  return {
      name, floor->x.size(), "scalar", [floor] {
        LambertFloor& f = *floor;
        for (std::size_t i = 0; i < f.x.size(); ++i)
          f.result[i] = polygon_irradiance_float(f.light, Vec3d(Vec3f{f.x[i], f.y[i], f.z[i]}), Vec3d(Vec3f{f.nx[i], f.ny[i], f.nz[i]}));
        keep(f.result.front());
      }};
}

}  // namespace

void add_lambert(BenchList& list) {
  const std::string name = "kernel/lambert/quad";
  list.add(name, [name](const BenchOptions& options) { return lambert_packs(name, options.simd); });
  for (const Simd simd : available_simd()) {
    const std::string one = name + "/" + name_of(simd);
    list.add(one, [one, simd](const BenchOptions&) { return lambert_packs(one, simd); });
  }
  for (const auto& [end, shape] : {std::pair<const char*, Shape>{"sphere", kBall}, {"capsule", kTube}}) {
    const std::string other = std::string("kernel/lambert/") + end;
    list.add(other, [other, kind = shape](const BenchOptions& options) { return lambert_packs(other, options.simd, kind); });
  }
  list.add(name + "/slopes", [name](const BenchOptions& options) { return lambert_slopes(name + "/slopes", options.simd); });
  list.add(name + "/scalar", [name](const BenchOptions&) { return lambert_scalar(name + "/scalar"); });
}

}  // namespace steradian::bench
