// How much light does a square metre, one metre above, send to a surface that faces it?
#include <steradian/steradian.h>

#include <cstdio>

int main() {
  steradian::PolygonLight light;
  light.vertices = {{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}};  // lit from below
  const auto prepared = steradian::prepare_polygon(light);
  std::printf("irradiance %.15f\n", steradian::polygon_irradiance(prepared, {0, 0, 0}, {0, 1, 0}));

  const auto d = steradian::polygon_irradiance_derivatives(light, {0, 0, 0}, {0, 1, 0});
  std::printf("changes by %.15f when the point rises by a metre\n", d.position.y);
}
