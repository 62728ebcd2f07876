// Calls the layers that depend on packages. Its output equals the first output of examples/cpp.
#include <steradian/steradian.h>

#include <cstdio>

int main() {
  steradian::PolygonLight light;
  light.vertices = {{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}};
  std::printf("irradiance %.15f\n", steradian::polygon_irradiance(steradian::prepare_polygon(light), {0, 0, 0}, {0, 1, 0}));
  try {
    steradian::load_scene("no such scene.glb");
    return 1;
  } catch (const steradian::Error& e) {
    std::printf("%s\n", e.what());
  }
  steradian::Picture picture;
  try {
    picture = steradian::render({}, {});
  } catch (const steradian::Error& e) {
    std::printf("%s\n", e.what());
  }
  return 0;
}
