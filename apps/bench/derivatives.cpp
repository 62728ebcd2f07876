// kernel/{lambert,phong,ggx,ltc}/quad/double and .../derivatives: the radiance of a quad in double, and all its derivatives by vertices,
// point, normal and view (for lambert with the value).
#include <functional>
#include <memory>

#include "benches.h"
#include "steradian/phong.h"
#include "steradian/polygon_derivatives.h"

namespace steradian::bench {
namespace {

constexpr std::size_t kPoints = 1000;

PolygonLight quad() {
  PolygonLight light;
  light.vertices = {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}};
  return light;
}

ShadingPoint derivatives_at(std::size_t i) {
  return {{1e-3 * static_cast<double>(i), 0.1, 0.0}, {0, 0, 1}, normalized(Vec3d{0.3, 0.2, 0.9})};
}

// Sums over the points a number that only `evaluate` computes.
void derivatives_add(BenchList& list, const std::string& name, const std::function<double(const ShadingPoint&)>& evaluate) {
  list.add(name, [name, evaluate](const BenchOptions&) -> Bench {
    return {name, kPoints, "scalar", [evaluate] {
              double sum = 0;
              for (std::size_t i = 0; i < kPoints; ++i) sum += evaluate(derivatives_at(i));
              keep(static_cast<float>(sum));
            }};
  });
}

}  // namespace

void add_derivatives(BenchList& list) {
  const auto prepared = std::make_shared<PreparedPolygon>(prepare_polygon(quad()));
  derivatives_add(list, "kernel/lambert/quad/double",
                  [=](const ShadingPoint& p) { return polygon_irradiance(*prepared, p.position, p.normal); });
  derivatives_add(list, "kernel/lambert/quad/derivatives",
                  [=](const ShadingPoint& p) { return polygon_irradiance_derivatives(*prepared, p.position, p.normal).position.x; });

  const Material phong{.brdf = Brdf::phong, .exponent = 20.0};
  derivatives_add(list, "kernel/phong/quad/double", [=](const ShadingPoint& p) { return phong_radiance(*prepared, p, phong).x; });
  derivatives_add(list, "kernel/phong/quad/derivatives",
                  [=](const ShadingPoint& p) { return by_position(radiance_derivatives(*prepared, p, phong))[0].x; });

  Material ggx{.brdf = Brdf::ggx};
  ggx.alpha_x = ggx.alpha_y = 0.3;
  derivatives_add(list, "kernel/ggx/quad/double", [=](const ShadingPoint& p) { return closed_form_radiance(*prepared, p, ggx).x; });
  derivatives_add(list, "kernel/ggx/quad/derivatives",
                  [=](const ShadingPoint& p) { return by_position(radiance_derivatives(*prepared, p, ggx))[0].x; });
  derivatives_add(list, "kernel/ltc/quad/double",
                  [=](const ShadingPoint& p) { return ltc_radiance(LtcMethod::classic, *prepared, p, ggx).x; });
  derivatives_add(list, "kernel/ltc/quad/derivatives",
                  [=](const ShadingPoint& p) { return by_position(ltc_radiance_derivatives(LtcMethod::classic, *prepared, p, ggx))[0].x; });
}

}  // namespace steradian::bench
