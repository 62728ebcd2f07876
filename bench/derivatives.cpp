// kernel/lambert/quad/double and kernel/lambert/quad/derivatives: irradiance of a quad in double, without and with its
// derivatives by vertices, point and normal. Their ratio is what derivatives cost.
#include <memory>

#include "benches.h"
#include "steradian/polygon_derivatives.h"

namespace steradian::bench {
namespace {

constexpr std::size_t kPoints = 1000;

PolygonLight quad() {
  PolygonLight light;
  light.vertices = {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}};
  return light;
}

Vec3d point(std::size_t i) { return {1e-3 * static_cast<double>(i), 0.1, 0.0}; }

Bench plain(const std::string& name) {
  auto light = std::make_shared<PreparedPolygon>(prepare_polygon(quad()));
  return {name, kPoints, "scalar", [light] {
            double sum = 0;
            for (std::size_t i = 0; i < kPoints; ++i) sum += polygon_irradiance(*light, point(i), {0, 0, 1});
            keep(static_cast<float>(sum));
          }};
}

Bench with_derivatives(const std::string& name) {
  auto light = std::make_shared<PolygonLight>(quad());
  return {name, kPoints, "scalar", [light] {
            double sum = 0;
            for (std::size_t i = 0; i < kPoints; ++i)
              sum += polygon_irradiance_derivatives(*light, point(i), {0, 0, 1}).position.x;
            keep(static_cast<float>(sum));
          }};
}

}  // namespace

void add_derivatives(BenchList& list) {
  list.add("kernel/lambert/quad/double", [](const BenchOptions&) { return plain("kernel/lambert/quad/double"); });
  list.add("kernel/lambert/quad/derivatives",
           [](const BenchOptions&) { return with_derivatives("kernel/lambert/quad/derivatives"); });
}

}  // namespace steradian::bench
